//! The curve of an eye ray through the layered atmosphere, made of parabolic arcs. Thesis 2.2 and 4.2.
//!
//! r is the horizontal distance from the eye, z the height. Arcs are made only as far as someone asks.

use std::sync::atomic::{AtomicBool, Ordering};

use wide::f32x4;

use super::arc::Arc;
use super::atmosphere::Atmosphere;
use super::sketch::{ArcSketch, Bends, Envelope};
use super::tip::{HeightRange, Tip};

/// What stops a curve that nobody stops.
static NEVER: AtomicBool = AtomicBool::new(false);

/// A curve in the making. One value serves many rays: `start` begins anew and keeps the memory.
#[derive(Clone, Debug)]
pub struct Path<'a> {
    air: &'a Atmosphere,
    /// Set by whoever wants no more: then every search ends, with whatever it has found.
    cancelled: &'a AtomicBool,
    bends: Bends,
    envelope: Envelope,
    eye_height: f64,
    /// The layer that holds the eye, or lies on it: the next curve mostly begins where the last one did.
    above_eye: usize,
    /// Arcs kept so far, and where they end.
    arcs: Vec<Arc>,
    tip: Tip,
    /// Where the whole curve ends, once someone has followed it so far.
    end_tip: Option<Tip>,
    /// Arcs as boxes see them, from number `first_sketched` on, as far as boxes have asked.
    sketches: Vec<ArcSketch>,
    first_sketched: usize,
}

impl<'a> Path<'a> {
    /// A curve that is yet to be started, and that nobody stops.
    pub fn new(air: &'a Atmosphere) -> Self {
        Self::stopped_by(air, &NEVER)
    }

    /// A curve that is yet to be started.
    pub fn stopped_by(air: &'a Atmosphere, cancelled: &'a AtomicBool) -> Self {
        let bends = Bends::of(air);
        Self {
            air,
            cancelled,
            bends,
            envelope: Envelope::new(&bends, 0.0, 0.0),
            eye_height: f64::NEG_INFINITY,
            above_eye: 0,
            arcs: Vec::new(),
            tip: Tip::new(air, 0, f64::NEG_INFINITY, 0.0),
            end_tip: None,
            sketches: Vec::new(),
            first_sketched: 0,
        }
    }

    /// Begins a curve at height z with the tangent's slope dz/dr.
    pub fn start(&mut self, z: f64, slope: f64) {
        self.arcs.clear();
        self.sketches.clear();
        self.envelope = Envelope::new(&self.bends, z, slope);
        if z != self.eye_height {
            self.eye_height = z;
            self.above_eye = self.air.layers.partition_point(|layer| layer.top <= z);
        }
        self.tip = Tip::new(self.air, self.above_eye, z, slope);
        self.end_tip = None;
    }

    /// Begins a curve at a height that is known only so well: within that of the lowest or highest boundary it
    /// counts as on it, not as outside of the air.
    pub fn start_near(&mut self, z: f64, slope: f64, uncertainty: f64) {
        let ends = [self.air.layers.first().map(|l| l.bottom), self.air.layers.last().map(|l| l.top)];
        let snapped = ends.into_iter().flatten().find(|end| (z - end).abs() <= uncertainty);
        self.start(snapped.unwrap_or(z), slope);
    }

    /// Height at which it begins.
    pub fn eye_height(&self) -> f64 {
        self.eye_height
    }

    /// Arcs kept so far.
    pub fn arcs(&self) -> &[Arc] {
        &self.arcs
    }

    /// Beyond this the curve does not go.
    pub fn reach(&self) -> f32 {
        self.envelope.reach
    }

    /// Keeps all arcs.
    pub fn keep_all(&mut self) -> &[Arc] {
        self.keep_while(|_| true);
        &self.arcs
    }

    /// Where the curve ends, which has a reason. None of its arcs is kept for that.
    pub fn end_tip(&mut self) -> Tip {
        if self.end_tip.is_none() {
            self.walk_on(HeightRange::NONE, |_, _| true);
        }
        self.end_tip.unwrap_or(self.tip)
    }

    /// Length of the curve from the eye to the distance r.
    pub fn length_to(&mut self, r: f64) -> f64 {
        let mut length = 0.0;
        self.walk(HeightRange::ALL, |_, arc| {
            if arc.r0 <= r {
                length += arc.length_to(arc.r1.min(r));
            }
            arc.r0 <= r
        });
        length
    }

