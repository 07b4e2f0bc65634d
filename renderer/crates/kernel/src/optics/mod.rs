//! How the atmosphere bends an eye ray: layers of constant curvature, the curve through them, and where the curve
//! meets what a shape leaves in its plane. Thesis chapters 2 and 4.

pub mod arc;
pub mod atmosphere;
pub mod crossing;
pub mod path;
pub mod radial_plane;
mod sketch;
pub mod tip;
