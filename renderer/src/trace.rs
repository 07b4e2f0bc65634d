//! How a ray finds the shape it meets first: straight, on its way to a light, or curved.

use glam::{DVec2, DVec3};

use crate::bvh::{Boxes, Bvh, Probe, Slab, Visit, at_least};
use crate::optics::crossing::{meet_circle, meet_line, meet_segment};
use crate::optics::path::Path;
use crate::ray::{Hit, Ray, ShapeId, ShapeKind};
use crate::scene::Shapes;
use crate::shape::{RadialPlane, cut, triangle};

/// Distance at which a straight ray meets a shape.
#[inline]
fn meet(shapes: &Shapes, ray: &Ray, shape: ShapeId, corners: [u32; 3]) -> Option<f64> {
    let own = ray.leaves == Some(shape);
    if shape.kind() == ShapeKind::Sphere {
        return shapes.sphere(shape.row()).intersect(ray, own);
    }
    if own {
        return None;
    }
    match shape.kind() {
        ShapeKind::Facet => triangle::intersect(&shapes.corners(corners), ray),
        ShapeKind::Rectangle => shapes.rectangle(shape.row()).intersect(ray),
        _ => shapes.plane(shape.row()).intersect(ray),
    }
}

fn corners_of(shapes: &Shapes, shape: ShapeId) -> [u32; 3] {
    if shape.kind() == ShapeKind::Facet { shapes.facet(shape.row()) } else { [0; 3] }
}

/// A straight ray's constants for boxes.
struct Straight {
    slabs: [Slab; 3],
    from: f32,
}

impl Straight {
    fn new(tree: &Bvh, ray: &Ray) -> Self {
        let slab = |axis| tree.slab(axis, ray.origin[axis], ray.direction[axis]);
        Self { slabs: [slab(0), slab(1), slab(2)], from: (ray.from as f32).next_down() }
    }

    #[inline]
    fn enter(&self, boxes: &Boxes, limit: f32) -> [f32; 4] {
        let [x, y, z] = &self.slabs;
        let [sides_x, sides_y, sides_z] = &boxes.sides;
        let from = wide::f32x4::splat(self.from);
        let to = wide::f32x4::splat(limit);
        let near = x.near(sides_x).fast_max(y.near(sides_y)).fast_max(z.near(sides_z).fast_max(from));
        let far = x.far(sides_x).fast_min(y.far(sides_y)).fast_min(z.far(sides_z).fast_min(to));
        let missed = wide::f32x4::splat(f32::INFINITY);
        use wide::CmpLe;
        near.simd_le(far).blend(near, missed).to_array()
    }
}

/// Looks for the nearest shape.
struct Nearest<'a> {
    shapes: &'a Shapes,
    ray: Ray,
    straight: Straight,
    limit: f32,
    found: Option<Hit>,
}

impl Nearest<'_> {
    #[inline]
    fn try_shape(&mut self, shape: ShapeId, corners: [u32; 3]) {
        if let Some(t) = meet(self.shapes, &self.ray, shape, corners)
            && t <= self.ray.to
        {
            Hit::keep_nearer(&mut self.found, t, shape);
            self.ray.to = t;
            self.limit = at_least(t);
        }
    }
}

impl Probe for Nearest<'_> {
    #[inline]
    fn enter(&mut self, boxes: &Boxes) -> [f32; 4] {
        self.straight.enter(boxes, self.limit)
    }

    #[inline]
    fn limit(&self) -> f32 {
        self.limit
    }

    #[inline]
    fn test(&mut self, item: &crate::bvh::Item) -> bool {
        self.try_shape(item.shape, item.corners);
        false
    }
}

/// The first shape of a tree along a straight ray.
pub fn nearest(shapes: &Shapes, tree: &Bvh, ray: &Ray, stack: &mut Vec<Visit>) -> Option<Hit> {
    let mut probe = Nearest {
        shapes,
        ray: *ray,
        straight: Straight::new(tree, ray),
        limit: at_least(ray.to),
        found: None,
    };
    for &shape in &tree.unbounded {
        probe.try_shape(shape, corners_of(shapes, shape));
    }
    tree.walk(&mut probe, stack);
    probe.found
}

/// Looks for any shape at all.
struct Blocker<'a> {
    shapes: &'a Shapes,
    ray: Ray,
    straight: Straight,
    limit: f32,
    found: bool,
}

impl Probe for Blocker<'_> {
    #[inline]
    fn enter(&mut self, boxes: &Boxes) -> [f32; 4] {
        self.straight.enter(boxes, self.limit)
    }

    #[inline]
    fn limit(&self) -> f32 {
        self.limit
    }

    #[inline]
    fn test(&mut self, item: &crate::bvh::Item) -> bool {
        let t = meet(self.shapes, &self.ray, item.shape, item.corners);
        self.found = t.is_some_and(|t| t < self.ray.to);
        self.found
    }
}

