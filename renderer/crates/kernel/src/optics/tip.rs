//! The end of a curve in the making, and how it goes on: arc by arc, each to the layer boundary it meets first.
//!
//! An arc ends exactly where the next one starts: a layer boundary's height is that boundary's, not a parabola's
//! rounded value, so that a surface lying on a boundary is met by the arc that ends there.

use wide::{CmpGt, f64x2};

use super::arc::Arc;
use super::atmosphere::{Atmosphere, Layer};
use crate::within::within;

/// A ray that no more than this, in metres, leads away from a boundary to either side is level on it: less than a
/// wavelength of light, where rays have lost their meaning.
const GIVE: f64 = 1e-9;

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

impl End {
    pub const ALL: [End; 4] = [End::Ground, End::Top, End::Range, End::Segments];

    pub fn name(self) -> &'static str {
        match self {
            End::Ground => "ground",
            End::Top => "top",
            End::Range => "range",
            End::Segments => "segments",
        }
    }
}

/// How far a curve has been followed.
#[derive(Clone, Copy, Debug)]
pub struct Tip {
    pub r: f64,
    pub z: f64,
    pub slope: f64,
    /// slope² less the gain of the height, the same all along the curve: what tells how steep it is at each boundary,
    /// and where it turns, without following it there.
    invariant: f64,
    /// Layer that the next arc runs in.
    layer: usize,
    /// Arcs so far.
    pub arcs: usize,
    pub end: Option<End>,
}

/// The heights at which someone wants to see a curve, both included.
#[derive(Clone, Copy, Debug)]
pub struct HeightRange {
    low: f64,
    high: f64,
}

impl HeightRange {
    pub const ALL: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };
    pub const NONE: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };

    /// A height that may be wrong by a few roundings.
    pub fn around(z: f64) -> Self {
        let slack = 1e-14 * z.abs();
        Self { low: z - slack, high: z + slack }
    }

    /// Whether nothing of a curve that only rises, or only falls, from one height to another lies within.
    #[inline]
    fn miss(&self, from: f64, to: f64) -> bool {
        (from > self.high && to > self.high) || (from < self.low && to < self.low)
    }
}

impl Tip {
    /// A curve's beginning at height z with the tangent's slope dz/dr. `above` is the layer that holds z, or lies on it.
    pub fn new(air: &Atmosphere, above: usize, z: f64, slope: f64) -> Self {
        let mut tip = Self { r: 0.0, z, slope, invariant: 0.0, layer: above, arcs: 0, end: None };
        let gain = match air.layers.get(above) {
            Some(layer) if layer.bottom < z => layer.gain_at(z),
            Some(layer) if layer.bottom == z => {
                tip.cross(air, above);
                layer.gain_at_bottom
            }
            Some(_) => {
                tip.end = Some(End::Ground);
                0.0
            }
            None => match air.layers.last() {
                Some(layer) if layer.top == z => {
                    tip.cross(air, above);
                    layer.gain_at_top
                }
                _ => {
                    tip.end = Some(End::Top);
                    0.0
                }
            },
        };
        tip.invariant = slope * slope - gain;
        tip
    }

    /// Follows the curve to its end, or for as long as `visit` wants more. It is shown each arc with its number from 0,
    /// but need not be shown those that miss the heights.
    #[inline(always)] // So that the loops keep the tip in registers.
    pub fn follow(
        &mut self,
        air: &Atmosphere,
        heights: HeightRange,
        mut visit: impl FnMut(usize, Arc) -> bool,
    ) {
        while self.end.is_none() {
            if self.arcs >= air.segments {
                self.end = Some(End::Segments);
                return;
            }
            let more = if self.slope > 0.0 {
                self.pass_layers::<true>(air, heights, &mut visit)
            } else {
                self.pass_layers::<false>(air, heights, &mut visit)
            };
            if !more {
                return;
            }
            if self.end.is_none() && self.arcs < air.segments {
                let arc = if self.is_held(air) { self.run_level(air) } else { self.step(air) };
                self.arcs += 1;
                if !visit(self.arcs - 1, arc) {
                    return;
                }
            }
        }
    }

