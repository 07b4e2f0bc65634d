//! Reads the scene IR (`m3dc.ir.SceneIR`) into the kernel's own scene.
//!
//! Nothing of it is trusted: a table that is missing, of the wrong type, names rows that do not exist, or holds what is
//! no finite number is a ValueError, and so is one that names rows of another more than once; what does not fit in
//! memory is a MemoryError. So a damaged file can do no more than that, and the rest of the kernel relies on it.

use std::ops::Range;

use glam::{DMat4, DVec3};
use numpy::{Element, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::{PyMemoryError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyAnyMethods;

use crate::camera::Camera;
use crate::optics::atmosphere::{Atmosphere, Limits};
use crate::ray::ShapeId;
use crate::scene::{Ambient, Background, Owner, Part, Scene, Shapes, Solid};
use crate::shade::haze::Haze;
use crate::shade::highlight::Gloss;
use crate::shade::illumination::{Light, Source, Surface};
use crate::shade::sky::Sky;
use crate::shape::rectangle::Rectangle;
use crate::shape::sphere::Sphere;
use crate::texture::Texture;
use crate::texture::blend::{Along, Blend};
use crate::texture::bumps::Bumps;
use crate::texture::checker::Checker;
use crate::texture::clouds::Clouds;
use crate::texture::color_range::ColorRange;
use crate::texture::gradient::Gradient;
use crate::texture::granite::Granite;
use crate::texture::heights::Heights;
use crate::texture::marble::Marble;
use crate::texture::placement::Placement;
use crate::texture::ripples::Ripples;
use crate::texture::snow::Snow;
use crate::texture::spotted::Spotted;
use crate::texture::squeeze::Squeeze;
use crate::texture::tint::Tint;
use crate::texture::wave::Wave;
use crate::texture::waves::lowered_by_frequency;
use crate::texture::wood::Wood;

fn damaged(what: String) -> PyErr {
    PyValueError::new_err(format!("damaged scene: {what}"))
}

/// A shape may reach so far from the origin, in any direction. Beyond, the fourth power of a coordinate, which facets
/// and rectangles take, is no longer a number.
const FARTHEST: f64 = 1e75;

const TOO_LARGE: &str = "the scene does not fit in memory";

/// A profile may have so many points.
const MOST_POINTS: usize = 10_000;

/// An empty vector with room for so many.
fn room<T>(count: usize) -> PyResult<Vec<T>> {
    let mut made = Vec::new();
    made.try_reserve_exact(count).map_err(|_| PyMemoryError::new_err(TOO_LARGE))?;
    Ok(made)
}

/// A coordinate, or a length.
fn place(value: f64, what: impl FnOnce() -> String) -> PyResult<f64> {
    if !value.is_finite() {
        Err(damaged(format!("{} is not a finite number", what())))
    } else if value.abs() > FARTHEST {
        let what = what();
        Err(PyValueError::new_err(format!("{what} is {value:e}: up to {FARTHEST:e} can be rendered")))
    } else {
        Ok(value)
    }
}

/// Rows of a table of which each belongs to one row of another at most.
struct Owned {
    what: &'static str,
    length: usize,
    taken: usize,
}

impl Owned {
    fn new(what: &'static str, length: usize) -> Self {
        Self { what, length, taken: 0 }
    }

    /// Rows `first`..`first + count`.
    fn take(&mut self, first: i32, count: i32) -> PyResult<Range<usize>> {
        let (what, length) = (self.what, self.length);
        let range = usize::try_from(first).ok().zip(usize::try_from(count).ok());
        let Some((first, count)) = range.filter(|(first, count)| first + count <= length) else {
            return Err(damaged(format!(
                "{what} {first} to {} do not exist",
                i64::from(first) + i64::from(count)
            )));
        };
        self.taken += count;
        if self.taken > length {
            return Err(damaged(format!("some rows of {what} belong to more than one")));
        }
        Ok(first..first + count)
    }
}

/// One table of the IR.
struct Table<'py> {
    name: &'static str,
    columns: Bound<'py, PyAny>,
}

impl<'py> Table<'py> {
    fn of(ir: &Bound<'py, PyAny>, name: &'static str) -> PyResult<Self> {
        let columns =
            ir.getattr("tables")?.get_item(name).map_err(|_| damaged(format!("there is no table {name}")))?;
        Ok(Self { name, columns })
    }

    fn column<T: pyo3::conversion::FromPyObjectOwned<'py>>(&self, column: &str) -> PyResult<T> {
        self.columns
            .get_item(column)
            .ok()
            .and_then(|array| array.extract().ok())
            .ok_or_else(|| damaged(format!("{}.{column} is missing or of the wrong type", self.name)))
    }

    fn plain<T: Element + Copy + 'static>(&self, column: &str) -> PyResult<Vec<T>> {
        let array: PyReadonlyArray1<T> = self.column(column)?;
        let mut values = room(array.as_array().len())?;
        values.extend(array.as_array().iter().copied());
        Ok(values)
    }

    /// A column of finite numbers.
    fn numbers(&self, column: &str) -> PyResult<Vec<f64>> {
        let values = self.plain(column)?;
        match values.iter().position(|value: &f64| !value.is_finite()) {
            Some(row) => Err(self.not_finite(column, row)),
            None => Ok(values),
        }
    }

    fn not_finite(&self, column: &str, row: usize) -> PyErr {
        damaged(format!("{}.{column}, row {row}, is not a finite number", self.name))
    }

    fn threes<T: Element + Copy + 'static>(&self, column: &str) -> PyResult<Threes<'py, T>> {
        let array: PyReadonlyArray2<T> = self.column(column)?;
        if array.as_array().ncols() != 3 {
            return Err(damaged(format!("{}.{column} does not have three numbers a row", self.name)));
        }
        Ok(Threes(array))
    }

    /// A column of finite vectors.
    fn vectors(&self, column: &str) -> PyResult<Vec<DVec3>> {
        let threes = self.threes::<f64>(column)?;
        let mut values = room(threes.len())?;
        values.extend((0..threes.len()).map(|row| DVec3::from(threes.row(row))));
        match values.iter().position(|value: &DVec3| !value.is_finite()) {
            Some(row) => Err(self.not_finite(column, row)),
            None => Ok(values),
        }
    }

    /// A column of vectors within reach.
    fn places(&self, column: &str) -> PyResult<Vec<DVec3>> {
        let values = self.vectors(column)?;
        let largest = |value: &DVec3| value.abs().max_element();
        if let Some(row) = values.iter().position(|value| largest(value) > FARTHEST) {
            place(largest(&values[row]), || format!("{}.{column}, row {row},", self.name))?;
        }
        Ok(values)
    }

    /// Matrices that act on row vectors become ones that act on columns, as glam has them.
    fn matrices(&self, column: &str) -> PyResult<Vec<DMat4>> {
        let array: PyReadonlyArray3<f64> = self.column(column)?;
        let array = array.as_array();
        if array.shape()[1..] != [4, 4] {
            return Err(damaged(format!("{}.{column} does not hold 4x4 matrices", self.name)));
        }
        let matrix = |rows: numpy::ndarray::ArrayView2<f64>| {
            DMat4::from_cols_array_2d(&std::array::from_fn(|i| std::array::from_fn(|j| rows[[i, j]])))
        };
        Ok(array.outer_iter().map(matrix).collect())
    }

    fn entry<'a, T>(&self, column: &'a [T], row: usize) -> PyResult<&'a T> {
        column.get(row).ok_or_else(|| damaged(format!("{} has no row {row}", self.name)))
    }
}

