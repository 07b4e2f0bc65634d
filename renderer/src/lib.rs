//! The kernel of the Mirage3D renderer: a ray tracer whose eye rays may be bent by the atmosphere.
//!
//! `scene` is what is rendered, `render` makes the picture, `trace` finds what a ray meets, `optics` bends rays,
//! `python` is the way in.

pub mod bvh;
pub mod camera;
pub mod film;
pub mod optics;
pub mod python;
pub mod ray;
pub mod render;
pub mod scene;
pub mod shade;
pub mod shape;
pub mod texture;
pub mod trace;