    /// Follows the curve from a boundary through whole layers, which is most of the work, until it is about to turn,
    /// to be level or to go beyond a limit: the same arcs as `step` makes. Not at all where it is inside of a layer.
    /// False once `visit` wants no more.
    #[inline(always)]
    fn pass_layers<const UP: bool>(
        &mut self,
        air: &Atmosphere,
        heights: HeightRange,
        visit: &mut impl FnMut(usize, Arc) -> bool,
    ) -> bool {
        let layers = &air.layers[..];
        let beyond = |layer: usize| if UP { layer + 1 } else { layer.wrapping_sub(1) };
        let far_side = |layer: &Layer| if UP { layer.top } else { layer.bottom };
        let gain = |layer: &Layer| if UP { layer.gain_at_top } else { layer.gain_at_bottom };
        let signed = |steep: f64| if UP { steep } else { -steep };
        let begins = layers.get(self.layer).map(|layer| if UP { layer.bottom } else { layer.top });
        if self.slope == 0.0 || begins != Some(self.z) {
            return true;
        }
        let Self { mut r, mut z, slope, invariant, mut layer, mut arcs, .. } = *self;
        let mut steep = slope.abs();
        let wants_more = 'passing: loop {
            let Some(one) = layers.get(layer) else { break true };
            // Two layers at once: square roots and divisions are what takes time. Of the last one only the first half
            // counts.
            let next = layers.get(beyond(layer));
            let two = next.unwrap_or(one);
            let roots = (f64x2::splat(invariant) + f64x2::from([gain(one), gain(two)])).sqrt();
            let [root_one, root_two] = roots.to_array();
            let height = f64x2::from([one.height, two.height]);
            let widths = (height + height) / (f64x2::from([steep, root_one]) + roots);
            let [width_one, width_two] = widths.to_array();
            let (middle, end) = (r + width_one, r + width_one + width_two);
            // A root that is not a number is not above 0.
            let both = roots.simd_gt(f64x2::splat(0.0)).all()
                && end < air.distance
                && next.is_some()
                && arcs + 2 <= air.segments;
            if both && heights.miss(z, far_side(two)) {
                (r, z, steep) = (end, far_side(two), root_two);
                (layer, arcs) = (beyond(beyond(layer)), arcs + 2);
                continue;
            }
            for (passed, root, r1) in [(one, root_one, middle), (two, root_two, end)] {
                if !(root > 0.0 && r1 < air.distance && arcs < air.segments) {
                    break 'passing true;
                }
                let z1 = far_side(passed);
                let half_bend = passed.half_bend;
                let arc = Arc { r0: r, r1, z0: z, z1, slope: signed(steep), half_bend, apex: z1 };
                (r, z, steep) = (r1, z1, root);
                (layer, arcs) = (beyond(layer), arcs + 1);
                if !visit(arcs - 1, arc) {
                    break 'passing false;
                }
                if next.is_none() {
                    break;
                }
            }
        };
        if layer >= layers.len() {
            self.end = Some(if UP { End::Top } else { End::Ground });
        }
        (self.r, self.z, self.slope, self.layer, self.arcs) = (r, z, signed(steep), layer, arcs);
        wants_more
    }

    /// Chooses the layer beyond the boundary below layer `above`, by the ray's slope. Where it is level it goes the way
    /// that it bends in the layer above, or in the uppermost layer, above which it would go straight: its neighbours
    /// do the same, but where it bends away from the boundary to both sides, and they part. There it counts as above.
    #[inline]
    fn cross(&mut self, air: &Atmosphere, above: usize) {
        let layers = &air.layers;
        let upward = if self.slope != 0.0 {
            self.slope > 0.0
        } else {
            match layers.get(above) {
                Some(layer) => layer.half_bend >= 0.0,
                None => layers.last().is_none_or(|layer| layer.half_bend > 0.0),
            }
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

    /// Whether the ray is on a boundary that it cannot leave: so nearly level that the layers on both sides, which bend
    /// it back, keep it within `GIVE`. It would cross the boundary over and over, the oftener the more level it is.
    #[inline]
    fn is_held(&self, air: &Atmosphere) -> bool {
        let layer = &air.layers[self.layer];
        let (below, above) = if self.z == layer.bottom {
            (self.layer.wrapping_sub(1), self.layer)
        } else if self.z == layer.top {
            (self.layer, self.layer + 1)
        } else {
            return false;
        };
        let (Some(below), Some(above)) = (air.layers.get(below), air.layers.get(above)) else {
            return false;
        };
        // slope² = 4 |A_p| times the height at which the ray turns.
        let holds = |bend: f64, height: f64| 4.0 * bend * height.min(GIVE);
        let most = holds(below.half_bend, below.height).min(holds(-above.half_bend, above.height));
        self.slope * self.slope <= most
    }

    /// The arc along the boundary, from here to the limit.
    fn run_level(&mut self, air: &Atmosphere) -> Arc {
        let (r0, z, r1) = (self.r, self.z, air.distance.max(self.r));
        (self.r, self.slope, self.end) = (r1, 0.0, Some(End::Range));
        Arc { r0, r1, z0: z, z1: z, slope: 0.0, half_bend: 0.0, apex: z }
    }

    /// The arc from here to the next layer boundary, of a curve that has not ended.
    #[inline(always)]
    fn step(&mut self, air: &Atmosphere) -> Arc {
        let layer = air.layers[self.layer];
        let (a, m, z) = (layer.half_bend, self.slope, self.z);
        // Heights are counted toward `ahead`, the boundary the ray points at; `bend` is positive toward it.
        let rising = m > 0.0 || (m == 0.0 && a > 0.0);
        let (ahead, gain_ahead, gain_behind, bend, steep) = if rising {
            (layer.top - z, layer.gain_at_top, layer.gain_at_bottom, a, m)
        } else {
            (z - layer.bottom, layer.gain_at_bottom, layer.gain_at_top, -a, -m)
        };
        // bend x² + steep x = ahead; where that has no solution the ray turns and meets the boundary behind.
        let square_ahead = self.invariant + gain_ahead;
        let (width, slope, turns) = if square_ahead >= 0.0 {
            let root = square_ahead.sqrt();
            (2.0 * ahead / (steep + root), root, false)
        } else {
            let root = (self.invariant + gain_behind).max(0.0).sqrt();
            ((steep + root) / (-2.0 * bend), -root, true)
        };
        let exits_up = rising != turns;
        let z1 = if exits_up { layer.top } else { layer.bottom };
        let mut arc = Arc { r0: self.r, r1: self.r + width, z0: z, z1, slope: m, half_bend: a, apex: z1 };
        let mut slope = if rising { slope } else { -slope };
        // A level ray in a layer that does not bend it has no width that is a number: it runs to the limit.
        let in_range = arc.r1 < air.distance;
        if !in_range {
            arc.r1 = f64::INFINITY;
            let r1 = air.distance.max(self.r);
            arc.z1 = within(arc.height(r1), layer.bottom, layer.top);
            arc.r1 = r1;
            arc.apex = arc.z1;
            slope = arc.slope_at(r1);
        }
        if m * slope < 0.0 {
            arc.apex = within(z - 0.25 * m * m / a, layer.bottom, layer.top);
        }
        (self.r, self.z, self.slope) = (arc.r1, arc.z1, slope);
        if in_range {
            self.cross(air, if exits_up { self.layer + 1 } else { self.layer });
        } else {
            self.end = Some(End::Range);
        }
        arc
    }
}
