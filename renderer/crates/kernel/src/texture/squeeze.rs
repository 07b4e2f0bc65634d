//! SQUEEZE: how thin the features of a pattern are. Thesis 7.5.5.4.
//!
//! Only the upper 1/(1 + SQUEEZE) of a pattern's range is kept, and stretched to the whole of it: 0 leaves
//! the pattern as it is, 1 keeps its upper half, 3 its upper quarter. What is below becomes 0, the surface's
//! own colour.

#[derive(Clone, Copy, Debug)]
pub struct Squeeze {
    factor: f64,
}

impl Squeeze {
    /// A negative amount is none.
    pub fn new(amount: f64) -> Self {
        Self { factor: 1.0 + amount.max(0.0) }
    }

    /// 1 + SQUEEZE, by which a pattern is stretched.
    pub fn factor(self) -> f64 {
        self.factor
    }

    /// 1 - (1 - t)(1 + SQUEEZE), 0 at least.
    pub fn apply(self, t: f64) -> f64 {
        (1.0 - (1.0 - t) * self.factor).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_upper_part_is_kept() {
        assert_eq!(Squeeze::new(0.0).apply(0.25), 0.25);
        assert_eq!(Squeeze::new(1.0).apply(0.5), 0.0);
        assert_eq!(Squeeze::new(1.0).apply(0.75), 0.5);
        assert_eq!(Squeeze::new(3.0).apply(1.0), 1.0);
        assert_eq!(Squeeze::new(-5.0).apply(0.25), 0.25);
    }
}
