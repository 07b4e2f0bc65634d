//! How a ray finds the shape it meets first: straight, on its way to a light, or curved.

use glam::{DVec2, DVec3};
use wide::{CmpLe, f32x4};

use crate::bvh::{Boxes, Bvh, Item, Probe, Slab, Visit, at_least};
use crate::optics::crossing::{Crossing, Range};
use crate::optics::path::Path;
use crate::optics::radial_plane::RadialPlane;
use crate::ray::{Hit, Ray, Row, ShapeId};
use crate::shape::geometry::Geometry;
use crate::shapes::Shapes;

/// Distance at which a straight ray meets a shape.
#[inline(always)] // It is called for every facet of every leaf.
fn meet(shapes: &Shapes, ray: &Ray, shape: ShapeId, corners: [u32; 3]) -> Option<f64> {
    let own = ray.leaves == Some(shape);
    match shape.row() {
        Row::Facet(_) => shapes.flat_facet(corners).meet(ray, own),
        Row::Other(row) => meet_other(shapes, ray, row, own),
    }
}

/// The same for what is no facet, out of the way of those.
#[inline(never)]
fn meet_other(shapes: &Shapes, ray: &Ray, row: usize, own: bool) -> Option<f64> {
    shapes.other(row).meet(ray, own)
}

/// What a straight ray is after.
trait Search {
    /// Farthest distance still of interest.
    fn limit(&self) -> f32;
    /// Tests one shape; true ends the search.
    fn test(&mut self, shape: ShapeId, corners: [u32; 3]) -> bool;
}

/// A search on its walk through a tree. Bit `axis` of `OCTANT` is the slab's near side: known to the compiler, it
/// costs no arithmetic at each node.
struct Straight<'a, S, const OCTANT: usize> {
    search: &'a mut S,
    slabs: &'a [Slab; 3],
    from: f32,
}

impl<S: Search, const OCTANT: usize> Probe for Straight<'_, S, OCTANT> {
    #[inline]
    fn enter(&mut self, boxes: &Boxes) -> [f32; 4] {
        let near = |axis: usize| self.slabs[axis].near(boxes.sides[axis][OCTANT >> axis & 1]);
        let far = |axis: usize| self.slabs[axis].far(boxes.sides[axis][1 - (OCTANT >> axis & 1)]);
        let from = f32x4::splat(self.from);
        let to = f32x4::splat(self.search.limit());
        let near = near(0).fast_max(near(1)).fast_max(near(2).fast_max(from));
        let far = far(0).fast_min(far(1)).fast_min(far(2).fast_min(to));
        let missed = f32x4::splat(f32::INFINITY);
        near.simd_le(far).blend(near, missed).to_array()
    }

    #[inline]
    fn limit(&self) -> f32 {
        self.search.limit()
    }

    #[inline]
    fn test(&mut self, item: &Item) -> bool {
        self.search.test(item.shape, item.corners)
    }
}

/// Takes a search along a ray through a tree.
#[inline]
fn walk(tree: &Bvh, ray: &Ray, search: &mut impl Search, stack: &mut Vec<Visit>) {
    // Eight calls with so many arguments would cost a ray that meets nothing more than its walk.
    #[inline(always)]
    fn within<S: Search, const OCTANT: usize>(
        tree: &Bvh,
        slabs: &[Slab; 3],
        from: f32,
        search: &mut S,
        stack: &mut Vec<Visit>,
    ) {
        tree.walk(&mut Straight::<S, OCTANT> { search, slabs, from }, stack);
    }
    if !tree.takes(ray.origin, ray.direction) {
        return try_all(tree, ray, search);
    }
    let slabs = &[0, 1, 2].map(|axis| tree.slab(axis, ray.origin, ray.direction[axis]));
    let from = (ray.from as f32).next_down();
    match [0, 1, 2].map(|axis| slabs[axis].near_side) {
        [0, 0, 0] => within::<_, 0>(tree, slabs, from, search, stack),
        [1, 0, 0] => within::<_, 1>(tree, slabs, from, search, stack),
        [0, 1, 0] => within::<_, 2>(tree, slabs, from, search, stack),
        [1, 1, 0] => within::<_, 3>(tree, slabs, from, search, stack),
        [0, 0, _] => within::<_, 4>(tree, slabs, from, search, stack),
        [1, 0, _] => within::<_, 5>(tree, slabs, from, search, stack),
        [0, 1, _] => within::<_, 6>(tree, slabs, from, search, stack),
        _ => within::<_, 7>(tree, slabs, from, search, stack),
    }
}

