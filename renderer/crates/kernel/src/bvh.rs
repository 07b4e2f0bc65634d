//! The bounding volume hierarchy over the finite shapes, and its walk by any kind of ray.
//!
//! obvhs builds a binary tree (PLOC: Meister and Bittner 2018); it is folded into nodes of four boxes, which one
//! set of SIMD instructions tests at once (Wald, Benthin and Boulos 2008). Boxes are f32 and rounded outward; the
//! tests against them are widened by their own rounding error, so that no box that a ray touches is missed; what is
//! in the leaves is tested in f64.

use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, SortPrecision};
use wide::f32x4;

use crate::ray::{Ray, ShapeId};

/// Beyond this, f32 arithmetic on boxes may overflow: such shapes are tested one by one.
const LARGEST_COORDINATE: f64 = 1e17;

/// Rays from farther away than this are tested against every shape: their slabs may overflow.
const FARTHEST_ORIGIN: f64 = 1e24;

/// Four boxes, by coordinate: x of the low sides, x of the high sides, then y and z.
#[derive(Clone, Copy, Debug)]
pub struct Boxes {
    pub sides: [[f32x4; 2]; 3],
}

#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Node {
    boxes: Boxes,
    /// A node's number, or the first item of a leaf.
    child: [u32; 4],
    /// Items of a leaf, 0 for a node.
    count: [u32; 4],
}

/// A shape in the tree. The corners of a facet stand beside its name, so that a leaf reads them in one go.
#[derive(Clone, Copy, Debug)]
pub struct Item {
    pub shape: ShapeId,
    pub corners: [u32; 3],
}

/// Shapes on their way into a tree. Their boxes are already the builder's leaves: of a million shapes every copy
/// counts.
#[derive(Default)]
pub struct Gathering {
    shapes: Vec<ShapeId>,
    leaves: Vec<Bvh2Node>,
    whole: Option<Aabb>,
    unbounded: Vec<ShapeId>,
}

impl Gathering {
    /// Room for so many shapes, of which the system gives what is written to.
    pub fn reserve(&mut self, shapes: usize) {
        self.shapes.reserve_exact(shapes);
        self.leaves.reserve_exact(shapes);
    }

    /// Adds a shape between two corners of its box. One whose box has a coordinate that is not a number or is too
    /// large for the tree will be tested by itself.
    pub fn add(&mut self, shape: ShapeId, low: DVec3, high: DVec3) {
        let within = low.min_element() >= -LARGEST_COORDINATE && high.max_element() <= LARGEST_COORDINATE;
        if !within {
            return self.add_unbounded(shape);
        }
        let down = |x: f64| {
            let rounded = x as f32;
            if f64::from(rounded) > x { rounded.next_down() } else { rounded }
        };
        let up = |x: f64| {
            let rounded = x as f32;
            if f64::from(rounded) < x { rounded.next_up() } else { rounded }
        };
        let bounds = Aabb::new(Vec3A::from(low.to_array().map(down)), Vec3A::from(high.to_array().map(up)));
        self.leaves.push(Bvh2Node::new(bounds, 1, self.shapes.len() as u32));
        self.whole = Some(self.whole.map_or(bounds, |whole| whole.union(&bounds)));
        self.shapes.push(shape);
    }

    pub fn add_unbounded(&mut self, shape: ShapeId) {
        self.unbounded.push(shape);
    }
}

/// A ray on its walk through the tree.
pub trait Probe {
    /// Distances at which the four boxes are entered; infinite where they are missed, or lie beyond what is wanted.
    fn enter(&mut self, boxes: &Boxes) -> [f32; 4];
    /// Farthest distance still of interest.
    fn limit(&self) -> f32;
    /// Tests one shape; true ends the walk.
    fn test(&mut self, item: &Item) -> bool;
}

/// The tree, and beside it the shapes that have no box.
#[derive(Clone, Debug, Default)]
pub struct Bvh {
    nodes: Vec<Node>,
    items: Vec<Item>,
    pub unbounded: Vec<ShapeId>,
    /// Largest coordinate of a box, by axis, whatever its sign.
    reach: [f32; 3],
    /// Height of the highest box.
    top: f32,
}

