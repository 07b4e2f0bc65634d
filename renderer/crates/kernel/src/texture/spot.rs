//! What a texture is told of a surface, and what it changes.

use glam::DVec3;

/// A point of a surface, as textures see it.
#[derive(Clone, Copy, Debug)]
pub struct Spot {
    /// World position.
    pub point: DVec3,
    /// Within which each of its coordinates is known.
    pub uncertainty: f64,
    /// u and v of the primitive, 0..1; a plane has none.
    pub uv: Option<(f64, f64)>,
}

/// What textures change. Each takes it as the one before has left it.
#[derive(Clone, Copy, Debug)]
pub struct Skin {
    pub color: DVec3,
    /// Unit vector, on the side one sees.
    pub normal: DVec3,
}

#[cfg(test)]
impl Spot {
    /// A point known exactly, of a shape without u and v.
    pub fn at(x: f64, y: f64, z: f64) -> Self {
        Self { point: DVec3::new(x, y, z), uncertainty: 0.0, uv: None }
    }
}
