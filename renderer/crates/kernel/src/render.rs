//! One pixel: its eye rays, the mirror rays, shadow rays and sample rays they cause, and the colour that comes of it.
//! Thesis 3.1, 3.4 and 4.2.

use std::sync::atomic::{AtomicBool, Ordering};

use glam::{DVec2, DVec3};

use crate::bvh::Visit;
use crate::camera::Size;
use crate::film::Film;
use crate::optics::crossing::Crossing;
use crate::optics::path::Path;
use crate::optics::radial_plane::RadialPlane;
use crate::optics::tip::Tip;
use crate::options::Options;
use crate::output::Output;
use crate::random::Branch;
use crate::ray::{Hit, Ray};
use crate::scene::{Background, Scene, Solid};
use crate::shade::illumination::LitPoint;
use crate::shade::scatter::{into_hemisphere, roughened};
use crate::shapes::Owner;
use crate::sight::{Arrival, Sight, Way};
use crate::supersampling::Filter;
use crate::texture::Texture;
use crate::texture::spot::{Skin, Spot};
use crate::trace::{Departure, blocked, clearance, nearest, nearest_on_curve, uncertainty};

/// A ray with a horizontal part shorter than this is straight.
const NEARLY_VERTICAL: f64 = 1e-6;

/// Indirect light that makes up less of a pixel than this is not sampled: the constant stands for it.
const FAINTEST: f64 = 1e-7;

/// So many sample rays may start one from another. Almost always they are too faint long before.
const DEEPEST: usize = 64;

/// Number of the branch from which FUZZ draws, after those of the mirror ray, 0, and of the sample rays, from 1.
const FUZZ: u64 = u64::MAX;

/// What may be asked of a picture of a scene.
#[derive(Clone, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Settings {
    pub size: Size,
    /// The part to render: its first column and row, and how many there are.
    pub left: usize,
    pub top: usize,
    pub columns: usize,
    pub rows: usize,
    pub options: Options,
    /// Extra outputs, in this order.
    pub outputs: Vec<Output>,
}

impl Settings {
    /// Numbers a pixel that the extra outputs take.
    pub fn channels(&self) -> usize {
        self.outputs.iter().map(|output| output.channels()).sum()
    }

    /// The same in parts of so many rows, from the top. Each can be rendered without the others, wherever the scene is.
    pub fn parts(&self, rows: usize) -> impl Iterator<Item = Self> {
        let end = self.top + self.rows;
        (self.top..end).step_by(rows.max(1)).map(move |top| Self {
            top,
            rows: rows.max(1).min(end - top),
            ..self.clone()
        })
    }

    pub fn film(&self) -> Film {
        Film { log_scale: self.options.log_scale, normalize: self.options.normalize }
    }
}

/// How many rays of each kind were traced, and the arcs of the curved ones.
#[derive(Clone, Copy, Default, Debug)]
pub struct Tally {
    pub eye: u64,
    pub mirage: u64,
    pub reflected: u64,
    pub shadow: u64,
    pub ambient: u64,
    pub arcs: u64,
}

impl Tally {
    pub fn plus(self, other: Self) -> Self {
        Self {
            eye: self.eye + other.eye,
            mirage: self.mirage + other.mirage,
            reflected: self.reflected + other.reflected,
            shadow: self.shadow + other.shadow,
            ambient: self.ambient + other.ambient,
            arcs: self.arcs + other.arcs,
        }
    }
}

/// What a ray carries with it through the tree of rays.
#[derive(Clone, Copy)]
struct Errand {
    /// 1 for the eye's ray, one more for each ray that another causes.
    level: usize,
    /// How many sample rays are among those before it.
    scattered: usize,
    /// Most of what it brings that can come through to the pixel.
    share: f64,
    branch: Branch,
}

/// One thread's means of tracing.
pub struct Tracer<'a> {
    scene: &'a Scene,
    settings: &'a Settings,
    filter: Option<&'a Filter>,
    cancelled: &'a AtomicBool,
    path: Option<Path<'a>>,
    stack: Vec<Visit>,
    /// Whether the lengths of curves are wanted, for haze or as an output.
    measures_length: bool,
    pub tally: Tally,
}

