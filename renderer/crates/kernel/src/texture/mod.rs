//! Procedural textures: how the colour or the normal of a surface changes from point to point. Thesis 3.5 and
//! 7.5.5.4.
//!
//! A point where a ray meets a surface is known to within rounding. Where a texture has a step, it sees a point that is
//! nearer to the step than that on its upper side: so a surface that lies in the step, such as a floor between two
//! layers of CHECKER's cubes, belongs to one side as a whole.

pub mod blend;
pub mod bumps;
pub mod checker;
pub mod clouds;
pub mod color_range;
pub mod gradient;
pub mod granite;
pub mod heights;
pub mod marble;
pub mod placement;
pub mod ripples;
pub mod snow;
pub mod spot;
pub mod spotted;
pub mod squeeze;
pub mod tint;
pub mod wave;
pub mod waves;
pub mod wood;

use blend::Blend;
use bumps::Bumps;
use checker::Checker;
use clouds::Clouds;
use gradient::Gradient;
use granite::Granite;
use marble::Marble;
use ripples::Ripples;
use snow::Snow;
use spot::{Skin, Spot};
use spotted::Spotted;
use wood::Wood;

/// The closed set of textures. WAVES are ripples of other heights, UBLEND and VBLEND one blend.
#[derive(Clone, Debug)]
pub enum Texture {
    Checker(Checker),
    Wood(Wood),
    Marble(Marble),
    Spotted(Spotted),
    Granite(Granite),
    Clouds(Clouds),
    Snow(Snow),
    Gradient(Gradient),
    Bumps(Bumps),
    Ripples(Ripples),
    Blend(Blend),
}

impl Texture {
    /// Whether it asks for the u and v of a spot.
    pub fn needs_uv(&self) -> bool {
        match self {
            Texture::Blend(_) => true,
            Texture::Checker(_)
            | Texture::Wood(_)
            | Texture::Marble(_)
            | Texture::Spotted(_)
            | Texture::Granite(_)
            | Texture::Clouds(_)
            | Texture::Snow(_)
            | Texture::Gradient(_)
            | Texture::Bumps(_)
            | Texture::Ripples(_) => false,
        }
    }

    /// The skin with this texture on it.
    pub fn apply(&self, skin: Skin, spot: &Spot) -> Skin {
        let Skin { color, normal } = skin;
        let painted = |color| Skin { color, normal };
        match self {
            Texture::Checker(checker) => painted(checker.color(color, spot)),
            Texture::Wood(wood) => painted(wood.color(color, spot)),
            Texture::Marble(marble) => painted(marble.color(color, spot)),
            Texture::Spotted(spotted) => painted(spotted.color(color, spot)),
            Texture::Granite(granite) => painted(granite.color(color, spot)),
            Texture::Clouds(clouds) => painted(clouds.color(color, spot)),
            Texture::Snow(snow) => painted(snow.color(color, normal, spot)),
            Texture::Gradient(gradient) => painted(gradient.color(color, spot)),
            Texture::Bumps(bumps) => bumps.apply(skin, spot),
            Texture::Ripples(ripples) => Skin { color, normal: ripples.normal(normal, spot) },
            Texture::Blend(blend) => painted(blend.color(color, spot)),
        }
    }
}
