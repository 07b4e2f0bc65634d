//! The picture as work. A job is a scene, which every machine reads from its `.m3ir` file, and `Settings`, which can be
//! written down. Its rows are shared out among threads, in passes if tiles of it are wanted early, and watched from
//! outside. For other processes and machines `Settings::parts` makes jobs of it that nobody needs the others for: put
//! together, their pixels are those of the whole.

#![deny(missing_docs)]

mod band;
mod pass;
mod schedule;
mod tile;
mod watch;

pub use band::Canvas;
pub use schedule::render;
pub use tile::Tile;
pub use watch::Watch;