impl<'a> Tracer<'a> {
    /// `filter` spreads several samples a pixel.
    pub fn new(
        scene: &'a Scene,
        settings: &'a Settings,
        filter: Option<&'a Filter>,
        cancelled: &'a AtomicBool,
    ) -> Self {
        Self {
            scene,
            settings,
            filter,
            cancelled,
            path: scene
                .air
                .as_ref()
                .filter(|_| !settings.options.straight)
                .map(|air| Path::stopped_by(air, cancelled)),
            stack: Vec::with_capacity(256),
            measures_length: scene.haze.density > 0.0 || settings.outputs.contains(&Output::Path),
            tally: Tally::default(),
        }
    }

    /// The colour of a pixel; the extra outputs of the ray through its middle go to `outputs`.
    pub fn pixel(&mut self, x: usize, y: usize, outputs: &mut [f32]) -> DVec3 {
        let middle = |tracer: &mut Self| tracer.look(x as f64, y as f64);
        let Some(filter) = self.filter else {
            let sight = middle(self);
            self.describe(&sight, outputs);
            return self.radiance(sight.arrival, Errand::of_eye(Branch::of_sample(x, y, 0)));
        };
        if !outputs.is_empty() {
            let sight = middle(self);
            self.describe(&sight, outputs);
        }
        let mut sum = DVec3::ZERO;
        for (i, [dx, dy]) in filter.samples(x, y, self.settings.options.samples).enumerate() {
            if self.is_cancelled() {
                break;
            }
            let sight = self.look(x as f64 + dx, y as f64 + dy);
            sum += self.radiance(sight.arrival, Errand::of_eye(Branch::of_sample(x, y, i)));
        }
        sum / self.settings.options.samples as f64
    }

    fn describe(&self, sight: &Sight, mut out: &mut [f32]) {
        for output in &self.settings.outputs {
            output.write(sight, &self.scene.camera, &self.scene.shapes, out);
            out = &mut out[output.channels()..];
        }
    }

    fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    /// Follows the eye ray through a point of the picture.
    fn look(&mut self, x: f64, y: f64) -> Sight {
        let camera = &self.scene.camera;
        let ray = Ray::new(camera.eye, camera.direction(self.settings.size, x, y));
        let bent = self.bent_part(&ray);
        self.tally.eye += 1;
        self.tally.mirage += u64::from(bent.is_some());
        self.follow(ray, bent)
    }

    /// The length of a ray's horizontal part, if the air bends the ray, should it start within the air's layers.
    fn bent_part(&self, ray: &Ray) -> Option<f64> {
        self.path.as_ref()?;
        let horizontal = DVec2::new(ray.direction.x, ray.direction.y).length();
        (horizontal >= NEARLY_VERTICAL).then_some(horizontal)
    }

    /// Follows a ray as the air bends it.
    fn follow(&mut self, ray: Ray, bent: Option<f64>) -> Sight {
        match bent {
            Some(horizontal) => self.curve(ray, horizontal),
            None => Sight { arrival: self.straight(ray, Way::default()), arcs: 0 },
        }
    }

