//! A curve as the boxes of the tree see it: in f32, four boxes at a time, and never narrower than it is.

use wide::{CmpGt, CmpLe, CmpLt, f32x4};

use super::arc::Arc;
use super::atmosphere::Atmosphere;

/// What holds of every curve through an atmosphere.
#[derive(Clone, Copy, Debug)]
pub struct Bends {
    /// Bounds of a layer's `half_bend`, one at most zero and one at least.
    least: f64,
    most: f64,
    bottom: f64,
    top: f64,
    distance: f64,
}

impl Bends {
    pub fn of(air: &Atmosphere) -> Self {
        let mut bends = Self {
            least: 0.0,
            most: 0.0,
            bottom: f64::INFINITY,
            top: f64::NEG_INFINITY,
            distance: air.distance,
        };
        for layer in &air.layers {
            bends.least = bends.least.min(layer.half_bend);
            bends.most = bends.most.max(layer.half_bend);
            bends.bottom = bends.bottom.min(layer.bottom);
            bends.top = bends.top.max(layer.top);
        }
        bends
    }
}

/// Between which heights a whole curve runs, told from its beginning alone: bent nowhere less than `Bends::least` nor
/// more than `Bends::most`, it stays between two parabolas, and it never leaves the layers.
#[derive(Clone, Copy, Debug)]
pub struct Envelope {
    /// The lower parabola, bent down, and the upper one, bent up: so each is outermost at an end of any interval.
    sides: [[f32x4; 3]; 2],
    bottom: f32x4,
    top: f32x4,
    pub reach: f32,
}

impl Envelope {
    pub fn new(bends: &Bends, z: f64, slope: f64) -> Self {
        // Sixteen roundings, where evaluation makes five; and what the arcs themselves lose in f64, and on a boundary
        // that holds them.
        let slack = |x: f64| x.abs() * 2f64.powi(-20) + 4e-9;
        let side = |sign: f64, half_bend: f64| {
            [half_bend * (1.0 + 2f64.powi(-20)), slope + sign * slack(slope), z + sign * slack(z)]
                .map(|x| f32x4::splat(x as f32))
        };
        Self {
            sides: [side(-1.0, bends.least), side(1.0, bends.most)],
            bottom: f32x4::splat((bends.bottom - slack(bends.bottom)) as f32),
            top: f32x4::splat((bends.top + slack(bends.top)) as f32),
            reach: (bends.distance as f32).next_up(),
        }
    }

    /// Of the boxes over the distances `near`..`far` and the heights `low`..`high`, those that the envelope passes; and
    /// those of them for which the envelope is too wide to tell much of the curve.
    #[inline]
    pub fn passes(&self, [near, far]: [f32x4; 2], [low, high]: [f32x4; 2]) -> (f32x4, f32x4) {
        let height = |[half_bend, slope, z]: [f32x4; 3], r: f32x4| (half_bend * r + slope) * r + z;
        let [below, above] = self.sides;
        let (lower, upper) = (height(below, far), height(above, far));
        let bottom = height(below, near).fast_min(lower).fast_max(self.bottom);
        let top = height(above, near).fast_max(upper).fast_min(self.top);
        // What has overflowed to no number misses nothing.
        let passed = !(bottom.simd_gt(high) | top.simd_lt(low));
        (passed, passed & (upper - lower).simd_gt(high - low))
    }
}

/// An arc. Its heights are widened by all that f32 may lose.
#[derive(Clone, Copy, Debug)]
pub struct ArcSketch {
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
    pub fn new(arc: &Arc) -> Self {
        let steepest = arc.slope.abs().max(arc.slope_at(arc.r1).abs());
        let size = arc.low().abs().max(arc.high().abs()) + steepest * arc.r1;
        Self {
            from: (arc.r0 as f32).next_down(),
            to: (arc.r1 as f32).next_up(),
            half_bend: arc.half_bend as f32,
            slope: arc.slope as f32,
            start: arc.z0 as f32,
            error: (size * 2f64.powi(-19)) as f32,
            apex: (arc.apex < arc.z0.min(arc.z1) || arc.apex > arc.z0.max(arc.z1)).then_some(arc.apex as f32),
        }
    }

    /// Which boxes end beyond the arc.
    #[inline]
    pub fn ends_before(&self, far: f32x4) -> f32x4 {
        far.simd_gt(f32x4::splat(self.to))
    }

    /// Boxes above or below which the arc is not all the way.
    #[inline]
    pub fn passes(&self, [near, far]: [f32x4; 2], [low, high]: [f32x4; 2]) -> f32x4 {
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
        near.simd_le(far) & !(bottom.simd_gt(high) | top.simd_lt(low))
    }
}
