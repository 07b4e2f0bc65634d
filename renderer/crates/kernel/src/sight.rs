//! What an eye ray came upon, and how far it went for it.

use glam::DVec3;

use crate::ray::ShapeId;

/// How far a ray has come.
#[derive(Clone, Copy, Default, Debug)]
pub struct Way {
    /// As rounding grows with it: of a curve its horizontal part.
    pub rough: f64,
    /// Along the ray, as light goes; of a curve no more than `rough` where nobody asks for it.
    pub length: f64,
}

impl Way {
    pub fn and(self, further: f64) -> Self {
        Self { rough: self.rough + further, length: self.length + further }
    }
}

/// What a ray came upon. One that meets nothing goes on straight from the origin.
#[derive(Clone, Copy, Debug)]
pub enum Arrival {
    Shape { shape: ShapeId, point: DVec3, direction: DVec3, way: Way },
    Nothing { origin: DVec3, direction: DVec3, way: Way },
}

impl Arrival {
    /// The shape, where it was met, and the direction of the ray there.
    pub fn shape(&self) -> Option<(ShapeId, DVec3, DVec3)> {
        match *self {
            Arrival::Shape { shape, point, direction, .. } => Some((shape, point, direction)),
            Arrival::Nothing { .. } => None,
        }
    }

    /// How far the ray has come along its curve.
    pub fn length(&self) -> f64 {
        match self {
            Arrival::Shape { way, .. } | Arrival::Nothing { way, .. } => way.length,
        }
    }
}

/// What an eye ray came upon, and the number of arcs it is made of; a straight one has none.
#[derive(Clone, Copy, Debug)]
pub struct Sight {
    pub arrival: Arrival,
    pub arcs: usize,
}
