//! The picture as work: its rows, shared out among threads in order from the top, and watched from outside.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::Sender;
use std::sync::{Mutex, PoisonError};

use crate::optics::atmosphere::Atmosphere;
use crate::render::{Settings, Tally, Tracer};
use crate::scene::Scene;
use crate::supersampling::Filter;

/// Where what is rendered goes, row after row: three numbers a pixel, and those of the extra layers.
#[derive(Debug)]
pub struct Canvas<'a> {
    pub pixels: &'a mut [f32],
    pub layers: &'a mut [f32],
}

/// The state of a rendering that others may watch and stop.
#[derive(Debug)]
pub struct Watch {
    pub pixels_done: AtomicUsize,
    pub cancelled: AtomicBool,
    finished: Vec<AtomicBool>,
}

impl Watch {
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

/// A part of the picture as far as it is known: pixels `step` apart, of rows from `top` on. Each stands for a square
/// of `step` pixels a side, of which it is the upper left.
#[derive(Clone, Debug)]
pub struct Tile {
    pub top: usize,
    pub step: usize,
    pub columns: usize,
    pub pixels: Vec<f32>,
}

/// Pixels of the first pass are so many columns and rows apart where tiles are wanted.
const COARSEST: usize = 4;

/// Renders a region. Where `tiles` are wanted it is done in passes over 1/16, 1/4 and all of the pixels, without
/// rendering any twice. What a pixel becomes does not depend on any of that. Stops early when it is cancelled.
pub fn render(
    scene: &Scene,
    air: Option<&Atmosphere>,
    settings: &Settings,
    watch: &Watch,
    mut canvas: Canvas,
    tiles: Option<Sender<Tile>>,
) -> Tally {
    let filter = (settings.samples > 1).then(Filter::new);
    let coarsest = if tiles.is_some() { COARSEST } else { 1 };
    let mut total = Tally::default();
    let mut step = coarsest;
    loop {
        let pass = Pass { step, first: step == coarsest };
        let bands = Mutex::new(bands(&mut canvas, settings, coarsest).into_iter());
        let tallies = rayon::broadcast(|_| {
            let mut tracer = Tracer::new(scene, air, settings, filter.as_ref(), &watch.cancelled);
            let tiles = tiles.clone();
            loop {
                let next = bands.lock().unwrap_or_else(PoisonError::into_inner).next();
                let Some(mut band) = next else { break };
                if !band.render(pass, &mut tracer, settings, watch) {
                    break;
                }
                if let Some(tiles) = &tiles {
                    // Nobody listens any more: then nobody misses it.
                    let _ = tiles.send(band.tile(pass.step));
                }
            }
            tracer.tally
        });
        total = tallies.into_iter().fold(total, Tally::plus);
        if step == 1 || watch.cancelled.load(Ordering::Relaxed) {
            return total;
        }
        step /= 2;
    }
}

/// Which pixels are rendered in one go: those whose column and row are multiples of `step`, but for those that are
/// multiples of twice that, if there was a pass before.
#[derive(Clone, Copy)]
struct Pass {
    step: usize,
    first: bool,
}

impl Pass {
    fn has(self, column: usize, row: usize) -> bool {
        let all = |step: usize| column.is_multiple_of(step) && row.is_multiple_of(step);
        all(self.step) && (self.first || !all(2 * self.step))
    }
}

/// A few rows of the picture.
struct Band<'a> {
    first_row: usize,
    rows: Vec<Canvas<'a>>,
}

fn bands<'a>(canvas: &'a mut Canvas, settings: &Settings, height: usize) -> Vec<Band<'a>> {
    let mut layers = &mut *canvas.layers;
    let mut bands: Vec<Band> = Vec::with_capacity(settings.rows.div_ceil(height));
    for (row, pixels) in canvas.pixels.chunks_exact_mut(3 * settings.columns).enumerate() {
        let (own, rest) = layers.split_at_mut(settings.columns * settings.channels());
        layers = rest;
        if row % height == 0 {
            bands.push(Band { first_row: row, rows: Vec::with_capacity(height) });
        }
        if let Some(band) = bands.last_mut() {
            band.rows.push(Canvas { pixels, layers: own });
        }
    }
    bands
}

impl Band<'_> {
    /// Renders the band's part of a pass; false if it was cancelled.
    fn render(&mut self, pass: Pass, tracer: &mut Tracer, settings: &Settings, watch: &Watch) -> bool {
        let channels = settings.channels();
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
                let layers = &mut canvas.layers[column * channels..(column + 1) * channels];
                let color = tracer.pixel(settings.left + column, settings.top + row, layers);
                if watch.cancelled.load(Ordering::Relaxed) {
                    return false;
                }
                pixel.copy_from_slice(&settings.film.expose(color));
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
    fn tile(&self, step: usize) -> Tile {
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
