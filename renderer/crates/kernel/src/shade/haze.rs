//! HAZE: colours fade into the haze's colour with the distance light has gone. Thesis 7.5.5.1.

use glam::DVec3;

#[derive(Clone, Copy, Debug)]
pub struct Haze {
    /// Colour times intensity.
    pub color: DVec3,
    /// ρ of I = I₀ e^(-ρx); none at or below 0.
    pub density: f64,
}

impl Haze {
    /// Share of the light that is left after a distance: e^(-ρx).
    pub fn transmits(&self, distance: f64) -> f64 {
        if self.density > 0.0 { (-self.density * distance).exp() } else { 1.0 }
    }

    /// The colour of a point of the sky at this distance behind the haze, thinner toward the zenith: the blend is
    /// (1 - e^(-ρd)) (1 - sin e), e the elevation of the point.
    pub fn over_sky(&self, sky: DVec3, distance: f64, sine_of_elevation: f64) -> DVec3 {
        if self.density > 0.0 {
            let blend = (1.0 - self.transmits(distance)) * (1.0 - sine_of_elevation);
            sky.lerp(self.color, blend)
        } else {
            sky
        }
    }
}
