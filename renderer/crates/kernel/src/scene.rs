//! A scene as the renderer has it: its shapes in trees, whom each belongs to, and what is said once.

use std::collections::TryReserveError;

use glam::DVec3;

use crate::bvh::{Bvh, Gathering};
use crate::camera::Camera;
use crate::optics::atmosphere::Atmosphere;
use crate::ray::{ShapeId, ShapeKind};
use crate::shade::haze::Haze;
use crate::shade::illumination::{Light, Surface};
use crate::shade::sky::Sky;
use crate::shape::plane::Plane;
use crate::shape::rectangle::Rectangle;
use crate::shape::sphere::Sphere;
use crate::shape::triangle::affine_coordinates;
use crate::texture::Texture;

#[derive(Clone, Debug)]
pub struct Solid {
    pub surface: Surface,
    /// In the order in which they apply.
    pub textures: Vec<Texture>,
}

/// What a shape is part of.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Owner {
    Solid(usize),
    /// A visible light: it shows its colour unshaded and blocks nothing.
    Light(usize),
}

/// Where a shape comes from: what it is part of, and the row of the scene's primitives that it is, or is a facet of.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Part {
    pub owner: Owner,
    pub primitive: usize,
}

/// Facets of one primitive, which follow one another.
#[derive(Clone, Copy, Debug)]
struct Run {
    first_facet: usize,
    part: Part,
}

/// All shapes by kind. Facets name their corners; those with interpolated normals name three of `normals` too.
#[derive(Clone, Debug, Default)]
pub struct Shapes {
    pub vertices: Vec<DVec3>,
    pub normals: Vec<DVec3>,
    facets: Vec<[u32; 3]>,
    /// Normals at the corners by facet, `FLAT` for none; shorter than `facets` where the rest has none.
    facet_normals: Vec<[u32; 3]>,
    runs: Vec<Run>,
    spheres: Vec<(Sphere, Part)>,
    rectangles: Vec<(Rectangle, Part)>,
    planes: Vec<(Plane, Part)>,
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

    pub fn push_sphere(&mut self, sphere: Sphere, part: Part) {
        self.spheres.push((sphere, part));
    }

    pub fn push_rectangle(&mut self, rectangle: Rectangle, part: Part) {
        self.rectangles.push((rectangle, part));
    }

