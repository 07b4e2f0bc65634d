//! CHECKER: cubes of unit size that alternate between the surface's colour and the texture's, along x, y and z.
//! Thesis 7.5.5.4.

use glam::DVec3;

use super::Spot;
use super::placement::Placement;

#[derive(Clone, Copy, Debug)]
pub struct Checker {
    pub placement: Placement,
    pub color: DVec3,
}

impl Checker {
    /// The texture's colour where floor(x) + floor(y) + floor(z) is odd.
    pub fn color(&self, surface: DVec3, spot: &Spot) -> DVec3 {
        let cell = self.placement.point(spot.point).floor();
        // Each coordinate by itself: their sum need not be exact where they are large.
        let odd = |x: f64| x.rem_euclid(2.0) == 1.0;
        if odd(cell.x) ^ odd(cell.y) ^ odd(cell.z) { self.color } else { surface }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat4;

    #[test]
    fn neighbouring_cubes_alternate() {
        let checker = Checker { placement: Placement::new(DMat4::IDENTITY), color: DVec3::X };
        let is_texture = |x, y, z| {
            let spot = Spot { point: DVec3::new(x, y, z), uv: None };
            checker.color(DVec3::ZERO, &spot) == DVec3::X
        };
        assert!(!is_texture(0.5, 0.5, 0.5));
        assert!(is_texture(1.5, 0.5, 0.5));
        assert!(is_texture(-0.5, 0.5, 0.5));
        assert!(!is_texture(-0.5, -0.5, 0.5));
        assert!(is_texture(-0.5, -0.5, -0.5));
    }
}
