//! The header: what a scene says once, as JSON, and the checks of its numbers.

use glam::DVec3;
use serde::Deserialize;

use crate::generated::{Globals, VERSION};
use crate::refusal::{Result, damaged};
use crate::tables::coordinate;

#[derive(Deserialize)]
struct Header {
    format: String,
    version: u64,
    scene: Globals,
}

/// What a scene says once, of the header of a `.m3ir` file.
pub fn read(json: &str) -> Result<Globals> {
    let header: Header =
        serde_json::from_str(json).map_err(|error| damaged(format!("the header cannot be read: {error}")))?;
    if header.format != "m3ir" || header.version != VERSION {
        return Err(damaged(format!("the header is not that of a scene of version {VERSION}")));
    }
    Ok(header.scene)
}

pub fn number(value: f64, name: &str) -> Result<f64> {
    if value.is_finite() { Ok(value) } else { Err(damaged(format!("{name} is not finite"))) }
}

pub fn vector(value: [f64; 3], name: &str) -> Result<DVec3> {
    let vector = DVec3::from(value);
    if vector.is_finite() { Ok(vector) } else { Err(damaged(format!("{name} is not finite"))) }
}

/// A vector of the view within reach.
pub fn position(value: [f64; 3], name: &str) -> Result<DVec3> {
    let vector = vector(value, name)?;
    coordinate(vector.abs().max_element(), || format!("the view's {name}")).map(|_| vector)
}

/// A whole number; one below 0 counts as 0.
pub fn count(value: i64) -> usize {
    usize::try_from(value).unwrap_or(0)
}
