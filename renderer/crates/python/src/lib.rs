//! The kernel as a Python module, `m3d_render._kernel`. The package around it checks arguments and explains them;
//! here only what must be native.

mod fault;
mod options;
mod tables;

use std::sync::atomic::Ordering;
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};

use glam::DVec3;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::{PyMemoryError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

use m3d_ir::{Ir, Refusal};
use m3d_kernel::camera::Size;
use m3d_kernel::optics::atmosphere::{Atmosphere, EARTH_RADIUS};
use m3d_kernel::optics::path::Path;
use m3d_kernel::optics::tip::End;
use m3d_kernel::options::Options;
use m3d_kernel::output::Output;
use m3d_kernel::ray::Ray;
use m3d_kernel::render::{Settings, Tally};
use m3d_kernel::scene;
use m3d_kernel::trace::blocked;
use m3d_work::{Canvas, Tile, Watch, render};

use fault::{failed, guarded};
use tables::PythonTables;

/// How often the waiting thread looks for an interrupt.
const LOOK: Duration = Duration::from_millis(40);

/// Ray paths: why each ended, where and how steeply, of how many arcs, and its heights.
type Paths<'py> = (
    Bound<'py, PyArray1<u8>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<u32>>,
    Bound<'py, PyArray2<f64>>,
);

/// `m3d_render.rendering.Request`: what is asked of a picture.
#[derive(FromPyObject)]
struct Request {
    width: usize,
    height: usize,
    left: usize,
    top: usize,
    columns: usize,
    rows: usize,
    #[pyo3(from_py_with = options::options)]
    options: Options,
    layers: Vec<String>,
    threads: usize,
}

impl Request {
    fn settings(&self) -> PyResult<Settings> {
        let Self { width, height, left, top, columns, rows, .. } = *self;
        let within = |start: usize, count: usize, all: usize| {
            count > 0 && start.checked_add(count).is_some_and(|end| end <= all)
        };
        if !within(left, columns, width) || !within(top, rows, height) {
            return Err(PyValueError::new_err("the region does not lie within the picture"));
        }
        let output = |name: &String| {
            Output::named(name).ok_or_else(|| PyValueError::new_err(format!("there is no output {name}")))
        };
        Ok(Settings {
            size: Size { width, height },
            left,
            top,
            columns,
            rows,
            options: self.options.clone(),
            outputs: self.layers.iter().map(output).collect::<PyResult<_>>()?,
        })
    }
}

/// What became of a request.
#[pyclass(frozen, get_all)]
struct Outcome {
    /// (rows, columns, 3)
    pixels: Py<PyArray3<f32>>,
    /// (rows, columns, channels of all extra outputs)
    layers: Py<PyArray3<f32>>,
    /// How many rows from the top are finished: all, unless `cancel` returned true.
    finished_rows: usize,
    counts: Py<PyDict>,
}

/// A scene ready to be rendered.
#[pyclass(frozen)]
struct Scene(scene::Scene);

#[pymethods]
impl Scene {
    #[new]
    fn new(header: &str, tables: &Bound<PyAny>, finer: usize) -> PyResult<Self> {
        guarded(|| {
            let tables = PythonTables::of(tables)?;
            let scene = Ir::new(header, &tables).and_then(|ir| m3d_ir::scene(&ir, finer));
            scene.map(Self).map_err(refused)
        })
    }

    /// The heights between which an observer must stand for a mirage, and the observer's; None without one.
    #[getter]
    fn observer(&self) -> Option<(f64, f64, f64)> {
        let air = self.0.air.as_ref()?;
        Some((air.bottom(), air.profile_top, self.0.camera.eye.z))
    }

