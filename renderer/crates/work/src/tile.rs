//! Tiles: parts of the picture as far as they are known.

/// A part of the picture as far as it is known: pixels `step` apart, of rows from `top` on. Each stands for a square
/// of `step` pixels a side, of which it is the upper left.
#[derive(Clone, Debug)]
pub struct Tile {
    pub top: usize,
    pub step: usize,
    pub columns: usize,
    pub pixels: Vec<f32>,
}
