//! The vertical plane that a curved ray runs in, and what shapes leave in it: a line (plane), a segment (facet,
//! rectangle) or a circle (sphere). Thesis 4.2 and 4.3.

use glam::{DVec2, DVec3};

/// The plane through the eye O along the horizontal unit vector R (thesis 4.2). A point of it is (r, z): its distance
/// along R and its height.
#[derive(Clone, Copy, Debug)]
pub struct RadialPlane {
    pub origin: DVec3,
    pub radial: DVec2,
}

/// A straight line in the plane, a r + c z + d = 0 (thesis eq. 4.5, measured from the eye).
#[derive(Clone, Copy, Debug)]
pub struct Line {
    pub a: f64,
    pub c: f64,
    pub d: f64,
}

/// A part of a straight line from (r, z) = `start` to `end`, start.x <= end.x.
#[derive(Clone, Copy, Debug)]
pub struct Segment {
    pub start: DVec2,
    pub end: DVec2,
}

/// A circle about (r, z) = `center`.
#[derive(Clone, Copy, Debug)]
pub struct Circle {
    pub center: DVec2,
    pub radius: f64,
}

impl RadialPlane {
    /// Distance of a point along R.
    #[inline]
    pub fn along(&self, point: DVec3) -> f64 {
        let (x, y) = (point.x - self.origin.x, point.y - self.origin.y);
        x * self.radial.x + y * self.radial.y
    }

    /// Signed distance of a point from the plane.
    #[inline]
    pub fn beside(&self, point: DVec3) -> f64 {
        let (x, y) = (point.x - self.origin.x, point.y - self.origin.y);
        y * self.radial.x - x * self.radial.y
    }

    /// The point of the plane at distance r and height z.
    #[inline]
    pub fn point(&self, r: f64, z: f64) -> DVec3 {
        DVec3::new(self.origin.x + r * self.radial.x, self.origin.y + r * self.radial.y, z)
    }

    /// What the plane cuts out of a convex polygon. An edge is cut where its ends lie on different sides, an end on the
    /// plane counting as on the positive one, and its cut depends on nothing but the edge: neighbours share it exactly.
    #[inline]
    pub fn cut<const N: usize>(&self, corners: [&DVec3; N]) -> Option<Segment> {
        let beside = corners.map(|&corner| self.beside(corner));
        // A bit a corner: whether it lies on the positive side; then a bit an edge: whether its ends differ. No
        // branches, for none could be foreseen.
        let positive = (0..N).fold(0u32, |bits, i| bits | u32::from(beside[i] >= 0.0) << i);
        let crossing = positive ^ (positive >> 1 | (positive & 1) << (N - 1));
        let but_first = crossing & crossing.wrapping_sub(1);
        if but_first == 0 || but_first & (but_first - 1) != 0 {
            return None;
        }
        let first = crossing.trailing_zeros() as usize;
        let last = but_first.trailing_zeros() as usize;
        let cuts = [first, last].map(|i| {
            let j = if i + 1 == N { 0 } else { i + 1 };
            let (low, high) = if beside[i] < 0.0 { (i, j) } else { (j, i) };
            let share = beside[low] / (beside[low] - beside[high]);
            let (from, to) = (corners[low], corners[high]);
            let (r0, r1) = (self.along(*from), self.along(*to));
            DVec2::new(r0 + share * (r1 - r0), from.z + share * (to.z - from.z))
        });
        let [start, end] = if cuts[0].x <= cuts[1].x { cuts } else { [cuts[1], cuts[0]] };
        Some(Segment { start, end })
    }
}
