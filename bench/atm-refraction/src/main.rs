//! Rays of a picture by the crate atm-refraction, the engine of atm-raytracer: fourth-order Runge-Kutta in fixed steps.
//!
//!     atm-paths PROFILE SLOPES eye-height distance step at
//!
//! PROFILE holds doubles: height in m, temperature in degrees Celsius, and so on upward. SLOPES holds doubles: dz/dr of
//! each ray at the eye. A ray ends at the ground or at the distance. Prints one JSON object: the number of rays and of
//! steps, and the heights of the rays at the distance `at` (null for those that ended before).

use std::{env, fs};

use atm_refraction::air::{Atmosphere, AtmosphereDef};
use atm_refraction::{EarthShape, Environment};
use serde_json::{json, Value};

fn doubles(path: &str) -> Vec<f64> {
    let bytes = fs::read(path).expect("a file of doubles");
    bytes.chunks_exact(8).map(|eight| f64::from_le_bytes(eight.try_into().unwrap())).collect()
}

/// The profile's straight lines from point to point, dry air, its highest temperature from there on.
fn atmosphere(profile: &[f64]) -> Atmosphere {
    let points: Vec<(f64, f64)> = profile.chunks_exact(2).map(|pair| (pair[0], pair[1] + 273.15)).collect();
    let gradients = points.windows(2).map(|pair| (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0));
    let functions: Vec<Value> = points
        .iter()
        .zip(gradients.chain([0.0]))
        .map(|(point, gradient)| json!({"altitude": point.0, "function": {"Linear": {"gradient": gradient}}}))
        .collect();
    let definition: AtmosphereDef = serde_json::from_value(json!({
        "pressure": {"altitude": 0.0, "pressure": 101325.0},
        "first_temperature_function": functions[0]["function"],
        "next_functions": functions[1..],
        "temperature_fixed_point": {"altitude": points[0].0, "temperature": points[0].1},
        "first_humidity_function": {"Linear": {"gradient": 0.0}},
        "humidity_fixed_point": {"altitude": 0.0, "humidity": 0.0},
    }))
    .expect("an atmosphere");
    Atmosphere::from_def(definition)
}

fn main() {
    let words: Vec<String> = env::args().collect();
    let number = |i: usize| -> f64 { words[i].parse().expect("a number") };
    let (profile, slopes) = (doubles(&words[1]), doubles(&words[2]));
    let (eye, distance, step, at) = (number(3), number(4), number(5), number(6));
    let shape = EarthShape::Spherical { radius: 6_371_000.0 };
    let air = Environment { shape, atmosphere: atmosphere(&profile), wavelength: 530e-9 };
    let mut steps = 0u64;
    let mut heights = Vec::with_capacity(slopes.len());
    for slope in &slopes {
        let mut stepper = air.cast_ray_stepper(eye, slope.atan(), false);
        stepper.set_step_size(step);
        let mut height = None;
        for state in stepper {
            steps += 1;
            if height.is_none() && state.x >= at - 0.5 * step {
                height = Some(state.h);
            }
            if state.h < profile[0] || state.x >= distance {
                break;
            }
        }
        heights.push(height);
    }
    println!("{}", json!({"rays": slopes.len(), "steps": steps, "heights": heights}));
}
