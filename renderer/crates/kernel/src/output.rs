//! What a picture can hold beside its colours: for each pixel, what the ray through its middle came upon.

use crate::camera::Camera;
use crate::shapes::{Owner, Shapes};
use crate::sight::Sight;

/// One kind of extra output. Each value is a number a channel.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Output {
    /// Distance along the direction of view; infinite where nothing is met.
    Depth,
    /// The unit vector that shades, as the shape has it: before textures and FUZZ.
    Normal,
    Position,
    /// Row of the scene's solids; -1 for none.
    Solid,
    /// Row of the scene's primitives; -1 for none.
    Primitive,
    /// u and v of the primitive; -1 where there are none.
    Uv,
    /// Length of the ray, bent as it is, infinite where nothing is met; and how many arcs it is made of.
    Path,
}

impl Output {
    pub const ALL: [(&'static str, Output); 7] = [
        ("depth", Output::Depth),
        ("normal", Output::Normal),
        ("position", Output::Position),
        ("solid", Output::Solid),
        ("primitive", Output::Primitive),
        ("uv", Output::Uv),
        ("path", Output::Path),
    ];

    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|(known, _)| *known == name).map(|(_, layer)| *layer)
    }

    pub fn channels(self) -> usize {
        match self {
            Output::Depth | Output::Solid | Output::Primitive => 1,
            Output::Uv | Output::Path => 2,
            Output::Normal | Output::Position => 3,
        }
    }

    /// Writes the output's channels to the front of `out`.
    pub fn write(self, sight: &Sight, camera: &Camera, shapes: &Shapes, out: &mut [f32]) {
        let met = sight.arrival.shape();
        let part = met.map(|(shape, ..)| shapes.part(shape));
        let values: [f64; 3] = match self {
            Output::Depth => [met.map_or(f64::INFINITY, |(_, point, _)| camera.depth(point)), 0.0, 0.0],
            Output::Normal => met.map_or([0.0; 3], |(shape, point, direction)| {
                shapes.normals(shape, point, direction).shading.to_array()
            }),
            Output::Position => met.map_or([0.0; 3], |(_, point, _)| point.to_array()),
            Output::Solid => match part.map(|part| part.owner) {
                Some(Owner::Solid(row)) => [f64::from(row), 0.0, 0.0],
                Some(Owner::Light(_)) | None => [-1.0, 0.0, 0.0],
            },
            Output::Primitive => [part.map_or(-1.0, |part| f64::from(part.primitive)), 0.0, 0.0],
            Output::Uv => {
                let uv = met.and_then(|(shape, point, _)| shapes.uv(shape, point));
                uv.map_or([-1.0, -1.0, 0.0], |(u, v)| [u, v, 0.0])
            }
            Output::Path => {
                let length = if met.is_some() { sight.arrival.length() } else { f64::INFINITY };
                [length, sight.arcs as f64, 0.0]
            }
        };
        for (out, value) in out.iter_mut().zip(values).take(self.channels()) {
            *out = value as f32;
        }
    }
}