/// A column of three numbers a row, where NumPy has it.
struct Threes<'py, T: Element>(PyReadonlyArray2<'py, T>);

impl<T: Element + Copy> Threes<'_, T> {
    fn len(&self) -> usize {
        self.0.as_array().nrows()
    }

    fn row(&self, i: usize) -> [T; 3] {
        let array = self.0.as_array();
        [array[[i, 0]], array[[i, 1]], array[[i, 2]]]
    }
}

fn vector(of: &Bound<PyAny>, name: &str) -> PyResult<DVec3> {
    let (x, y, z): (f64, f64, f64) = of.getattr(name)?.extract()?;
    let vector = DVec3::new(x, y, z);
    if vector.is_finite() { Ok(vector) } else { Err(damaged(format!("{name} is not finite"))) }
}

fn position(of: &Bound<PyAny>, name: &str) -> PyResult<DVec3> {
    let vector = vector(of, name)?;
    place(vector.abs().max_element(), || format!("the view's {name}")).map(|_| vector)
}

fn number(of: &Bound<PyAny>, name: &str) -> PyResult<f64> {
    let value: f64 = of.getattr(name)?.extract()?;
    if value.is_finite() { Ok(value) } else { Err(damaged(format!("{name} is not finite"))) }
}

/// A whole number; one below 0 counts as 0.
fn count(of: &Bound<PyAny>, name: &str) -> PyResult<usize> {
    let value: i64 = of.getattr(name)?.extract()?;
    Ok(usize::try_from(value).unwrap_or(0))
}

