//! Where a curve of parabolic arcs first meets what a shape leaves in its plane: a line (plane), a segment
//! (triangle, rectangle) or a circle (sphere). Thesis 4.3, eq. 4.3 and 4.6.
//!
//! All three look for the first change of sign of a polynomial arc by arc. The sign at an arc's end is computed
//! from the stored end, which is the next arc's start, and a zero there counts: nothing is lost between two arcs,
//! between two facets with a common edge, or between the last arc and a surface that lies where it ends.

use super::arc::Arc;
use super::path::Path;
use super::radial_plane::{Circle, Line, Segment};
use super::tip::HeightRange;
use crate::within::within;

/// Coefficients of q(s) = a s² + b s + c.
#[derive(Clone, Copy)]
struct Quadratic {
    a: f64,
    b: f64,
    c: f64,
}

impl Quadratic {
    #[inline]
    fn at(&self, s: f64) -> f64 {
        (self.a * s + self.b) * s + self.c
    }

    /// Whether the same signs at both ends show that there is no root between: there are two roots or none, and none
    /// unless the values first near zero and then leave it.
    #[inline]
    fn keeps_its_sign(&self, from: f64, to: f64, value_from: f64, value_to: f64) -> bool {
        let slope = |s: f64| 2.0 * self.a * s + self.b;
        value_from * value_to > 0.0 && (slope(from) * value_from >= 0.0 || slope(to) * value_from <= 0.0)
    }

    /// Smallest root in from..to, both included, where the values at the two ends are known better than the
    /// coefficients say.
    #[inline(always)]
    fn first_root(&self, from: f64, to: f64, value_from: f64, value_to: f64) -> Option<f64> {
        if value_from == 0.0 {
            return Some(from);
        }
        if self.keeps_its_sign(from, to, value_from, value_to) {
            return None;
        }
        if value_from * value_to > 0.0 {
            let turn = self.turn();
            return (self.at(turn) * value_from <= 0.0).then(|| self.root_before(from, turn));
        }
        let turn = self.turn();
        let turns_inside = from < turn && turn < to;
        if turns_inside && self.at(turn) * value_from <= 0.0 {
            return Some(self.root_before(from, turn));
        }
        if value_to == 0.0 && !turns_inside {
            return Some(to);
        }
        Some(self.only_root(from, to, value_from, value_to))
    }

    /// Where it is lowest or highest.
    fn turn(&self) -> f64 {
        -self.b / (2.0 * self.a)
    }

    /// The root left of the turning point.
    fn root_before(&self, from: f64, turn: f64) -> f64 {
        let spread = (self.b * self.b - 4.0 * self.a * self.c).max(0.0).sqrt() / (2.0 * self.a).abs();
        within(turn - spread, from, turn)
    }

    /// The one root where the ends have different signs.
    fn only_root(&self, from: f64, to: f64, value_from: f64, value_to: f64) -> f64 {
        let discriminant = self.b * self.b - 4.0 * self.a * self.c;
        if discriminant >= 0.0 {
            let q = -0.5 * (self.b + discriminant.sqrt().copysign(self.b));
            let (one, other) = (self.c / q, q / self.a);
            // Of two candidates the one inside, or nearer to it, is meant.
            let outside = |s: f64| (from - s).max(s - to).max(0.0);
            let (first, second) = (outside(one), outside(other));
            let best = if first.is_nan() || second < first { other } else { one };
            if best.is_finite() {
                return within(best, from, to);
            }
        }
        from + (to - from) * (value_from / (value_from - value_to))
    }
}

/// Which meetings of a curve with a shape count.
#[derive(Clone, Copy, Debug)]
pub struct Range {
    /// Those beyond this distance,
    pub from: f64,
    /// and not beyond this one.
    pub to: f64,
    /// Whether the curve starts on the shape: what counts is where it comes back.
    pub leaves: bool,
    /// An arc near the shape.
    pub hint: usize,
}

impl Range {
    fn holds(&self, r: f64) -> bool {
        self.from < r && r <= self.to
    }
}

/// Where a curve meets a shape: at a distance, on one of its arcs.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    pub r: f64,
    pub arc: Arc,
    /// Of the curve's arcs, from 0.
    pub number: usize,
}

#[cfg(test)]
impl Range {
    fn whole(hint: usize) -> Self {
        Self { from: 0.0, to: f64::INFINITY, leaves: false, hint }
    }
}

