//! Noise in space, which most textures are made of. Thesis 3.5, after Perlin, "An Image Synthesizer" (1985).
//!
//! Every point of the integer lattice has a random value from 0 to 1. Between lattice points the values are
//! interpolated along the edges of the cell by the cubic 3s² - 2s³, first along x, then along y, then along
//! z: the noise has no step and no kink. It repeats every 4096 units along each axis. A lattice point is
//! hashed into a table of 256 values; hash and table are fixed for ever, so that a scene looks the same in
//! every version.
//!
//! Sums over octaves (the noise at 1, 2, 4, ... times the frequency and 1, 1/2, 1/4, ... of the strength)
//! look the same near and far. The octaves' lattices are shifted against each other, so that no point is
//! special to all.

use glam::DVec3;

/// Lattice points after which the noise repeats, along each axis.
pub const PERIOD: i64 = 4096;

/// Where the space between two numbers is 1.
const FARTHEST: f64 = (1u64 << 52) as f64;

/// Octaves of a sum: the finest details are 1/32 of the largest.
pub const OCTAVES: u32 = 6;

/// The numbers 0 to 255 in the order of a shuffled deck.
#[rustfmt::skip]
const RANDOM: [u8; 256] = [
    77, 34, 226, 224, 46, 230, 200, 188, 148, 128, 72, 106, 33, 215, 97, 119,
    244, 12, 178, 205, 61, 32, 242, 146, 223, 7, 160, 93, 129, 54, 172, 115,
    24, 154, 153, 76, 19, 120, 62, 199, 166, 127, 13, 96, 170, 221, 231, 149,
    53, 217, 36, 235, 11, 66, 0, 245, 25, 176, 184, 241, 10, 238, 44, 58,
    155, 83, 191, 165, 167, 219, 138, 40, 249, 104, 156, 179, 31, 81, 69, 174,
    196, 198, 192, 52, 190, 228, 197, 17, 136, 107, 185, 232, 161, 56, 60, 236,
    141, 139, 144, 110, 28, 43, 243, 73, 169, 16, 209, 80, 181, 182, 5, 51,
    252, 64, 212, 50, 208, 118, 177, 253, 234, 26, 183, 55, 125, 157, 122, 239,
    117, 111, 202, 163, 180, 23, 162, 132, 100, 14, 250, 193, 134, 248, 21, 20,
    105, 68, 88, 201, 124, 189, 255, 220, 78, 135, 175, 74, 145, 57, 131, 210,
    47, 35, 87, 195, 101, 94, 41, 84, 159, 247, 151, 150, 38, 113, 225, 240,
    2, 108, 137, 116, 152, 4, 206, 143, 22, 218, 254, 121, 216, 173, 86, 133,
    142, 75, 6, 207, 171, 63, 91, 109, 15, 211, 95, 92, 186, 3, 99, 126,
    123, 45, 98, 30, 213, 140, 65, 251, 214, 203, 49, 82, 8, 27, 37, 187,
    18, 164, 222, 59, 130, 194, 48, 1, 112, 168, 79, 237, 70, 204, 71, 103,
    90, 147, 102, 39, 89, 229, 85, 42, 227, 29, 9, 114, 233, 67, 158, 246,
];

/// Three large odd numbers, one an axis, that the hash multiplies lattice coordinates by.
const SPREAD: [u64; 3] = [0x9E37_79B9_7F4A_7C15, 0xC2B2_AE3D_27D4_EB4F, 0x1656_67B1_9E37_79F9];

/// The random value of a lattice point, from its three coordinates times `SPREAD`.
#[inline]
fn value(x: u64, y: u64, z: u64) -> f64 {
    let mixed = x.wrapping_add(y).wrapping_add(z);
    let mixed = (mixed ^ mixed >> 32).wrapping_mul(0xD6E8_FEB8_6659_FD93);
    f64::from(RANDOM[(mixed >> 56) as usize]) / 255.0
}

/// The lattice cell that holds a point: the values of its eight corners, by x, then y, then z, and where the
/// point is in it, 0..1.
struct Cell {
    corners: [f64; 8],
    inside: DVec3,
}

