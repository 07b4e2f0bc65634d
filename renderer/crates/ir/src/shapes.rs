//! Primitives: spheres, planes, triangles, rectangles and meshes, and whom each belongs to.

use glam::DVec3;

use m3d_kernel::ray::ShapeId;
use m3d_kernel::shape::facet::corners;
use m3d_kernel::shape::plane::Plane;
use m3d_kernel::shape::rectangle::Rectangle;
use m3d_kernel::shape::sphere::Sphere;
use m3d_kernel::shapes::{Owner, Part, Shapes};

use crate::generated::PrimitiveKind;
use crate::ir::Ir;
use crate::refusal::{Refusal, Result, damaged};
use crate::tables::{Owned, Table, coordinate};

/// P, U and V of a table of planar primitives.
struct Planar<'a> {
    table: Table<'a>,
    point: Vec<DVec3>,
    u: Vec<DVec3>,
    v: Vec<DVec3>,
}

impl<'a> Planar<'a> {
    fn of(ir: &Ir<'a>, name: &'static str) -> Result<Self> {
        let table = ir.table(name);
        let (point, u, v) = (table.positions("point")?, table.positions("u")?, table.positions("v")?);
        Ok(Self { table, point, u, v })
    }

    fn row(&self, i: usize) -> Result<(DVec3, DVec3, DVec3)> {
        Ok((self.table.entry(&self.point, i)?, self.table.entry(&self.u, i)?, self.table.entry(&self.v, i)?))
    }
}

fn spheres(ir: &Ir) -> Result<Vec<Sphere>> {
    let table = ir.table("spheres");
    let center = table.positions("center")?;
    let radius = table.numbers("radius")?;
    for (row, &radius) in radius.iter().enumerate() {
        coordinate(radius, || format!("spheres.radius, row {row},"))?;
    }
    let (pole, equator) = (table.vectors("pole")?, table.vectors("equator")?);
    (0..center.len())
        .map(|i| {
            Ok(Sphere {
                center: center[i],
                radius: table.entry(radius, i)?,
                pole: table.entry(&pole, i)?,
                equator: table.entry(&equator, i)?,
            })
        })
        .collect()
}

pub fn shapes(ir: &Ir, solids: usize, lights: usize) -> Result<Shapes> {
    let table = ir.table("primitives");
    let kind = table.plain::<i32>("kind")?;
    let row = table.plain::<i32>("row")?;
    let (solid, light) = (table.plain("solid")?, table.plain("light")?);
    let spheres = spheres(ir)?;
    let (planes, triangles) = (Planar::of(ir, "planes")?, Planar::of(ir, "triangles")?);
    let rectangles = Planar::of(ir, "rectangles")?;
    let mut meshes = Meshes::of(ir)?;
    let mut shapes = Shapes::default();
    shapes.vertices = ir.table("vertices").positions("position")?;
    shapes.normals = ir.table("normals").vectors("direction")?;
    if kind.len() + meshes.owned.length > ShapeId::MOST || shapes.vertices.len() > ShapeId::MOST {
        return Err(Refusal::Limit("the scene has more than 1,073,741,824 shapes".into()));
    }
    shapes.reserve(kind.len(), meshes.owned.length).map_err(|_| Refusal::TooLarge)?;
    for (i, &kind) in kind.iter().enumerate() {
        let owner = match (table.entry(solid, i)?, table.entry(light, i)?) {
            (solid, -1) if usize::try_from(solid).is_ok_and(|row| row < solids) => Owner::Solid(solid as u32),
            (-1, light) if usize::try_from(light).is_ok_and(|row| row < lights) => Owner::Light(light as u32),
            _ => return Err(damaged(format!("primitive {i} belongs to no solid and no light"))),
        };
        let part = Part { owner, primitive: i as u32 };
        let row = usize::try_from(table.entry(row, i)?)
            .map_err(|_| damaged(format!("primitive {i} has no row")))?;
        let kind = PrimitiveKind::numbered(kind)
            .ok_or_else(|| damaged(format!("primitive {i} is of an unknown kind, {kind}")))?;
        match kind {
            PrimitiveKind::Sphere => {
                let sphere = spheres.get(row).ok_or_else(|| damaged(format!("spheres has no row {row}")))?;
                shapes.push(*sphere, part);
            }
            PrimitiveKind::Plane => {
                let (point, u, v) = planes.row(row)?;
                shapes.push(Plane::spanned(point, u, v), part);
            }
            PrimitiveKind::Triangle => {
                let (point, u, v) = triangles.row(row)?;
                shapes.push_triangle(corners(point, u, v), part);
            }
            PrimitiveKind::Rectangle => {
                let (point, u, v) = rectangles.row(row)?;
                shapes.push(Rectangle { point, u, v }, part);
            }
            PrimitiveKind::Polygons | PrimitiveKind::Terrain => meshes.push(row, part, &mut shapes)?,
        }
    }
    Ok(shapes)
}

/// POLYGONS and TERRAIN.
struct Meshes<'a> {
    table: Table<'a>,
    phong: &'a [bool],
    first_facet: &'a [i32],
    facet_count: &'a [i32],
    corners: &'a [[i32; 3]],
    normals: &'a [[i32; 3]],
    owned: Owned,
}

impl<'a> Meshes<'a> {
    fn of(ir: &Ir<'a>) -> Result<Self> {
        let table = ir.table("meshes");
        let facets = ir.table("facets");
        let (corners, normals) = (facets.threes("vertex")?, facets.threes("normal")?);
        Ok(Self {
            owned: Owned::new("facets", corners.len().min(normals.len())),
            phong: table.plain("phong")?,
            first_facet: table.plain("first_facet")?,
            facet_count: table.plain("facet_count")?,
            corners,
            normals,
            table,
        })
    }

    fn push(&mut self, row: usize, part: Part, shapes: &mut Shapes) -> Result<()> {
        let first = self.table.entry(self.first_facet, row)?;
        let count = self.table.entry(self.facet_count, row)?;
        let used = self.owned.take(first, count)?;
        let phong = self.table.entry(self.phong, row)?;
        let (vertices, normals) = (shapes.vertices.len(), shapes.normals.len());
        let exist = |names: [i32; 3], length: usize| {
            names.iter().all(|&name| usize::try_from(name).is_ok_and(|name| name < length))
        };
        if !used.clone().all(|i| exist(self.corners[i], vertices)) {
            return Err(damaged("a facet has a corner that does not exist"));
        }
        let facets = used.map(|i| {
            let smooth = phong && exist(self.normals[i], normals);
            let name = |names: [i32; 3]| names.map(|name| name as u32);
            (name(self.corners[i]), smooth.then(|| name(self.normals[i])))
        });
        shapes.push_facets(facets, part);
        Ok(())
    }
}
