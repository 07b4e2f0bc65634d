//! The curve of an eye ray through the layered atmosphere, made of parabolic arcs. Thesis 2.2 and 4.2.
//!
//! r is the horizontal distance from the eye, z the height. Arcs are made only as far as someone asks. An arc owns
//! both its ends, and ends exactly where the next one starts: a layer boundary's height is that boundary's, not a
//! parabola's rounded value, so that a surface lying on a boundary is met by the arc that ends there.

use wide::{CmpGe, CmpGt, CmpLe, f32x4};

use super::atmosphere::Atmosphere;

/// One parabola: z = half_bend (r - r0)² + slope (r - r0) + z0 for r0 <= r <= r1, z1 at r1.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Arc {
    pub r0: f64,
    pub r1: f64,
    pub z0: f64,
    pub z1: f64,
    pub slope: f64,
    pub half_bend: f64,
    /// Lowest and highest point.
    pub low: f64,
    pub high: f64,
}

/// Why a curve ended: what the straight ray along its last tangent starts from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum End {
    /// Below the lowest layer.
    Ground,
    /// Above the highest layer, or the elevation limit.
    Top,
    /// The distance limit.
    Range,
    /// The limit of the number of arcs.
    Segments,
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

/// An arc in f32, for four boxes at once. Its heights are widened by all that f32 may lose.
#[derive(Clone, Copy, Default, Debug)]
struct ArcSketch {
    from: f32,
    to: f32,
    half_bend: f32,
    slope: f32,
    start: f32,
    error: f32,
    /// Height of the turning point, if there is one inside.
    apex: Option<f32>,
}

impl ArcSketch {
    fn new(arc: &Arc) -> Self {
        let steepest = arc.slope.abs().max(arc.slope_at(arc.r1).abs());
        let size = arc.low.abs().max(arc.high.abs()) + steepest * arc.r1;
        let (low_end, high_end) = if arc.z0 < arc.z1 { (arc.z0, arc.z1) } else { (arc.z1, arc.z0) };
        Self {
            from: (arc.r0 as f32).next_down(),
            to: (arc.r1 as f32).next_up(),
            half_bend: arc.half_bend as f32,
            slope: arc.slope as f32,
            start: arc.z0 as f32,
            error: (size * 2f64.powi(-19)) as f32,
            apex: if arc.low < low_end {
                Some(arc.low as f32)
            } else if arc.high > high_end {
                Some(arc.high as f32)
            } else {
                None
            },
        }
    }

    /// Boxes above or below which the arc is not all the way.
    #[inline]
    fn passes(&self, [near, far]: [f32x4; 2], [low, high]: [f32x4; 2]) -> f32x4 {
        let from = f32x4::splat(self.from);
        let near = near.fast_max(from);
        let far = far.fast_min(f32x4::splat(self.to));
        let (half_bend, slope) = (f32x4::splat(self.half_bend), f32x4::splat(self.slope));
        let height = |x: f32x4| (half_bend * x + slope) * x + f32x4::splat(self.start);
        let (x0, x1) = (near - from, far - from);
        let (z0, z1) = (height(x0), height(x1));
        let (mut bottom, mut top) = (z0.fast_min(z1), z0.fast_max(z1));
        if let Some(apex) = self.apex {
            let slope_at = |x: f32x4| half_bend * (x + x) + slope;
            let turns = (slope_at(x0) * slope_at(x1)).simd_le(f32x4::splat(0.0));
            let apex = f32x4::splat(apex);
            bottom = turns.blend(bottom.fast_min(apex), bottom);
            top = turns.blend(top.fast_max(apex), top);
        }
        let error = f32x4::splat(self.error);
        let (bottom, top) = (bottom - error, top + error);
        near.simd_le(far) & bottom.simd_le(high) & top.simd_ge(low)
    }
}

/// A curve in the making. One value serves many rays: `start` begins anew and keeps the memory.
#[derive(Clone, Debug)]
pub struct Path<'a> {
    air: &'a Atmosphere,
    arcs: Vec<Arc>,
    /// One arc as boxes see it, and which: the one they asked for last.
    sketch: ArcSketch,
    sketched: usize,
    /// Layer that the next arc runs in.
    layer: usize,
    r: f64,
    z: f64,
    slope: f64,
    /// slope², which is linear in the height within a layer: it runs ahead of the square roots.
    slope_squared: f64,
    end: Option<End>,
}

