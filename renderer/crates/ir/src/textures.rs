//! Textures, with the colour ranges and waves that they own.

use glam::DMat4;

use m3d_kernel::texture::Texture;
use m3d_kernel::texture::blend::{Along, Blend};
use m3d_kernel::texture::bumps::Bumps;
use m3d_kernel::texture::checker::Checker;
use m3d_kernel::texture::clouds::Clouds;
use m3d_kernel::texture::color_range::ColorRange;
use m3d_kernel::texture::gradient::Gradient;
use m3d_kernel::texture::granite::Granite;
use m3d_kernel::texture::heights::Heights;
use m3d_kernel::texture::marble::Marble;
use m3d_kernel::texture::placement::Placement;
use m3d_kernel::texture::ripples::Ripples;
use m3d_kernel::texture::snow::Snow;
use m3d_kernel::texture::spotted::Spotted;
use m3d_kernel::texture::squeeze::Squeeze;
use m3d_kernel::texture::tint::Tint;
use m3d_kernel::texture::wave::Wave;
use m3d_kernel::texture::waves::lowered_by_frequency;
use m3d_kernel::texture::wood::Wood;

use crate::generated::TextureKind;
use crate::ir::Ir;
use crate::refusal::{Result, damaged};
use crate::tables::Owned;

/// A row of `textures` before it is put on a solid.
pub struct TextureRow {
    kind: TextureKind,
    local: bool,
    inverse: DMat4,
    tint: Tint,
    turbulence: f64,
    squeeze: Squeeze,
    scale: f64,
    slope: f64,
    elevation: f64,
    waves: Vec<Wave>,
}

impl TextureRow {
    /// The texture on an object. World to texture space is the inverse object matrix where LOCAL, then the
    /// texture's own inverse.
    pub fn on(&self, object_inverse: DMat4, heights: Option<Heights>) -> Result<Texture> {
        let to_texture = if self.local { self.inverse * object_inverse } else { self.inverse };
        if !to_texture.is_finite() {
            return Err(damaged("the matrix of a texture is not finite"));
        }
        let placement = Placement::new(to_texture);
        let (tint, turbulence, squeeze, scale) =
            (self.tint.clone(), self.turbulence, self.squeeze, self.scale);
        let waves = &self.waves;
        Ok(match self.kind {
            TextureKind::Checker => Texture::Checker(Checker { placement, color: tint.color }),
            TextureKind::Wood => Texture::Wood(Wood { placement, tint, turbulence, squeeze }),
            TextureKind::Marble => Texture::Marble(Marble { placement, tint, turbulence, squeeze }),
            TextureKind::Spotted => Texture::Spotted(Spotted { placement, tint, scale }),
            TextureKind::Granite => Texture::Granite(Granite { placement, tint, turbulence }),
            TextureKind::Clouds => Texture::Clouds(Clouds { placement, tint, turbulence, squeeze }),
            TextureKind::Snow => Texture::Snow(Snow {
                placement,
                color: tint.color,
                heights,
                elevation: self.elevation,
                scale,
                steepest: self.slope.to_radians().cos(),
                turbulence,
            }),
            TextureKind::Gradient => Texture::Gradient(Gradient { placement, tint, heights, turbulence }),
            TextureKind::Bumps => {
                Texture::Bumps(Bumps { placement, scale, squeeze, turbulence, ranges: tint.ranges })
            }
            TextureKind::Waves => Texture::Ripples(lowered_by_frequency(placement, waves)),
            TextureKind::Ripples => Texture::Ripples(Ripples { placement, waves: waves.clone() }),
            TextureKind::Ublend => Texture::Blend(Blend { along: Along::U, tint }),
            TextureKind::Vblend => Texture::Blend(Blend { along: Along::V, tint }),
        })
    }
}

fn color_ranges(ir: &Ir) -> Result<Vec<ColorRange>> {
    let table = ir.table("color_ranges");
    let (start, end) = (table.numbers("start")?, table.numbers("end")?);
    let (start_color, end_color) = (table.vectors("start_color")?, table.vectors("end_color")?);
    (0..start.len())
        .map(|i| {
            Ok(ColorRange {
                start: start[i],
                end: table.entry(end, i)?,
                start_color: table.entry(&start_color, i)?,
                end_color: table.entry(&end_color, i)?,
            })
        })
        .collect()
}

fn waves(ir: &Ir) -> Result<Vec<Wave>> {
    let table = ir.table("waves");
    let center = table.vectors("center")?;
    let (amplitude, freq) = (table.numbers("amplitude")?, table.numbers("freq")?);
    let (phase, damp) = (table.numbers("phase")?, table.numbers("damp")?);
    (0..center.len())
        .map(|i| {
            Ok(Wave {
                center: center[i],
                amplitude: table.entry(amplitude, i)?,
                freq: table.entry(freq, i)?,
                phase: table.entry(phase, i)?,
                damp: table.entry(damp, i)?,
            })
        })
        .collect()
}

pub fn textures(ir: &Ir) -> Result<Vec<TextureRow>> {
    let (ranges, waves) = (color_ranges(ir)?, waves(ir)?);
    let table = ir.table("textures");
    let kind = table.plain::<i32>("kind")?;
    let local = table.plain::<bool>("local")?;
    let (color, inverse) = (table.vectors("color")?, table.matrices("inverse")?);
    let numbers = |column| table.numbers(column);
    let (turbulence, squeeze, scale) = (numbers("turbulence")?, numbers("squeeze")?, numbers("scale")?);
    let (slope, elevation) = (numbers("slope")?, numbers("elevation")?);
    let counts = |column| table.plain::<i32>(column);
    let (first_range, range_count) = (counts("first_color_range")?, counts("color_range_count")?);
    let (first_wave, wave_count) = (counts("first_wave")?, counts("wave_count")?);
    let mut owned_ranges = Owned::new("color_ranges", ranges.len());
    let mut owned_waves = Owned::new("waves", waves.len());
    (0..kind.len())
        .map(|i| {
            let part = |owned: &mut Owned, first: &[i32], count: &[i32]| {
                owned.take(table.entry(first, i)?, table.entry(count, i)?)
            };
            let used_ranges = part(&mut owned_ranges, first_range, range_count)?;
            let used_waves = part(&mut owned_waves, first_wave, wave_count)?;
            Ok(TextureRow {
                kind: TextureKind::numbered(kind[i])
                    .ok_or_else(|| damaged(format!("texture {i} is of an unknown kind, {}", kind[i])))?,
                local: table.entry(local, i)?,
                inverse: table.entry(&inverse, i)?,
                tint: Tint { color: table.entry(&color, i)?, ranges: ranges[used_ranges].to_vec() },
                turbulence: table.entry(turbulence, i)?,
                squeeze: Squeeze::new(table.entry(squeeze, i)?),
                scale: table.entry(scale, i)?,
                slope: table.entry(slope, i)?,
                elevation: table.entry(elevation, i)?,
                waves: waves[used_waves].to_vec(),
            })
        })
        .collect()
}
