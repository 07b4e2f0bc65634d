//! The air: the temperature profile, and where curved rays end.

use m3d_kernel::optics::atmosphere::{Atmosphere, Limits};

use crate::generated::Mirage;
use crate::header::{count, number};
use crate::ir::Ir;
use crate::refusal::{Refusal, Result, damaged};

/// A profile may have so many points.
const MOST_POINTS: usize = 10_000;

/// The atmosphere, if the scene has a MIRAGE. Each interval of the profile becomes `finer` layers.
pub fn air(ir: &Ir, finer: usize) -> Result<Option<Atmosphere>> {
    let Some(Mirage { segments, distance, elevation }) = ir.globals.mirage else { return Ok(None) };
    let limits = Limits {
        segments: count(segments),
        distance: number(distance, "distance")?,
        elevation: number(elevation, "elevation")?,
    };
    let table = ir.table("profile");
    let (elevations, temperatures) = (table.numbers("elevation")?, table.numbers("temperature")?);
    if elevations.len() > MOST_POINTS {
        return Err(damaged(format!("the temperature profile has more than {MOST_POINTS} points")));
    }
    Atmosphere::new(elevations, temperatures, limits, finer).map(Some).map_err(Refusal::Limit)
}
