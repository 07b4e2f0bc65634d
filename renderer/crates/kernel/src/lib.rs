//! The kernel of the Mirage3D renderer: a ray tracer whose eye rays may be bent by the atmosphere.
//!
//! `scene` is what is rendered, `render` makes a pixel of it, `trace` finds what a ray meets, `optics` bends rays. It
//! starts no thread and reads no file: who calls it shares out the pixels, and says where scenes come from.

pub mod bvh;
pub mod camera;
pub mod film;
pub mod noise;
pub mod optics;
pub mod options;
pub mod output;
pub mod picture;
pub mod random;
pub mod ray;
pub mod render;
pub mod scene;
pub mod shade;
pub mod shape;
pub mod shapes;
pub mod sight;
pub mod supersampling;
pub mod texture;
pub mod trace;
pub mod within;
