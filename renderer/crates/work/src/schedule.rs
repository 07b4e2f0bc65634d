//! The rows of a picture shared out among threads, in order from the top.

use std::sync::atomic::Ordering;
use std::sync::mpsc::Sender;
use std::sync::{Mutex, PoisonError};

use m3d_kernel::render::{Settings, Tally, Tracer};
use m3d_kernel::scene::Scene;
use m3d_kernel::supersampling::Filter;

use crate::band::{Canvas, bands};
use crate::pass::Pass;
use crate::tile::Tile;
use crate::watch::Watch;

/// Pixels of the first pass are so many columns and rows apart where tiles are wanted.
const COARSEST: usize = 4;

/// Renders a region on the threads of the calling pool. Where `tiles` are wanted it is done in passes over 1/16, 1/4 and
/// all of the pixels, without rendering any twice. What a pixel becomes does not depend on any of that. Stops early when
/// it is cancelled.
pub fn render(
    scene: &Scene,
    settings: &Settings,
    watch: &Watch,
    mut canvas: Canvas,
    tiles: Option<Sender<Tile>>,
) -> Tally {
    let filter = (settings.options.samples > 1).then(Filter::new);
    let coarsest = if tiles.is_some() { COARSEST } else { 1 };
    let mut total = Tally::default();
    let mut step = coarsest;
    loop {
        let pass = Pass { step, first: step == coarsest };
        let bands = Mutex::new(bands(&mut canvas, settings, coarsest).into_iter());
        let tallies = rayon::broadcast(|_| {
            let mut tracer = Tracer::new(scene, settings, filter.as_ref(), &watch.cancelled);
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