/// The whole scene but the atmosphere.
pub fn scene(ir: &Bound<PyAny>) -> PyResult<Scene> {
    let said = ir.getattr("scene")?;
    let view = said.getattr("view")?;
    let camera = Camera {
        eye: position(&view, "eye")?,
        ahead: number(&view, "distance")? * position(&view, "normal")?,
        right: position(&view, "right")?,
        up: position(&view, "up")?,
        aspect: number(&view, "aspect")?,
    };
    let ambient = said.getattr("ambient")?;
    let block = said.getattr("haze")?;
    let haze = Haze {
        color: number(&block, "intensity")? * vector(&block, "color")?,
        density: number(&block, "density")?,
    };
    let lights = lights(ir)?;
    let background = background(&said, &block, &haze, &lights)?;
    let solids = solids(ir)?;
    let shapes = shapes(ir, solids.len(), lights.len())?;
    let (solid_tree, light_tree) = shapes.trees();
    Ok(Scene {
        camera,
        background,
        ambient: Ambient {
            constant: number(&ambient, "intensity")? * vector(&ambient, "color")?,
            samples: count(&ambient, "samples")?,
            depth: count(&ambient, "depth")?,
        },
        haze,
        lights,
        solids,
        shapes,
        solid_tree,
        light_tree,
    })
}

fn background(
    said: &Bound<PyAny>,
    block: &Bound<PyAny>,
    haze: &Haze,
    lights: &[Light],
) -> PyResult<Background> {
    let sky = said.getattr("sky")?;
    if sky.is_none() {
        let hazy: bool = block.getattr("defined")?.extract()?;
        return Ok(Background::Plain(if hazy { haze.color } else { vector(said, "background")? }));
    }
    let sun: i64 = sky.getattr("sun")?.extract()?;
    let sun = usize::try_from(sun).ok().and_then(|row| lights.get(row));
    let sun = sun.ok_or_else(|| damaged("the sky's sun is not among the lights".into()))?;
    Ok(Background::Sky(Sky {
        radius: number(&sky, "radius")?,
        intensity: number(&sky, "intensity")?,
        zenith_color: vector(&sky, "zenith_color")?,
        horizon_color: vector(&sky, "horizon_color")?,
        overcast: number(&sky, "overcast")?,
        sun: -sun.direction,
    }))
}

