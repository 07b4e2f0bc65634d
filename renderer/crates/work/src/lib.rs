//! The picture as work. A job is a scene and `Settings`, plain values that can be sent to another thread, process or
//! machine; its rows are shared out among threads, in passes if parts of it are wanted early, and watched from outside.

mod band;
mod pass;
mod schedule;
mod tile;
mod watch;

pub use band::Canvas;
pub use schedule::render;
pub use tile::Tile;
pub use watch::Watch;