/// Takes a search to every shape of a tree, where the slabs of the ray would hold no numbers. A ray that starts nowhere
/// or leads nowhere meets none.
#[cold]
#[inline(never)]
fn try_all(tree: &Bvh, ray: &Ray, search: &mut impl Search) {
    if ray.is_finite() {
        tree.items().iter().any(|item| search.test(item.shape, item.corners));
    }
}

/// Looks for the nearest shape.
struct Nearest<'a> {
    shapes: &'a Shapes,
    ray: Ray,
    limit: f32,
    found: Option<Hit>,
}

impl Search for Nearest<'_> {
    #[inline]
    fn limit(&self) -> f32 {
        self.limit
    }

    #[inline(always)]
    fn test(&mut self, shape: ShapeId, corners: [u32; 3]) -> bool {
        if let Some(t) = meet(self.shapes, &self.ray, shape, corners)
            && t <= self.ray.to
        {
            let hit = Hit { t, shape };
            if self.found.is_none_or(|known| hit.is_nearer(&known)) {
                self.found = Some(hit);
            }
            self.ray.to = t;
            self.limit = at_least(t);
        }
        false
    }
}

/// The first shape of a tree along a straight ray.
#[inline]
pub fn nearest(shapes: &Shapes, tree: &Bvh, ray: &Ray, stack: &mut Vec<Visit>) -> Option<Hit> {
    if tree.is_empty() { None } else { nearest_of_any(shapes, tree, ray, stack) }
}

fn nearest_of_any(shapes: &Shapes, tree: &Bvh, ray: &Ray, stack: &mut Vec<Visit>) -> Option<Hit> {
    let mut nearest = Nearest { shapes, ray: *ray, limit: at_least(ray.to), found: None };
    for &shape in &tree.unbounded {
        nearest.test(shape, shapes.corners_of(shape));
    }
    if !tree.lies_below(ray) {
        walk(tree, ray, &mut nearest, stack);
    }
    nearest.found
}

/// Looks for any shape at all.
struct Blocker<'a> {
    shapes: &'a Shapes,
    ray: Ray,
    limit: f32,
    found: bool,
}

impl Search for Blocker<'_> {
    #[inline]
    fn limit(&self) -> f32 {
        self.limit
    }

    #[inline(always)]
    fn test(&mut self, shape: ShapeId, corners: [u32; 3]) -> bool {
        self.found = meet(self.shapes, &self.ray, shape, corners).is_some_and(|t| t < self.ray.to);
        self.found
    }
}

/// Whether a shape of the tree lies on the ray before its end.
pub fn blocked(shapes: &Shapes, tree: &Bvh, ray: &Ray, stack: &mut Vec<Visit>) -> bool {
    let mut blocker = Blocker { shapes, ray: *ray, limit: at_least(ray.to), found: false };
    if tree.unbounded.iter().any(|&shape| blocker.test(shape, shapes.corners_of(shape))) {
        return true;
    }
    walk(tree, ray, &mut blocker, stack);
    blocker.found
}

/// How a curve starts.
#[derive(Clone, Copy, Default, Debug)]
pub struct Departure {
    /// Hits at this horizontal distance or nearer do not count.
    pub from: f64,
    /// The shape it starts on, if any. It may come back to it.
    pub leaves: Option<ShapeId>,
}