/// Whether a shape of the tree lies on the ray before its end.
pub fn blocked(shapes: &Shapes, tree: &Bvh, ray: &Ray, stack: &mut Vec<Visit>) -> bool {
    let blocks =
        |shape: &ShapeId| meet(shapes, ray, *shape, corners_of(shapes, *shape)).is_some_and(|t| t < ray.to);
    if tree.unbounded.iter().any(blocks) {
        return true;
    }
    let mut probe = Blocker {
        shapes,
        ray: *ray,
        straight: Straight::new(tree, ray),
        limit: at_least(ray.to),
        found: false,
    };
    tree.walk(&mut probe, stack);
    probe.found
}

/// Looks for the nearest shape along a curve in a radial plane. A box is entered where the plane's two horizontal
/// slabs say, if the curve passes the box's heights in between.
struct Curved<'a, 'b, 'c> {
    shapes: &'a Shapes,
    plane: RadialPlane,
    path: &'b mut Path<'c>,
    slabs: [Slab; 2],
    to: f64,
    limit: f32,
    /// Number of the arc last looked at, near which the next one is.
    arc: usize,
    found: Option<Hit>,
}

impl Curved<'_, '_, '_> {
    fn try_shape(&mut self, shape: ShapeId, corners: [u32; 3]) {
        let row = shape.row();
        let met = match shape.kind() {
            ShapeKind::Facet => cut(&self.plane, &self.shapes.corners(corners))
                .and_then(|segment| meet_segment(self.path, &segment, self.to, self.arc)),
            ShapeKind::Rectangle => self
                .shapes
                .rectangle(row)
                .cut(&self.plane)
                .and_then(|segment| meet_segment(self.path, &segment, self.to, self.arc)),
            ShapeKind::Sphere => self
                .shapes
                .sphere(row)
                .cut(&self.plane)
                .and_then(|circle| meet_circle(self.path, &circle, self.to, self.arc)),
            ShapeKind::Plane => {
                self.shapes.plane(row).cut(&self.plane).and_then(|line| meet_line(self.path, &line, self.to))
            }
        };
        if let Some(r) = met {
            Hit::keep_nearer(&mut self.found, r, shape);
            self.to = r;
            self.limit = at_least(r);
        }
    }
}

impl Probe for Curved<'_, '_, '_> {
    #[inline]
    fn enter(&mut self, boxes: &Boxes) -> [f32; 4] {
        let [x, y] = &self.slabs;
        let [sides_x, sides_y, [low, high]] = &boxes.sides;
        let zero = wide::f32x4::splat(0.0);
        let to = wide::f32x4::splat(self.limit);
        let near = x.near(sides_x).fast_max(y.near(sides_y)).fast_max(zero).to_array();
        let far = x.far(sides_x).fast_min(y.far(sides_y)).fast_min(to).to_array();
        let (low, high) = (low.to_array(), high.to_array());
        let mut entered = [f32::INFINITY; 4];
        for i in 0..4 {
            if near[i] <= far[i]
                && self.path.passes(
                    f64::from(near[i]),
                    f64::from(far[i]),
                    f64::from(low[i]),
                    f64::from(high[i]),
                    &mut self.arc,
                )
            {
                entered[i] = near[i];
            }
        }
        entered
    }

    #[inline]
    fn limit(&self) -> f32 {
        self.limit
    }

    #[inline]
    fn test(&mut self, item: &crate::bvh::Item) -> bool {
        self.try_shape(item.shape, item.corners);
        false
    }
}

/// The first shape of a tree along a curve that starts at the plane's origin, not beyond `limit`.
pub fn nearest_on_curve(
    shapes: &Shapes,
    tree: &Bvh,
    plane: &RadialPlane,
    path: &mut Path,
    limit: f64,
    stack: &mut Vec<Visit>,
) -> Option<Hit> {
    let (origin, DVec2 { x, y }) = (plane.origin, plane.radial);
    let mut probe = Curved {
        shapes,
        plane: *plane,
        path,
        slabs: [tree.slab(0, origin.x, x), tree.slab(1, origin.y, y)],
        to: limit,
        limit: at_least(limit),
        arc: 0,
        found: None,
    };
    tree.walk(&mut probe, stack);
    // After the tree: a plane is looked for arc by arc, and need not be beyond what is already found.
    for &shape in &tree.unbounded {
        probe.try_shape(shape, corners_of(shapes, shape));
    }
    probe.found
}

/// How far from a surface a ray that starts on it begins to look for others: well above the rounding of the start.
pub fn clearance(point: DVec3, travelled: f64) -> f64 {
    1e-10 * (point.abs().max_element() + travelled.min(1e12))
}