    /// Which points the eye sees along straight lines. What is nearer to a point than `tolerance` of its distance
    /// does not hide it.
    fn sees<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
        tolerance: f64,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let points = points.as_array();
        if points.ncols() != 3 {
            return Err(PyValueError::new_err("points have three coordinates"));
        }
        let (scene, eye) = (&self.0, self.0.camera.eye);
        let points: Vec<DVec3> = points.outer_iter().map(|p| DVec3::new(p[0], p[1], p[2])).collect();
        let sees = |stack: &mut Vec<_>, point: &DVec3| {
            let line = *point - eye;
            let length = line.length();
            let ray = Ray { to: length * (1.0 - tolerance), ..Ray::new(eye, line / length) };
            !(length > 0.0 && blocked(&scene.shapes, &scene.solid_tree, &ray, stack))
        };
        let seen = guarded(|| Ok(py.detach(|| points.par_iter().map_init(Vec::new, sees).collect())))?;
        Ok(PyArray1::from_vec(py, seen))
    }

    /// The pixels of a region. Callbacks, None or callable, are called from the calling thread:
    /// `progress(rows, all_rows)`, `cancel()`, which ends the work by returning true, and
    /// `tiles(top, step, pixels)` for each part of the picture that has become known.
    fn render(
        &self,
        py: Python,
        request: Request,
        progress: Option<Bound<PyAny>>,
        cancel: Option<Bound<PyAny>>,
        tiles: Option<Bound<PyAny>>,
    ) -> PyResult<Outcome> {
        let settings = request.settings()?;
        let (columns, rows, channels) = (settings.columns, settings.rows, settings.channels());
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(request.threads)
            .build()
            .map_err(|error| PyValueError::new_err(error.to_string()))?;
        let mut pixels = zeros(&[rows, columns, 3])?;
        let mut outputs = zeros(&[rows, columns, channels])?;
        let watch = Watch::new(rows);
        let finished = Bell::default();
        let (sender, receiver) = channel();
        let sender = tiles.is_some().then_some(sender);
        let mut audience = Audience { settings: &settings, progress, cancel, tiles, told: 0, largest: 0.0 };
        let (tally, stopped) = std::thread::scope(|scope| {
            let (settings, watch) = (&settings, &watch);
            let canvas = Canvas { pixels: &mut pixels, outputs: &mut outputs };
            let work = scope.spawn(|| {
                let _rings = finished.at_end();
                pool.install(|| render(&self.0, settings, watch, canvas, sender))
            });
            let mut stopped = Ok(false);
            while !py.detach(|| finished.wait(LOOK)) {
                if watch.cancelled.load(Ordering::Relaxed) {
                    continue;
                }
                stopped = audience.is_told(py, watch, &receiver);
                if !matches!(stopped, Ok(false)) {
                    watch.cancelled.store(true, Ordering::Relaxed);
                }
            }
            (work.join().map_err(|_| failed()), stopped)
        });
        let tally = tally?;
        if !stopped? {
            audience.is_told_the_end(py, &receiver)?;
        }
        let finished_rows = watch.finished_rows();
        settings.film().develop(&mut pixels[..finished_rows * columns * 3]);
        let array = |values: Vec<f32>, depth: usize| {
            Ok::<_, PyErr>(PyArray1::from_vec(py, values).reshape([rows, columns, depth])?.unbind())
        };
        Ok(Outcome {
            pixels: array(pixels, 3)?,
            layers: array(outputs, channels)?,
            finished_rows,
            counts: counts(py, &tally)?.unbind(),
        })
    }
}

/// Room for as many values, which the system gives as they are written. That there is none is found out first: a
/// failed `vec!` would end the process.
fn zeros(shape: &[usize]) -> PyResult<Vec<f32>> {
    let values = shape.iter().try_fold(1usize, |product, side| product.checked_mul(*side));
    match values {
        Some(values) if Vec::<f32>::new().try_reserve_exact(values).is_ok() => Ok(vec![0.0; values]),
        _ => Err(PyMemoryError::new_err("the picture does not fit in memory")),
    }
}

/// Those who want to hear of a rendering while it goes on.
struct Audience<'a, 'py> {
    settings: &'a Settings,
    progress: Option<Bound<'py, PyAny>>,
    cancel: Option<Bound<'py, PyAny>>,
    tiles: Option<Bound<'py, PyAny>>,
    /// Rows that were reported last.
    told: usize,
    /// Largest value in the tiles so far.
    largest: f32,
}

