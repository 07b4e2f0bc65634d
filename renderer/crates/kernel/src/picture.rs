//! The whole picture by the calling thread alone, for where there are no others.

use std::sync::atomic::AtomicBool;

use crate::render::{Settings, Tracer};
use crate::scene::Scene;
use crate::supersampling::Filter;

/// The pixels of the region, three numbers each, row after row from the top left.
pub fn picture(scene: &Scene, settings: &Settings) -> Vec<f32> {
    let filter = (settings.options.samples > 1).then(Filter::new);
    let film = settings.film();
    let never = AtomicBool::new(false);
    let mut tracer = Tracer::new(scene, settings, filter.as_ref(), &never);
    let mut outputs = vec![0.0; settings.channels()];
    let mut pixels = Vec::with_capacity(3 * settings.columns * settings.rows);
    for row in settings.top..settings.top + settings.rows {
        for column in settings.left..settings.left + settings.columns {
            pixels.extend(film.expose(tracer.pixel(column, row, &mut outputs)));
        }
    }
    film.develop(&mut pixels);
    pixels
}
