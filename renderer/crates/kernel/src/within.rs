//! A number held within two others, for any numbers at all.

/// x where it lies between `low` and `high`, else the nearer of the two; `low` for what is not a number, and `high` where
/// it lies below `low`. `f64::clamp` panics in the last case, which rounding brings about.
#[inline(always)]
pub fn within(x: f64, low: f64, high: f64) -> f64 {
    x.max(low).min(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_numbers_have_an_answer() {
        assert_eq!(within(0.5, 0.0, 1.0), 0.5);
        assert_eq!(within(-1.0, 0.0, 1.0), 0.0);
        assert_eq!(within(2.0, 0.0, 1.0), 1.0);
        assert_eq!(within(f64::NAN, 0.0, 1.0), 0.0);
        assert_eq!(within(0.5, 1.0, 0.0), 0.0);
        assert_eq!(within(0.5, f64::NAN, f64::NAN), 0.5);
    }
}
