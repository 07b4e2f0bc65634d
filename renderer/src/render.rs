//! A picture: eye rays, the mirror rays and shadow rays they cause, and the rows of pixels they make.
//! Thesis 3.1 and 4.2.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::bvh::Visit;
use crate::camera::Size;
use crate::film::Film;
use crate::optics::atmosphere::Atmosphere;
use crate::optics::path::Path;
use crate::ray::{Hit, Ray, ShapeId};
use crate::scene::{Background, Owner, Scene};
use crate::shade::illumination::LitPoint;
use crate::shape::RadialPlane;
use crate::texture::{Spot, Texture};
use crate::trace::{blocked, clearance, nearest, nearest_on_curve};

/// A ray with a horizontal part shorter than this is straight.
const NEARLY_VERTICAL: f64 = 1e-6;

/// What may be asked of a picture of a scene.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    pub size: Size,
    /// The part to render: its first column and row, and how many there are.
    pub left: usize,
    pub top: usize,
    pub columns: usize,
    pub rows: usize,
    pub shadows: bool,
    /// Level of the last mirror ray; the eye ray is level 1.
    pub depth: usize,
    pub film: Film,
}

/// How many rays of each kind were traced, and the arcs of the curved ones.
#[derive(Clone, Copy, Default, Debug)]
pub struct Tally {
    pub eye: u64,
    pub mirage: u64,
    pub reflected: u64,
    pub shadow: u64,
    pub arcs: u64,
}

impl Tally {
    fn plus(self, other: Self) -> Self {
        Self {
            eye: self.eye + other.eye,
            mirage: self.mirage + other.mirage,
            reflected: self.reflected + other.reflected,
            shadow: self.shadow + other.shadow,
            arcs: self.arcs + other.arcs,
        }
    }
}

/// The state of a rendering that others may watch and stop.
#[derive(Default, Debug)]
pub struct Watch {
    pub rows_done: AtomicUsize,
    pub cancelled: AtomicBool,
}

/// What a ray came upon.
enum Arrival {
    Shape { shape: ShapeId, point: DVec3, direction: DVec3, travelled: f64 },
    Nothing { origin: DVec3, direction: DVec3, travelled: f64 },
}

/// Renders the rows of a region into `pixels`, three numbers a pixel. A row that is finished does not depend on
/// the others. Stops early when it is cancelled.
pub fn render(
    scene: &Scene,
    air: Option<&Atmosphere>,
    settings: &Settings,
    watch: &Watch,
    pixels: &mut [f32],
) -> Tally {
    pixels
        .par_chunks_exact_mut(3 * settings.columns)
        .with_max_len(1)
        .enumerate()
        .map_init(
            || Tracer::new(scene, air, settings),
            |tracer, (row, pixels)| {
                tracer.tally = Tally::default();
                for (column, pixel) in pixels.chunks_exact_mut(3).enumerate() {
                    if watch.cancelled.load(Ordering::Relaxed) {
                        return tracer.tally;
                    }
                    let color = tracer.pixel(settings.left + column, settings.top + row);
                    pixel.copy_from_slice(&settings.film.develop(color));
                }
                watch.rows_done.fetch_add(1, Ordering::Relaxed);
                tracer.tally
            },
        )
        .reduce(Tally::default, Tally::plus)
}

/// One thread's means of tracing.
struct Tracer<'a> {
    scene: &'a Scene,
    settings: &'a Settings,
    path: Option<Path<'a>>,
    stack: Vec<Visit>,
    tally: Tally,
}

impl<'a> Tracer<'a> {
    fn new(scene: &'a Scene, air: Option<&'a Atmosphere>, settings: &'a Settings) -> Self {
        Self {
            scene,
            settings,
            path: air.map(Path::new),
            stack: Vec::with_capacity(256),
            tally: Tally::default(),
        }
    }

    fn pixel(&mut self, x: usize, y: usize) -> DVec3 {
        let direction = self.scene.camera.direction(self.settings.size, x, y);
        self.tally.eye += 1;
        let horizontal = DVec2::new(direction.x, direction.y).length();
        let arrival = if self.path.is_some() && horizontal >= NEARLY_VERTICAL {
            self.tally.mirage += 1;
            self.curve(direction, horizontal)
        } else {
            self.straight(Ray::new(self.scene.camera.eye, direction), 0.0)
        };
        self.radiance(arrival)
    }

    /// Follows a straight ray that has come some way before its origin.
    fn straight(&mut self, mut ray: Ray, before: f64) -> Arrival {
        let scene = self.scene;
        let mut hit = nearest(&scene.shapes, &scene.solid_tree, &ray, &mut self.stack);
        if let Some(solid) = hit {
            ray.to = solid.t;
        }
        if let Some(light) = nearest(&scene.shapes, &scene.light_tree, &ray, &mut self.stack) {
            hit = Some(light);
        }
        match hit {
            Some(Hit { t, shape }) => {
                Arrival::Shape { shape, point: ray.at(t), direction: ray.direction, travelled: before + t }
            }
            None => Arrival::Nothing { origin: ray.origin, direction: ray.direction, travelled: before },
        }
    }