impl<'py> Audience<'_, 'py> {
    /// Reports what is new, and asks whether to stop.
    fn is_told(&mut self, py: Python<'py>, watch: &Watch, tiles: &Receiver<Tile>) -> PyResult<bool> {
        py.check_signals()?;
        let rows = watch.pixels_done.load(Ordering::Relaxed) / self.settings.columns;
        if let Some(progress) = &self.progress
            && rows != self.told
            && rows < self.settings.rows
        {
            self.told = rows;
            progress.call1((rows, self.settings.rows))?;
        }
        let started = Instant::now();
        for tile in tiles.try_iter() {
            self.show(py, tile)?;
            if started.elapsed() > LOOK {
                break;
            }
        }
        self.cancel.as_ref().map_or(Ok(false), |cancel| cancel.call0()?.is_truthy())
    }

    fn is_told_the_end(&mut self, py: Python<'py>, tiles: &Receiver<Tile>) -> PyResult<()> {
        for tile in tiles.try_iter() {
            self.show(py, tile)?;
        }
        if let Some(progress) = &self.progress {
            progress.call1((self.settings.rows, self.settings.rows))?;
        }
        Ok(())
    }

    /// Where values are to be divided by the largest one, a tile is by the largest so far.
    fn show(&mut self, py: Python<'py>, mut tile: Tile) -> PyResult<()> {
        let Some(tiles) = &self.tiles else { return Ok(()) };
        self.largest = tile.pixels.iter().copied().fold(self.largest, f32::max);
        self.settings.film().develop_by(self.largest, &mut tile.pixels);
        let rows = tile.pixels.len() / (3 * tile.columns);
        let pixels = PyArray1::from_vec(py, tile.pixels).reshape([rows, tile.columns, 3])?;
        tiles.call1((tile.top, tile.step, pixels))?;
        Ok(())
    }
}

fn counts<'py>(py: Python<'py>, tally: &Tally) -> PyResult<Bound<'py, PyDict>> {
    let counts = PyDict::new(py);
    counts.set_item("eye", tally.eye)?;
    counts.set_item("mirage", tally.mirage)?;
    counts.set_item("reflected", tally.reflected)?;
    counts.set_item("shadow", tally.shadow)?;
    counts.set_item("ambient", tally.ambient)?;
    counts.set_item("arcs", tally.arcs)?;
    Ok(counts)
}

/// Tells one thread that another has come to its end, be it by a panic.
#[derive(Default)]
struct Bell {
    rung: Mutex<bool>,
    sound: Condvar,
}

struct Ringer<'a>(&'a Bell);

impl Bell {
    fn at_end(&self) -> Ringer<'_> {
        Ringer(self)
    }

    /// Whether it has rung, after waiting for it a while.
    fn wait(&self, patience: Duration) -> bool {
        let rung = self.rung.lock().unwrap_or_else(PoisonError::into_inner);
        let waited = self.sound.wait_timeout_while(rung, patience, |rung| !*rung);
        *waited.unwrap_or_else(PoisonError::into_inner).0
    }
}

impl Drop for Ringer<'_> {
    fn drop(&mut self) {
        *self.0.rung.lock().unwrap_or_else(PoisonError::into_inner) = true;
        self.0.sound.notify_all();
    }
}

/// The air of a scene, for rays without a picture.
#[pyclass(frozen)]
struct Air(Atmosphere);

#[pymethods]
impl Air {
    #[new]
    fn new(header: &str, tables: &Bound<PyAny>, finer: usize) -> PyResult<Self> {
        guarded(|| {
            let tables = PythonTables::of(tables)?;
            let air = Ir::new(header, &tables).and_then(|ir| m3d_ir::air(&ir, finer)).map_err(refused)?;
            let none = || PyValueError::new_err("the scene has no MIRAGE, so its rays are straight");
            Ok(Self(air.ok_or_else(none)?))
        })
    }

