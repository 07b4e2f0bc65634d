//! Made by `make generate` from compiler/m3dc/ir/tables.py: the kinds of rows, and what a scene says once.

use serde::Deserialize;

/// Version of the .m3ir format.
pub const VERSION: u64 = 2;

/// What a row of `primitives` is, and so which table its `row` points into.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PrimitiveKind {
    Sphere,
    Plane,
    Triangle,
    Rectangle,
    Polygons,
    Terrain,
}

impl PrimitiveKind {
    /// The kind with this number in a table; None where there is none.
    pub fn numbered(number: i32) -> Option<Self> {
        match number {
            0 => Some(Self::Sphere),
            1 => Some(Self::Plane),
            2 => Some(Self::Triangle),
            3 => Some(Self::Rectangle),
            4 => Some(Self::Polygons),
            5 => Some(Self::Terrain),
            _ => None,
        }
    }
}

/// What a row of `textures` is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TextureKind {
    Checker,
    Wood,
    Marble,
    Spotted,
    Granite,
    Clouds,
    Snow,
    Gradient,
    Bumps,
    Waves,
    Ripples,
    Ublend,
    Vblend,
}

impl TextureKind {
    /// The kind with this number in a table; None where there is none.
    pub fn numbered(number: i32) -> Option<Self> {
        match number {
            0 => Some(Self::Checker),
            1 => Some(Self::Wood),
            2 => Some(Self::Marble),
            3 => Some(Self::Spotted),
            4 => Some(Self::Granite),
            5 => Some(Self::Clouds),
            6 => Some(Self::Snow),
            7 => Some(Self::Gradient),
            8 => Some(Self::Bumps),
            9 => Some(Self::Waves),
            10 => Some(Self::Ripples),
            11 => Some(Self::Ublend),
            12 => Some(Self::Vblend),
            _ => None,
        }
    }
}

/// Where a light shines from: a direction, or a point of the scene.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum LightKind {
    Infinite,
    Point,
}

impl LightKind {
    /// The kind with this number in a table; None where there is none.
    pub fn numbered(number: i32) -> Option<Self> {
        match number {
            0 => Some(Self::Infinite),
            1 => Some(Self::Point),
            _ => None,
        }
    }
}

/// Indirect light (thesis 7.5.5.1, AMBIENT).
#[derive(Clone, PartialEq, Debug, Deserialize)]
pub struct Ambient {
    pub intensity: f64,
    pub color: [f64; 3],
    pub samples: i64,
    pub depth: i64,
}

/// Attenuation with distance (HAZE).
#[derive(Clone, PartialEq, Debug, Deserialize)]
pub struct Haze {
    pub defined: bool,
    pub intensity: f64,
    pub color: [f64; 3],
    pub density: f64,
}

/// The CIE sky (SKY).
#[derive(Clone, PartialEq, Debug, Deserialize)]
pub struct Sky {
    pub radius: f64,
    pub intensity: f64,
    pub zenith_color: [f64; 3],
    pub horizon_color: [f64; 3],
    pub overcast: f64,
    pub sun: i64,
}

/// Where curved rays end (MIRAGE).
#[derive(Clone, PartialEq, Debug, Deserialize)]
pub struct Mirage {
    pub segments: i64,
    pub distance: f64,
    pub elevation: f64,
}

/// The pin-hole camera (VIEW; thesis 3.2).
#[derive(Clone, PartialEq, Debug, Deserialize)]
pub struct View {
    pub eye: [f64; 3],
    pub target: [f64; 3],
    pub fov: f64,
    pub tilt: f64,
    pub width: i64,
    pub height: i64,
    pub aspect: f64,
    pub top: i64,
    pub left: i64,
    pub bottom: i64,
    pub right_edge: i64,
    pub normal: [f64; 3],
    pub general_up: [f64; 3],
    pub right: [f64; 3],
    pub up: [f64; 3],
    pub reference_point: [f64; 3],
    pub distance: f64,
}

/// Corners of the box about all finite primitives of solids and lights, in world space; None without any.
#[derive(Clone, PartialEq, Debug, Deserialize)]
pub struct Extent {
    pub minimum: [f64; 3],
    pub maximum: [f64; 3],
}

/// What a scene says once.
#[derive(Clone, PartialEq, Debug, Deserialize)]
pub struct Globals {
    pub shadows: bool,
    pub log_scale: f64,
    pub depth: i64,
    pub background: [f64; 3],
    pub ambient: Ambient,
    pub haze: Haze,
    pub sky: Option<Sky>,
    pub mirage: Option<Mirage>,
    pub view: View,
    pub extent: Option<Extent>,
    pub refract_reflections: bool,
}