    /// Shows the arcs, with their numbers, from the first for as long as `visit` wants more, but not all of those that
    /// miss the heights. Those that are not kept yet will not be.
    #[inline]
    pub fn walk(&mut self, heights: HeightRange, mut visit: impl FnMut(usize, &Arc) -> bool) {
        if !self.is_cancelled() && self.arcs.iter().enumerate().all(|(number, arc)| visit(number, arc)) {
            self.walk_on(heights, visit);
        }
    }

    /// Shows those that are not kept.
    #[inline(always)]
    fn walk_on(&mut self, heights: HeightRange, mut visit: impl FnMut(usize, &Arc) -> bool) {
        let (mut tip, cancelled) = (self.tip, self.cancelled);
        tip.follow(self.air, heights, |number, arc| {
            visit(number, &arc) && !cancelled.load(Ordering::Relaxed)
        });
        if tip.end.is_some() {
            self.end_tip = Some(tip);
        }
    }

    /// Keeps one arc more, and those after it for as long as the last one is such.
    fn keep_while(&mut self, such: impl Fn(&Arc) -> bool) {
        let (mut tip, arcs, cancelled) = (self.tip, &mut self.arcs, self.cancelled);
        tip.follow(self.air, HeightRange::ALL, |_, arc| {
            arcs.push(arc);
            such(&arc) && !cancelled.load(Ordering::Relaxed)
        });
        self.tip = tip;
    }