fn lights(ir: &Bound<PyAny>) -> PyResult<Vec<Light>> {
    let table = Table::of(ir, "lights")?;
    let kind: Vec<i32> = table.plain("kind")?;
    let (color, intensity) = (table.vectors("color")?, table.numbers("intensity")?);
    let (attenuation, exponent) = (table.numbers("attenuation")?, table.numbers("exponent")?);
    let angle = table.numbers("angle")?;
    let (position, direction) = (table.vectors("position")?, table.vectors("direction")?);
    let (shadows, highlights) = (table.plain("shadows")?, table.plain("highlights")?);
    (0..kind.len())
        .map(|i| {
            let angle = *table.entry(&angle, i)?;
            let source = if kind[i] == 0 {
                Source::Infinite
            } else {
                Source::Point {
                    position: *table.entry(&position, i)?,
                    attenuation: *table.entry(&attenuation, i)?,
                    exponent: *table.entry(&exponent, i)?,
                    cone: if angle >= 180.0 { -2.0 } else { angle.to_radians().cos() },
                }
            };
            Ok(Light {
                source,
                color: *table.entry(&color, i)?,
                intensity: *table.entry(&intensity, i)?,
                direction: table.entry(&direction, i)?.normalize_or_zero(),
                shadows: *table.entry(&shadows, i)?,
                highlights: *table.entry(&highlights, i)?,
            })
        })
        .collect()
}

fn solids(ir: &Bound<PyAny>) -> PyResult<Vec<Solid>> {
    let object_inverse = Table::of(ir, "solids")?.matrices("inverse")?;
    let (textures, heights) = (textures(ir)?, heights(ir)?);
    let mut owned = Owned::new("textures", textures.len());
    let table = Table::of(ir, "surfaces")?;
    let color = table.vectors("color")?;
    let numbers = |column| table.numbers(column);
    let (ambient, diffuse, specular) = (numbers("ambient")?, numbers("diffuse")?, numbers("specular")?);
    let (refindex, rough, hard) = (numbers("refindex")?, numbers("rough")?, numbers("hard")?);
    let (metallic, fresnel, fuzz) = (numbers("metallic")?, numbers("fresnel")?, numbers("fuzz")?);
    // Infinite where ROUGH is 0.
    let beckmann: Vec<f64> = table.plain("beckmann")?;
    let first: Vec<i32> = table.plain("first_texture")?;
    let count: Vec<i32> = table.plain("texture_count")?;
    (0..object_inverse.len())
        .map(|i| {
            let used = owned.take(*table.entry(&first, i)?, *table.entry(&count, i)?)?;
            Ok(Solid {
                surface: Surface {
                    color: *table.entry(&color, i)?,
                    ambient: *table.entry(&ambient, i)?,
                    diffuse: *table.entry(&diffuse, i)?,
                    specular: *table.entry(&specular, i)?,
                    hard: *table.entry(&hard, i)?,
                    fuzz: *table.entry(&fuzz, i)?,
                    gloss: Gloss {
                        refindex: *table.entry(&refindex, i)?,
                        rough: *table.entry(&rough, i)?,
                        metallic: *table.entry(&metallic, i)?,
                        fresnel: *table.entry(&fresnel, i)?,
                        beckmann: *table.entry(&beckmann, i)?,
                    },
                },
                textures: textures[used]
                    .iter()
                    .map(|texture| texture.on(object_inverse[i], heights))
                    .collect::<PyResult<_>>()?,
            })
        })
        .collect()
}

/// A row of `textures` before it is put on a solid.
struct TextureRow {
    kind: i32,
    local: bool,
    inverse: DMat4,
    tint: Tint,
    turbulence: f64,
    squeeze: Squeeze,
    scale: f64,
    slope: f64,
    elevation: f64,
    waves: Vec<Wave>,
}

