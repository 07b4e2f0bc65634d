//! Procedural textures: how the colour of a surface changes from point to point. Thesis 3.5 and 7.5.5.4.

pub mod blend;
pub mod checker;
pub mod color_range;

use glam::DVec3;

use blend::Blend;
use checker::Checker;

/// A point of a surface, as textures see it.
#[derive(Clone, Copy, Debug)]
pub struct Spot {
    /// World position.
    pub point: DVec3,
    /// u and v of the primitive, 0..1; a plane has none.
    pub uv: Option<(f64, f64)>,
}

/// The closed set of textures.
#[derive(Clone, Debug)]
pub enum Texture {
    Checker(Checker),
    Blend(Blend),
}

impl Texture {
    pub fn needs_uv(&self) -> bool {
        matches!(self, Texture::Blend(_))
    }

    /// The colour that the texture makes of the surface's.
    pub fn color(&self, surface: DVec3, spot: &Spot) -> DVec3 {
        match self {
            Texture::Checker(checker) => checker.color(surface, spot),
            Texture::Blend(blend) => blend.color(surface, spot),
        }
    }
}