impl Cell {
    /// None so far away that there is nothing between lattice points.
    #[inline]
    fn at(point: DVec3) -> Option<Self> {
        if !point.to_array().iter().all(|x| x.abs() < FARTHEST) {
            return None;
        }
        let floor = point.to_array().map(|x| x as i64 - i64::from(x < x as i64 as f64));
        let [x, y, z] = std::array::from_fn(|axis| {
            let name = |i: i64| (i.rem_euclid(PERIOD) as u64).wrapping_mul(SPREAD[axis]);
            [name(floor[axis]), name(floor[axis] + 1)]
        });
        Some(Self {
            corners: std::array::from_fn(|i| value(x[i & 1], y[i >> 1 & 1], z[i >> 2])),
            inside: point - DVec3::from(floor.map(|x| x as f64)),
        })
    }
}

/// 3s² - 2s³, which goes from 0 to 1 and is flat at both ends.
#[inline]
pub fn cubic(s: f64) -> f64 {
    s * s * (3.0 - 2.0 * s)
}

#[inline]
fn between(a: f64, b: f64, share: f64) -> f64 {
    a + share * (b - a)
}

/// The noise at a point: 0..1, and 1/2 where the point is nowhere or too far away.
pub fn noise(point: DVec3) -> f64 {
    let Some(Cell { corners: c, inside: s }) = Cell::at(point) else {
        return 0.5;
    };
    let along_x = |edge: usize| between(c[2 * edge], c[2 * edge + 1], cubic(s.x));
    let along_y = |side: usize| between(along_x(2 * side), along_x(2 * side + 1), cubic(s.y));
    between(along_y(0), along_y(1), cubic(s.z))
}

/// The noise at a point and its gradient there: Perlin's Dnoise.
pub fn noise_and_gradient(point: DVec3) -> (f64, DVec3) {
    let Some(Cell { corners: c, inside: s }) = Cell::at(point) else {
        return (0.5, DVec3::ZERO);
    };
    let share = DVec3::new(cubic(s.x), cubic(s.y), cubic(s.z));
    let rate = 6.0 * s * (DVec3::ONE - s);
    let edge = |i: usize| {
        let (a, b) = (c[2 * i], c[2 * i + 1]);
        (between(a, b, share.x), (b - a) * rate.x)
    };
    let side = |i: usize| {
        let ((a, ax), (b, bx)) = (edge(2 * i), edge(2 * i + 1));
        (between(a, b, share.y), between(ax, bx, share.y), (b - a) * rate.y)
    };
    let ((a, ax, ay), (b, bx, by)) = (side(0), side(1));
    let gradient = DVec3::new(between(ax, bx, share.z), between(ay, by, share.z), (b - a) * rate.z);
    (between(a, b, share.z), gradient)
}

/// Where the i-th octave looks: at 2ⁱ times the point, shifted.
#[inline]
pub fn octave(point: DVec3, i: u32) -> DVec3 {
    let shift = DVec3::new(0.37, 0.71, 0.53);
    f64::from(1u32 << i) * point + f64::from(i) * shift
}

/// Turbulence: the sum of |signed noise| / f over the octaves f = 1, 2, 4, ..., with its creases; 0 to 2, and
/// mostly 0.3 to 0.9.
pub fn turbulence(point: DVec3) -> f64 {
    (0..OCTAVES).map(|i| (2.0 * noise(octave(point, i)) - 1.0).abs() / f64::from(1u32 << i)).sum()
}