impl Bvh {
    /// `corners` are a facet's, by its name.
    pub fn build(gathered: Gathering, corners: impl Fn(ShapeId) -> [u32; 3]) -> Self {
        let Gathering { shapes, leaves, whole, unbounded } = gathered;
        let mut tree = Self { unbounded, ..Self::default() };
        let Some(whole) = whole else {
            return tree;
        };
        let binary = binary_tree(leaves, whole);
        tree.items = (binary.primitive_indices.iter())
            .map(|&i| shapes[i as usize])
            .map(|shape| Item { shape, corners: corners(shape) })
            .collect();
        let root = binary.nodes[0];
        let (low, high) = (root.min.to_array(), root.max.to_array());
        for axis in 0..3 {
            tree.reach[axis] = low[axis].abs().max(high[axis].abs());
        }
        tree.top = high[2];
        tree.fold(&binary.nodes);
        tree
    }

    /// Makes nodes of four out of a binary tree: of a node's descendants the largest is opened until there are four.
    fn fold(&mut self, binary: &[Bvh2Node]) {
        self.nodes.reserve(binary.len() / 3 + 1);
        // (binary nodes that become one node, where its number is to be written)
        let mut todo: Vec<(u32, Option<(usize, usize)>)> = vec![(0, None)];
        while let Some((top, parent)) = todo.pop() {
            let mut members = [top, u32::MAX, u32::MAX, u32::MAX];
            let mut count = 1;
            while count < 4 {
                let largest =
                    (0..count).filter(|&i| binary[members[i] as usize].prim_count == 0).max_by(|&i, &j| {
                        let area = |k: usize| binary[members[k] as usize].aabb().half_area();
                        area(i).total_cmp(&area(j))
                    });
                let Some(largest) = largest else { break };
                let first = binary[members[largest] as usize].first_index;
                members[largest] = first;
                members[count] = first + 1;
                count += 1;
            }
            let number = self.nodes.len();
            if let Some((node, slot)) = parent {
                self.nodes[node].child[slot] = number as u32;
            }
            let mut low = [[f32::INFINITY; 4]; 3];
            let mut high = [[f32::NEG_INFINITY; 4]; 3];
            let (mut child, mut prims) = ([0; 4], [0; 4]);
            for (slot, &member) in members.iter().take(count).enumerate() {
                let node = binary[member as usize];
                for axis in 0..3 {
                    low[axis][slot] = node.min[axis];
                    high[axis][slot] = node.max[axis];
                }
                child[slot] = node.first_index;
                prims[slot] = node.prim_count;
                if node.prim_count == 0 {
                    todo.push((member, Some((number, slot))));
                }
            }
            let sides = [0, 1, 2].map(|axis| [f32x4::from(low[axis]), f32x4::from(high[axis])]);
            self.nodes.push(Node { boxes: Boxes { sides }, child, count: prims });
        }
    }

    /// The shapes in the tree, in its order.
    pub fn items(&self) -> &[Item] {
        &self.items
    }

    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty() && self.unbounded.is_empty()
    }

    /// Whether a ray starts above all boxes and goes up, as one does that has left the air.
    #[inline]
    pub fn lies_below(&self, ray: &Ray) -> bool {
        let start = ray.origin.z + ray.from * ray.direction.z;
        start > f64::from(self.top) && ray.direction.z >= 0.0
    }

    /// Whether the slabs of a ray hold numbers, so that it can be taken through the tree.
    #[inline]
    pub fn takes(&self, origin: DVec3, direction: DVec3) -> bool {
        let far = origin.abs().max_element();
        // Of numbers and what is none the sum is none.
        far + 0.0 * (origin + direction).element_sum() <= FARTHEST_ORIGIN
    }

    /// Constants of the slab test along one axis.
    #[inline]
    pub fn slab(&self, axis: usize, origin: DVec3, direction: f64) -> Slab {
        // No box is farther away.
        let farthest = || (0..3).map(|axis| origin[axis].abs() + f64::from(self.reach[axis])).sum();
        Slab::new(origin[axis], direction, f64::from(self.reach[axis]), farthest)
    }

    /// Takes a ray through the tree, nearest boxes first. `stack` is working memory, kept between walks.
    #[inline]
    pub fn walk(&self, probe: &mut impl Probe, stack: &mut Vec<Visit>) {
        if self.nodes.is_empty() {
            return;
        }
        stack.clear();
        let mut visit = Visit { near: f32::NEG_INFINITY, child: 0, count: 0 };
        loop {
            if visit.near <= probe.limit() {
                if visit.count > 0 {
                    let first = visit.child as usize;
                    for item in &self.items[first..first + visit.count as usize] {
                        if probe.test(item) {
                            return;
                        }
                    }
                } else {
                    let node = &self.nodes[visit.child as usize];
                    let near = probe.enter(&node.boxes);
                    let base = stack.len();
                    let mut nearest: Option<Visit> = None;
                    for (slot, &near) in near.iter().enumerate() {
                        if near < f32::INFINITY {
                            let mut next = Visit { near, child: node.child[slot], count: node.count[slot] };
                            match &mut nearest {
                                None => {
                                    nearest = Some(next);
                                    continue;
                                }
                                Some(nearest) if next.near < nearest.near => {
                                    std::mem::swap(nearest, &mut next)
                                }
                                Some(_) => {}
                            }
                            // Farthest below, nearest on top.
                            let mut at = stack.len();
                            stack.push(next);
                            while at > base && stack[at - 1].near < next.near {
                                stack[at] = stack[at - 1];
                                at -= 1;
                            }
                            stack[at] = next;
                        }
                    }
                    if let Some(nearest) = nearest {
                        visit = nearest;
                        continue;
                    }
                }
            }
            match stack.pop() {
                Some(next) => visit = next,
                None => return,
            }
        }
    }
}

