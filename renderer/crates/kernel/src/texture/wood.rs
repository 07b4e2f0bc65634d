//! WOOD: the year rings of a trunk that stands on the xy plane. Thesis 7.5.5.4.
//!
//! Rings are concentric about the z axis, one a unit, and the grain runs along it. Within a ring the colour
//! goes slowly from the surface's (early wood) to the texture's (late wood) and back within the last sixth.
//! TURBULENCE bends the rings: the distance from the axis is r = sqrt(x² + y²) + TURBULENCE f(x, y, z/6) / 2,
//! f being noise summed over octaves (`fractal`), long along the grain as wood is. SQUEEZE leaves the late
//! wood the outer 1/(1 + SQUEEZE) of a ring. Peachey, "Solid Texturing of Complex Surfaces" (1985), cut wood
//! out of such rings.

use glam::DVec3;

use super::placement::Placement;
use super::spot::Spot;
use super::squeeze::Squeeze;
use super::tint::Tint;
use crate::noise::{cubic, fractal};

/// Where in a ring the late wood is darkest.
const DARKEST: f64 = 5.0 / 6.0;
/// How much longer the wood's unevenness is along the grain than across.
const GRAIN: f64 = 6.0;

#[derive(Clone, Debug)]
pub struct Wood {
    pub placement: Placement,
    pub tint: Tint,
    pub turbulence: f64,
    pub squeeze: Squeeze,
}

impl Wood {
    pub fn color(&self, surface: DVec3, spot: &Spot) -> DVec3 {
        self.tint.over(surface, self.value(self.placement.point(spot.point)))
    }

    fn value(&self, p: DVec3) -> f64 {
        let bend = self.turbulence * 0.5 * fractal(DVec3::new(p.x, p.y, p.z / GRAIN));
        let radius = p.x.hypot(p.y) + bend;
        let late = self.squeeze.apply(radius - radius.floor());
        if late <= DARKEST { cubic(late / DARKEST) } else { cubic((1.0 - late) / (1.0 - DARKEST)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::tint::plain;
    use glam::DMat4;

    fn wood(turbulence: f64, squeeze: f64) -> impl Fn(f64, f64, f64) -> f64 {
        let wood = Wood {
            placement: Placement::new(DMat4::IDENTITY),
            tint: plain(DVec3::ONE),
            turbulence,
            squeeze: Squeeze::new(squeeze),
        };
        move |x, y, z| wood.value(DVec3::new(x, y, z))
    }

    #[test]
    fn rings_are_about_z_and_a_unit_apart() {
        let t = wood(0.0, 0.0);
        assert_eq!(t(2.0, 0.0, 0.0), 0.0);
        assert!((t(2.0 + DARKEST, 0.0, 3.0) - 1.0).abs() < 1e-9);
        assert!((t(3.0, 4.0, 0.0) - t(0.0, 5.0, -7.0)).abs() < 1e-9);
        assert!((t(0.3, 0.0, 0.0) - t(1.3, 0.0, 0.0)).abs() < 1e-9);
    }

    #[test]
    fn squeeze_thins_the_rings() {
        let covered = |squeeze| {
            let t = wood(0.0, squeeze);
            (0..1000).filter(|i| t(f64::from(*i) / 1000.0, 0.0, 0.0) > 0.0).count()
        };
        assert!(covered(0.0) > 990);
        assert!((495..=505).contains(&covered(1.0)));
        assert!((245..=255).contains(&covered(3.0)));
    }

    #[test]
    fn turbulence_bends_the_rings_by_half_a_ring_at_most() {
        let (straight, bent) = (wood(0.0, 0.0), wood(1.0, 0.0));
        assert!((0..50).any(|i| {
            let (x, z) = (f64::from(i) * 0.37, f64::from(i) * 0.7);
            (straight(x, 0.5, z) - bent(x, 0.5, z)).abs() > 0.1
        }));
    }
}