/// Looks for the nearest shape along a curve in a radial plane. A box is entered where the plane's two horizontal
/// slabs say, if the curve passes the box's heights in between.
struct Curved<'a, 'b, 'c> {
    shapes: &'a Shapes,
    plane: RadialPlane,
    path: &'b mut Path<'c>,
    departure: Departure,
    slabs: [Slab; 2],
    to: f64,
    limit: f32,
    /// Number of the arc last looked at, near which the next one is.
    arc: usize,
    found: Option<(Hit, Crossing)>,
}

impl Curved<'_, '_, '_> {
    /// The first shape of a tree.
    fn first_of(mut self, tree: &Bvh, stack: &mut Vec<Visit>) -> Option<(Hit, Crossing)> {
        match self.slabs.map(|slab| slab.near_side) {
            _ if !tree.takes(self.plane.origin, DVec3::ZERO) => self.try_all(tree),
            [0, 0] => tree.walk(&mut Walking::<0>(&mut self), stack),
            [1, 0] => tree.walk(&mut Walking::<1>(&mut self), stack),
            [0, _] => tree.walk(&mut Walking::<2>(&mut self), stack),
            _ => tree.walk(&mut Walking::<3>(&mut self), stack),
        }
        // After the tree: a plane is looked for arc by arc, and need not be beyond what is already found.
        for &shape in &tree.unbounded {
            self.try_shape(shape, self.shapes.corners_of(shape));
        }
        self.found
    }

    /// As of a straight ray.
    #[cold]
    #[inline(never)]
    fn try_all(&mut self, tree: &Bvh) {
        tree.items().iter().for_each(|item| self.try_shape(item.shape, item.corners));
    }

    fn try_shape(&mut self, shape: ShapeId, corners: [u32; 3]) {
        let mut range = Range {
            from: self.departure.from,
            to: self.to,
            leaves: self.departure.leaves == Some(shape),
            hint: self.arc,
        };
        let met = match shape.row() {
            Row::Facet(_) => self.shapes.flat_facet(corners).meet_curve(&self.plane, self.path, &mut range),
            Row::Other(row) => self.shapes.other(row).meet_curve(&self.plane, self.path, &mut range),
        };
        self.arc = range.hint;
        if let Some(crossing) = met {
            let hit = Hit { t: crossing.r, shape };
            if self.found.is_none_or(|(known, _)| hit.is_nearer(&known)) {
                self.found = Some((hit, crossing));
            }
            self.to = crossing.r;
            self.limit = at_least(crossing.r);
        }
    }
}

/// A search along a curve on its walk through a tree. Bit `axis` of `QUADRANT` is the slab's near side, as of a straight
/// ray's `OCTANT`.
struct Walking<'a, 'b, 'c, 'd, const QUADRANT: usize>(&'d mut Curved<'a, 'b, 'c>);

impl<const QUADRANT: usize> Probe for Walking<'_, '_, '_, '_, QUADRANT> {
    #[inline]
    fn enter(&mut self, boxes: &Boxes) -> [f32; 4] {
        let Curved { slabs, path, arc, limit, .. } = &mut *self.0;
        let near = |axis: usize| slabs[axis].near(boxes.sides[axis][QUADRANT >> axis & 1]);
        let far = |axis: usize| slabs[axis].far(boxes.sides[axis][1 - (QUADRANT >> axis & 1)]);
        let near = near(0).fast_max(near(1)).fast_max(f32x4::splat(0.0));
        let far = far(0).fast_min(far(1)).fast_min(f32x4::splat(*limit));
        let reached = near.simd_le(far);
        if reached.none() {
            return [f32::INFINITY; 4];
        }
        let passed = path.passes(reached, [near, far], boxes.sides[2], arc);
        passed.blend(near, f32x4::splat(f32::INFINITY)).to_array()
    }

