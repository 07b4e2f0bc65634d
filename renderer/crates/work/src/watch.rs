//! How a rendering is watched and stopped.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// The state of a rendering that others may watch and stop.
#[derive(Debug)]
pub struct Watch {
    /// Pixels that have been rendered.
    pub pixels_done: AtomicUsize,
    /// Set by whoever wants no more.
    pub cancelled: AtomicBool,
    pub(crate) finished: Vec<AtomicBool>,
}

impl Watch {
    /// Of a rendering of so many rows, yet to begin.
    pub fn new(rows: usize) -> Self {
        Self {
            pixels_done: AtomicUsize::new(0),
            cancelled: AtomicBool::new(false),
            finished: (0..rows).map(|_| AtomicBool::new(false)).collect(),
        }
    }

    /// How many rows from the top are finished, one and all.
    pub fn finished_rows(&self) -> usize {
        self.finished.iter().take_while(|row| row.load(Ordering::Acquire)).count()
    }
}
