//! A picture may be made by many who know nothing of each other.

use glam::DVec3;
use m3d_kernel::camera::{Camera, Size};
use m3d_kernel::options::Options;
use m3d_kernel::output::Output;
use m3d_kernel::picture::picture;
use m3d_kernel::render::Settings;
use m3d_kernel::scene::{Ambient, Background, Scene, Solid};
use m3d_kernel::shade::haze::Haze;
use m3d_kernel::shade::highlight::Gloss;
use m3d_kernel::shade::illumination::Surface;
use m3d_kernel::shape::plane::Plane;
use m3d_kernel::shape::sphere::Sphere;
use m3d_kernel::shapes::{Owner, Part, Shapes};
use m3d_work::{Canvas, Tile, Watch, render};

/// A rough mirror and a plane in sampled light.
fn scene() -> Scene {
    let gloss = Gloss { refindex: 1.5, rough: 0.2, metallic: 0.0, fresnel: 0.04, beckmann: 1.0 };
    let color = DVec3::new(0.9, 0.6, 0.3);
    let surface = Surface { color, ambient: 1.0, diffuse: 0.6, specular: 0.4, hard: 0.5, fuzz: 0.1, gloss };
    let mut shapes = Shapes::default();
    let part = |primitive| Part { owner: Owner::Solid(0), primitive };
    let (pole, equator) = (DVec3::Z, DVec3::X);
    shapes.push(Plane::spanned(DVec3::ZERO, DVec3::X, DVec3::Y), part(0));
    shapes.push(Sphere { center: DVec3::new(0.0, 6.0, 1.0), radius: 1.0, pole, equator }, part(1));
    let (solid_tree, light_tree) = shapes.trees();
    Scene {
        camera: Camera { eye: 2.0 * DVec3::Z, ahead: DVec3::Y, right: DVec3::X, up: DVec3::Z, aspect: 1.0 },
        background: Background::Plain(DVec3::new(0.2, 0.4, 0.8)),
        ambient: Ambient { constant: DVec3::ONE, samples: 2, depth: 2 },
        haze: Haze { color: DVec3::ONE, density: 0.01 },
        air: None,
        lights: vec![],
        solids: vec![Solid { surface, textures: vec![] }],
        shapes,
        solid_tree,
        light_tree,
    }
}

fn settings() -> Settings {
    Settings {
        size: Size { width: 20, height: 16 },
        left: 3,
        top: 2,
        columns: 11,
        rows: 13,
        options: Options {
            straight: false,
            shadows: true,
            depth: 3,
            normalize: false,
            log_scale: 0.0,
            samples: 3,
            refract_reflections: false,
        },
        outputs: vec![Output::Position, Output::Uv],
    }
}

fn canvas(settings: &Settings) -> (Vec<f32>, Vec<f32>) {
    let pixels = settings.columns * settings.rows;
    (vec![0.0; 3 * pixels], vec![0.0; settings.channels() * pixels])
}

fn rendered(scene: &Scene, settings: &Settings) -> (Vec<f32>, Vec<f32>) {
    let (mut pixels, mut outputs) = canvas(settings);
    let watch = Watch::new(settings.rows);
    let canvas = Canvas { pixels: &mut pixels, outputs: &mut outputs };
    render(scene, settings, &watch, canvas, None);
    assert_eq!(watch.finished_rows(), settings.rows);
    (pixels, outputs)
}

#[test]
fn parts_that_were_written_down_make_the_whole() {
    let (scene, whole) = (scene(), settings());
    let (pixels, outputs) = rendered(&scene, &whole);
    assert_eq!(pixels, picture(&scene, &whole));
    for rows in [1, 4, 13, 99] {
        let letters: Vec<String> =
            whole.parts(rows).map(|part| serde_json::to_string(&part).unwrap()).collect();
        // Whoever gets the last one is the first to answer.
        let workers = letters.into_iter().rev().map(|letter| {
            let scene = scene.clone();
            std::thread::spawn(move || {
                let part: Settings = serde_json::from_str(&letter).unwrap();
                (part.top, rendered(&scene, &part))
            })
        });
        let mut answers: Vec<_> = workers.map(|worker| worker.join().unwrap()).collect();
        answers.sort_by_key(|(top, _)| *top);
        let (tops, made): (Vec<_>, Vec<_>) = answers.into_iter().unzip();
        assert_eq!(tops, (2..15).step_by(rows).collect::<Vec<_>>());
        let (made_pixels, made_outputs): (Vec<_>, Vec<_>) = made.into_iter().unzip();
        assert_eq!((made_pixels.concat(), made_outputs.concat()), (pixels.clone(), outputs.clone()));
    }
}

#[test]
fn tiles_can_be_written_down() {
    let (scene, settings) = (scene(), settings());
    let (mut pixels, mut outputs) = canvas(&settings);
    let (sender, tiles) = std::sync::mpsc::channel();
    let canvas = Canvas { pixels: &mut pixels, outputs: &mut outputs };
    render(&scene, &settings, &Watch::new(settings.rows), canvas, Some(sender));
    let mut shown = vec![f32::NAN; pixels.len()];
    for tile in tiles {
        let letter = serde_json::to_string(&tile).unwrap();
        let arrived: Tile = serde_json::from_str(&letter).unwrap();
        assert_eq!(arrived, tile);
        for (i, pixel) in tile.pixels.chunks_exact(3).enumerate() {
            let row = tile.top + tile.step * (i / tile.columns);
            let first = 3 * (row * settings.columns + tile.step * (i % tile.columns));
            shown[first..first + 3].copy_from_slice(pixel);
        }
    }
    assert_eq!(shown, pixels);
}
