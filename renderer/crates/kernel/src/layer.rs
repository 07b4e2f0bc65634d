//! What a picture can hold beside its colours: for each pixel, what the ray through its middle came upon.

use crate::camera::Camera;
use crate::scene::{Owner, Shapes};

use crate::render::Sight;

/// One kind of extra output. Each value is a number a channel.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Layer {
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

impl Layer {
    pub const ALL: [(&'static str, Layer); 7] = [
        ("depth", Layer::Depth),
        ("normal", Layer::Normal),
        ("position", Layer::Position),
        ("solid", Layer::Solid),
        ("primitive", Layer::Primitive),
        ("uv", Layer::Uv),
        ("path", Layer::Path),
    ];

    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|(known, _)| *known == name).map(|(_, layer)| *layer)
    }

    pub fn channels(self) -> usize {
        match self {
            Layer::Depth | Layer::Solid | Layer::Primitive => 1,
            Layer::Uv | Layer::Path => 2,
            Layer::Normal | Layer::Position => 3,
        }
    }

    /// Writes the layer's channels to the front of `out`.
    pub fn write(self, sight: &Sight, camera: &Camera, shapes: &Shapes, out: &mut [f32]) {
        let met = sight.arrival.shape();
        let part = met.map(|(shape, ..)| shapes.part(shape));
        let values: [f64; 3] = match self {
            Layer::Depth => [met.map_or(f64::INFINITY, |(_, point, _)| camera.depth(point)), 0.0, 0.0],
            Layer::Normal => met.map_or([0.0; 3], |(shape, point, direction)| {
                shapes.normals(shape, point, direction).shading.to_array()
            }),
            Layer::Position => met.map_or([0.0; 3], |(_, point, _)| point.to_array()),
            Layer::Solid => match part.map(|part| part.owner) {
                Some(Owner::Solid(row)) => [row as f64, 0.0, 0.0],
                Some(Owner::Light(_)) | None => [-1.0, 0.0, 0.0],
            },
            Layer::Primitive => [part.map_or(-1.0, |part| part.primitive as f64), 0.0, 0.0],
            Layer::Uv => {
                let uv = met.and_then(|(shape, point, _)| shapes.uv(shape, point));
                uv.map_or([-1.0, -1.0, 0.0], |(u, v)| [u, v, 0.0])
            }
            Layer::Path => {
                let length = if met.is_some() { sight.arrival.length() } else { f64::INFINITY };
                [length, sight.arcs as f64, 0.0]
            }
        };
        for (out, value) in out.iter_mut().zip(values).take(self.channels()) {
            *out = value as f32;
        }
    }
}
