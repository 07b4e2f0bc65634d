//! The end of a curve in the making, and how it goes on: arc by arc, each to the layer boundary it meets first.
//!
//! An arc ends exactly where the next one starts: a layer boundary's height is that boundary's, not a parabola's
//! rounded value, so that a surface lying on a boundary is met by the arc that ends there.

use wide::f64x2;

use super::arc::Arc;
use super::atmosphere::{Atmosphere, Layer};

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

/// How far a curve has been followed.
#[derive(Clone, Copy, Debug)]
pub struct Tip {
    pub r: f64,
    pub z: f64,
    pub slope: f64,
    /// slope², which is linear in the height within a layer: it runs ahead of the square roots.
    slope_squared: f64,
    /// Layer that the next arc runs in.
    layer: usize,
    pub end: Option<End>,
}

impl Tip {
    /// A curve's beginning at height z with the tangent's slope dz/dr.
    pub fn new(air: &Atmosphere, z: f64, slope: f64) -> Self {
        let mut tip = Self { r: 0.0, z, slope, slope_squared: slope * slope, layer: 0, end: None };
        let above = air.layers.partition_point(|layer| layer.top <= z);
        match air.layers.get(above) {
            Some(layer) if layer.bottom < z => tip.layer = above,
            // On the boundary below layer `above`, or outside of all layers.
            Some(layer) if layer.bottom == z => tip.cross(air, above),
            Some(_) => tip.end = Some(End::Ground),
            None if air.layers.last().is_some_and(|layer| layer.top == z) => tip.cross(air, above),
            None => tip.end = Some(End::Top),
        }
        tip
    }

    /// Follows the curve, at most `most` arcs, for as long as `keep` wants more after each.
    #[inline(always)] // So that the loops keep the tip in registers.
    pub fn follow(&mut self, air: &Atmosphere, most: usize, mut keep: impl FnMut(Arc) -> bool) {
        let mut left = most;
        let mut keep = |arc| {
            left -= 1;
            keep(arc) && left > 0
        };
        while self.end.is_none() && most > 0 {
            let more = if self.slope > 0.0 {
                self.pass_layers::<true>(air, &mut keep)
            } else {
                self.pass_layers::<false>(air, &mut keep)
            };
            if !more {
                return;
            }
            let arc = self.step(air);
            if !keep(arc) {
                return;
            }
        }
    }

    /// Follows the curve to where it ends, and gives the number of its arcs.
    pub fn follow_to_end(&mut self, air: &Atmosphere) -> usize {
        let mut arcs = 0;
        let mut tip = *self;
        tip.follow(air, air.segments, |_| {
            arcs += 1;
            true
        });
        tip.end = tip.end.or(Some(End::Segments));
        *self = tip;
        arcs
    }

    /// Follows the curve from a boundary through whole layers, which is most of the work, until it is about to turn,
    /// to be level, to go beyond the distance limit or to leave the layers: the same arcs as `step` makes. Not at all
    /// where it is inside of a layer. False once `keep` wants no more.
    #[inline(always)]
    fn pass_layers<const UP: bool>(&mut self, air: &Atmosphere, keep: &mut impl FnMut(Arc) -> bool) -> bool {
        let begins = air.layers.get(self.layer).map(|layer| if UP { layer.bottom } else { layer.top });
        if self.slope == 0.0 || begins != Some(self.z) {
            return true;
        }
        let beyond = |layer: usize| if UP { layer + 1 } else { layer.wrapping_sub(1) };
        let reach = |slope_squared: f64, layer: &Layer| {
            if UP { slope_squared + layer.gain } else { slope_squared - layer.gain }
        };
        loop {
            let (first, second) = (self.layer, beyond(self.layer));
            let (Some(one), Some(two)) = (air.layers.get(first), air.layers.get(second)) else { return true };
            let reach_one = reach(self.slope_squared, one);
            let reach_two = reach(reach_one, two);
            // Two layers at once: square roots and divisions are what takes time.
            let roots = f64x2::from([reach_one, reach_two]).sqrt();
            let [root_one, root_two] = roots.to_array();
            let doubled = f64x2::from([2.0 * one.height, 2.0 * two.height]);
            let widths = doubled / (f64x2::from([self.slope.abs(), root_one]) + roots);
            let [width_one, width_two] = widths.to_array();
            for (layer, reach, root, width) in
                [(one, reach_one, root_one, width_one), (two, reach_two, root_two, width_two)]
            {
                let r1 = self.r + width;
                let next = beyond(self.layer);
                if reach.is_nan() || reach <= 0.0 || !(r1 < air.distance && next < air.layers.len()) {
                    return true;
                }
                let z1 = if UP { layer.top } else { layer.bottom };
                let half_bend = layer.half_bend;
                let arc = Arc { r0: self.r, r1, z0: self.z, z1, slope: self.slope, half_bend, apex: z1 };
                self.slope = if UP { root } else { -root };
                (self.r, self.z, self.slope_squared, self.layer) = (r1, z1, reach, next);
                if !keep(arc) {
                    return false;
                }
            }
        }
    }

    /// Chooses the layer beyond the boundary below layer `above`, by the ray's slope, or by the way it bends where
    /// it is level.
    #[inline]
    fn cross(&mut self, air: &Atmosphere, above: usize) {
        let layers = &air.layers;
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

    /// The arc from here to the next layer boundary, of a curve that has not ended.
    #[inline(always)]
    fn step(&mut self, air: &Atmosphere) -> Arc {
        let layer = air.layers[self.layer];
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
        let z1 = if exits_up { layer.top } else { layer.bottom };
        let mut arc = Arc { r0: self.r, r1: self.r + width, z0: z, z1, slope: m, half_bend: a, apex: z1 };
        let mut slope = if rising { slope } else { -slope };
        // A level ray in a layer that does not bend it has no width that is a number: it runs to the limit.
        let in_range = arc.r1 < air.distance;
        if !in_range {
            arc.r1 = f64::INFINITY;
            let r1 = air.distance.max(self.r);
            arc.z1 = arc.height(r1).clamp(layer.bottom, layer.top);
            arc.r1 = r1;
            arc.apex = arc.z1;
            slope = arc.slope_at(r1);
            self.slope_squared = slope * slope;
        }
        if m * slope < 0.0 {
            arc.apex = (z - 0.25 * m * m / a).clamp(layer.bottom, layer.top);
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