impl TextureRow {
    /// The texture on an object. World to texture space is the inverse object matrix where LOCAL, then the
    /// texture's own inverse.
    fn on(&self, object_inverse: DMat4, heights: Option<Heights>) -> PyResult<Texture> {
        let to_texture = if self.local { self.inverse * object_inverse } else { self.inverse };
        if !to_texture.is_finite() {
            return Err(damaged("the matrix of a texture is not finite".into()));
        }
        let placement = Placement::new(to_texture);
        let (tint, turbulence, squeeze, scale) =
            (self.tint.clone(), self.turbulence, self.squeeze, self.scale);
        let waves = &self.waves;
        Ok(match self.kind {
            0 => Texture::Checker(Checker { placement, color: tint.color }),
            1 => Texture::Wood(Wood { placement, tint, turbulence, squeeze }),
            2 => Texture::Marble(Marble { placement, tint, turbulence, squeeze }),
            3 => Texture::Spotted(Spotted { placement, tint, scale }),
            4 => Texture::Granite(Granite { placement, tint, turbulence }),
            5 => Texture::Clouds(Clouds { placement, tint, turbulence, squeeze }),
            6 => Texture::Snow(Snow {
                placement,
                color: tint.color,
                heights,
                elevation: self.elevation,
                scale,
                steepest: self.slope.to_radians().cos(),
                turbulence,
            }),
            7 => Texture::Gradient(Gradient { placement, tint, heights, turbulence }),
            8 => Texture::Bumps(Bumps { placement, scale, squeeze, turbulence, ranges: tint.ranges }),
            9 => Texture::Ripples(lowered_by_frequency(placement, waves)),
            10 => Texture::Ripples(Ripples { placement, waves: waves.clone() }),
            11 => Texture::Blend(Blend { along: Along::U, tint }),
            12 => Texture::Blend(Blend { along: Along::V, tint }),
            other => return Err(damaged(format!("a texture is of an unknown kind, {other}"))),
        })
    }
}

fn color_ranges(ir: &Bound<PyAny>) -> PyResult<Vec<ColorRange>> {
    let table = Table::of(ir, "color_ranges")?;
    let (start, end): (Vec<f64>, Vec<f64>) = (table.numbers("start")?, table.numbers("end")?);
    let (start_color, end_color) = (table.vectors("start_color")?, table.vectors("end_color")?);
    (0..start.len())
        .map(|i| {
            Ok(ColorRange {
                start: start[i],
                end: *table.entry(&end, i)?,
                start_color: *table.entry(&start_color, i)?,
                end_color: *table.entry(&end_color, i)?,
            })
        })
        .collect()
}

fn waves(ir: &Bound<PyAny>) -> PyResult<Vec<Wave>> {
    let table = Table::of(ir, "waves")?;
    let center = table.vectors("center")?;
    let (amplitude, freq) = (table.numbers("amplitude")?, table.numbers("freq")?);
    let (phase, damp) = (table.numbers("phase")?, table.numbers("damp")?);
    (0..center.len())
        .map(|i| {
            Ok(Wave {
                center: center[i],
                amplitude: *table.entry(&amplitude, i)?,
                freq: *table.entry(&freq, i)?,
                phase: *table.entry(&phase, i)?,
                damp: *table.entry(&damp, i)?,
            })
        })
        .collect()
}

fn textures(ir: &Bound<PyAny>) -> PyResult<Vec<TextureRow>> {
    let (ranges, waves) = (color_ranges(ir)?, waves(ir)?);
    let table = Table::of(ir, "textures")?;
    let kind: Vec<i32> = table.plain("kind")?;
    let local: Vec<bool> = table.plain("local")?;
    let (color, inverse) = (table.vectors("color")?, table.matrices("inverse")?);
    let numbers = |column| table.numbers(column);
    let (turbulence, squeeze, scale) = (numbers("turbulence")?, numbers("squeeze")?, numbers("scale")?);
    let (slope, elevation) = (numbers("slope")?, numbers("elevation")?);
    let counts = |column| table.plain::<i32>(column);
    let (first_range, range_count) = (counts("first_color_range")?, counts("color_range_count")?);
    let (first_wave, wave_count) = (counts("first_wave")?, counts("wave_count")?);
    let mut owned_ranges = Owned::new("color_ranges", ranges.len());
    let mut owned_waves = Owned::new("waves", waves.len());
    (0..kind.len())
        .map(|i| {
            let part = |owned: &mut Owned, first: &[i32], count: &[i32]| {
                owned.take(*table.entry(first, i)?, *table.entry(count, i)?)
            };
            let used_ranges = part(&mut owned_ranges, &first_range, &range_count)?;
            let used_waves = part(&mut owned_waves, &first_wave, &wave_count)?;
            Ok(TextureRow {
                kind: kind[i],
                local: *table.entry(&local, i)?,
                inverse: *table.entry(&inverse, i)?,
                tint: Tint { color: *table.entry(&color, i)?, ranges: ranges[used_ranges].to_vec() },
                turbulence: *table.entry(&turbulence, i)?,
                squeeze: Squeeze::new(*table.entry(&squeeze, i)?),
                scale: *table.entry(&scale, i)?,
                slope: *table.entry(&slope, i)?,
                elevation: *table.entry(&elevation, i)?,
                waves: waves[used_waves].to_vec(),
            })
        })
        .collect()
}

