//! COLORS: the interval 0..1 divided into ranges, each a blend between two colours. Thesis 7.5.5.4.

use glam::DVec3;

#[derive(Clone, Copy, Debug)]
pub struct ColorRange {
    pub start: f64,
    pub end: f64,
    pub start_color: DVec3,
    pub end_color: DVec3,
}

/// The blend within the range that holds t, start <= t < end; None in a gap between ranges. A range that ends at 1
/// holds 1.
pub fn color_at(ranges: &[ColorRange], t: f64) -> Option<DVec3> {
    let holds = |range: &&ColorRange| range.start <= t && (t < range.end || (t == 1.0 && range.end == 1.0));
    let range = ranges.iter().find(holds)?;
    Some(range.start_color.lerp(range.end_color, (t - range.start) / (range.end - range.start)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_blend_and_gaps_do_not() {
        let range = |start, end| ColorRange { start, end, start_color: DVec3::ZERO, end_color: DVec3::ONE };
        let ranges = [range(0.0, 0.5), range(0.75, 1.0)];
        assert_eq!(color_at(&ranges, 0.25), Some(DVec3::splat(0.5)));
        assert_eq!(color_at(&ranges, 0.5), None);
        assert_eq!(color_at(&ranges, 0.75), Some(DVec3::ZERO));
        assert_eq!(color_at(&ranges, 1.0), Some(DVec3::ONE));
        assert_eq!(color_at(&ranges[..1], 0.5), None);
    }
}
