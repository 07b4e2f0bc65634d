//! Reads a compiled scene (docs/m3ir.md) into the kernel's own.
//!
//! A scene is its header, a JSON text, and its tables, whose numbers may lie anywhere. Nothing of it is trusted: a table
//! that is missing, of the wrong type, names rows that do not exist, or holds what is no finite number is refused, and
//! so is one that names rows of another more than once, and what does not fit in memory. So a damaged file can do no
//! more than that, and the kernel relies on it.

mod air;
mod archive;
mod generated;
mod header;
mod lights;
mod options;
mod refusal;
mod shapes;
mod solids;
mod tables;
mod textures;

use m3d_kernel::camera::Camera;
use m3d_kernel::scene::{Ambient, Background, Scene};
use m3d_kernel::shade::haze::Haze;
use m3d_kernel::shade::illumination::Light;
use m3d_kernel::shade::sky::Sky;

pub use air::air;
pub use archive::Archive;
pub use options::options;
pub use refusal::{Refusal, Result};
pub use tables::{Column, Numbers, Tables};

use header::{count, number, position, vector};
use refusal::damaged;
use tables::Table;

/// A compiled scene.
pub struct Ir<'a> {
    pub scene: generated::Scene,
    tables: &'a dyn Tables,
}

impl<'a> Ir<'a> {
    /// `header` is the JSON text that a `.m3ir` file begins with.
    pub fn new(header: &str, tables: &'a dyn Tables) -> Result<Self> {
        Ok(Self { scene: header::read(header)?, tables })
    }

    fn table(&self, name: &'static str) -> Table<'a> {
        Table::new(self.tables, name)
    }
}

/// The whole scene. Each interval of its temperature profile becomes `finer` layers.
pub fn scene(ir: &Ir, finer: usize) -> Result<Scene> {
    let said = &ir.scene;
    let view = &said.view;
    let camera = Camera {
        eye: position(view.eye, "eye")?,
        ahead: number(view.distance, "distance")? * position(view.normal, "normal")?,
        right: position(view.right, "right")?,
        up: position(view.up, "up")?,
        aspect: number(view.aspect, "aspect")?,
    };
    let haze = Haze {
        color: number(said.haze.intensity, "intensity")? * vector(said.haze.color, "color")?,
        density: number(said.haze.density, "density")?,
    };
    let ambient = Ambient {
        constant: number(said.ambient.intensity, "intensity")? * vector(said.ambient.color, "color")?,
        samples: count(said.ambient.samples),
        depth: count(said.ambient.depth),
    };
    let lights = lights::lights(ir)?;
    let background = background(ir, &haze, &lights)?;
    let solids = solids::solids(ir)?;
    let shapes = shapes::shapes(ir, solids.len(), lights.len())?;
    let air = air(ir, finer)?;
    let (solid_tree, light_tree) = shapes.trees();
    Ok(Scene { camera, background, ambient, haze, air, lights, solids, shapes, solid_tree, light_tree })
}

fn background(ir: &Ir, haze: &Haze, lights: &[Light]) -> Result<Background> {
    let Some(sky) = &ir.scene.sky else {
        let plain =
            if ir.scene.haze.defined { haze.color } else { vector(ir.scene.background, "background")? };
        return Ok(Background::Plain(plain));
    };
    let sun = usize::try_from(sky.sun).ok().and_then(|row| lights.get(row));
    let sun = sun.ok_or_else(|| damaged("the sky's sun is not among the lights"))?;
    Ok(Background::Sky(Sky {
        radius: number(sky.radius, "radius")?,
        intensity: number(sky.intensity, "intensity")?,
        zenith_color: vector(sky.zenith_color, "zenith_color")?,
        horizon_color: vector(sky.horizon_color, "horizon_color")?,
        overcast: number(sky.overcast, "overcast")?,
        sun: -sun.direction,
    }))
}
