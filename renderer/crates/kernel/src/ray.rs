//! A straight ray, what it hits, and the names of shapes.

use glam::DVec3;

/// Which shape of a scene, in 32 bits. In a leaf of a tree four of them, with the corners of facets, fill a cache line.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct ShapeId(u32);

/// Where a shape stands in `Shapes`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Row {
    Facet(usize),
    /// A row of those that are no facets.
    Other(usize),
}

impl ShapeId {
    /// Shapes there may be at most.
    pub const MOST: usize = 1 << 30;
    const OTHER: u32 = 1 << 31;

    pub fn facet(row: usize) -> Self {
        debug_assert!(row < Self::MOST);
        Self(row as u32)
    }

    pub fn other(row: usize) -> Self {
        debug_assert!(row < Self::MOST);
        Self(row as u32 | Self::OTHER)
    }

    #[inline]
    pub fn row(self) -> Row {
        if self.0 & Self::OTHER == 0 {
            Row::Facet(self.0 as usize)
        } else {
            Row::Other((self.0 & !Self::OTHER) as usize)
        }
    }
}

/// A straight ray r(t) = O + t D with D of unit length (thesis eq. 3.2), for t in `from`..`to`.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    pub origin: DVec3,
    pub direction: DVec3,
    /// Hits at `from` or nearer do not count.
    pub from: f64,
    /// Hits at `to` or farther do not count.
    pub to: f64,
    /// The shape the ray starts on, if any: a planar one is not met again, of a sphere only the far side.
    pub leaves: Option<ShapeId>,
}

impl Ray {
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction, from: 0.0, to: f64::INFINITY, leaves: None }
    }

    /// Whether it starts somewhere and leads somewhere.
    #[inline]
    pub fn is_finite(&self) -> bool {
        self.origin.is_finite() && self.direction.is_finite()
    }

    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }
}

/// Where along a ray the nearest shape is: `t` is a length on a straight ray, and the horizontal distance r from
/// the eye on a curved one.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Hit {
    pub t: f64,
    pub shape: ShapeId,
}

impl Hit {
    /// Of two hits at the same distance the one with the lower name is nearer, so that the order in which shapes are
    /// tested never shows.
    #[inline]
    pub fn is_nearer(&self, than: &Hit) -> bool {
        self.t < than.t || (self.t == than.t && self.shape < than.shape)
    }
}