    /// The layers, from the lowest: rows of (bottom, top, curvature of a level ray there, 1/m), positive where it is
    /// concave toward the earth, over an earth drawn flat.
    fn layers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let layers = &self.0.layers;
        let rows: Vec<f64> =
            layers.iter().flat_map(|layer| [layer.bottom, layer.top, -2.0 * layer.half_bend]).collect();
        PyArray1::from_vec(py, rows).reshape([layers.len(), 3])
    }

    /// Ray paths: for each slope dz/dr from `height`, why the path ended (a number of `END_NAMES`), where and how
    /// steeply (r, z, dz/dr), how many arcs it has, and its heights at the given distances, NaN beyond the end.
    fn paths<'py>(
        &self,
        py: Python<'py>,
        height: f64,
        slopes: PyReadonlyArray1<'py, f64>,
        distances: Vec<f64>,
    ) -> PyResult<Paths<'py>> {
        let mut path = self.path(height)?;
        let slopes = slopes.as_array();
        let mut ends = Vec::with_capacity(slopes.len());
        let mut tips = Vec::with_capacity(3 * slopes.len());
        let mut arcs = Vec::with_capacity(slopes.len());
        let mut heights = Vec::with_capacity(slopes.len() * distances.len());
        for &slope in slopes {
            py.check_signals()?;
            let tip = guarded(|| {
                path.start(height, slope);
                Ok(path.end_tip())
            })?;
            ends.push(end_number(tip.end));
            tips.extend([tip.r, tip.z, tip.slope]);
            arcs.push(tip.arcs as u32);
            let mut arc = 0;
            for &distance in &distances {
                let found = guarded(|| Ok(path.find(distance, arc)))?.filter(|_| distance >= 0.0);
                arc = found.unwrap_or(arc);
                heights.push(found.map_or(f64::NAN, |i| path.arcs()[i].height(distance)));
            }
        }
        let tips = PyArray1::from_vec(py, tips).reshape([slopes.len(), 3])?;
        let heights = PyArray1::from_vec(py, heights).reshape([slopes.len(), distances.len()])?;
        Ok((PyArray1::from_vec(py, ends), tips, PyArray1::from_vec(py, arcs), heights))
    }

    /// Every layer crossing of one path: an array of rows (r, z), the eye first and the end last.
    fn crossings<'py>(
        &self,
        py: Python<'py>,
        height: f64,
        slope: f64,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let mut path = self.path(height)?;
        let mut points = vec![0.0, height];
        guarded(|| {
            path.start(height, slope);
            points.extend(path.keep_all().iter().flat_map(|arc| [arc.r1, arc.z1]));
            Ok(())
        })?;
        let rows = points.len() / 2;
        PyArray1::from_vec(py, points).reshape([rows, 2])
    }
}

impl Air {
    /// A path from a height, which must lie within the profile.
    fn path(&self, height: f64) -> PyResult<Path<'_>> {
        if self.0.holds(height) {
            Ok(Path::new(&self.0))
        } else {
            Err(PyValueError::new_err(format!(
                "the observer's height {height} lies outside of the temperature profile, {} to {}",
                self.0.bottom(),
                self.0.profile_top
            )))
        }
    }
}

fn refused(refusal: Refusal) -> PyErr {
    match refusal {
        Refusal::Damaged(_) | Refusal::Limit(_) => PyValueError::new_err(refusal.to_string()),
        Refusal::TooLarge => PyMemoryError::new_err(refusal.to_string()),
    }
}

/// Which of `END_NAMES` tells why a path has ended.
fn end_number(end: Option<End>) -> u8 {
    let end = end.unwrap_or(End::Segments);
    End::ALL.iter().take_while(|&&other| other != end).count() as u8
}

#[pymodule]
fn _kernel(module: &Bound<PyModule>) -> PyResult<()> {
    fault::note_panics();
    module.add_class::<Scene>()?;
    module.add_class::<Air>()?;
    module.add("EARTH_RADIUS", EARTH_RADIUS)?;
    module.add("END_NAMES", End::ALL.map(End::name).to_vec())?;
    module.add("VERSION", env!("CARGO_PKG_VERSION"))?;
    module.add("LAYERS", Output::ALL.map(|(name, output)| (name, output.channels())).to_vec())
}