/// The sum of signed noise / f over the octaves, without creases, divided by its largest value: -1 to 1.
pub fn fractal(point: DVec3) -> f64 {
    let (mut sum, mut most) = (0.0, 0.0);
    for i in 0..OCTAVES {
        let strength = 1.0 / f64::from(1u32 << i);
        sum += strength * (2.0 * noise(octave(point, i)) - 1.0);
        most += strength;
    }
    sum / most
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = DVec3> {
        let axis = || prop_oneof![-5.0..5.0f64, -9000.0..9000.0f64];
        (axis(), axis(), axis()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    /// The noise is what scenes were made with.
    #[test]
    fn lattice_values_never_change() {
        let at = |x, y, z| (255.0 * noise(DVec3::new(x, y, z))).round() as u8;
        let found = [
            at(0.0, 0.0, 0.0),
            at(1.0, 0.0, 0.0),
            at(0.0, 1.0, 0.0),
            at(0.0, 0.0, 1.0),
            at(-1.0, 2.0, -3.0),
            at(4095.0, 17.0, 1234.0),
        ];
        assert_eq!(found, [77, 146, 66, 46, 210, 207]);
    }

    #[test]
    fn the_table_holds_every_value_once() {
        let mut sorted = RANDOM;
        sorted.sort_unstable();
        assert!(sorted.iter().enumerate().all(|(i, &value)| i == usize::from(value)));
    }

    /// Thesis 3.5: the point (4097, -2, 1) is the lattice point (1, 4094, 1).
    #[test]
    fn the_thesis_example_of_the_period() {
        assert_eq!(noise(DVec3::new(4097.0, -2.0, 1.0)), noise(DVec3::new(1.0, 4094.0, 1.0)));
    }

    #[test]
    fn half_way_along_an_edge_is_the_mean_of_its_ends() {
        for axis in DVec3::AXES {
            let (a, b) = (noise(7.0 * axis), noise(8.0 * axis));
            assert!((noise(7.5 * axis) - 0.5 * (a + b)).abs() < 1e-12);
            assert!((noise(7.25 * axis) - (a + cubic(0.25) * (b - a))).abs() < 1e-12);
        }
    }

    /// Lattice values are spread evenly, and neighbours have nothing to do with each other.
    #[test]
    fn values_are_even_and_independent() {
        let lattice = |i: i32| DVec3::new(f64::from(i % 40), f64::from(i / 40 % 40), f64::from(i / 1600));
        let mean = (0..64_000).map(|i| noise(lattice(i))).sum::<f64>() / 64_000.0;
        assert!((mean - 0.5).abs() < 0.005, "{mean}");
        for step in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ONE, DVec3::new(1.0, -1.0, 0.0), 2.0 * DVec3::X] {
            let product = |i: i32| (noise(lattice(i)) - 0.5) * (noise(lattice(i) + step) - 0.5);
            let correlation = 12.0 * (0..64_000).map(product).sum::<f64>() / 64_000.0;
            assert!(correlation.abs() < 0.02, "{step}: {correlation}");
        }
    }

    #[test]
    fn nowhere_is_the_middle() {
        assert_eq!(noise(DVec3::new(f64::NAN, 0.0, 0.0)), 0.5);
        assert_eq!(noise_and_gradient(DVec3::splat(f64::INFINITY)), (0.5, DVec3::ZERO));
        assert_eq!(noise(DVec3::new(0.0, -1e300, 0.0)), 0.5);
        assert_ne!(noise(DVec3::splat(-4.5e15)), 0.5);
    }

    proptest! {
        #[test]
        fn all_values_lie_in_their_range(p in point()) {
            prop_assert!((0.0..=1.0).contains(&noise(p)));
            prop_assert!((0.0..2.0).contains(&turbulence(p)));
            prop_assert!((-1.0..=1.0).contains(&fractal(p)));
        }

        #[test]
        fn the_noise_repeats(
            x in -64i32..64, y in -64i32..64, z in -64i32..64, turns in -3i32..3, axis in 0usize..3,
        ) {
            // Eighths: a whole number of periods away they are the same numbers.
            let p = DVec3::new(f64::from(x), f64::from(y), f64::from(z)) / 8.0;
            let away = p + f64::from(turns) * PERIOD as f64 * DVec3::AXES[axis];
            prop_assert_eq!(noise_and_gradient(away), noise_and_gradient(p));
        }

        #[test]
        fn the_gradient_is_the_noises(p in point()) {
            let (here, gradient) = noise_and_gradient(p);
            prop_assert_eq!(here, noise(p));
            let step = 1e-5;
            for axis in DVec3::AXES {
                let slope = (noise(p + step * axis) - noise(p - step * axis)) / (2.0 * step);
                prop_assert!((slope - gradient.dot(axis)).abs() < 1e-3, "{} {}", slope, gradient);
            }
        }

        /// No step and no kink between two cells.
        #[test]
        fn neighbouring_cells_join(x in -5000i32..5000, y in -9.0..9.0f64, z in -9.0..9.0f64) {
            let at = |x: f64| noise_and_gradient(DVec3::new(x, y, z));
            let ((a, slope_a), (b, slope_b)) = (at(f64::from(x) - 1e-7), at(f64::from(x) + 1e-7));
            prop_assert!((a - b).abs() < 1e-6);
            prop_assert!((slope_a - slope_b).abs().max_element() < 1e-5);
        }
    }
}
