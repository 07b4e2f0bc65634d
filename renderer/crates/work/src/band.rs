//! Bands: a few rows of the picture each, the piece of work that a thread takes.

use std::sync::atomic::Ordering;

use m3d_kernel::render::{Settings, Tracer};

use crate::pass::Pass;
use crate::tile::Tile;
use crate::watch::Watch;

/// Where what is rendered goes, row after row: three numbers a pixel, and those of the extra outputs.
#[derive(Debug)]
pub struct Canvas<'a> {
    /// Three numbers a pixel.
    pub pixels: &'a mut [f32],
    /// As many numbers a pixel as `Settings::channels` says.
    pub outputs: &'a mut [f32],
}

/// A few rows of the picture.
pub(crate) struct Band<'a> {
    first_row: usize,
    rows: Vec<Canvas<'a>>,
}

pub(crate) fn bands<'a>(canvas: &'a mut Canvas, settings: &Settings, height: usize) -> Vec<Band<'a>> {
    let mut outputs = &mut *canvas.outputs;
    let mut bands: Vec<Band> = Vec::with_capacity(settings.rows.div_ceil(height));
    for (row, pixels) in canvas.pixels.chunks_exact_mut(3 * settings.columns).enumerate() {
        let (own, rest) = outputs.split_at_mut(settings.columns * settings.channels());
        outputs = rest;
        if row % height == 0 {
            bands.push(Band { first_row: row, rows: Vec::with_capacity(height) });
        }
        if let Some(band) = bands.last_mut() {
            band.rows.push(Canvas { pixels, outputs: own });
        }
    }
    bands
}

impl Band<'_> {
    /// Renders the band's part of a pass; false if it was cancelled.
    pub fn render(&mut self, pass: Pass, tracer: &mut Tracer, settings: &Settings, watch: &Watch) -> bool {
        let (channels, film) = (settings.channels(), settings.film());
        for (i, canvas) in self.rows.iter_mut().enumerate() {
            let row = self.first_row + i;
            if !row.is_multiple_of(pass.step) {
                continue;
            }
            let mut done = 0;
            for (column, pixel) in canvas.pixels.chunks_exact_mut(3).enumerate() {
                if !pass.has(column, row) {
                    continue;
                }
                let outputs = &mut canvas.outputs[column * channels..(column + 1) * channels];
                let color = tracer.pixel(settings.left + column, settings.top + row, outputs);
                if watch.cancelled.load(Ordering::Relaxed) {
                    return false;
                }
                pixel.copy_from_slice(&film.expose(color));
                done += 1;
            }
            watch.pixels_done.fetch_add(done, Ordering::Relaxed);
            if pass.step == 1 {
                watch.finished[row].store(true, Ordering::Release);
            }
        }
        true
    }

    /// The pixels of the band that are known after a pass.
    pub fn tile(&self, step: usize) -> Tile {
        let mut pixels = Vec::new();
        let mut columns = 0;
        for canvas in self.rows.iter().step_by(step) {
            let known = canvas.pixels.chunks_exact(3).step_by(step);
            columns = known.len();
            pixels.extend(known.flatten());
        }
        Tile { top: self.first_row, step, columns, pixels }
    }
}