    /// A plane through a point; one whose normal has no direction is left out.
    pub fn push_plane(&mut self, point: DVec3, normal: DVec3, part: Part) {
        if let Some(normal) = normal.try_normalize() {
            self.planes.push((Plane { point, normal }, part));
        }
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
    pub fn count(&self) -> usize {
        self.facets.len() + self.spheres.len() + self.rectangles.len() + self.planes.len()
    }

    #[inline]
    pub fn corners(&self, names: [u32; 3]) -> [&DVec3; 3] {
        names.map(|name| &self.vertices[name as usize])
    }

    #[inline]
    pub fn sphere(&self, row: usize) -> &Sphere {
        &self.spheres[row].0
    }

    #[inline]
    pub fn rectangle(&self, row: usize) -> &Rectangle {
        &self.rectangles[row].0
    }

    #[inline]
    pub fn plane(&self, row: usize) -> &Plane {
        &self.planes[row].0
    }

    /// The names of a facet's corners; of no use for another shape.
    pub fn corners_of(&self, shape: ShapeId) -> [u32; 3] {
        if shape.kind() == ShapeKind::Facet { self.facets[shape.row()] } else { [0; 3] }
    }

    pub fn part(&self, shape: ShapeId) -> Part {
        let row = shape.row();
        match shape.kind() {
            ShapeKind::Facet => {
                let after = self.runs.partition_point(|run| run.first_facet <= row);
                self.runs[after - 1].part
            }
            ShapeKind::Sphere => self.spheres[row].1,
            ShapeKind::Rectangle => self.rectangles[row].1,
            ShapeKind::Plane => self.planes[row].1,
        }
    }

    /// The tree over the solids' shapes and the one over the lights'. Shapes of no extent, or without numbers for
    /// coordinates, are left out.
    pub fn trees(&self) -> (Bvh, Bvh) {
        let mut solids = Gathering::default();
        let mut lights = Gathering::default();
        solids.reserve(self.count());
        let mut gather = |part: Part, shape, bounds: Option<(DVec3, DVec3)>| {
            let into = if matches!(part.owner, Owner::Solid(_)) { &mut solids } else { &mut lights };
            match bounds {
                Some((low, high)) => into.add(shape, low, high),
                None => into.add_unbounded(shape),
            }
        };
        for (i, run) in self.runs.iter().enumerate() {
            let end = self.runs.get(i + 1).map_or(self.facets.len(), |next| next.first_facet);
            for row in run.first_facet..end {
                let [&a, &b, &c] = self.corners(self.facets[row]);
                let area = (a - b).cross(c - b).length_squared();
                if area > 0.0 && area < f64::INFINITY {
                    let bounds = (a.min(b).min(c), a.max(b).max(c));
                    gather(run.part, ShapeId::new(ShapeKind::Facet, row), Some(bounds));
                }
            }
        }
        for (row, (sphere, part)) in self.spheres.iter().enumerate() {
            if sphere.center.is_finite() && sphere.radius > 0.0 && sphere.radius < f64::INFINITY {
                let reach = DVec3::splat(sphere.radius);
                let bounds = (sphere.center - reach, sphere.center + reach);
                gather(*part, ShapeId::new(ShapeKind::Sphere, row), Some(bounds));
            }
        }
        for (row, (rectangle, part)) in self.rectangles.iter().enumerate() {
            let area = rectangle.normal().length_squared();
            if area > 0.0 && area < f64::INFINITY && rectangle.point.is_finite() {
                let [a, b, c, d] = rectangle.corners();
                let bounds = (a.min(b).min(c).min(d), a.max(b).max(c).max(d));
                gather(*part, ShapeId::new(ShapeKind::Rectangle, row), Some(bounds));
            }
        }
        for (row, (plane, part)) in self.planes.iter().enumerate() {
            if plane.point.is_finite() {
                gather(*part, ShapeId::new(ShapeKind::Plane, row), None);
            }
        }
        let corners = |shape| self.corners_of(shape);
        (Bvh::build(solids, corners), Bvh::build(lights, corners))
    }

    /// The normals of a shape at a point of it, met by a ray of this direction.
    pub fn normals(&self, shape: ShapeId, point: DVec3, incoming: DVec3) -> Normals {
        let row = shape.row();
        let mut shading = None;
        let geometric = match shape.kind() {
            ShapeKind::Sphere => self.sphere(row).normal(point),
            ShapeKind::Rectangle => self.rectangle(row).normal().normalize_or_zero(),
            ShapeKind::Plane => self.plane(row).normal,
            ShapeKind::Facet => {
                let [&first, &second, &third] = self.corners(self.facets[row]);
                let (u, v) = (third - second, first - second);
                let names = self.facet_normals.get(row).copied().unwrap_or(FLAT);
                if names != FLAT {
                    let (s, t) = affine_coordinates(second, u, v, point);
                    let [n1, n2, n3] = names.map(|name| self.normals[name as usize]);
                    shading = (t * n1 + (1.0 - s - t) * n2 + s * n3).try_normalize();
                }
                u.cross(v).normalize_or_zero()
            }
        };
        let shading = shading.unwrap_or(geometric);
        if geometric.dot(incoming) > 0.0 {
            Normals { geometric: -geometric, shading: -shading }
        } else {
            Normals { geometric, shading }
        }
    }

    /// u and v of a point of a shape; a plane has none.
    pub fn uv(&self, shape: ShapeId, point: DVec3) -> Option<(f64, f64)> {
        let row = shape.row();
        match shape.kind() {
            ShapeKind::Sphere => Some(self.sphere(row).uv(point)),
            ShapeKind::Rectangle => Some(self.rectangle(row).uv(point)),
            ShapeKind::Plane => None,
            ShapeKind::Facet => {
                let [&first, &second, &third] = self.corners(self.facets[row]);
                Some(affine_coordinates(second, third - second, first - second, point))
            }
        }
    }
}

/// What a ray sees that meets nothing.
#[derive(Clone, Copy, Debug)]
pub enum Background {
    Plain(DVec3),
    Sky(Sky),
}

/// AMBIENT: indirect light, constant, or sampled by rays all around. Thesis 3.4 (3).
#[derive(Clone, Copy, Debug)]
pub struct Ambient {
    /// The constant: intensity times colour.
    pub constant: DVec3,
    /// How many rays a surface sends out.
    pub samples: usize,
    /// Surfaces send them out that were met by rays of a level below this; the eye's is 1.
    pub depth: usize,
}

/// Everything a picture is made from.
#[derive(Clone, Debug)]
pub struct Scene {
    pub camera: Camera,
    pub background: Background,
    pub ambient: Ambient,
    pub haze: Haze,
    /// The atmosphere, where there is a MIRAGE.
    pub air: Option<Atmosphere>,
    pub lights: Vec<Light>,
    pub solids: Vec<Solid>,
    pub shapes: Shapes,
    pub solid_tree: Bvh,
    pub light_tree: Bvh,
}