    #[inline]
    fn limit(&self) -> f32 {
        self.0.limit
    }

    #[inline]
    fn test(&mut self, item: &Item) -> bool {
        self.0.try_shape(item.shape, item.corners);
        false
    }
}

/// The first shape of a tree along a curve that starts at the plane's origin, not beyond `limit`.
#[inline]
pub fn nearest_on_curve(
    shapes: &Shapes,
    tree: &Bvh,
    plane: &RadialPlane,
    path: &mut Path,
    departure: &Departure,
    limit: f64,
    stack: &mut Vec<Visit>,
) -> Option<(Hit, Crossing)> {
    let (origin, DVec2 { x, y }) = (plane.origin, plane.radial);
    if tree.is_empty() || !origin.is_finite() {
        return None;
    }
    let reach = path.reach();
    let curved = Curved {
        shapes,
        plane: *plane,
        path,
        departure: *departure,
        slabs: [tree.slab(0, origin, x), tree.slab(1, origin, y)],
        to: limit,
        limit: at_least(limit).min(reach),
        arc: 0,
        found: None,
    };
    curved.first_of(tree, stack)
}

/// How well a point of a surface is known that a ray has met after this way: well above the rounding of its numbers.
pub fn uncertainty(point: DVec3, travelled: f64) -> f64 {
    1e-13 * (point.abs().max_element() + travelled)
}