/// Where the curve first meets a line.
pub fn meet_line(path: &mut Path, line: &Line, range: &Range) -> Option<Crossing> {
    let side = |r: f64, z: f64| line.a * r + line.c * z + line.d;
    let level = line.a == 0.0;
    // A curve that starts on the line leaves it, and may come back.
    let leaves = range.leaves || side(0.0, path.eye_height()).abs() <= range.from;
    let heights = if level && !leaves { HeightRange::around(-line.d / line.c) } else { HeightRange::ALL };
    let mut met = None;
    path.walk(heights, |number, arc| {
        if arc.r0 > range.to {
            return false;
        }
        let leaves = leaves && number == 0;
        // Of one arc's end and the next one's start the same value comes.
        let ends = [side(arc.r0, arc.z0), side(arc.r1, arc.z1)];
        // A level line is not crossed by an arc that does not turn and has both ends on one side.
        let passes_by = level && ends[0] * ends[1] > 0.0 && arc.apex == arc.z1 && !leaves;
        if !passes_by && let Some(r) = arc_meets_line(arc, line, ends, leaves) {
            met = (r <= range.to).then_some(Crossing { r, arc: *arc, number });
            return false;
        }
        true
    });
    met
}

/// The values are those of the line at the arc's two ends.
#[inline(never)]
fn arc_meets_line(arc: &Arc, line: &Line, [start, end]: [f64; 2], leaves: bool) -> Option<f64> {
    let q = Quadratic { a: line.c * arc.half_bend, b: line.c * arc.slope + line.a, c: start };
    let width = arc.r1 - arc.r0;
    let root = if leaves {
        let again = -q.b / q.a;
        (0.0 < again && again <= width).then_some(again)
    } else {
        q.first_root(0.0, width, start, end)
    };
    root.map(|x| arc.r0 + x)
}

/// Where the curve first meets a segment. The range's hint becomes the arc above the segment's start.
#[inline]
pub fn meet_segment(path: &mut Path, segment: &Segment, range: &mut Range) -> Option<Crossing> {
    let (start, step) = (segment.start, segment.end - segment.start);
    if segment.end.x < 0.0 || start.x > range.to {
        return None;
    }
    let mut i = path.find(start.x.max(0.0), range.hint)?;
    range.hint = i;
    while let Some(arc) = path.arc(i) {
        if arc.r0 > segment.end.x || arc.r0 > range.to {
            return None;
        }
        let uncertainty = if arc.r0 > 0.0 {
            -1.0
        } else if range.leaves {
            f64::INFINITY
        } else {
            range.from
        };
        if let Some(r) = arc_meets_segment(arc, segment, start, step, uncertainty) {
            return range.holds(r).then_some(Crossing { r, arc: *arc, number: i });
        }
        i += 1;
    }
    None
}

/// Along the segment, (r, z) = start + s step, so that an upright one is no special case. An arc whose start lies on
/// the segment, as well as it is known, leaves it, and may come back.
#[inline]
fn arc_meets_segment(
    arc: &Arc,
    segment: &Segment,
    start: glam::DVec2,
    step: glam::DVec2,
    uncertainty: f64,
) -> Option<f64> {
    let (lower, upper) = if step.y >= 0.0 { (start.y, segment.end.y) } else { (segment.end.y, start.y) };
    if arc.low() > upper || arc.high() < lower {
        return None;
    }
    let starts_before = start.x < arc.r0;
    let ends_after = segment.end.x > arc.r1;
    let over_start = |r: f64, z: f64, s: f64| (z - start.y - s * step.y, s, r);
    let (value_from, from, _) = if starts_before {
        over_start(arc.r0, arc.z0, (arc.r0 - start.x) / step.x)
    } else {
        over_start(start.x, arc.height(start.x), 0.0)
    };
    let (value_to, to, _) = if ends_after {
        over_start(arc.r1, arc.z1, (arc.r1 - start.x) / step.x)
    } else {
        (arc.height(segment.end.x) - segment.end.y, 1.0, segment.end.x)
    };
    let x = start.x - arc.r0;
    let q = Quadratic {
        a: arc.half_bend * step.x * step.x,
        b: (2.0 * arc.half_bend * x + arc.slope) * step.x - step.y,
        c: (arc.half_bend * x + arc.slope) * x + arc.z0 - start.y,
    };
    let s = if starts_before && value_from.abs() <= uncertainty {
        // The roots add up to -b/a.
        Some(-q.b / q.a - from).filter(|&again| from < again && again <= to)?
    } else {
        q.first_root(from, to, value_from, value_to)?
    };
    Some(within(start.x + s * step.x, arc.r0, arc.r1))
}

