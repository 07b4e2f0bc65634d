//! A scene as the renderer has it: its shapes in trees, whom each belongs to, and what is said once.

use glam::DVec3;

use crate::bvh::Bvh;
use crate::camera::Camera;
use crate::optics::atmosphere::Atmosphere;
use crate::shade::haze::Haze;
use crate::shade::illumination::{Light, Surface};
use crate::shade::sky::Sky;
use crate::shapes::Shapes;
use crate::texture::Texture;

#[derive(Clone, Debug)]
pub struct Solid {
    pub surface: Surface,
    /// In the order in which they apply.
    pub textures: Vec<Texture>,
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