/// The heights of the scene's extent, if it has any.
fn heights(ir: &Bound<PyAny>) -> PyResult<Option<Heights>> {
    let extent = ir.getattr("scene")?.getattr("extent")?;
    if extent.is_none() {
        return Ok(None);
    }
    Ok(Some(Heights { low: vector(&extent, "minimum")?.z, high: vector(&extent, "maximum")?.z }))
}

/// P, U and V of a table of planar primitives.
struct Planar<'py> {
    table: Table<'py>,
    point: Vec<DVec3>,
    u: Vec<DVec3>,
    v: Vec<DVec3>,
}

impl<'py> Planar<'py> {
    fn of(ir: &Bound<'py, PyAny>, name: &'static str) -> PyResult<Self> {
        let table = Table::of(ir, name)?;
        let (point, u, v) = (table.places("point")?, table.places("u")?, table.places("v")?);
        Ok(Self { table, point, u, v })
    }

    fn row(&self, i: usize) -> PyResult<(DVec3, DVec3, DVec3)> {
        Ok((
            *self.table.entry(&self.point, i)?,
            *self.table.entry(&self.u, i)?,
            *self.table.entry(&self.v, i)?,
        ))
    }
}

fn spheres(ir: &Bound<PyAny>) -> PyResult<Vec<Sphere>> {
    let table = Table::of(ir, "spheres")?;
    let center = table.places("center")?;
    let radius = table.numbers("radius")?;
    for (row, &radius) in radius.iter().enumerate() {
        place(radius, || format!("spheres.radius, row {row},"))?;
    }
    let (pole, equator) = (table.vectors("pole")?, table.vectors("equator")?);
    (0..center.len())
        .map(|i| {
            Ok(Sphere {
                center: center[i],
                radius: *table.entry(&radius, i)?,
                pole: *table.entry(&pole, i)?,
                equator: *table.entry(&equator, i)?,
            })
        })
        .collect()
}

