//! All shapes of a scene: the tables that hold them, and whom each belongs to.

use std::collections::TryReserveError;

use glam::DVec3;

use crate::bvh::{Bvh, Gathering};
use crate::ray::{Row, ShapeId};
use crate::shape::Shape;
use crate::shape::facet::Facet;
use crate::shape::geometry::{Bounds, Geometry};

/// What a shape is part of: a row of the solids, or of the lights.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Owner {
    Solid(u32),
    /// A visible light: it shows its colour unshaded and blocks nothing.
    Light(u32),
}

/// Where a shape comes from: what it is part of, and the row of the scene's primitives that it is, or is a facet of.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Part {
    pub owner: Owner,
    pub primitive: u32,
}

/// Facets of one primitive, which follow one another.
#[derive(Clone, Copy, Debug)]
struct Run {
    first_facet: usize,
    part: Part,
}

/// All shapes. Facets name their corners; those with interpolated normals name three of `normals` too.
#[derive(Clone, Debug, Default)]
pub struct Shapes {
    pub vertices: Vec<DVec3>,
    pub normals: Vec<DVec3>,
    facets: Vec<[u32; 3]>,
    /// Normals at the corners by facet, `FLAT` for none; shorter than `facets` where the rest has none.
    facet_normals: Vec<[u32; 3]>,
    runs: Vec<Run>,
    /// Those that are no facets, kind by kind once there are trees.
    others: Vec<(Shape, Part)>,
}

const FLAT: [u32; 3] = [u32::MAX; 3];

/// The two normals of a point: of the shape itself, and the one that shades it. Both unit vectors, toward the
/// viewer by the shape's own.
#[derive(Clone, Copy, Debug)]
pub struct Normals {
    pub geometric: DVec3,
    pub shading: DVec3,
}

/// What the trees over so many facets and other shapes take at most, in bytes a shape: their items and nodes, and the
/// leaves they are built from.
const TREE_BYTES: usize = 256;

impl Shapes {
    /// Room for so many facets, and for all else that as many of them and of other shapes will take; an error where that
    /// is more memory than there is.
    pub fn reserve(&mut self, others: usize, facets: usize) -> Result<(), TryReserveError> {
        self.facets.try_reserve_exact(facets)?;
        self.vertices.try_reserve(3 * others)?;
        Vec::<[u8; TREE_BYTES]>::new().try_reserve_exact(others + facets)
    }

    pub fn push(&mut self, shape: impl Into<Shape>, part: Part) {
        self.others.push((shape.into(), part));
    }

    /// A single triangle, VERTEX1, VERTEX2, VERTEX3.
    pub fn push_triangle(&mut self, corners: [DVec3; 3], part: Part) {
        let first = self.vertices.len() as u32;
        self.vertices.extend(corners);
        self.push_facets(std::iter::once(([first, first + 1, first + 2], None)), part);
    }

    /// Facets by their corners in `vertices`, and the corners' normals in `normals`.
    pub fn push_facets(&mut self, facets: impl Iterator<Item = ([u32; 3], Option<[u32; 3]>)>, part: Part) {
        self.runs.push(Run { first_facet: self.facets.len(), part });
        for (corners, normals) in facets {
            if let Some(normals) = normals {
                self.facet_normals.resize(self.facets.len(), FLAT);
                self.facet_normals.push(normals);
            }
            self.facets.push(corners);
        }
    }

    /// How many shapes there are.
    fn count(&self) -> usize {
        self.facets.len() + self.others.len()
    }

    /// The shape of a row that is no facet's.
    #[inline]
    pub fn other(&self, row: usize) -> &Shape {
        &self.others[row].0
    }

    /// A facet by the names of its corners, which a leaf of a tree knows: for a ray that looks for it.
    #[inline(always)]
    pub fn flat_facet(&self, corners: [u32; 3]) -> Facet<'_> {
        Facet { corners: corners.map(|name| &self.vertices[name as usize]), normals: None }
    }

    fn facet(&self, row: usize) -> Facet<'_> {
        let names = self.facet_normals.get(row).copied().unwrap_or(FLAT);
        let normals = (names != FLAT).then(|| names.map(|name| self.normals[name as usize]));
        Facet { normals, ..self.flat_facet(self.facets[row]) }
    }

    /// The names of a facet's corners; of no use for another shape.
    pub fn corners_of(&self, shape: ShapeId) -> [u32; 3] {
        match shape.row() {
            Row::Facet(row) => self.facets[row],
            Row::Other(_) => [0; 3],
        }
    }

    pub fn part(&self, shape: ShapeId) -> Part {
        match shape.row() {
            Row::Facet(row) => {
                let after = self.runs.partition_point(|run| run.first_facet <= row);
                self.runs[after - 1].part
            }
            Row::Other(row) => self.others[row].1,
        }
    }

    /// The tree over the solids' shapes and the one over the lights'. Shapes that are nowhere are left out.
    pub fn trees(&mut self) -> (Bvh, Bvh) {
        if !self.others.is_sorted_by_key(|(shape, _)| shape.kind()) {
            self.others.sort_by_key(|(shape, _)| shape.kind());
        }
        let mut solids = Gathering::default();
        let mut lights = Gathering::default();
        solids.reserve(self.count());
        let mut gather = |part: Part, shape: ShapeId, bounds: Bounds| {
            let into = match part.owner {
                Owner::Solid(_) => &mut solids,
                Owner::Light(_) => &mut lights,
            };
            match bounds {
                Bounds::Box { low, high } => into.add(shape, low, high),
                Bounds::Endless => into.add_unbounded(shape),
                Bounds::Nowhere => {}
            }
        };
        for (i, run) in self.runs.iter().enumerate() {
            let end = self.runs.get(i + 1).map_or(self.facets.len(), |next| next.first_facet);
            for row in run.first_facet..end {
                gather(run.part, ShapeId::facet(row), self.flat_facet(self.facets[row]).bounds());
            }
        }
        for (row, (shape, part)) in self.others.iter().enumerate() {
            gather(*part, ShapeId::other(row), shape.bounds());
        }
        let corners = |shape| self.corners_of(shape);
        (Bvh::build(solids, corners), Bvh::build(lights, corners))
    }

    /// What a shape answers.
    fn ask<T>(&self, shape: ShapeId, question: impl FnOnce(&dyn Geometry) -> T) -> T {
        match shape.row() {
            Row::Facet(row) => question(&self.facet(row)),
            Row::Other(row) => question(self.other(row)),
        }
    }

    /// The normals of a shape at a point of it, met by a ray of this direction.
    pub fn normals(&self, shape: ShapeId, point: DVec3, incoming: DVec3) -> Normals {
        let (geometric, shading) =
            self.ask(shape, |shape| (shape.normal(point), shape.shading_normal(point)));
        let shading = shading.unwrap_or(geometric);
        if geometric.dot(incoming) > 0.0 {
            Normals { geometric: -geometric, shading: -shading }
        } else {
            Normals { geometric, shading }
        }
    }

    /// u and v of a point of a shape; None for a shape that has none.
    pub fn uv(&self, shape: ShapeId, point: DVec3) -> Option<(f64, f64)> {
        self.ask(shape, |shape| shape.uv(point))
    }
}
