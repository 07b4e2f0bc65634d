//! Random directions: of the rays that sample indirect light, and of normals made rough by FUZZ. Thesis 3.4 (2), (3).

use glam::DVec3;

use crate::random::Numbers;

/// The direction of a sample ray: three uniform numbers with random signs, turned into the hemisphere of a normal.
/// They lie densest towards the corners of a cube: N.D is 0.5156 on average for an N along an axis and 0.4907 for one
/// along a diagonal, where directions spread evenly would give 1/2.
pub fn into_hemisphere(numbers: &mut Numbers, normal: DVec3) -> DVec3 {
    // A normal of no direction has no hemisphere: then any direction must do.
    for _ in 0..8 {
        let direction = within_cube(numbers).normalize();
        let cosine = normal.dot(direction);
        if cosine > 0.0 {
            return direction;
        }
        if cosine < 0.0 {
            return -direction;
        }
    }
    within_cube(numbers).normalize()
}

/// A normal moved by a random vector, each of whose components is within ± `fuzz`. It stays on its side.
pub fn roughened(numbers: &mut Numbers, normal: DVec3, fuzz: f64) -> DVec3 {
    let deviation = fuzz * within_cube(numbers);
    let side = if normal.dot(normal + deviation) > 0.0 { 1.0 } else { -1.0 };
    (normal + side * deviation).normalize_or(normal)
}

fn within_cube(numbers: &mut Numbers) -> DVec3 {
    let [x, y, z] = std::array::from_fn(|_| numbers.signed());
    DVec3::new(x, y, z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Branch;

    #[test]
    fn samples_lie_in_the_hemisphere_and_keep_their_mean_cosine() {
        let mut numbers = Branch::of_sample(1, 2, 0).numbers();
        let mut sum = 0.0;
        for _ in 0..100_000 {
            let direction = into_hemisphere(&mut numbers, DVec3::Z);
            assert!(direction.z > 0.0 && (direction.length() - 1.0).abs() < 1e-12);
            sum += direction.z;
        }
        assert!((sum / 1e5 - 0.5156).abs() < 0.003, "{}", sum / 1e5);
    }

    #[test]
    fn without_a_normal_there_is_still_a_direction() {
        let mut numbers = Branch::of_sample(1, 2, 0).numbers();
        for normal in [DVec3::ZERO, DVec3::NAN] {
            assert!((into_hemisphere(&mut numbers, normal).length() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_rough_normal_stays_on_its_side_and_deviates_by_fuzz() {
        let mut numbers = Branch::of_sample(1, 2, 0).numbers();
        for fuzz in [0.01, 0.3, 1.0] {
            let mut sum = DVec3::ZERO;
            for _ in 0..20_000 {
                let normal = roughened(&mut numbers, DVec3::Z, fuzz);
                assert!(normal.z > 0.0 && (normal.length() - 1.0).abs() < 1e-12);
                sum += normal;
            }
            let mean = sum / 2e4;
            assert!(mean.x.abs() < 0.02 && mean.y.abs() < 0.02);
            assert!(fuzz > 0.1 || mean.z > 0.9999);
        }
        assert_eq!(roughened(&mut numbers, DVec3::Z, 0.0), DVec3::Z);
    }
}