/// How far from a surface a ray that starts on it begins to look for others: well above the rounding of the start.
pub fn clearance(point: DVec3, travelled: f64) -> f64 {
    1e-10 * (point.abs().max_element() + travelled)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::atmosphere::Atmosphere;
    use crate::shape::facet::corners;
    use crate::shape::plane::Plane;
    use crate::shape::rectangle::Rectangle;
    use crate::shape::sphere::Sphere;
    use crate::shapes::{Owner, Part};
    use proptest::prelude::*;

    const PART: Part = Part { owner: Owner::Solid(0), primitive: 0 };

    fn point(reach: f64) -> impl Strategy<Value = DVec3> {
        (-reach..reach, -reach..reach, 0.0..8.0f64).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    fn edge() -> impl Strategy<Value = DVec3> {
        (-30.0..30.0f64, -30.0..30.0f64, -3.0..3.0f64).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    /// A few shapes of each kind in a field 400 m wide and 8 m high.
    fn shapes() -> impl Strategy<Value = Shapes> {
        let three = || (point(200.0), edge(), edge());
        (
            prop::collection::vec(three(), 0..12),
            prop::collection::vec(three(), 0..6),
            prop::collection::vec((point(200.0), 0.5..15.0f64), 0..6),
            prop::collection::vec((point(200.0), edge(), edge()), 0..2),
        )
            .prop_map(|(triangles, rectangles, spheres, planes)| {
                let mut shapes = Shapes::default();
                for (p, u, v) in triangles {
                    shapes.push_triangle(corners(p, u, v), PART);
                }
                for (point, u, v) in rectangles {
                    shapes.push(Rectangle { point, u, v }, PART);
                }
                for (center, radius) in spheres {
                    shapes.push(Sphere { center, radius, pole: DVec3::Z, equator: DVec3::X }, PART);
                }
                for (point, u, v) in planes {
                    shapes.push(Plane::spanned(point, u, v), PART);
                }
                shapes
            })
    }

    /// Every shape of a tree, without its help.
    fn each(tree: &Bvh) -> Vec<ShapeId> {
        let mut all = tree.unbounded.clone();
        all.extend(tree.items().iter().map(|item| item.shape));
        all
    }

    /// Whether a step of the curve from one point to another goes through a shape.
    fn pierced(shapes: &Shapes, shape: ShapeId, from: DVec3, to: DVec3) -> bool {
        let step = to - from;
        let ray = Ray { to: step.length(), ..Ray::new(from, step.normalize()) };
        meet(shapes, &ray, shape, shapes.corners_of(shape)).is_some_and(|t| t <= ray.to)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(600))]

        #[test]
        fn the_tree_finds_what_trying_every_shape_finds(
            mut shapes in shapes(), origin in point(250.0), target in point(200.0),
        ) {
            prop_assume!(origin.distance(target) > 1e-3);
            let (tree, _) = shapes.trees();
            let ray = Ray::new(origin, (target - origin).normalize());
            let found = nearest(&shapes, &tree, &ray, &mut Vec::new());
            let expected = each(&tree)
                .into_iter()
                .filter_map(|shape| Some((meet(&shapes, &ray, shape, shapes.corners_of(shape))?, shape)))
                .min_by(|a, b| a.partial_cmp(b).unwrap());
            prop_assert_eq!(found.map(|hit| (hit.t, hit.shape)), expected);
            let reach = expected.map_or(1e9, |(t, _)| t);
            for (to, expects) in [(0.999 * reach, false), (1.001 * reach, expected.is_some())] {
                let short = Ray { to, ..ray };
                prop_assert_eq!(blocked(&shapes, &tree, &short, &mut Vec::new()), expects);
            }
        }

        /// The curve is sampled so finely that its chords can be tested as straight rays.
        #[test]
        fn a_curve_hits_what_its_chords_hit(
            mut shapes in shapes(), eye in point(250.0), toward in 0.0..std::f64::consts::TAU,
            slope in -0.03..0.03f64, bends in prop::collection::vec(-3e-4..3e-4f64, 8),
        ) {
            let air = Atmosphere::of_bends(&bends, 300, 400.0);
            let mut path = Path::new(&air);
            path.start(eye.z, slope);
            let plane = RadialPlane { origin: eye, radial: DVec2::from_angle(toward) };
            let (tree, _) = shapes.trees();
            let found = nearest_on_curve(&shapes, &tree, &plane, &mut path, &Departure::default(), f64::INFINITY, &mut Vec::new());
            let found = found.map(|(hit, _)| hit);
            path.keep_all();
            // Chords of at most 0.2 m lie within 3e-6 m of the curve.
            let all = each(&tree);
            let mut expected = None;
            'curve: for arc in path.arcs() {
                let steps = ((arc.r1 - arc.r0) / 0.2).ceil().max(1.0);
                let at = |k: f64| arc.r0 + (arc.r1 - arc.r0) * (k / steps);
                let place = |r: f64| plane.point(r, arc.height(r));
                for k in 0..steps as u64 {
                    let (from, to) = (at(k as f64), at(k as f64 + 1.0));
                    if let Some(shape) =
                        all.iter().find(|&&shape| pierced(&shapes, shape, place(from), place(to)))
                    {
                        expected = Some((from, to, *shape));
                        break 'curve;
                    }
                }
            }
            match (found, expected) {
                (None, None) => {}
                (Some(hit), Some((from, to, _))) if from - 1e-3 <= hit.t && hit.t <= to + 1e-3 => {}
                // Where a shape is only grazed the chords may pass beside it: a curve moved a little decides.
                (hit, expected) => {
                    let mut near = |nudge: f64| {
                        path.start(eye.z + nudge, slope);
                        let mut moved = plane;
                        moved.origin.z += nudge;
                        nearest_on_curve(&shapes, &tree, &moved, &mut path, &Departure::default(), f64::INFINITY, &mut Vec::new())
                            .map(|(hit, _)| hit.t)
                    };
                    let around = [near(1e-4), near(-1e-4)];
                    let steady = around.iter().all(|t| match (t, hit) {
                        (Some(t), Some(hit)) => (t - hit.t).abs() < 1.0,
                        (None, None) => true,
                        _ => false,
                    });
                    prop_assert!(!steady, "{hit:?} {expected:?}");
                }
            }
        }
    }
}
