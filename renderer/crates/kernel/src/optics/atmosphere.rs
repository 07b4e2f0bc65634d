//! The layered atmosphere (thesis 2.1 and 2.2): between two points of the temperature profile the temperature is
//! linear and the curvature of a ray constant.
//!
//! Pressure is 101325 Pa at z = 0 and hydrostatic through the profile. Temperatures are given in degrees Celsius,
//! heights in metres.

/// ε of η = 1 + εβp/T (thesis eq. 2.2), the refractivity per unit of density.
const EPSILON: f64 = 226e-6;
/// β of ρ = βp/T, kg K/J: the molar mass of air over the gas constant.
const BETA: f64 = 3.48e-3;
/// g, m/s².
const GRAVITY: f64 = 9.80665;
/// Pressure at z = 0, Pa.
const SEA_LEVEL_PRESSURE: f64 = 101_325.0;
/// R, m.
pub const EARTH_RADIUS: f64 = 6_371_000.0;
/// 0 °C in K.
const CELSIUS: f64 = 273.15;

/// A curve has no more arcs than this, whatever MIRAGE says of SEGMENTS: it keeps its arcs.
pub const MOST_ARCS: usize = 1_000_000;
/// A curvature beyond this, 1/m, is nonsense, and may overflow.
const MOST_CURVATURE: f64 = 1e12;
/// There are no more layers than this.
const MOST_LAYERS: usize = 4_000_000;

/// One layer. Inside it a ray is the parabola z = `half_bend` r² + r tan φ + z₀ (thesis eq. 2.4), so that slope² grows
/// by 4 A_p for each metre of height. The gains are what it has grown by since the lowest layer's bottom: slope² less
/// the gain is the same all along a ray, through all layers.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Layer {
    pub bottom: f64,
    pub top: f64,
    /// A_p = -κ_eff / 2 (thesis eq. 4.1), 1/m.
    pub half_bend: f64,
    pub height: f64,
    pub gain_at_bottom: f64,
    pub gain_at_top: f64,
}

impl Layer {
    /// One upon another, each given by bottom, top and `half_bend`.
    pub fn stack(layers: impl IntoIterator<Item = (f64, f64, f64)>) -> Vec<Self> {
        let mut gain = 0.0;
        let layer = |(bottom, top, half_bend): (f64, f64, f64)| {
            let (height, gain_at_bottom) = (top - bottom, gain);
            gain += 4.0 * half_bend * height;
            Self { bottom, top, half_bend, height, gain_at_bottom, gain_at_top: gain }
        };
        layers.into_iter().map(layer).collect()
    }

    pub fn gain_at(&self, z: f64) -> f64 {
        self.gain_at_bottom + 4.0 * self.half_bend * (z - self.bottom)
    }
}

/// What MIRAGE says of the end of a curved ray.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    pub segments: usize,
    pub distance: f64,
    pub elevation: f64,
}

/// The layers from the profile's lowest elevation to the highest that curved rays reach.
#[derive(Clone, Debug)]
pub struct Atmosphere {
    pub layers: Vec<Layer>,
    /// Highest elevation of the profile, which may lie above the last layer.
    pub profile_top: f64,
    pub segments: usize,
    pub distance: f64,
}

/// Temperature at every height: linear between the points, constant beyond them.
struct Profile<'a> {
    /// (height in m, temperature in K), heights increasing.
    points: &'a [(f64, f64)],
}

impl Profile<'_> {
    fn temperature(&self, z: f64) -> f64 {
        let above = self.points.partition_point(|point| point.0 <= z);
        if above == 0 {
            return self.points[0].1;
        }
        let (z0, t0) = self.points[above - 1];
        match self.points.get(above) {
            Some(&(z1, t1)) => t0 + (t1 - t0) * ((z - z0) / (z1 - z0)),
            None => t0,
        }
    }

    /// Pressure at z, from sea level through every kink of the profile in between.
    fn pressure(&self, z: f64) -> f64 {
        let (low, high) = if z < 0.0 { (z, 0.0) } else { (0.0, z) };
        let mut log_ratio = 0.0;
        let mut from = low;
        let kinks = self.points.iter().map(|point| point.0);
        for to in kinks.filter(|&kink| low < kink && kink < high).chain([high]) {
            log_ratio += hydrostatic(self.temperature(from), self.temperature(to), to - from);
            from = to;
        }
        SEA_LEVEL_PRESSURE * if z < 0.0 { -log_ratio } else { log_ratio }.exp()
    }
}

/// ln(p₁/p₀) over a height in which temperature runs linearly from t0 to t1: (T₁/T₀)^(-βg/(dT/dz)), or the
/// exponential of an isothermal layer.
fn hydrostatic(t0: f64, t1: f64, height: f64) -> f64 {
    let rise = (t1 - t0) / t0;
    // ln(1 + x)/x, which is 1 at 0.
    let mean = if rise.abs() < 1e-12 { 1.0 } else { rise.ln_1p() / rise };
    -BETA * GRAVITY * height / t0 * mean
}

/// κ of a horizontal ray, 1/m, positive where it is concave toward the earth. Thesis eq. 2.3, with pressure for its
/// second ρ: κ = εβp (dT/dz + βg) / (ηT²).
fn ray_curvature(gradient: f64, pressure: f64, temperature: f64) -> f64 {
    let eta = 1.0 + EPSILON * BETA * pressure / temperature;
    EPSILON * BETA * pressure * (gradient + BETA * GRAVITY) / (eta * temperature * temperature)
}

