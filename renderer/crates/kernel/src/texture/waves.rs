//! WAVES: like RIPPLES, but the higher a wave's frequency, the lower it is. Thesis 7.5.5.4.
//!
//! A wave's height is AMPLITUDE / FREQ. With sources of many frequencies this is a natural sea: Perlin (1985)
//! gives each wave a height of one over its frequency.

use super::placement::Placement;
use super::ripples::Ripples;
use super::wave::Wave;

/// The ripples that the waves are. A source without a frequency makes none.
pub fn lowered_by_frequency(placement: Placement, sources: &[Wave]) -> Ripples {
    let lowered = |wave: &Wave| Wave { amplitude: wave.amplitude / wave.freq.abs(), ..*wave };
    Ripples { placement, waves: sources.iter().filter(|wave| wave.freq != 0.0).map(lowered).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat4, DVec3};

    #[test]
    fn the_height_is_divided_by_the_frequency() {
        let wave = |freq| Wave { center: DVec3::ZERO, amplitude: 0.6, freq, phase: 0.0, damp: 0.0 };
        let made = lowered_by_frequency(Placement::new(DMat4::IDENTITY), &[wave(3.0), wave(0.0), wave(0.5)]);
        let heights: Vec<f64> = made.waves.iter().map(|wave| wave.amplitude).collect();
        assert_eq!(heights, [0.6 / 3.0, 1.2]);
    }
}
