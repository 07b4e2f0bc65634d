//! Several rays a pixel: where they go, and how they count.
//!
//! The picture is what a Blackman-Harris filter, three pixels wide, makes of the scene. Each pixel draws its own
//! samples from the filter's weights (importance sampling of the filter: Ernst, Stamminger and Greiner 2006), so
//! that all count alike and no pixel needs its neighbours: a region is the same as that part of the whole.

use crate::random::Branch;

/// Half the filter's width, in pixels.
const REACH: f64 = 1.5;

/// Steps of the table of offsets.
const STEPS: usize = 1024;

/// Harris 1978, the window with four terms.
const TERMS: [f64; 4] = [0.35875, 0.48829, 0.14128, 0.01168];

/// The filter: offsets from a pixel's middle by the share of the filter's weight that lies below them.
#[derive(Clone, Debug)]
pub struct Filter {
    offsets: Vec<f64>,
}

impl Filter {
    pub fn new() -> Self {
        let offset = |share: f64| {
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if below(middle) < share { low = middle } else { high = middle }
            }
            REACH * (low + high - 1.0)
        };
        Self { offsets: (0..=STEPS).map(|i| offset(i as f64 / STEPS as f64)).collect() }
    }

    /// Where the samples of a pixel go, as offsets from its middle.
    pub fn samples(&self, x: usize, y: usize, count: usize) -> impl Iterator<Item = [f64; 2]> {
        // Apart from the branches of all rays: those have numbers of samples.
        let mut numbers = Branch::of_sample(x, y, u32::MAX as usize).numbers();
        let (across, down) = (numbers.unit(), numbers.unit());
        (0..count).map(move |i| {
            let [u, v] = hammersley(i, count);
            [self.offset((u + across).fract()), self.offset((v + down).fract())]
        })
    }

    fn offset(&self, share: f64) -> f64 {
        let step = share * STEPS as f64;
        let i = (step as usize).min(STEPS - 1);
        let (low, high) = (self.offsets[i], self.offsets[i + 1]);
        low + (high - low) * (step - i as f64)
    }
}

impl Default for Filter {
    fn default() -> Self {
        Self::new()
    }
}

/// Share of the filter's weight below t, 0..1 over its width.
fn below(t: f64) -> f64 {
    let wave = |k: f64| (std::f64::consts::TAU * k * t).sin() / (std::f64::consts::TAU * k);
    let [a, b, c, d] = TERMS;
    (a * t - b * wave(1.0) + c * wave(2.0) - d * wave(3.0)) / a
}

/// Point i of n in the unit square: one in each of n columns, and spread over the rows by the bits of i in reverse.
/// Strata of any shape hold their share. A shift about the torus, one a pixel (Cranley and Patterson 1976), keeps that.
fn hammersley(i: usize, n: usize) -> [f64; 2] {
    [(i as f64 + 0.5) / n as f64, (f64::from((i as u32).reverse_bits()) + 0.5) * 2f64.powi(-32)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_quarter_of_the_square_has_its_share() {
        for n in [4usize, 16, 64] {
            let side = n.isqrt() as f64;
            let mut cells: Vec<_> = (0..n).map(|i| hammersley(i, n).map(|x| (x * side) as usize)).collect();
            cells.sort();
            cells.dedup();
            assert_eq!(cells.len(), n);
        }
    }

    #[test]
    fn samples_have_the_filters_moments() {
        let filter = Filter::new();
        let samples: Vec<_> = filter.samples(4, 9, 4096).collect();
        let moment = |power| samples.iter().map(|[x, _]| x.powi(power)).sum::<f64>() / 4096.0;
        // The window's variance over a width of 1: 1/12 + Σ (-1)^k a_k / (2 π² k² a_0).
        let [a, b, c, d] = TERMS;
        let variance = 1.0 / 12.0 + (-b + c / 4.0 - d / 9.0) / (2.0 * std::f64::consts::PI.powi(2) * a);
        assert!(moment(1).abs() < 1e-3);
        assert!((moment(2) - (2.0 * REACH).powi(2) * variance).abs() < 1e-3, "{} {variance}", moment(2));
        assert!(samples.iter().flatten().all(|x| x.abs() <= REACH));
    }
}
