//! What the kernel asks of a shape: the file of each kind of shape answers.

use glam::DVec3;

use crate::optics::crossing::{Crossing, Range};
use crate::optics::path::Path;
use crate::optics::radial_plane::RadialPlane;
use crate::ray::Ray;

/// How much room a shape takes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Bounds {
    /// It lies between two corners of a box.
    Box { low: DVec3, high: DVec3 },
    /// It has no end.
    Endless,
    /// It has no extent, or its coordinates are no numbers: no ray meets it.
    Nowhere,
}

impl Bounds {
    /// The box about these points.
    pub fn about(points: &[DVec3]) -> Self {
        let low = points.iter().copied().reduce(DVec3::min);
        let high = points.iter().copied().reduce(DVec3::max);
        low.zip(high).map_or(Self::Nowhere, |(low, high)| Self::Box { low, high })
    }
}

pub trait Geometry {
    fn bounds(&self) -> Bounds;

    /// Distance at which a straight ray meets the shape. `own` is whether the ray starts on this very shape: what counts
    /// is where it comes back, and a flat shape it does not meet again.
    fn meet(&self, ray: &Ray, own: bool) -> Option<f64>;

    /// Where a curve that runs in a radial plane first meets the shape.
    fn meet_curve(&self, plane: &RadialPlane, path: &mut Path, range: &mut Range) -> Option<Crossing>;

    /// Unit normal at a point of the shape, on either side.
    fn normal(&self, point: DVec3) -> DVec3;

    /// The unit vector that shades the point in place of the normal, on the normal's side; None where it is the normal.
    fn shading_normal(&self, _point: DVec3) -> Option<DVec3> {
        None
    }

    /// u and v of a point of the shape, each within 0..1; None for a shape that has none.
    fn uv(&self, point: DVec3) -> Option<(f64, f64)>;
}
