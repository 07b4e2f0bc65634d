//! Random numbers that depend on nothing but what they are for: the pixel, the sample of it, and the branch of the
//! tree of rays. No thread, no order of work and no part of the picture can be told from them.
//!
//! Philox4x32-10 of Salmon, Moraes, Dror and Shaw, *Parallel Random Numbers: As Easy as 1, 2, 3* (2011): ten rounds
//! of multiplication make four random words of a counter and a key. Pixel, sample and block are the counter, the
//! branch of the tree is the key.

/// A branch of the tree of rays behind one sample of a pixel.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Branch {
    pixel: [u32; 2],
    sample: u32,
    node: u64,
}

impl Branch {
    /// Where the eye ray of a sample arrives.
    pub fn of_sample(x: usize, y: usize, sample: usize) -> Self {
        Self { pixel: [x as u32, y as u32], sample: sample as u32, node: 0 }
    }

    /// Of the branches that begin at its end, the one of a number.
    pub fn child(self, number: u64) -> Self {
        Self { node: scramble(self.node ^ scramble(number.wrapping_add(1))), ..self }
    }

    /// The numbers that are drawn here, always the same ones.
    pub fn numbers(self) -> Numbers {
        Numbers { branch: self, block: [0; 4], drawn: 0 }
    }
}

/// Numbers drawn one after another.
#[derive(Clone, Debug)]
pub struct Numbers {
    branch: Branch,
    block: [u32; 4],
    drawn: u32,
}

impl Numbers {
    /// The next one, above 0 and below 1.
    pub fn unit(&mut self) -> f64 {
        let at = self.drawn % 4;
        if at == 0 {
            let Branch { pixel: [x, y], sample, node } = self.branch;
            self.block = philox([x, y, sample, self.drawn / 4], [node as u32, (node >> 32) as u32]);
        }
        self.drawn = self.drawn.wrapping_add(1);
        (f64::from(self.block[at as usize]) + 0.5) * 2f64.powi(-32)
    }

    /// The next one with a random sign: above -1 and below 1.
    pub fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }
}

/// Spreads the bits of a number over all others: the finish of SplitMix64 (Steele, Lea and Flood 2014).
fn scramble(number: u64) -> u64 {
    let mut z = number.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

fn philox(mut counter: [u32; 4], mut key: [u32; 2]) -> [u32; 4] {
    let product = |a: u32, b: u32| {
        let wide = u64::from(a) * u64::from(b);
        ((wide >> 32) as u32, wide as u32)
    };
    for _ in 0..10 {
        let (high0, low0) = product(0xD251_1F53, counter[0]);
        let (high1, low1) = product(0xCD9E_8D57, counter[2]);
        counter = [high1 ^ counter[1] ^ key[0], low1, high0 ^ counter[3] ^ key[1], low0];
        key = [key[0].wrapping_add(0x9E37_79B9), key[1].wrapping_add(0xBB67_AE85)];
    }
    counter
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The known answers of the authors' own library, Random123.
    #[test]
    fn philox_is_philox() {
        let expected = [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8];
        assert_eq!(philox([0; 4], [0; 2]), expected);
        let expected = [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd];
        assert_eq!(philox([u32::MAX; 4], [u32::MAX; 2]), expected);
        let counter = [0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344];
        let expected = [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1];
        assert_eq!(philox(counter, [0xa409_3822, 0x299f_31d0]), expected);
    }

    #[test]
    fn numbers_are_uniform_and_differ_from_branch_to_branch() {
        let here = Branch::of_sample(3, 5, 0);
        let draw = |branch: Branch| -> Vec<f64> {
            let mut numbers = branch.numbers();
            (0..10_000).map(|_| numbers.unit()).collect()
        };
        let mut seen = draw(here);
        assert_eq!(seen, draw(here));
        let others = [here.child(0), here.child(1), here.child(0).child(0), Branch::of_sample(5, 3, 0)];
        for other in others.into_iter().chain([Branch::of_sample(3, 5, 1)]) {
            assert_ne!(seen, draw(other));
        }
        let mean = seen.iter().sum::<f64>() / 1e4;
        let spread = seen.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / 1e4;
        assert!((mean - 0.5).abs() < 0.01 && (spread - 1.0 / 12.0).abs() < 0.003, "{mean} {spread}");
        seen.sort_by(f64::total_cmp);
        let farthest = seen.iter().enumerate().map(|(i, x)| (x - i as f64 / 1e4).abs()).fold(0.0, f64::max);
        assert!(farthest < 0.02, "{farthest}"); // Kolmogorov and Smirnov: 0.0163 at 1 %
    }
}
