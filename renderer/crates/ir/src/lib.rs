//! Reads a compiled scene (docs/m3ir.md) into the kernel's own.
//!
//! A scene is its header, a JSON text, and its tables, whose numbers may lie anywhere. Nothing of it is trusted: a table
//! that is missing, of the wrong type, names rows that do not exist, or holds what is no finite number is refused, and
//! so is one that names rows of another more than once, and what does not fit in memory. So a damaged file can do no
//! more than that, and the kernel relies on it.

#![deny(missing_docs)]

mod air;
mod archive;
mod generated;
mod header;
mod ir;
mod lights;
mod options;
mod refusal;
mod scene;
mod shapes;
mod solids;
mod tables;
mod textures;

pub use air::air;
pub use archive::Archive;
pub use ir::Ir;
pub use options::options;
pub use refusal::{Refusal, Result};
pub use scene::scene;
pub use tables::{Column, Numbers, Tables};
