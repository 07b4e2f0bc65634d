//! Tiles: parts of the picture as far as they are known.

use serde::{Deserialize, Serialize};

/// A part of the picture as far as it is known: pixels `step` apart, of rows from `top` on. Each stands for a square
/// of `step` pixels a side, of which it is the upper left.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Tile {
    /// First row, counted from that of the region.
    pub top: usize,
    /// Pixels from one known pixel to the next, across and down.
    pub step: usize,
    /// Known pixels in a row.
    pub columns: usize,
    /// Three numbers a known pixel, row after row.
    pub pixels: Vec<f32>,
}
