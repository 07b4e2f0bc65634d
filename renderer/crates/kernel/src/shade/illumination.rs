//! The illumination of a surface by its lights: eq. 3.9 without its last term, which the tracing of mirror rays
//! adds. Thesis 3.4.

use glam::DVec3;

use super::highlight::Gloss;

/// Reflectances of a solid.
#[derive(Clone, Debug)]
pub struct Surface {
    pub color: DVec3,
    pub ambient: f64,
    pub diffuse: f64,
    pub specular: f64,
    pub hard: f64,
    /// How far the normal deviates at random, 0..1.
    pub fuzz: f64,
    pub gloss: Gloss,
}

impl Surface {
    /// I_amb = I_a k_a O_d, `color` being the diffuse one after texturing.
    pub fn ambient(&self, light: DVec3, color: DVec3) -> DVec3 {
        light * self.ambient * color
    }

    /// k_h k_s, the share of the light from the mirror direction.
    pub fn mirrors(&self) -> f64 {
        self.hard * self.specular
    }
}

/// Where a light stands.
#[derive(Clone, Copy, Debug)]
pub enum Source {
    Infinite,
    Point {
        position: DVec3,
        attenuation: f64,
        exponent: f64,
        /// Cosine of the half-angle of the cone it shines into; below -1 all around.
        cone: f64,
    },
}

#[derive(Clone, Copy, Debug)]
pub struct Light {
    pub source: Source,
    pub color: DVec3,
    pub intensity: f64,
    /// L_d, where it shines to.
    pub direction: DVec3,
    pub shadows: bool,
    pub highlights: bool,
}

/// A light as one point of a surface has it.
#[derive(Clone, Copy, Debug)]
pub struct Incident {
    /// L, unit vector toward the light.
    pub toward: DVec3,
    pub distance: f64,
    /// I_j.
    pub color: DVec3,
}

impl Light {
    /// I_j = I_p (L_d . -L)^ρ / (1 + d)^α of a point light; None outside of its cone, or behind one that has an
    /// exponent.
    pub fn at(&self, point: DVec3) -> Option<Incident> {
        let full = self.color * self.intensity;
        match self.source {
            Source::Infinite => {
                Some(Incident { toward: -self.direction, distance: f64::INFINITY, color: full })
            }
            Source::Point { position, attenuation, exponent, cone } => {
                let to_light = position - point;
                let distance = to_light.length();
                let toward = to_light / distance;
                let axis = -self.direction.dot(toward);
                if axis.is_nan() || axis < cone || (exponent > 0.0 && axis <= 0.0) {
                    return None;
                }
                // Rounding may take the cosine beyond 1, of which a large exponent makes more than the light has.
                let beam = if exponent > 0.0 { axis.min(1.0).powf(exponent) } else { 1.0 };
                let loss = if attenuation == 0.0 { 1.0 } else { (1.0 + distance).powf(attenuation) };
                Some(Incident { toward, distance, color: full * (beam / loss) })
            }
        }
    }
}

/// A point of a surface about to be lit. `diffuse` is the colour after texturing.
#[derive(Clone, Copy, Debug)]
pub struct LitPoint<'a> {
    pub surface: &'a Surface,
    pub diffuse: DVec3,
    pub normal: DVec3,
    /// V, unit vector toward the viewer.
    pub toward_viewer: DVec3,
}

impl LitPoint<'_> {
    /// I_amb, as of the surface.
    pub fn ambient(&self, light: DVec3) -> DVec3 {
        self.surface.ambient(light, self.diffuse)
    }

    /// What a share of light from all around, each direction weighted by N.D, makes of the surface: k_d O_d of it.
    pub fn scattered(&self, light: DVec3) -> DVec3 {
        light * self.surface.diffuse * self.diffuse
    }

    /// One light's term, I_j (N.L)(k_d O_d + k_s O_s), for a light that is in sight.
    pub fn lit_by(&self, light: &Light, incident: &Incident) -> DVec3 {
        let cosine = self.normal.dot(incident.toward);
        let mut reflected = cosine * self.surface.diffuse * self.diffuse;
        if light.highlights && self.surface.specular > 0.0 {
            reflected += self.surface.specular
                * self.surface.gloss.reflects(
                    self.normal,
                    self.toward_viewer,
                    incident.toward,
                    self.diffuse,
                    light.color,
                );
        }
        incident.color * reflected
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn light(attenuation: f64, exponent: f64, angle: f64) -> Light {
        let cone = if angle >= 180.0 { -2.0 } else { f64::to_radians(angle).cos() };
        Light {
            source: Source::Point { position: DVec3::ZERO, attenuation, exponent, cone },
            color: DVec3::ONE,
            intensity: 2.0,
            direction: DVec3::X,
            shadows: true,
            highlights: true,
        }
    }

    #[test]
    fn a_point_light_fades_with_distance_and_angle() {
        let at = |light: Light, x, y| light.at(DVec3::new(x, y, 0.0)).map(|incident| incident.color.x);
        assert_eq!(at(light(0.0, 0.0, 180.0), -3.0, 0.0), Some(2.0));
        assert_eq!(at(light(1.0, 0.0, 180.0), 3.0, 0.0), Some(0.5));
        assert_eq!(at(light(2.0, 0.0, 180.0), 1.0, 0.0), Some(0.5));
        assert_eq!(at(light(0.0, 0.0, 30.0), 1.0, 1.0), None);
        assert_eq!(at(light(0.0, 1.0, 180.0), 0.0, 1.0), None);
        assert!((at(light(0.0, 2.0, 180.0), 1.0, 1.0).unwrap() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_narrow_beam_is_nowhere_brighter_than_the_light() {
        for i in 0..2000 {
            let angle = 0.37 * f64::from(i);
            let direction = DVec3::new(angle.cos(), angle.sin(), (1.7 * angle).cos()).normalize();
            let light = Light { direction, ..light(0.0, 1e15, 180.0) };
            let lit = light.at(3.0 * direction).unwrap();
            assert!(lit.color.max_element() <= light.intensity, "{:?}", lit.color);
        }
    }
}
