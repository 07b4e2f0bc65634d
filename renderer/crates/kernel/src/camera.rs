//! The pin-hole camera: from a pixel to the direction of its eye ray. Thesis 3.2.

use glam::DVec3;

/// Viewing geometry: eye O, the way from it to the view reference point VRP, and the unit vectors VR (right) and VUP
/// (up). The way, and not the point: far from the origin their difference would have lost its digits.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    pub eye: DVec3,
    pub ahead: DVec3,
    pub right: DVec3,
    pub up: DVec3,
    pub aspect: f64,
}

/// How many pixels the whole picture has.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Size {
    pub width: usize,
    pub height: usize,
}

impl Camera {
    /// D = (P - O)/|P - O| of pixel (x, y), counted from the top left, where
    /// P = VRP + (2u - 1) VR + (1 - 2v) (height/width) aspect VUP, u = x/(width - 1), v = y/(height - 1).
    /// Whole numbers are the pixels' middles.
    pub fn direction(&self, size: Size, x: f64, y: f64) -> DVec3 {
        let share = |i: f64, n: usize| if n > 1 { i / (n - 1) as f64 } else { 0.5 + i };
        let (u, v) = (share(x, size.width), share(y, size.height));
        let upright = size.height as f64 / size.width as f64 * self.aspect;
        let way = self.ahead + (2.0 * u - 1.0) * self.right + (1.0 - 2.0 * v) * upright * self.up;
        way.normalize_or_zero()
    }

    /// How far a point lies from the eye along the direction of view.
    pub fn depth(&self, point: DVec3) -> f64 {
        (point - self.eye).dot(self.ahead.normalize_or_zero())
    }
}
