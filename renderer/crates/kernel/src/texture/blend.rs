//! UBLEND and VBLEND: a colour that changes along the u or v of a sphere, triangle, facet or rectangle.
//! Thesis 7.5.5.4.
//!
//! With COLORS, u or v picks from the ranges. Without, hue, saturation and value run from the surface's colour to
//! the texture's, each linearly and the hue without passing 360 degrees: from red to blue it goes by yellow and
//! green. A plane has no u and v and keeps its colour.

use glam::DVec3;

use super::spot::Spot;
use super::tint::Tint;
use crate::within::within;

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Along {
    U,
    V,
}

#[derive(Clone, Debug)]
pub struct Blend {
    pub along: Along,
    pub tint: Tint,
}

impl Blend {
    pub fn color(&self, surface: DVec3, spot: &Spot) -> DVec3 {
        let Some((u, v)) = spot.uv else {
            return surface;
        };
        let t = if self.along == Along::U { u } else { v };
        if self.tint.ranges.is_empty() {
            rgb(hsv(surface).lerp(hsv(self.tint.color), t))
        } else {
            self.tint.over(surface, t)
        }
    }
}

/// Hue in degrees, 0 for a grey; saturation and value. Smith's hexcone (1978).
fn hsv(color: DVec3) -> DVec3 {
    let (value, low) = (color.max_element(), color.min_element());
    let chroma = value - low;
    if chroma <= 0.0 {
        return DVec3::new(0.0, 0.0, value);
    }
    let sixth = if value == color.x {
        ((color.y - color.z) / chroma).rem_euclid(6.0)
    } else if value == color.y {
        (color.z - color.x) / chroma + 2.0
    } else {
        (color.x - color.y) / chroma + 4.0
    };
    DVec3::new(60.0 * sixth, chroma / value, value)
}

fn rgb(hsv: DVec3) -> DVec3 {
    let channel = |shift: f64| {
        let k = (shift + hsv.x / 60.0).rem_euclid(6.0);
        hsv.z - hsv.z * hsv.y * within(k.min(4.0 - k), 0.0, 1.0)
    };
    DVec3::new(channel(5.0), channel(3.0), channel(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::tint::plain;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn hsv_and_back(r in 0.0..=1.0f64, g in 0.0..=1.0f64, b in 0.0..=1.0f64) {
            let color = DVec3::new(r, g, b);
            prop_assert!((rgb(hsv(color)) - color).abs().max_element() < 1e-12);
        }
    }

    #[test]
    fn red_to_blue_goes_by_yellow_and_green() {
        let blend = Blend { along: Along::U, tint: plain(DVec3::Z) };
        let at = |u| blend.color(DVec3::X, &Spot { uv: Some((u, 0.0)), ..Spot::at(0.0, 0.0, 0.0) });
        assert!((at(0.25) - DVec3::new(1.0, 1.0, 0.0)).abs().max_element() < 1e-12);
        assert!((at(0.5) - DVec3::Y).abs().max_element() < 1e-12);
    }
}
