//! Lights.

use m3d_kernel::shade::illumination::{Light, Source};

use crate::generated::LightKind;
use crate::ir::Ir;
use crate::refusal::{Result, damaged};

pub fn lights(ir: &Ir) -> Result<Vec<Light>> {
    let table = ir.table("lights");
    let kind = table.plain::<i32>("kind")?;
    let (color, intensity) = (table.vectors("color")?, table.numbers("intensity")?);
    let (attenuation, exponent) = (table.numbers("attenuation")?, table.numbers("exponent")?);
    let angle = table.numbers("angle")?;
    let (position, direction) = (table.vectors("position")?, table.vectors("direction")?);
    let (shadows, highlights) = (table.plain::<bool>("shadows")?, table.plain::<bool>("highlights")?);
    (0..kind.len())
        .map(|i| {
            let angle = table.entry(angle, i)?;
            let source = match LightKind::numbered(kind[i]) {
                Some(LightKind::Infinite) => Source::Infinite,
                Some(LightKind::Point) => Source::Point {
                    position: table.entry(&position, i)?,
                    attenuation: table.entry(attenuation, i)?,
                    exponent: table.entry(exponent, i)?,
                    cone: if angle >= 180.0 { -2.0 } else { angle.to_radians().cos() },
                },
                None => return Err(damaged(format!("light {i} is of an unknown kind, {}", kind[i]))),
            };
            Ok(Light {
                source,
                color: table.entry(&color, i)?,
                intensity: table.entry(intensity, i)?,
                direction: table.entry(&direction, i)?.normalize_or_zero(),
                shadows: table.entry(shadows, i)?,
                highlights: table.entry(highlights, i)?,
            })
        })
        .collect()
}