impl<'a> Path<'a> {
    pub fn new(air: &'a Atmosphere) -> Self {
        Self {
            air,
            arcs: Vec::new(),
            sketch: ArcSketch::default(),
            sketched: usize::MAX,
            layer: 0,
            r: 0.0,
            z: 0.0,
            slope: 0.0,
            slope_squared: 0.0,
            end: Some(End::Segments),
        }
    }

    /// Begins a curve at height z with the tangent's slope dz/dr.
    pub fn start(&mut self, z: f64, slope: f64) {
        self.arcs.clear();
        self.sketched = usize::MAX;
        (self.r, self.z, self.slope, self.end) = (0.0, z, slope, None);
        self.slope_squared = slope * slope;
        let layers = &self.air.layers;
        let above = layers.partition_point(|layer| layer.top <= z);
        match layers.get(above) {
            Some(layer) if layer.bottom < z => self.layer = above,
            // On the boundary below layer `above`, or outside of all layers.
            Some(layer) if layer.bottom == z => self.cross(above),
            Some(_) => self.end = Some(End::Ground),
            None if layers.last().is_some_and(|layer| layer.top == z) => self.cross(above),
            None => self.end = Some(End::Top),
        }
    }

    /// Begins a curve at a height that is known only so well: within that of the lowest or highest boundary it
    /// counts as on it, not as outside of the air.
    pub fn start_near(&mut self, z: f64, slope: f64, uncertainty: f64) {
        let ends = [self.air.layers.first().map(|l| l.bottom), self.air.layers.last().map(|l| l.top)];
        let snapped = ends.into_iter().flatten().find(|end| (z - end).abs() <= uncertainty);
        self.start(snapped.unwrap_or(z), slope);
    }

    /// Arcs made so far.
    pub fn arcs(&self) -> &[Arc] {
        &self.arcs
    }

    /// Why the curve ended, once it has.
    pub fn end(&self) -> Option<End> {
        self.end
    }

    /// Where the last arc made so far ends: r, z and slope.
    pub fn tip(&self) -> (f64, f64, f64) {
        (self.r, self.z, self.slope)
    }

    /// The i-th arc, made if need be; None beyond the end.
    #[inline]
    pub fn arc(&mut self, i: usize) -> Option<&Arc> {
        while self.arcs.len() <= i {
            if !self.extend() {
                return None;
            }
        }
        self.arcs.get(i)
    }

    /// Number of the first arc that ends at r or beyond, searched from arc `hint`; None if the curve ends before r.
    #[inline]
    pub fn find(&mut self, r: f64, hint: usize) -> Option<usize> {
        let mut i = hint.min(self.arcs.len().saturating_sub(1));
        while i > 0 && self.arcs[i - 1].r1 >= r {
            i -= 1;
        }
        while self.arc(i)?.r1 < r {
            i += 1;
        }
        Some(i)
    }

    /// The i-th arc as boxes see it; None beyond the end.
    #[inline]
    fn sketch(&mut self, i: usize) -> Option<&ArcSketch> {
        if self.sketched != i {
            self.sketch = ArcSketch::new(self.arc(i)?);
            self.sketched = i;
        }
        Some(&self.sketch)
    }

    /// Of four boxes, over the distances `near`..`far` and the heights `low`..`high`, those that the curve passes,
    /// and now and then one that it all but touches. Only the lanes of `asked` are looked at. `hint` is an arc near
    /// the boxes, and becomes the one above the first.
    #[inline]
    pub fn passes(
        &mut self,
        asked: f32x4,
        [near, far]: [f32x4; 2],
        [low, high]: [f32x4; 2],
        hint: &mut usize,
    ) -> f32x4 {
        let mut passed = f32x4::splat(0.0);
        let starts = asked.blend(near, f32x4::splat(f32::INFINITY)).to_array();
        let first = starts[0].min(starts[1]).min(starts[2].min(starts[3]));
        let Some(mut i) = self.find(f64::from(first), *hint) else {
            return passed;
        };
        *hint = i;
        while let Some(sketch) = self.sketch(i) {
            passed |= sketch.passes([near, far], [low, high]);
            let beyond = far.simd_gt(f32x4::splat(sketch.to));
            if (asked & beyond).to_bitmask() & !passed.to_bitmask() == 0 {
                break;
            }
            i += 1;
        }
        asked & passed
    }