    /// Follows an eye ray along its curve, and beyond the curve's end along the last tangent.
    fn curve(&mut self, direction: DVec3, horizontal: f64) -> Arrival {
        let scene = self.scene;
        let eye = scene.camera.eye;
        let slope = direction.z / horizontal;
        let radial = DVec2::new(direction.x, direction.y) / horizontal;
        let plane = RadialPlane { origin: eye, radial };
        let Some(path) = self.path.as_mut() else {
            return self.straight(Ray::new(eye, direction), 0.0);
        };
        path.start(eye.z, slope);
        let stack = &mut self.stack;
        let solid = nearest_on_curve(&scene.shapes, &scene.solid_tree, &plane, path, f64::INFINITY, stack);
        let limit = solid.map_or(f64::INFINITY, |hit| hit.t);
        let light = nearest_on_curve(&scene.shapes, &scene.light_tree, &plane, path, limit, stack);
        let measures_length = scene.haze.density > 0.0;
        let length = |path: &Path, until: f64| {
            if !measures_length {
                return 0.0;
            }
            let arcs = path.arcs().iter().take_while(|arc| arc.r0 <= until);
            arcs.map(|arc| arc.length_to(arc.r1.min(until))).sum()
        };
        if let Some(Hit { t: r, shape }) = light.or(solid) {
            let arc = path.find(r, 0).and_then(|i| path.arc(i).copied());
            self.tally.arcs += path.arcs().len() as u64;
            if let Some(arc) = arc {
                let tangent = DVec3::new(radial.x, radial.y, arc.slope_at(r));
                return Arrival::Shape {
                    shape,
                    point: plane.point(r, arc.height(r)),
                    direction: tangent.normalize(),
                    travelled: if measures_length { length(path, r) } else { r },
                };
            }
        }
        while path.arc(path.arcs().len()).is_some() {}
        self.tally.arcs += path.arcs().len() as u64;
        let (r, z, slope) = path.tip();
        let travelled = length(path, f64::INFINITY);
        let tangent = DVec3::new(radial.x, radial.y, slope);
        let mut ray = Ray::new(plane.point(r, z), tangent.normalize());
        // A surface where the curve ends, which rounding puts a hair before it, still counts.
        ray.from = if r > 0.0 { -clearance(ray.origin, r) } else { 0.0 };
        self.straight(ray, travelled)
    }

    /// The colour that a ray brings back, with those of the mirror rays behind it: eq. 3.9.
    fn radiance(&mut self, first: Arrival) -> DVec3 {
        let scene = self.scene;
        let haze = scene.haze;
        let mut sum = DVec3::ZERO;
        let mut share = 1.0;
        let mut arrival = first;
        let mut level = 1;
        loop {
            let (shape, point, direction, travelled) = match arrival {
                Arrival::Nothing { origin, direction, travelled } => {
                    return sum + share * self.nothing(origin, direction, travelled);
                }
                Arrival::Shape { shape, point, direction, travelled } => (shape, point, direction, travelled),
            };
            let clear = haze.transmits(travelled);
            sum += share * (1.0 - clear) * haze.color;
            share *= clear;
            let solid = match scene.shapes.owner(shape) {
                Owner::Solid(solid) => &scene.solids[solid],
                Owner::Light(light) => {
                    let light = &scene.lights[light];
                    return sum + share * light.intensity * light.color;
                }
            };
            let normals = scene.shapes.normals(shape, point, direction);
            let mut diffuse = solid.surface.color;
            if !solid.textures.is_empty() {
                let needs_uv = solid.textures.iter().any(Texture::needs_uv);
                let uv = if needs_uv { scene.shapes.uv(shape, point) } else { None };
                let spot = Spot { point, uv };
                for texture in &solid.textures {
                    diffuse = texture.color(diffuse, &spot);
                }
            }
            let lit = LitPoint {
                surface: &solid.surface,
                diffuse,
                normal: normals.shading,
                toward_viewer: -direction,
            };
            let from = clearance(point, travelled);
            sum += share * lit.ambient(scene.ambient);
            sum += share * self.direct(&lit, shape, point, from);
            share *= solid.surface.mirrors();
            if share.is_nan() || share <= 0.0 {
                return sum;
            }
            if level >= self.settings.depth {
                return sum + share * scene.ambient;
            }
            level += 1;
            // Eq. 3.1.
            let n = normals.shading;
            let mirrored = direction - 2.0 * direction.dot(n) * n;
            self.tally.reflected += 1;
            let ray = Ray { from, leaves: Some(shape), ..Ray::new(point, mirrored.normalize_or_zero()) };
            arrival = self.straight(ray, 0.0);
        }
    }

    /// The sum over the lights that the point sees.
    fn direct(&mut self, lit: &LitPoint, shape: ShapeId, point: DVec3, from: f64) -> DVec3 {
        let scene = self.scene;
        let mut sum = DVec3::ZERO;
        for light in &scene.lights {
            let Some(incident) = light.at(point) else { continue };
            let cosine = lit.normal.dot(incident.toward);
            if cosine.is_nan() || cosine <= 0.0 {
                continue;
            }
            if self.settings.shadows && light.shadows {
                self.tally.shadow += 1;
                let ray = Ray {
                    origin: point,
                    direction: incident.toward,
                    from,
                    to: incident.distance,
                    leaves: Some(shape),
                };
                if blocked(&scene.shapes, &scene.solid_tree, &ray, &mut self.stack) {
                    continue;
                }
            }
            sum += lit.lit_by(light, &incident);
        }
        sum
    }

    /// The colour where a ray meets nothing.
    fn nothing(&self, origin: DVec3, direction: DVec3, travelled: f64) -> DVec3 {
        match &self.scene.background {
            Background::Plain(color) => *color,
            Background::Sky(sky) => {
                let seen = sky.seen_along(origin, direction);
                let color = sky.color(seen.direction);
                self.scene.haze.over_sky(color, travelled + seen.distance, seen.direction.z)
            }
        }
    }
}