/// Where the curve first enters a circle, or leaves the one it starts in.
pub fn meet_circle(path: &mut Path, circle: &Circle, range: &Range) -> Option<Crossing> {
    let (center, radius) = (circle.center, circle.radius);
    let (near, far) = (center.x - radius, center.x + radius);
    if far < 0.0 || near > range.to {
        return None;
    }
    // Positive outside.
    let side = |r: f64, z: f64| {
        let (x, y) = (r - center.x, z - center.y);
        x * x + y * y - radius * radius
    };
    let &first = path.arc(0)?;
    let outside = if range.leaves {
        Quartic::new(&first, circle).coefficients[1] > 0.0
    } else {
        side(first.r0, first.z0) > 0.0
    };
    let mut i = path.find(near.max(0.0), range.hint)?;
    while let Some(&arc) = path.arc(i) {
        let (from, to) = (arc.r0.max(near), arc.r1.min(far));
        if from > to || from > range.to {
            return None;
        }
        let high_enough = arc.high() >= center.y - radius;
        if (high_enough && arc.low() <= center.y + radius) || !outside {
            let mut quartic = Quartic::new(&arc, circle);
            if i == 0 && range.leaves {
                quartic = quartic.without_start();
            }
            let found = if outside {
                quartic.first_at_most_zero(from - arc.r0, to - arc.r0)
            } else {
                quartic.negated().first_at_most_zero((from - arc.r0).max(1e-12), to - arc.r0)
            };
            if let Some(x) = found {
                let r = arc.r0 + x;
                return range.holds(r).then_some(Crossing { r, arc, number: i });
            }
        }
        i += 1;
    }
    None
}

/// The polynomial of eq. 4.3, from the constant upward, in x = r - r0.
#[derive(Clone, Copy)]
struct Quartic {
    coefficients: [f64; 5],
}

impl Quartic {
    fn new(arc: &Arc, circle: &Circle) -> Self {
        let (a, b, c) = (arc.half_bend, arc.slope, arc.z0 - circle.center.y);
        let x = circle.center.x - arc.r0;
        Self {
            coefficients: [
                c * c + x * x - circle.radius * circle.radius,
                2.0 * (b * c - x),
                2.0 * a * c + b * b + 1.0,
                2.0 * a * b,
                a * a,
            ],
        }
    }

    /// For a curve that starts on the circle: divided by x, so that the start is no root.
    fn without_start(self) -> Self {
        let [_, b, c, d, e] = self.coefficients;
        Self { coefficients: [b, c, d, e, 0.0] }
    }

    fn negated(mut self) -> Self {
        self.coefficients = self.coefficients.map(|k| -k);
        self
    }

    /// Smallest x in from..to at which the polynomial is zero or less; None where `to` lies before `from`.
    fn first_at_most_zero(&self, from: f64, to: f64) -> Option<f64> {
        if from > to {
            return None;
        }
        let k = &self.coefficients;
        let value = |x: f64| (((k[4] * x + k[3]) * x + k[2]) * x + k[1]) * x + k[0];
        if value(from) <= 0.0 {
            return Some(from);
        }
        let slope = |x: f64| ((4.0 * k[4] * x + 3.0 * k[3]) * x + 2.0 * k[2]) * x + k[1];
        let second = |x: f64| (12.0 * k[4] * x + 6.0 * k[3]) * x + 2.0 * k[2];
        let lowest = Quadratic { a: 12.0 * k[4], b: 6.0 * k[3], c: 2.0 * k[2] };
        let turn = within(lowest.turn(), from, to);
        let convex = second(from) > 0.0 && second(to) > 0.0 && second(turn) > 0.0;
        if convex {
            return descend(value, slope, from, to);
        }
        first_change(k, from, to)
    }
}

