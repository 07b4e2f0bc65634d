//! Where a texture is: from the world, or with LOCAL from the object, into the texture's own space. Thesis
//! 7.5.5.4, LOCAL and TRANSFORM.

use glam::{DMat3, DMat4, DVec3};

use super::spot::Spot;

#[derive(Clone, Copy, Debug)]
pub struct Placement {
    to_texture: DMat4,
    /// How far, by axis of texture space, a step of one along each of the world's axes leads at most.
    stretch: DVec3,
    /// What takes normals there, and back.
    normals: DMat3,
    normals_back: DMat3,
}

impl Placement {
    /// By the matrix from the world to texture space.
    pub fn new(to_texture: DMat4) -> Self {
        let normals_back = DMat3::from_mat4(to_texture).transpose();
        let [x, y, z] =
            [to_texture.x_axis, to_texture.y_axis, to_texture.z_axis].map(|axis| axis.abs().truncate());
        Self { to_texture, stretch: x + y + z, normals: normals_back.inverse(), normals_back }
    }

    /// A point of the world in texture space.
    pub fn point(&self, point: DVec3) -> DVec3 {
        self.to_texture.transform_point3(point)
    }

    /// Within which each coordinate in texture space of a spot is known, `point` being where it is there.
    pub fn uncertainty(&self, spot: &Spot, point: DVec3) -> DVec3 {
        spot.uncertainty * self.stretch + 4.0 * f64::EPSILON * point.abs()
    }

    /// The normal of a surface that is raised along its normal, in texture space, by a height of this
    /// gradient. The raised surface is taken back to the world as a whole: a texture that is shrunk keeps its
    /// slopes. N' = N - ∇h without the part of ∇h along N; the normal stays as it is where that makes no
    /// sense.
    pub fn raised(&self, normal: DVec3, gradient: DVec3) -> DVec3 {
        let there = (self.normals * normal).normalize_or_zero();
        let along_surface = gradient - gradient.dot(there) * there;
        (self.normals_back * (there - along_surface)).try_normalize().unwrap_or(normal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tangents of the surface raised in texture space, taken to the world, are at right angles to the
    /// normal.
    #[test]
    fn the_normal_is_that_of_the_raised_surface() {
        let to_world = DMat4::from_scale(DVec3::new(0.5, 3.0, -2.0)) * DMat4::from_rotation_x(0.7);
        let to_texture = to_world.inverse();
        let placement = Placement::new(to_texture);
        let normal = DVec3::new(0.3, -0.5, 0.8).normalize();
        let gradient = DVec3::new(0.4, 0.9, -0.2);
        let found = placement.raised(normal, gradient);
        assert!((found.length() - 1.0).abs() < 1e-12 && found.dot(normal) > 0.0);
        for tangent in [normal.any_orthonormal_vector(), normal.cross(normal.any_orthonormal_vector())] {
            let along = to_texture.transform_vector3(tangent);
            let up = (DMat3::from_mat4(to_world).transpose() * normal).normalize();
            let raised = to_world.transform_vector3(along + gradient.dot(along) * up);
            assert!(found.dot(raised).abs() < 1e-12);
        }
    }

    #[test]
    fn slopes_do_not_depend_on_size() {
        let gradient = DVec3::new(0.4, 0.9, 0.0);
        let at = |size| Placement::new(DMat4::from_scale(DVec3::splat(size))).raised(DVec3::Z, gradient);
        assert!((at(1.0) - at(7.0)).length() < 1e-12);
        assert!((at(1.0) - DVec3::new(-0.4, -0.9, 1.0).normalize()).length() < 1e-12);
    }

    #[test]
    fn a_senseless_slope_leaves_the_normal() {
        let flat = Placement::new(DMat4::ZERO);
        assert_eq!(flat.raised(DVec3::Z, DVec3::X), DVec3::Z);
        let placement = Placement::new(DMat4::IDENTITY);
        assert_eq!(placement.raised(DVec3::Z, DVec3::new(f64::NAN, 0.0, 0.0)), DVec3::Z);
        assert_eq!(placement.raised(DVec3::Z, DVec3::new(f64::INFINITY, 0.0, 0.0)), DVec3::Z);
    }
}