    /// Follows a straight ray that has come some way before its origin.
    fn straight(&mut self, mut ray: Ray, before: Way) -> Arrival {
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
                Arrival::Shape { shape, point: ray.at(t), direction: ray.direction, way: before.and(t) }
            }
            None => Arrival::Nothing { origin: ray.origin, direction: ray.direction, way: before },
        }
    }

    /// Follows a ray along its curve, and beyond the curve's end along the last tangent.
    fn curve(&mut self, start: Ray, horizontal: f64) -> Sight {
        let scene = self.scene;
        let slope = start.direction.z / horizontal;
        let radial = DVec2::new(start.direction.x, start.direction.y) / horizontal;
        let plane = RadialPlane { origin: start.origin, radial };
        let Some(path) = self.path.as_mut() else {
            return Sight { arrival: self.straight(start, Way::default()), arcs: 0 };
        };
        path.start_near(start.origin.z, slope, start.from);
        let departure = Departure { from: start.from * horizontal, leaves: start.leaves };
        let stack = &mut self.stack;
        let solid = nearest_on_curve(
            &scene.shapes,
            &scene.solid_tree,
            &plane,
            path,
            &departure,
            f64::INFINITY,
            stack,
        );
        let limit = solid.map_or(f64::INFINITY, |(hit, _)| hit.t);
        let light =
            nearest_on_curve(&scene.shapes, &scene.light_tree, &plane, path, &departure, limit, stack);
        let measures_length = self.measures_length;
        if let Some((Hit { t: r, shape }, Crossing { arc, number, .. })) = light.or(solid) {
            let arcs = number + 1;
            self.tally.arcs += arcs as u64;
            let tangent = DVec3::new(radial.x, radial.y, arc.slope_at(r));
            let arrival = Arrival::Shape {
                shape,
                point: plane.point(r, arc.height(r)),
                direction: tangent.normalize(),
                way: Way { rough: r, length: if measures_length { path.length_to(r) } else { r } },
            };
            return Sight { arrival, arcs };
        }
        let Tip { r, z, slope, arcs, .. } = path.end_tip();
        self.tally.arcs += arcs as u64;
        let way = Way { rough: r, length: if measures_length { path.length_to(r) } else { r } };
        let tangent = DVec3::new(radial.x, radial.y, slope);
        let mut ray = Ray::new(plane.point(r, z), tangent.normalize());
        if r > departure.from {
            // A surface where the curve ends, which rounding puts a hair before it, still counts.
            ray.from = -clearance(ray.origin, r);
        } else {
            ray = start;
        }
        Sight { arrival: self.straight(ray, way), arcs }
    }

    /// The colour that a ray brings back, with those of the mirror rays behind it: eq. 3.9.
    fn radiance(&mut self, first: Arrival, mut errand: Errand) -> DVec3 {
        let scene = self.scene;
        let haze = scene.haze;
        let mut sum = DVec3::ZERO;
        let mut share = 1.0;
        let mut arrival = first;
        loop {
            let (shape, point, direction, way) = match arrival {
                Arrival::Nothing { origin, direction, way } => {
                    return sum + share * self.nothing(origin, direction, way.length);
                }
                Arrival::Shape { shape, point, direction, way } => (shape, point, direction, way),
            };
            let clear = haze.transmits(way.length);
            sum += share * (1.0 - clear) * haze.color;
            share *= clear;
            let solid = match scene.shapes.part(shape).owner {
                Owner::Solid(solid) => &scene.solids[solid as usize],
                Owner::Light(light) => {
                    let light = &scene.lights[light as usize];
                    return sum + share * light.intensity * light.color;
                }
            };
            if !self.needs_normals(solid) {
                return sum + share * solid.surface.ambient(scene.ambient.constant, solid.surface.color);
            }
            let normals = scene.shapes.normals(shape, point, direction);
            let mut skin = Skin { color: solid.surface.color, normal: normals.shading };
            if !solid.textures.is_empty() {
                let needs_uv = solid.textures.iter().any(Texture::needs_uv);
                let uv = if needs_uv { scene.shapes.uv(shape, point) } else { None };
                let spot = Spot { point, uncertainty: uncertainty(point, way.rough), uv };
                for texture in &solid.textures {
                    skin = texture.apply(skin, &spot);
                }
            }
            let Skin { color: diffuse, mut normal } = skin;
            if solid.surface.fuzz > 0.0 {
                normal = roughened(&mut errand.branch.child(FUZZ).numbers(), normal, solid.surface.fuzz);
            }
            let lit = LitPoint { surface: &solid.surface, diffuse, normal, toward_viewer: -direction };
            let from = clearance(point, way.rough);
            let start = Ray { from, leaves: Some(shape), ..Ray::new(point, direction) };
            let brings = errand.share * share * lit.surface.diffuse * lit.diffuse.max_element();
            sum += share
                * if self.samples_surroundings(&errand, brings) {
                    self.indirect(&lit, &start, &errand, brings)
                } else {
                    lit.ambient(scene.ambient.constant)
                };
            sum += share * self.direct(&lit, &start);
            share *= solid.surface.mirrors();
            if share.is_nan() || share <= 0.0 {
                return sum;
            }
            if errand.level >= self.settings.options.depth {
                return sum + share * scene.ambient.constant;
            }
            if self.is_cancelled() {
                return sum;
            }
            errand.level += 1;
            errand.branch = errand.branch.child(0);
            // Eq. 3.1.
            let n = normal;
            let mut mirrored = direction - 2.0 * direction.dot(n) * n;
            let inward = mirrored.dot(normals.geometric);
            if n != normals.shading && inward < 0.0 {
                // A rough surface would throw it back into itself: that mirrors it out again, as if it were flat.
                mirrored -= 2.0 * inward * normals.geometric;
            }
            self.tally.reflected += 1;
            let ray = Ray { direction: mirrored.normalize_or_zero(), ..start };
            arrival = if self.settings.options.refract_reflections {
                self.follow(ray, self.bent_part(&ray)).arrival
            } else {
                self.straight(ray, Way::default())
            };
        }
    }

    /// Whether the colour of a solid depends on where its surface points to. Where nothing shines, and nothing is
    /// mirrored or textured, it has the constant of indirect light alone.
    fn needs_normals(&self, solid: &Solid) -> bool {
        let Scene { lights, ambient, .. } = self.scene;
        !(lights.is_empty()
            && ambient.samples == 0
            && solid.textures.is_empty()
            && solid.surface.mirrors() <= 0.0)
    }

    /// Whether sample rays are sent out by a surface, of whose indirect light such a share comes through to the
    /// pixel, or the constant stands for them.
    fn samples_surroundings(&self, errand: &Errand, share: f64) -> bool {
        let ambient = &self.scene.ambient;
        ambient.samples > 0 && errand.level < ambient.depth && errand.scattered < DEEPEST && share >= FAINTEST
    }

    /// I_amb as what a number of rays into the hemisphere bring, each weighted by N.D. They see no lights. Thesis
    /// 3.4 (3).
    #[cold]
    fn indirect(&mut self, lit: &LitPoint, start: &Ray, errand: &Errand, share: f64) -> DVec3 {
        let scene = self.scene;
        let samples = scene.ambient.samples;
        let mut sum = DVec3::ZERO;
        for i in 1..=samples as u64 {
            if self.is_cancelled() {
                break;
            }
            let branch = errand.branch.child(i);
            let direction = into_hemisphere(&mut branch.numbers(), lit.normal);
            let cosine = lit.normal.dot(direction);
            self.tally.ambient += 1;
            let ray = Ray { direction, ..*start };
            let arrival = match nearest(&scene.shapes, &scene.solid_tree, &ray, &mut self.stack) {
                Some(Hit { t, shape }) => {
                    Arrival::Shape { shape, point: ray.at(t), direction, way: Way::default().and(t) }
                }
                None => Arrival::Nothing { origin: ray.origin, direction, way: Way::default() },
            };
            let (level, scattered) = (errand.level + 1, errand.scattered + 1);
            let errand = Errand { level, scattered, share: share * cosine, branch };
            sum += cosine * self.radiance(arrival, errand);
        }
        lit.scattered(sum / samples as f64)
    }

    /// The sum over the lights that the point sees.
    fn direct(&mut self, lit: &LitPoint, start: &Ray) -> DVec3 {
        let scene = self.scene;
        let mut sum = DVec3::ZERO;
        for light in &scene.lights {
            let Some(incident) = light.at(start.origin) else { continue };
            let cosine = lit.normal.dot(incident.toward);
            if cosine.is_nan() || cosine <= 0.0 {
                continue;
            }
            if self.is_cancelled() {
                break;
            }
            if self.settings.options.shadows && light.shadows {
                self.tally.shadow += 1;
                let ray = Ray { direction: incident.toward, to: incident.distance, ..*start };
                if blocked(&scene.shapes, &scene.solid_tree, &ray, &mut self.stack) {
                    continue;
                }
            }
            sum += lit.lit_by(light, &incident);
        }
        sum
    }

    /// The colour where a ray meets nothing.
    fn nothing(&self, origin: DVec3, direction: DVec3, length: f64) -> DVec3 {
        match &self.scene.background {
            Background::Plain(color) => *color,
            Background::Sky(sky) => {
                let seen = sky.seen_along(origin, direction);
                let color = sky.color(seen.direction);
                self.scene.haze.over_sky(color, length + seen.distance, seen.direction.z)
            }
        }
    }
}

impl Errand {
    fn of_eye(branch: Branch) -> Self {
        Self { level: 1, scattered: 0, share: 1.0, branch }
    }
}