/// Newton's method down a convex function that is positive at `from`: each step stays left of the first root.
fn descend(value: impl Fn(f64) -> f64, slope: impl Fn(f64) -> f64, from: f64, to: f64) -> Option<f64> {
    let mut x = from;
    for _ in 0..100 {
        let (y, descent) = (value(x), slope(x));
        if y <= 0.0 {
            return Some(x);
        }
        if descent.is_nan() || descent >= 0.0 {
            return None;
        }
        let next = x - y / descent;
        if next > to {
            // The last step may pass the end by a rounding error only if the end itself is inside.
            return (value(to) <= 0.0).then_some(to);
        }
        if next <= x {
            return Some(x);
        }
        x = next;
    }
    Some(x)
}

/// First change of sign of any polynomial in from..to: between two neighbouring roots of its derivative it is
/// monotonic, and those are found the same way.
fn first_change(coefficients: &[f64], from: f64, to: f64) -> Option<f64> {
    let value = |x: f64| coefficients.iter().rev().fold(0.0, |sum, k| sum * x + k);
    let mut left = from;
    for right in changes(coefficients, from, to).into_iter().chain([to]) {
        if value(left) > 0.0 && value(right) <= 0.0 {
            return Some(bisect(value, left, right));
        }
        left = right;
    }
    None
}

/// Extremes of a polynomial in from..to, in order.
fn changes(coefficients: &[f64], from: f64, to: f64) -> Vec<f64> {
    if coefficients.len() < 3 {
        return Vec::new();
    }
    let derivative: Vec<f64> = coefficients.iter().enumerate().skip(1).map(|(n, k)| n as f64 * k).collect();
    let value = |x: f64| derivative.iter().rev().fold(0.0, |sum, k| sum * x + k);
    let mut found = Vec::new();
    let mut left = from;
    for right in changes(&derivative, from, to).into_iter().chain([to]) {
        if value(left) * value(right) <= 0.0 {
            let falling = value(left) > 0.0;
            found.push(bisect(|x| if falling { value(x) } else { -value(x) }, left, right));
        }
        left = right;
    }
    found
}