/// The library's tree over these leaves: as its `build_bvh2` with its parameters for a fast build, but that the leaves
/// are ours and that what one step needs is given back before the next.
fn binary_tree(leaves: Vec<Bvh2Node>, whole: Aabb) -> Bvh2 {
    const SEARCH_DISTANCE: usize = 6;
    const QUICK_ROUNDS: usize = 2;
    const REINSERTED: f32 = 0.02;
    const MOST_ITEMS: u32 = 4;
    const TRAVERSAL_COST: f32 = 2.0;

    let mut tree = Bvh2::zeroed(leaves.len());
    tree.primitive_indices = (0..leaves.len() as u32).collect();
    let mut builder = PlocBuilder::new();
    builder.current_nodes = leaves;
    builder.build_ploc_from_leaves::<SEARCH_DISTANCE, false>(
        &mut tree,
        whole,
        SortPrecision::U64,
        QUICK_ROUNDS,
    );
    drop(builder);
    ReinsertionOptimizer::default().run(&mut tree, REINSERTED, None);
    collapse(&mut tree, MOST_ITEMS, TRAVERSAL_COST);
    tree
}

/// A box or leaf still to be visited.
#[derive(Clone, Copy, Debug)]
pub struct Visit {
    near: f32,
    child: u32,
    count: u32,
}

/// The slab test of one axis: a box is between near side * inverse - near_offset and far side * inverse - far_offset.
/// The offsets hold the error of all the arithmetic, so that the interval is never too narrow.
#[derive(Clone, Copy, Debug)]
pub struct Slab {
    inverse: f32x4,
    near_offset: f32x4,
    far_offset: f32x4,
    /// Which side of a box is the near one: 0 the low one, 1 the high one.
    pub near_side: usize,
}

impl Slab {
    /// A direction flatter than this is tested as if it were this, and the slab widened by what that moves a ray.
    const FLATTEST: f64 = 1e-12;

    #[inline]
    fn new(origin: f64, direction: f64, reach: f64, farthest: impl FnOnce() -> f64) -> Self {
        let (direction, moved) = if direction.abs() < Self::FLATTEST {
            (Self::FLATTEST.copysign(direction), 2.0 * Self::FLATTEST * farthest())
        } else {
            (direction, 0.0)
        };
        let inverse = 1.0 / direction;
        let offset = origin * inverse;
        let error = ((origin.abs() + reach) * 2f64.powi(-21) + moved) * inverse.abs();
        Self {
            inverse: f32x4::splat(inverse as f32),
            near_offset: f32x4::splat((offset + error) as f32),
            far_offset: f32x4::splat((offset - error) as f32),
            near_side: usize::from(direction < 0.0),
        }
    }

    /// Distances of the near sides.
    #[inline]
    pub fn near(&self, side: f32x4) -> f32x4 {
        side * self.inverse - self.near_offset
    }

    /// Distances of the far sides.
    #[inline]
    pub fn far(&self, side: f32x4) -> f32x4 {
        side * self.inverse - self.far_offset
    }
}

/// The next f32 at or beyond a distance.
#[inline]
pub fn at_least(t: f64) -> f32 {
    (t as f32).next_up()
}