    /// Chooses the layer beyond the boundary below layer `above`, by the ray's slope, or by the way it bends where
    /// it is level.
    #[inline]
    fn cross(&mut self, above: usize) {
        let layers = &self.air.layers;
        let upward = if self.slope != 0.0 {
            self.slope > 0.0
        } else {
            layers.get(above).is_some_and(|layer| layer.half_bend >= 0.0)
        };
        if upward {
            if above == layers.len() {
                self.end = Some(End::Top);
            } else {
                self.layer = above;
            }
        } else if above == 0 {
            self.end = Some(End::Ground);
        } else {
            self.layer = above - 1;
        }
    }

    /// Makes one more arc: to the layer boundary the ray meets first. False once the curve has ended.
    fn extend(&mut self) -> bool {
        if self.end.is_some() {
            return false;
        }
        if self.arcs.len() >= self.air.segments {
            self.end = Some(End::Segments);
            return false;
        }
        let layer = self.air.layers[self.layer];
        let (a, m, z) = (layer.half_bend, self.slope, self.z);
        // Heights are counted toward `ahead`, the boundary the ray points at; `bend` is positive toward it.
        let rising = m > 0.0 || (m == 0.0 && a > 0.0);
        let (ahead, behind, bend, steep) = if rising {
            (layer.top - z, z - layer.bottom, a, m)
        } else {
            (z - layer.bottom, layer.top - z, -a, -m)
        };
        // bend x² + steep x = ahead; where that has no solution the ray turns and meets the boundary behind.
        let reach = self.slope_squared + 4.0 * bend * ahead;
        let (width, slope, turns) = if reach >= 0.0 {
            let root = reach.sqrt();
            self.slope_squared = reach;
            (2.0 * ahead / (steep + root), root, false)
        } else {
            self.slope_squared -= 4.0 * bend * behind;
            let root = self.slope_squared.sqrt();
            ((steep + root) / (-2.0 * bend), -root, true)
        };
        let exits_up = rising != turns;
        let mut arc = Arc {
            r0: self.r,
            r1: self.r + width,
            z0: z,
            z1: if exits_up { layer.top } else { layer.bottom },
            slope: m,
            half_bend: a,
            low: 0.0,
            high: 0.0,
        };
        let mut slope = if rising { slope } else { -slope };
        // A level ray in a layer that does not bend it has no width that is a number: it runs to the limit.
        let in_range = arc.r1 < self.air.distance;
        if !in_range {
            arc.r1 = f64::INFINITY;
            let r1 = self.air.distance.max(self.r);
            arc.z1 = arc.height(r1).clamp(layer.bottom, layer.top);
            arc.r1 = r1;
            slope = arc.slope_at(r1);
            self.slope_squared = slope * slope;
        }
        (arc.low, arc.high) = if arc.z0 < arc.z1 { (arc.z0, arc.z1) } else { (arc.z1, arc.z0) };
        if arc.slope * slope < 0.0 {
            let apex = (z - 0.25 * m * m / a).clamp(layer.bottom, layer.top);
            arc.low = arc.low.min(apex);
            arc.high = arc.high.max(apex);
        }
        (self.r, self.z, self.slope) = (arc.r1, arc.z1, slope);
        self.arcs.push(arc);
        if in_range {
            self.cross(if exits_up { self.layer + 1 } else { self.layer });
        } else {
            self.end = Some(End::Range);
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::atmosphere::Layer;
    use proptest::prelude::*;

    fn air(bends: &[f64]) -> Atmosphere {
        let layers: Vec<Layer> = bends
            .iter()
            .enumerate()
            .map(|(i, &half_bend)| Layer { bottom: i as f64, top: i as f64 + 1.0, half_bend })
            .collect();
        let profile_top = layers.len() as f64;
        Atmosphere { layers, profile_top, segments: 200, distance: 10_000.0 }
    }

    fn whole(path: &mut Path) {
        while path.extend() {}
    }

    #[test]
    fn a_ray_without_bend_is_straight() {
        let air = air(&[0.0, 0.0, 0.0]);
        let mut path = Path::new(&air);
        path.start(0.5, 0.01);
        whole(&mut path);
        assert_eq!(path.end(), Some(End::Top));
        assert!((path.tip().0 - 250.0).abs() < 1e-9);
        path.start(0.5, 0.0);
        whole(&mut path);
        assert_eq!((path.end(), path.tip().0), (Some(End::Range), 10_000.0));
        path.start(0.0, -1.0);
        whole(&mut path);
        assert_eq!((path.end(), path.arcs().len()), (Some(End::Ground), 0));
        path.start(3.0, 1.0);
        assert_eq!((path.end(), path.arcs().len()), (Some(End::Top), 0));
    }

    #[test]
    fn a_duct_ends_with_the_number_of_segments() {
        let air = air(&[1e-3, -1e-3]);
        let mut path = Path::new(&air);
        path.start(1.0, 1e-3);
        whole(&mut path);
        assert_eq!((path.end(), path.arcs().len()), (Some(End::Segments), 200));
    }

    #[test]
    fn length_has_two_forms_that_agree() {
        let arc =
            Arc { r0: 0.0, r1: 10.0, z0: 0.0, z1: 0.0, slope: 0.3, half_bend: 0.00049, low: 0.0, high: 0.0 };
        let primitive = |s: f64| 0.5 * (s * s.hypot(1.0) + s.asinh());
        let s1 = arc.slope_at(10.0);
        let closed = 10.0 * (primitive(s1) - primitive(0.3)) / (s1 - 0.3);
        assert!((arc.length_to(10.0) - closed).abs() < 1e-9);
    }

    proptest! {
        /// Arcs join, keep to their layers, have no kink, and follow from their own equation.
        #[test]
        fn arcs_join_smoothly(
            bends in prop::collection::vec(-1e-3..1e-3f64, 1..6),
            z in 0.0..1.0f64,
            slope in -0.02..0.02f64,
        ) {
            let air = air(&bends);
            let mut path = Path::new(&air);
            path.start(z * bends.len() as f64, slope);
            whole(&mut path);
            prop_assert!(path.end().is_some());
            for pair in path.arcs().windows(2) {
                prop_assert_eq!((pair[0].r1, pair[0].z1), (pair[1].r0, pair[1].z0));
                prop_assert!((pair[0].slope_at(pair[0].r1) - pair[1].slope).abs() < 1e-7);
            }
            for arc in path.arcs() {
                prop_assert!(arc.r1 >= arc.r0 && arc.low <= arc.high);
                let x = arc.r1 - arc.r0;
                let z1 = (arc.half_bend * x + arc.slope) * x + arc.z0;
                prop_assert!((z1 - arc.z1).abs() < 1e-7);
                for i in 0..=10 {
                    let z = arc.height(arc.r0 + x * f64::from(i) / 10.0);
                    prop_assert!(arc.low - 1e-9 <= z && z <= arc.high + 1e-9);
                }
            }
        }

        /// A box is passed exactly when some point of the finely sampled curve lies in it.
        #[test]
        fn passes_agrees_with_sampling(
            bends in prop::collection::vec(-1e-4..1e-4f64, 1..6),
            slope in -0.005..0.005f64,
            from in 0.0..500.0f64,
            width in 1.0..500.0f64,
            low in 0.0..5.0f64,
            height in 0.01..2.0f64,
        ) {
            let air = air(&bends);
            let mut path = Path::new(&air);
            path.start(0.5 * bends.len() as f64, slope);
            let mut hint = 3;
            // The lane counts; the others are elsewhere, or not asked.
            let lanes = |x: f64, others: [f32; 3]| f32x4::from([x as f32, others[0], others[1], others[2]]);
            let asked = f32x4::splat(0.0).simd_le(lanes(0.0, [0.0, 0.0, -1.0]));
            let distances = [lanes(from, [7.0, 900.0, 0.0]), lanes(from + width, [400.0, 901.0, 9.0])];
            let heights = [lanes(low, [1.0, 2.0, 0.0]), lanes(low + height, [1.1, 9.0, 9.0])];
            let lanes_passed = path.passes(asked, distances, heights, &mut hint).to_bitmask();
            prop_assert_eq!(lanes_passed & 8, 0);
            let passed = lanes_passed & 1 != 0;
            whole(&mut path);
            let inside = |margin: f64| (0..=4000).any(|i| {
                let r = from + width * f64::from(i) / 4000.0;
                path.arcs().iter().filter(|arc| arc.r0 <= r && r <= arc.r1).any(|arc| {
                    let z = arc.height(r);
                    low - margin <= z && z <= low + height + margin
                })
            });
            if passed { prop_assert!(inside(0.01)) } else { prop_assert!(!inside(-1e-6)) }
        }
    }
}