    #[inline(always)]
    fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    /// The i-th arc, made if need be; None beyond the end, and once nobody wants more.
    #[inline]
    pub fn arc(&mut self, i: usize) -> Option<&Arc> {
        if self.is_cancelled() {
            return None;
        }
        while self.arcs.len() <= i && self.tip.end.is_none() {
            self.keep_while(|_| false);
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
        if self.arcs.last().is_none_or(|last| last.r1 < r) {
            i = self.arcs.len();
            self.keep_while(|arc| arc.r1 < r);
        }
        while self.arcs.get(i)?.r1 < r {
            i += 1;
        }
        Some(i)
    }

    /// The i-th arc as boxes see it; None beyond the end.
    #[inline]
    fn sketch(&mut self, i: usize) -> Option<&ArcSketch> {
        if self.sketches.is_empty() || i < self.first_sketched {
            self.sketches.clear();
            self.first_sketched = i;
        }
        let place = i - self.first_sketched;
        while self.sketches.len() <= place {
            let sketch = ArcSketch::new(self.arc(self.first_sketched + self.sketches.len())?);
            self.sketches.push(sketch);
        }
        self.sketches.get(place)
    }

    /// Of four boxes, over the distances `near`..`far` and the heights `low`..`high`, those that the curve passes,
    /// and now and then one that it all but touches. Only the lanes of `asked` are looked at. `hint` is an arc near
    /// the boxes, and becomes the one above the first.
    #[inline(always)]
    pub fn passes(
        &mut self,
        asked: f32x4,
        distances: [f32x4; 2],
        heights: [f32x4; 2],
        hint: &mut usize,
    ) -> f32x4 {
        let (passed, vague) = self.envelope.passes(distances, heights);
        let (passed, vague) = (asked & passed, asked & vague);
        if vague.none() {
            return passed;
        }
        (passed & !vague) | self.arcs_pass(vague, distances, heights, hint)
    }

    /// The same arc by arc. Seldom needed: the envelope tells much of a box that is not very flat.
    #[inline(never)]
    fn arcs_pass(
        &mut self,
        asked: f32x4,
        [near, far]: [f32x4; 2],
        heights: [f32x4; 2],
        hint: &mut usize,
    ) -> f32x4 {
        let mut passed = f32x4::splat(0.0);
        if self.is_cancelled() {
            return passed;
        }
        let starts = asked.blend(near, f32x4::splat(f32::INFINITY)).to_array();
        let first = starts[0].min(starts[1]).min(starts[2].min(starts[3]));
        let Some(mut i) = self.find(f64::from(first), *hint) else {
            return passed;
        };
        *hint = i;
        while let Some(sketch) = self.sketch(i) {
            passed |= sketch.passes([near, far], heights);
            if (asked & sketch.ends_before(far)).to_bitmask() & !passed.to_bitmask() == 0 {
                break;
            }
            i += 1;
        }
        asked & passed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::tip::End;
    use proptest::prelude::*;
    use wide::CmpLe;

    fn air(bends: &[f64]) -> Atmosphere {
        Atmosphere::of_bends(bends, 200, 10_000.0)
    }

    #[test]
    fn a_ray_without_bend_is_straight() {
        let air = air(&[0.0, 0.0, 0.0]);
        let mut path = Path::new(&air);
        path.start(0.5, 0.01);
        let tip = path.end_tip();
        assert_eq!((tip.end, tip.arcs), (Some(End::Top), 3));
        assert!((tip.r - 250.0).abs() < 1e-9);
        path.start(0.5, 0.0);
        let tip = path.end_tip();
        assert_eq!((tip.end, tip.r), (Some(End::Range), 10_000.0));
        path.start(0.0, -1.0);
        let tip = path.end_tip();
        assert_eq!((tip.end, tip.arcs), (Some(End::Ground), 0));
        path.start(3.0, 1.0);
        let tip = path.end_tip();
        assert_eq!((tip.end, tip.arcs), (Some(End::Top), 0));
    }

    #[test]
    fn a_duct_ends_with_the_number_of_segments() {
        let air = air(&[1e-3, -1e-3]);
        let mut path = Path::new(&air);
        path.start(1.0, 1e-3);
        let tip = path.end_tip();
        assert_eq!((tip.end, tip.arcs, path.arcs().len()), (Some(End::Segments), 200, 0));
        assert_eq!(path.keep_all().len(), 200);
    }

    /// Where a boundary is at 1, and rays bend so much below it and above it.
    fn from_the_boundary(below: f64, above: f64, slope: f64) -> Tip {
        let air = air(&[below, above]);
        let mut path = Path::new(&air);
        path.start(1.0, slope);
        path.end_tip()
    }

    #[test]
    fn a_level_ray_stays_on_a_boundary_that_both_sides_bend_it_back_to() {
        for [below, above] in [[1e-4, -1e-4], [1e-7, -3e-2], [0.0, -1e-4], [1e-4, 0.0], [0.0, 0.0]] {
            let tip = from_the_boundary(below, above, 0.0);
            assert_eq!(
                (tip.end, tip.r, tip.z, tip.slope),
                (Some(End::Range), 10_000.0, 1.0, 0.0),
                "{below} {above}"
            );
        }
        for slope in [-1e-8, -3e-10, 1e-300, 3e-10, 1e-8] {
            let tip = from_the_boundary(1e-4, -2e-4, slope);
            assert_eq!((tip.end, tip.arcs, tip.z), (Some(End::Range), 1, 1.0), "{slope}");
        }
        // 1/4 mm away from it the ray crosses over and over.
        let tip = from_the_boundary(1e-4, -1e-4, 3e-4);
        assert_eq!((tip.end, tip.arcs), (Some(End::Segments), 200));
    }

    #[test]
    fn a_level_ray_goes_from_a_boundary_where_it_is_bent() {
        let bends = 2f64.powi(-10);
        for (below, above, end) in [(1.0, 1.0, End::Top), (-1.0, -1.0, End::Ground), (-1.0, 1.0, End::Top)] {
            assert_eq!(from_the_boundary(below * bends, above * bends, 0.0).end, Some(end));
            // The same for one that rises to the boundary and is level just there.
            if below < 0.0 {
                let air = air(&[below * bends, above * bends]);
                let mut path = Path::new(&air);
                path.start(0.0, 2f64.powi(-4));
                let tip = path.end_tip();
                assert_eq!((tip.end, path.keep_all()[0].z1), (Some(end), 1.0));
            }
        }
    }

    #[test]
    fn a_level_ray_at_the_airs_end_goes_in_where_it_is_bent_in() {
        for (z, bend, end, arcs) in [
            (1.0, 1e-3, End::Top, 0),
            (1.0, -1e-3, End::Ground, 1),
            (0.0, 1e-3, End::Top, 1),
            (0.0, -1e-3, End::Ground, 0),
        ] {
            let air = air(&[bend]);
            let mut path = Path::new(&air);
            path.start(z, 0.0);
            let tip = path.end_tip();
            assert_eq!((tip.end, tip.arcs), (Some(end), arcs), "{z} {bend}");
        }
    }

    #[test]
    fn a_curve_that_is_cancelled_ends_its_searches() {
        let air = Atmosphere::of_bends(&[1e-3, -1e-3], 1_000_000, f64::INFINITY);
        let cancelled = AtomicBool::new(true);
        let mut path = Path::stopped_by(&air, &cancelled);
        path.start(1.0, 1e-3);
        assert!(path.arc(0).is_none() && path.find(1e9, 0).is_none());
        assert!(path.keep_all().len() <= 2 && path.length_to(1e9) == 0.0);
    }

    proptest! {
        /// A level ray from a boundary is where rays a little above or below the horizontal are.
        #[test]
        fn a_level_ray_has_a_neighbour(
            bends in prop::collection::vec(prop_oneof![Just(0.0), -1e-5..1e-5f64], 2..7), boundary in 0usize..7,
        ) {
            let air = Atmosphere::of_bends(&bends, 1_000_000, 1_000.0);
            let z = (boundary % (bends.len() + 1)) as f64;
            let mut path = Path::new(&air);
            let mut heights = |slope: f64| -> Vec<f64> {
                path.start(z, slope);
                let tip = path.end_tip();
                let straight = |r: f64| tip.z + tip.slope * (r - tip.r);
                let at = |r: f64| path.find(r, 0).map_or_else(|| straight(r), |i| path.arcs()[i].height(r));
                (0..=20).map(|i| f64::from(i) * 50.0).map(at).collect()
            };
            let level = heights(0.0);
            // Beyond their turns neighbours part as their slopes do, a hundredfold at most.
            let mut near = |slope: f64| heights(slope).iter().zip(&level).all(|(one, other)| (one - other).abs() < 1e-2);
            prop_assert!(near(1e-7) || near(-1e-7), "{level:?}");
        }

        /// Arcs join, keep to their layers, have no kink, and follow from their own equation. They are the same
        /// whether they are kept, shown or counted.
        #[test]
        fn arcs_join_smoothly(
            bends in prop::collection::vec(-1e-3..1e-3f64, 1..6),
            z in 0.0..1.0f64,
            slope in -0.02..0.02f64,
        ) {
            let air = air(&bends);
            let mut path = Path::new(&air);
            path.start(z * bends.len() as f64, slope);
            let tip = path.end_tip();
            prop_assert!(tip.end.is_some());
            let arcs = path.keep_all().to_vec();
            prop_assert_eq!(tip.arcs, arcs.len());
            if let Some(last) = arcs.last() {
                prop_assert_eq!((tip.r, tip.z), (last.r1, last.z1));
            }
            for kept in [0, 1, arcs.len() / 2, arcs.len()] {
                path.start(z * bends.len() as f64, slope);
                if kept > 0 {
                    path.arc(kept - 1);
                }
                let mut seen = Vec::new();
                path.walk(HeightRange::ALL, |i, arc| {
                    seen.push(*arc);
                    seen.len() == i + 1
                });
                prop_assert_eq!(&seen, &arcs);
                prop_assert_eq!(path.arcs().len(), kept.min(arcs.len()));
            }
            for pair in arcs.windows(2) {
                prop_assert_eq!((pair[0].r1, pair[0].z1), (pair[1].r0, pair[1].z0));
                let kink = (pair[0].slope_at(pair[0].r1) - pair[1].slope).abs();
                // Where it is all but level a boundary may hold it: 4 bends of 1 nm.
                let held = pair[1].slope == 0.0 && pair[1].half_bend == 0.0;
                let most = if held { 2.1e-6 } else { 1e-7 };
                prop_assert!(kink < most);
            }
            for arc in &arcs {
                prop_assert!(arc.r1 >= arc.r0 && arc.low() <= arc.high());
                let x = arc.r1 - arc.r0;
                let z1 = (arc.half_bend * x + arc.slope) * x + arc.z0;
                prop_assert!((z1 - arc.z1).abs() < 1e-7);
                for i in 0..=10 {
                    let z = arc.height(arc.r0 + x * f64::from(i) / 10.0);
                    prop_assert!(arc.low() - 1e-9 <= z && z <= arc.high() + 1e-9);
                }
            }
        }

        /// A box is passed when some point of the finely sampled curve lies in it. By the arcs exactly then; by the
        /// envelope also where the curve is not farther from it than it is high, and beyond the curve's end.
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
            let lanes_passed = path.passes(asked, distances, heights, &mut hint);
            let lanes_passed_by_arcs = path.arcs_pass(asked, distances, heights, &mut hint);
            prop_assert_eq!(lanes_passed.to_bitmask() & 8, 0);
            let passed = [lanes_passed, lanes_passed_by_arcs].map(|lanes| lanes.to_bitmask() & 1 != 0);
            let ends_before = path.end_tip().r < from + width;
            path.keep_all();
            let inside = |margin: f64| (0..=4000).any(|i| {
                let r = from + width * f64::from(i) / 4000.0;
                path.arcs().iter().filter(|arc| arc.r0 <= r && r <= arc.r1).any(|arc| {
                    let z = arc.height(r);
                    low - margin <= z && z <= low + height + margin
                })
            });
            let right = match passed {
                [true, _] if ends_before => true,
                [passed, _] => inside(if passed { height + 0.01 } else { -1e-6 }) == passed,
            };
            prop_assert!(right, "the envelope");
            prop_assert!(inside(if passed[1] { 0.01 } else { -1e-6 }) == passed[1], "the arcs");
        }
    }
}
