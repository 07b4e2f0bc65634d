//! CHECKER: cubes of unit size that alternate between the surface's colour and the texture's, along x, y and z.
//! Thesis 7.5.5.4.
//!
//! A face between two cubes belongs to the one above it, along the texture's axes.

use glam::DVec3;

use super::placement::Placement;
use super::spot::Spot;

#[derive(Clone, Copy, Debug)]
pub struct Checker {
    pub placement: Placement,
    pub color: DVec3,
}

impl Checker {
    /// The texture's colour where floor(x) + floor(y) + floor(z) is odd.
    pub fn color(&self, surface: DVec3, spot: &Spot) -> DVec3 {
        let point = self.placement.point(spot.point);
        let cell = (point + self.placement.uncertainty(spot, point).min(DVec3::splat(0.5))).floor();
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
        let is_texture = |x, y, z| checker.color(DVec3::ZERO, &Spot::at(x, y, z)) == DVec3::X;
        assert!(!is_texture(0.5, 0.5, 0.5));
        assert!(is_texture(1.5, 0.5, 0.5));
        assert!(is_texture(-0.5, 0.5, 0.5));
        assert!(!is_texture(-0.5, -0.5, 0.5));
        assert!(is_texture(-0.5, -0.5, -0.5));
    }

    #[test]
    fn a_face_belongs_to_the_cube_above_it() {
        let turned = DMat4::from_rotation_x(0.7) * DMat4::from_scale(DVec3::new(3.0, 0.2, 70.0));
        for to_texture in [DMat4::IDENTITY, turned] {
            let checker = Checker { placement: Placement::new(to_texture), color: DVec3::X };
            let to_world = to_texture.inverse();
            for i in 0..1000 {
                let place =
                    |z: f64| to_world.transform_point3(DVec3::new(0.013 * f64::from(i) - 3.0, 0.4, z));
                let look = |z: f64| {
                    let point = place(z);
                    let uncertainty = crate::trace::uncertainty(point, 1e3);
                    checker.color(DVec3::ZERO, &Spot { point, uncertainty, uv: None })
                };
                for face in [-1.0, 0.0, 3.0] {
                    assert_eq!(look(face), look(face + 0.5));
                    assert_ne!(look(face - 1e-6), look(face + 0.5));
                }
            }
        }
    }
}
