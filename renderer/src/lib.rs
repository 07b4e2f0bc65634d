//! The kernel of the Mirage3D renderer: a ray tracer whose eye rays may be bent by the atmosphere.
//!
//! `scene` is what is rendered, `schedule` makes the picture and `render` a pixel of it, `trace` finds what a ray
//! meets, `optics` bends rays, `python` is the way in.

pub mod bvh;
pub mod camera;
pub mod film;
pub mod layer;
pub mod noise;
pub mod optics;
pub mod python;
pub mod random;
pub mod ray;
pub mod render;
pub mod scene;
pub mod schedule;
pub mod shade;
pub mod shape;
pub mod supersampling;
pub mod texture;
pub mod trace;
pub mod within;
