//! From the lowest to the highest z of the scene's finite shapes, by which SNOW and GRADIENT measure. Planes
//! do not count. Thesis 7.5.5.4.

use crate::within::within;

#[derive(Clone, Copy, Debug)]
pub struct Heights {
    pub low: f64,
    pub high: f64,
}

impl Heights {
    /// (Z_max - Z_min) share + Z_min.
    pub fn at(&self, share: f64) -> f64 {
        (self.high - self.low) * share + self.low
    }

    /// What share of the scene's height a length is, 1 at most.
    pub fn share_of(&self, length: f64) -> f64 {
        (length / (self.high - self.low)).min(1.0)
    }

    /// The share of the scene's height that z is at, 0..1; 0 in a scene without height.
    pub fn share(&self, z: f64) -> f64 {
        let share = (z - self.low) / (self.high - self.low);
        if share.is_finite() { within(share, 0.0, 1.0) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_thesis_example() {
        let heights = Heights { low: -20.0, high: 80.0 };
        assert_eq!(heights.at(0.7), 50.0);
        assert_eq!(heights.share(50.0), 0.7);
        assert_eq!(heights.share(-30.0), 0.0);
        assert_eq!(Heights { low: 1.0, high: 1.0 }.share(5.0), 0.0);
    }
}
