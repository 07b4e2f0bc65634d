//! One parabola of a curved ray. Thesis 2.2 and 4.2; r is the horizontal distance from the eye, z the height.

/// z = half_bend (r - r0)² + slope (r - r0) + z0 for r0 <= r <= r1, z1 at r1.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Arc {
    pub r0: f64,
    pub r1: f64,
    pub z0: f64,
    pub z1: f64,
    pub slope: f64,
    pub half_bend: f64,
    /// Height of the turning point, or z1 where there is none.
    pub apex: f64,
}

impl Arc {
    #[inline]
    pub fn height(&self, r: f64) -> f64 {
        if r >= self.r1 {
            return self.z1;
        }
        let x = r - self.r0;
        (self.half_bend * x + self.slope) * x + self.z0
    }

    #[inline]
    pub fn slope_at(&self, r: f64) -> f64 {
        2.0 * self.half_bend * (r - self.r0) + self.slope
    }

    /// Height of the lowest point.
    #[inline]
    pub fn low(&self) -> f64 {
        self.z0.min(self.z1).min(self.apex)
    }

    /// Height of the highest point.
    #[inline]
    pub fn high(&self) -> f64 {
        self.z0.max(self.z1).max(self.apex)
    }

    /// Length of the curve from r0 to r: the closed form of ∫ sqrt(1 + z'²) dr, or Simpson's rule where the slope
    /// hardly changes and the closed form would lose its digits.
    pub fn length_to(&self, r: f64) -> f64 {
        let (s0, s1) = (self.slope, self.slope_at(r));
        let width = r - self.r0;
        if (s1 - s0).abs() < 1e-2 {
            let middle = 0.5 * (s0 + s1);
            return width / 6.0 * (s0.hypot(1.0) + 4.0 * middle.hypot(1.0) + s1.hypot(1.0));
        }
        let primitive = |s: f64| 0.5 * (s * s.hypot(1.0) + s.asinh());
        width * (primitive(s1) - primitive(s0)) / (s1 - s0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn length_has_two_forms_that_agree() {
        let arc = Arc { r0: 0.0, r1: 10.0, z0: 0.0, z1: 0.0, slope: 0.3, half_bend: 0.00049, apex: 0.0 };
        let primitive = |s: f64| 0.5 * (s * s.hypot(1.0) + s.asinh());
        let s1 = arc.slope_at(10.0);
        let closed = 10.0 * (primitive(s1) - primitive(0.3)) / (s1 - 0.3);
        assert!((arc.length_to(10.0) - closed).abs() < 1e-9);
    }
}