impl Atmosphere {
    /// `elevations` in metres, increasing; `temperatures` in degrees Celsius. Each interval of the profile becomes
    /// `finer` layers of equal height.
    pub fn new(
        elevations: &[f64],
        temperatures: &[f64],
        limits: Limits,
        finer: usize,
    ) -> Result<Self, String> {
        let points: Vec<(f64, f64)> =
            elevations.iter().zip(temperatures).map(|(&z, &celsius)| (z, celsius + CELSIUS)).collect();
        if points.len() < 2 {
            return Err("the temperature profile has fewer than two points".into());
        }
        if let Some(&(z, t)) =
            points.iter().find(|point| !(point.0.is_finite() && point.1.is_finite() && point.1 > 0.0))
        {
            return Err(format!(
                "the temperature profile has {} °C at elevation {z}: a temperature must lie above -273.15 °C",
                t - CELSIUS
            ));
        }
        if points.windows(2).any(|pair| pair[0].0 >= pair[1].0) {
            return Err("the elevations of the temperature profile do not increase".into());
        }
        let profile = Profile { points: &points };
        let profile_top = points[points.len() - 1].0;
        let ceiling = limits.elevation.min(profile_top);
        let finer = finer.max(1);
        if (points.len() - 1).saturating_mul(finer) > MOST_LAYERS {
            return Err(format!(
                "{finer} layers an interval of the profile are more than {MOST_LAYERS} in all"
            ));
        }
        let mut layers = Vec::with_capacity((points.len() - 1) * finer);
        for pair in points.windows(2) {
            let [(z0, t0), (z1, t1)] = [pair[0], pair[1]];
            let gradient = (t1 - t0) / (z1 - z0);
            let height = |i: usize| if i == finer { z1 } else { z0 + (z1 - z0) * (i as f64 / finer as f64) };
            for i in 0..finer {
                let (bottom, top) = (height(i), height(i + 1));
                if bottom >= ceiling || bottom >= top {
                    continue;
                }
                let middle = 0.5 * (bottom + top);
                let bend = ray_curvature(gradient, profile.pressure(middle), profile.temperature(middle))
                    - 1.0 / EARTH_RADIUS;
                if bend.is_nan() || bend.abs() > MOST_CURVATURE {
                    return Err(format!("the atmosphere at elevation {middle} has no finite curvature"));
                }
                layers.push((bottom, top.min(ceiling), -0.5 * bend));
            }
        }
        Ok(Self {
            layers: Layer::stack(layers),
            profile_top,
            segments: limits.segments.min(MOST_ARCS),
            distance: limits.distance,
        })
    }

    /// Lowest elevation of the layers.
    pub fn bottom(&self) -> f64 {
        self.layers.first().map_or(self.profile_top, |layer| layer.bottom)
    }

    /// Whether an observer at this height stands in the profile, which the tracing of curved rays requires.
    pub fn holds(&self, z: f64) -> bool {
        self.bottom() <= z && z <= self.profile_top
    }
}

#[cfg(test)]
impl Atmosphere {
    /// A layer for each `half_bend`, one metre high, from 0 upward.
    pub fn of_bends(bends: &[f64], segments: usize, distance: f64) -> Self {
        let layers =
            Layer::stack(bends.iter().enumerate().map(|(i, &bend)| (i as f64, i as f64 + 1.0, bend)));
        let profile_top = layers.len() as f64;
        Self { layers, profile_top, segments, distance }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: Limits = Limits { segments: 500, distance: 25_000.0, elevation: 500.0 };

    #[test]
    fn an_isothermal_layer_has_exponential_pressure() {
        let profile = Profile { points: &[(0.0, 288.15), (1000.0, 288.15)] };
        let expected = 101_325.0 * (-BETA * GRAVITY * 700.0 / 288.15).exp();
        assert!((profile.pressure(700.0) - expected).abs() < 1e-6);
        assert!((profile.pressure(0.0) - 101_325.0).abs() < 1e-9);
        assert!(profile.pressure(-100.0) > 101_325.0);
    }

    #[test]
    fn pressure_does_not_depend_on_where_a_linear_profile_is_divided() {
        let whole = Profile { points: &[(0.0, 290.0), (100.0, 280.0)] };
        let halves = Profile { points: &[(0.0, 290.0), (37.0, 286.3), (100.0, 280.0)] };
        for z in [1.0, 36.0, 37.0, 55.0, 100.0, 130.0] {
            assert!((whole.pressure(z) - halves.pressure(z)).abs() < 1e-7, "at {z}");
        }
    }

    #[test]
    fn standard_air_bends_a_ray_about_a_fifth_of_the_earths_curvature() {
        let layer = Atmosphere::new(&[0.0, 10.0], &[15.0, 14.935], LIMITS, 1).unwrap().layers[0];
        let share = 1.0 + -2.0 * layer.half_bend * EARTH_RADIUS;
        assert!((0.15..0.25).contains(&share), "{share}");
    }

    #[test]
    fn layers_end_at_the_elevation_limit() {
        let limits = Limits { elevation: 7.5, ..LIMITS };
        let air = Atmosphere::new(&[0.0, 5.0, 10.0, 15.0], &[0.0; 4], limits, 2).unwrap();
        assert_eq!(air.layers.last().unwrap().top, 7.5);
        assert!(air.holds(15.0) && air.holds(0.0) && !air.holds(15.1) && !air.holds(-0.1));
    }

    #[test]
    fn a_profile_that_makes_no_sense_is_refused() {
        assert!(Atmosphere::new(&[0.0, 5.0], &[0.0, -300.0], LIMITS, 1).is_err());
        assert!(Atmosphere::new(&[0.0, f64::NAN], &[0.0, 1.0], LIMITS, 1).is_err());
        assert!(Atmosphere::new(&[1.0, 1.0], &[0.0, 1.0], LIMITS, 1).is_err());
        assert!(Atmosphere::new(&[1.0], &[0.0], LIMITS, 1).is_err());
    }
}
