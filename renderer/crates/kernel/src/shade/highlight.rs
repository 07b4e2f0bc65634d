//! Specular highlights: O_s of eq. 3.9. Thesis 3.4 (7), after Cook and Torrance (1982).
//!
//! Microfacets turned as Beckmann's distribution says; Fresnel's equation for unpolarised light shifts the colour
//! of a metal toward the light's at grazing angles.

use crate::within::within;
use glam::DVec3;

/// What a surface's highlights depend on.
#[derive(Clone, Copy, Debug)]
pub struct Gloss {
    pub refindex: f64,
    /// r; below 1e-6 there is no highlight.
    pub rough: f64,
    pub metallic: f64,
    /// F at normal incidence.
    pub fresnel: f64,
    /// Largest value of Beckmann's term, by which it is divided.
    pub beckmann: f64,
}

impl Gloss {
    /// (N.L) O_s = O_sF D' G / (N.V), with all cosines positive. `diffuse` is the surface's colour, `light` the
    /// light's.
    pub fn reflects(&self, n: DVec3, v: DVec3, l: DVec3, diffuse: DVec3, light: DVec3) -> DVec3 {
        let h = (v + l).normalize_or_zero();
        let (nh, nv, nl, vh) = (n.dot(h), n.dot(v), n.dot(l), v.dot(h));
        if self.rough < 1e-6 || nh <= 0.0 || nv <= 0.0 || vh <= 0.0 {
            return DVec3::ZERO;
        }
        // G / (N.V), each of the three values divided by itself: no 0/0 at the rim of a shape.
        let shadowed = (1.0 / nv).min(2.0 * nh / vh).min(2.0 * nh * nl / (vh * nv));
        self.color(vh, diffuse, light) * (self.facets(nh) * shadowed)
    }

    /// D' = e^(-tan²β/r²) / (r² cos⁴β), divided by its largest value: 0..1.
    fn facets(&self, nh: f64) -> f64 {
        let cos2 = (nh * nh).min(1.0);
        let r2 = self.rough * self.rough;
        let tan2 = (1.0 - cos2) / cos2;
        within((-tan2 / r2).exp() / (r2 * cos2 * cos2) / self.beckmann, 0.0, 1.0)
    }

    /// O_sF = O_d' + m (I_j - O_d') max(0, (F_γ - F_0)/(1 - F_0)), O_d' from white toward O_d by m.
    fn color(&self, vh: f64, diffuse: DVec3, light: DVec3) -> DVec3 {
        let base = DVec3::ONE.lerp(diffuse, self.metallic);
        let shift = (fresnel(self.refindex, vh) - self.fresnel) / (1.0 - self.fresnel);
        base + self.metallic * within(shift, 0.0, 1.0) * (light - base)
    }
}

/// Fresnel's reflectance of unpolarised light, by Cook and Torrance: c = V.H, g² = n² + c² - 1,
/// F = ½ ((g-c)/(g+c))² (1 + ((c(g+c)-1)/(c(g-c)+1))²).
fn fresnel(n: f64, c: f64) -> f64 {
    let g = (n * n + c * c - 1.0).max(0.0).sqrt();
    let (difference, sum) = (g - c, g + c);
    let ratio = (c * sum - 1.0) / (c * difference + 1.0);
    0.5 * (difference / sum).powi(2) * (1.0 + ratio * ratio)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fresnel_at_normal_and_grazing_incidence() {
        assert!((fresnel(1.4, 1.0) - (0.4f64 / 2.4).powi(2)).abs() < 1e-12);
        assert!((fresnel(1.4, 1e-9) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn the_facet_term_reaches_one_and_never_passes_it() {
        for rough in [0.05f64, 0.2, 0.5, 0.7, 0.8, 1.0] {
            let r2 = rough * rough;
            let beckmann =
                if r2 <= 0.5 { 1.0 / r2 } else { (2.0 * r2).powi(2) * (-(2.0 * r2 - 1.0) / r2).exp() / r2 };
            let gloss = Gloss { refindex: 1.4, rough, metallic: 0.0, fresnel: 0.0, beckmann };
            let largest = (1..=10_000).map(|i| gloss.facets(f64::from(i) / 1e4)).fold(0.0, f64::max);
            assert!((largest - 1.0).abs() < 1e-6, "{rough}: {largest}");
        }
    }
}
