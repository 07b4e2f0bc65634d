//! The colour that a texture gives a surface where its function has the value t. Thesis 7.5.5.4, COLOR and
//! COLORS.

use glam::DVec3;

use super::color_range::{ColorRange, color_at};
use crate::within::within;

#[derive(Clone, Debug)]
pub struct Tint {
    pub color: DVec3,
    pub ranges: Vec<ColorRange>,
}

impl Tint {
    /// A blend from the surface's colour, t = 0, to the texture's, t = 1; with COLORS, the colour of the
    /// range that holds t, and the surface's own in the gaps.
    pub fn over(&self, surface: DVec3, t: f64) -> DVec3 {
        self.over_known(surface, t, 0.0)
    }

    /// The same for a t that may be constant over a surface, and is known to within `uncertainty`: where a range begins
    /// at it, it is within.
    pub fn over_known(&self, surface: DVec3, t: f64, uncertainty: f64) -> DVec3 {
        if t.is_nan() {
            return surface;
        }
        let t = within(t, 0.0, 1.0);
        if self.ranges.is_empty() {
            surface.lerp(self.color, t)
        } else {
            color_at(&self.ranges, (t + uncertainty).min(1.0)).unwrap_or(surface)
        }
    }
}

#[cfg(test)]
pub fn plain(color: DVec3) -> Tint {
    Tint { color, ranges: vec![] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_color_is_blended_and_ranges_are_looked_up() {
        assert_eq!(plain(DVec3::X).over(DVec3::Z, 0.25), DVec3::new(0.25, 0.0, 0.75));
        assert_eq!(plain(DVec3::X).over(DVec3::Z, 7.0), DVec3::X);
        let range = ColorRange { start: 0.5, end: 1.0, start_color: DVec3::ZERO, end_color: DVec3::Y };
        let tint = Tint { color: DVec3::X, ranges: vec![range] };
        assert_eq!(tint.over(DVec3::Z, 0.25), DVec3::Z);
        assert_eq!(tint.over(DVec3::Z, 0.75), 0.5 * DVec3::Y);
        assert_eq!(tint.over(DVec3::Z, 2.0), DVec3::Y);
        assert_eq!(plain(DVec3::X).over(DVec3::Z, f64::NAN), DVec3::Z);
    }
}