/// Halves until nothing is between: `value` is positive left of the result and not positive right of it.
fn bisect(value: impl Fn(f64) -> f64, mut left: f64, mut right: f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (left + right);
        if middle <= left || middle >= right {
            break;
        }
        if value(middle) > 0.0 {
            left = middle;
        } else {
            right = middle;
        }
    }
    right
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::atmosphere::Atmosphere;
    use glam::DVec2;
    use proptest::prelude::*;

    fn air(bends: &[f64]) -> Atmosphere {
        Atmosphere::of_bends(bends, 500, 2_000.0)
    }

    /// First distance at which `side` changes sign along the curve, by small steps.
    fn sampled(path: &mut Path, side: impl Fn(f64, f64) -> f64) -> Option<f64> {
        let mut i = 0;
        let mut before: Option<f64> = None;
        while let Some(&arc) = path.arc(i) {
            for k in 0..=2000 {
                let r = arc.r0 + (arc.r1 - arc.r0) * f64::from(k) / 2000.0;
                let now = side(r, arc.height(r));
                if before.is_some_and(|value| value * now < 0.0) {
                    return Some(r);
                }
                before = Some(now);
            }
            i += 1;
        }
        None
    }

    /// A step of the sampling above, which may also pass over a short visit.
    fn agree(exact: Option<f64>, sampled: Option<f64>) -> bool {
        match (exact, sampled) {
            (Some(one), Some(other)) => one <= other + 1e-6 && (other - one < 2.0),
            (None, None) => true,
            _ => false,
        }
    }

    fn bends() -> impl Strategy<Value = Vec<f64>> {
        prop::collection::vec(-2e-4..2e-4f64, 1..6)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(400))]

        #[test]
        fn lines_are_met_where_sampling_finds_them(
            bends in bends(), slope in -0.02..0.02f64,
            a in prop_oneof![Just(0.0), -0.01..0.01f64], height in -1.0..6.0f64,
        ) {
            let air = air(&bends);
            let mut path = Path::new(&air);
            path.start(0.4 * bends.len() as f64, slope);
            let line = Line { a, c: 1.0, d: -height };
            let exact = meet_line(&mut path, &line, &Range::whole(0)).map(|met| met.r);
            let expected = sampled(&mut path, |r, z| line.a * r + z + line.d);
            if let (Some(r), None) = (exact, expected) {
                // A graze that sampling steps over must at least be a meeting.
                let arc = path.arcs().iter().find(|arc| arc.r0 <= r && r <= arc.r1).unwrap();
                prop_assert!((line.a * r + arc.height(r) + line.d).abs() < 1e-7);
            } else {
                prop_assert!(agree(exact, expected), "{exact:?} {expected:?}");
            }
        }

        #[test]
        fn segments_are_met_where_sampling_finds_them(
            bends in bends(), slope in -0.02..0.02f64,
            r in 1.0..800.0f64, dr in 0.0..50.0f64, z in -1.0..6.0f64, dz in -3.0..3.0f64, hint in 0usize..9,
        ) {
            let air = air(&bends);
            let mut path = Path::new(&air);
            path.start(0.4 * bends.len() as f64, slope);
            let segment = Segment { start: DVec2::new(r, z), end: DVec2::new(r + dr, z + dz) };
            let exact = meet_segment(&mut path, &segment, &mut Range::whole(hint)).map(|met| met.r);
            if let Some(t) = exact {
                let arc = *path.arcs().iter().find(|arc| arc.r0 <= t && t <= arc.r1).unwrap();
                prop_assert!(r - 1e-9 <= t && t <= r + dr + 1e-9);
                if dr > 1e-3 {
                    prop_assert!((z + dz * (t - r) / dr - arc.height(t)).abs() < 1e-6);
                }
            }
            // By sampling the segment and comparing the sides of its points.
            path.keep_all();
            let sides: Vec<f64> = (0..=4000).filter_map(|i| {
                let s = f64::from(i) / 4000.0;
                let at = r + s * dr;
                let arc = path.arcs().iter().find(|arc| arc.r0 <= at && at <= arc.r1)?;
                Some(arc.height(at) - z - s * dz)
            }).collect();
            let crosses = sides.windows(2).any(|pair| pair[0] * pair[1] < 0.0);
            if crosses { prop_assert!(exact.is_some()); }
            if exact.is_some() && !crosses {
                prop_assert!(sides.iter().any(|side| side.abs() < 1e-3));
            }
        }

        #[test]
        fn circles_are_met_where_sampling_finds_them(
            bends in bends(), slope in -0.02..0.02f64,
            r in -3.0..800.0f64, z in -3.0..8.0f64, radius in 0.1..20.0f64, hint in 0usize..9,
        ) {
            let air = air(&bends);
            let mut path = Path::new(&air);
            path.start(0.4 * bends.len() as f64, slope);
            let circle = Circle { center: DVec2::new(r, z), radius };
            let exact = meet_circle(&mut path, &circle, &Range::whole(hint)).map(|met| met.r);
            let expected = sampled(&mut path, |x, y| (x - r).hypot(y - z) - radius);
            if let (Some(t), None) = (exact, expected) {
                let arc = path.arcs().iter().find(|arc| arc.r0 <= t && t <= arc.r1).unwrap();
                prop_assert!(((t - r).hypot(arc.height(t) - z) - radius).abs() < 1e-6);
            } else {
                prop_assert!(agree(exact, expected), "{exact:?} {expected:?}");
            }
        }

        /// Strong bends and big circles, where the polynomial is not convex.
        #[test]
        fn the_general_root_finder_agrees_with_sampling(
            k in prop::array::uniform5(-1.0..1.0f64), to in 0.1..3.0f64,
        ) {
            let mut k = k;
            k[0] = k[0].abs() + 0.01;
            let value = |x: f64| k.iter().rev().fold(0.0, |sum, c| sum * x + c);
            let exact = first_change(&k, 0.0, to);
            let expected = (0..=10_000).map(|i| to * f64::from(i) / 10_000.0).find(|&x| value(x) <= 0.0);
            match (exact, expected) {
                (Some(x), None) => prop_assert!(value(x).abs() < 1e-6),
                (None, Some(_)) => prop_assert!(false),
                (Some(x), Some(y)) => prop_assert!((x - y).abs() < 1e-3 || value(x).abs() < 1e-6),
                (None, None) => {}
            }
        }
    }

    #[test]
    fn a_curve_that_ends_on_the_ground_meets_it() {
        let air = air(&[1e-5, -1e-5, 3e-5]);
        let mut path = Path::new(&air);
        let ground = Line { a: 0.0, c: 1.0, d: 0.0 };
        for i in 1..1000 {
            path.start(2.1, -f64::from(i) * 1e-4 - 6e-3);
            let met = meet_line(&mut path, &ground, &Range::whole(0));
            assert_eq!(met.is_some(), path.end_tip().z == 0.0, "slope {i}");
        }
    }
}
