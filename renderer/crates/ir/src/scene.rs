//! The whole scene.

use m3d_kernel::camera::Camera;
use m3d_kernel::scene::{Ambient, Background, Scene};
use m3d_kernel::shade::haze::Haze;
use m3d_kernel::shade::illumination::Light;
use m3d_kernel::shade::sky::Sky;

use crate::air::air;
use crate::header::{count, number, position, vector};
use crate::ir::Ir;
use crate::lights::lights;
use crate::refusal::{Result, damaged};
use crate::shapes::shapes;
use crate::solids::solids;

/// The whole scene. Each interval of its temperature profile becomes `finer` layers.
pub fn scene(ir: &Ir, finer: usize) -> Result<Scene> {
    let said = &ir.globals;
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
    let lights = lights(ir)?;
    let background = background(ir, &haze, &lights)?;
    let solids = solids(ir)?;
    let mut shapes = shapes(ir, solids.len(), lights.len())?;
    let air = air(ir, finer)?;
    let (solid_tree, light_tree) = shapes.trees();
    Ok(Scene { camera, background, ambient, haze, air, lights, solids, shapes, solid_tree, light_tree })
}

fn background(ir: &Ir, haze: &Haze, lights: &[Light]) -> Result<Background> {
    let Some(sky) = &ir.globals.sky else {
        let plain =
            if ir.globals.haze.defined { haze.color } else { vector(ir.globals.background, "background")? };
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