fn shapes(ir: &Bound<PyAny>, solids: usize, lights: usize) -> PyResult<Shapes> {
    let table = Table::of(ir, "primitives")?;
    let kind: Vec<i32> = table.plain("kind")?;
    let row: Vec<i32> = table.plain("row")?;
    let (solid, light): (Vec<i32>, Vec<i32>) = (table.plain("solid")?, table.plain("light")?);
    let spheres = spheres(ir)?;
    let (planes, triangles) = (Planar::of(ir, "planes")?, Planar::of(ir, "triangles")?);
    let rectangles = Planar::of(ir, "rectangles")?;
    let mut meshes = Meshes::of(ir)?;
    let mut shapes = Shapes::default();
    shapes.vertices = Table::of(ir, "vertices")?.places("position")?;
    shapes.normals = Table::of(ir, "normals")?.vectors("direction")?;
    if kind.len() + meshes.owned.length > ShapeId::MOST || shapes.vertices.len() > ShapeId::MOST {
        return Err(PyValueError::new_err("the scene has more than 1,073,741,824 shapes"));
    }
    shapes.reserve(kind.len(), meshes.owned.length).map_err(|_| PyMemoryError::new_err(TOO_LARGE))?;
    for (i, &kind) in kind.iter().enumerate() {
        let owner = match (*table.entry(&solid, i)?, *table.entry(&light, i)?) {
            (solid, -1) if usize::try_from(solid).is_ok_and(|row| row < solids) => {
                Owner::Solid(solid as usize)
            }
            (-1, light) if usize::try_from(light).is_ok_and(|row| row < lights) => {
                Owner::Light(light as usize)
            }
            _ => return Err(damaged(format!("primitive {i} belongs to no solid and no light"))),
        };
        let part = Part { owner, primitive: i };
        let row = usize::try_from(*table.entry(&row, i)?)
            .map_err(|_| damaged(format!("primitive {i} has no row")))?;
        match kind {
            0 => {
                let sphere = spheres.get(row).ok_or_else(|| damaged(format!("spheres has no row {row}")))?;
                shapes.push_sphere(*sphere, part);
            }
            1 => {
                let (point, u, v) = planes.row(row)?;
                shapes.push_plane(point, u.cross(v), part);
            }
            2 => {
                let (point, u, v) = triangles.row(row)?;
                shapes.push_triangle([point + v, point, point + u], part);
            }
            3 => {
                let (point, u, v) = rectangles.row(row)?;
                shapes.push_rectangle(Rectangle { point, u, v }, part);
            }
            4 | 5 => meshes.push(row, part, &mut shapes)?,
            other => return Err(damaged(format!("primitive {i} is of an unknown kind, {other}"))),
        }
    }
    Ok(shapes)
}

/// POLYGONS and TERRAIN.
struct Meshes<'py> {
    table: Table<'py>,
    phong: Vec<bool>,
    first_facet: Vec<i32>,
    facet_count: Vec<i32>,
    corners: Threes<'py, i32>,
    normals: Threes<'py, i32>,
    owned: Owned,
}

impl<'py> Meshes<'py> {
    fn of(ir: &Bound<'py, PyAny>) -> PyResult<Self> {
        let table = Table::of(ir, "meshes")?;
        let facets = Table::of(ir, "facets")?;
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

    fn push(&mut self, row: usize, part: Part, shapes: &mut Shapes) -> PyResult<()> {
        let first = *self.table.entry(&self.first_facet, row)?;
        let count = *self.table.entry(&self.facet_count, row)?;
        let used = self.owned.take(first, count)?;
        let phong = *self.table.entry(&self.phong, row)?;
        let (vertices, normals) = (shapes.vertices.len(), shapes.normals.len());
        let exist = |names: [i32; 3], length: usize| {
            names.iter().all(|&name| usize::try_from(name).is_ok_and(|name| name < length))
        };
        if !used.clone().all(|i| exist(self.corners.row(i), vertices)) {
            return Err(damaged("a facet has a corner that does not exist".into()));
        }
        let facets = used.map(|i| {
            let smooth = phong && exist(self.normals.row(i), normals);
            let name = |names: [i32; 3]| names.map(|name| name as u32);
            (name(self.corners.row(i)), smooth.then(|| name(self.normals.row(i))))
        });
        shapes.push_facets(facets, part);
        Ok(())
    }
}

/// The atmosphere, if the scene has a MIRAGE.
pub fn atmosphere(ir: &Bound<PyAny>, finer: usize) -> PyResult<Option<Atmosphere>> {
    let mirage = ir.getattr("scene")?.getattr("mirage")?;
    if mirage.is_none() {
        return Ok(None);
    }
    let limits = Limits {
        segments: count(&mirage, "segments")?,
        distance: number(&mirage, "distance")?,
        elevation: number(&mirage, "elevation")?,
    };
    let table = Table::of(ir, "profile")?;
    let (elevations, temperatures) = (table.numbers("elevation")?, table.numbers("temperature")?);
    if elevations.len() > MOST_POINTS {
        return Err(damaged(format!("the temperature profile has more than {MOST_POINTS} points")));
    }
    Atmosphere::new(&elevations, &temperatures, limits, finer).map(Some).map_err(PyValueError::new_err)
}
