//! The kernel as a Python module, `m3d_render._kernel`. The package around it checks arguments and explains them;
//! here only what must be native.

mod ir;

use std::sync::atomic::Ordering;
use std::sync::{Condvar, Mutex, PoisonError};
use std::time::Duration;

use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::exceptions::{PyMemoryError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::camera::Size;
use crate::film::Film;
use crate::optics::atmosphere::Atmosphere;
use crate::optics::path::{End, Path};
use crate::render::{Settings, Tally, Watch, render};
use crate::scene;

/// How often the waiting thread looks for an interrupt.
const LOOK: Duration = Duration::from_millis(40);

/// Pixels, and what was traced for them by kind.
type Rendered<'py> = (Bound<'py, PyArray3<f32>>, Bound<'py, PyDict>);

/// Ray paths: why each ended, where, of how many arcs, and its heights.
type Paths<'py> = (Vec<&'static str>, Bound<'py, PyArray2<f64>>, Vec<usize>, Bound<'py, PyArray2<f64>>);

/// A scene ready to be rendered.
#[pyclass(frozen)]
struct Scene {
    scene: scene::Scene,
    air: Option<Atmosphere>,
}

#[pymethods]
impl Scene {
    #[new]
    fn new(ir: &Bound<PyAny>, finer: usize) -> PyResult<Self> {
        Ok(Self { scene: ir::scene(ir)?, air: ir::atmosphere(ir, finer)? })
    }

    /// The heights between which an observer must stand for a mirage, and the observer's; None without one.
    #[getter]
    fn observer(&self) -> Option<(f64, f64, f64)> {
        let air = self.air.as_ref()?;
        Some((air.bottom(), air.profile_top, self.scene.camera.eye.z))
    }

    /// The pixels of a region as an array (rows, columns, 3), and what was traced for them; None if `cancel`
    /// returned true. Both callbacks are called from the calling thread.
    #[pyo3(signature = (*, width, height, left, top, columns, rows, straight, shadows, depth, log_scale, threads, progress, cancel))]
    #[allow(clippy::too_many_arguments)]
    fn render<'py>(
        &self,
        py: Python<'py>,
        width: usize,
        height: usize,
        left: usize,
        top: usize,
        columns: usize,
        rows: usize,
        straight: bool,
        shadows: bool,
        depth: usize,
        log_scale: f64,
        threads: usize,
        progress: Option<Bound<'py, PyAny>>,
        cancel: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Option<Rendered<'py>>> {
        let settings = Settings {
            size: Size { width, height },
            left,
            top,
            columns,
            rows,
            shadows,
            depth,
            film: Film { log_scale },
        };
        if columns == 0 || rows == 0 || left + columns > width || top + rows > height {
            return Err(PyValueError::new_err("the region does not lie within the picture"));
        }
        let air = if straight { None } else { self.air.as_ref() };
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|error| PyValueError::new_err(error.to_string()))?;
        let mut pixels = zeros(columns, rows)?;
        let watch = Watch::default();
        let finished = Bell::default();
        let (tally, stopped) = std::thread::scope(|scope| {
            let (pixels, watch, settings) = (&mut pixels, &watch, &settings);
            let work = scope.spawn(|| {
                let _rings = finished.at_end();
                pool.install(|| render(&self.scene, air, settings, watch, pixels))
            });
            let mut stopped = Ok(false);
            let mut told = usize::MAX;
            while !py.detach(|| finished.wait(LOOK)) {
                if watch.cancelled.load(Ordering::Relaxed) {
                    continue;
                }
                stopped = look_around(py, watch, rows, &mut told, progress.as_ref(), cancel.as_ref());
                if !matches!(stopped, Ok(false)) {
                    watch.cancelled.store(true, Ordering::Relaxed);
                }
            }
            let tally = match work.join() {
                Ok(tally) => tally,
                Err(panic) => std::panic::resume_unwind(panic),
            };
            (tally, stopped)
        });
        if stopped? {
            return Ok(None);
        }
        if let Some(progress) = progress {
            progress.call1((rows, rows))?;
        }
        let array = PyArray1::from_vec(py, pixels).reshape([rows, columns, 3])?;
        Ok(Some((array, counts(py, &tally)?)))
    }
}

/// Room for the pixels, which the system gives as they are written. That there is none is found out first: a failed
/// `vec!` would end the process.
fn zeros(columns: usize, rows: usize) -> PyResult<Vec<f32>> {
    let values = columns.checked_mul(rows).and_then(|pixels| pixels.checked_mul(3));
    match values {
        Some(values) if Vec::<f32>::new().try_reserve_exact(values).is_ok() => Ok(vec![0.0; values]),
        _ => Err(PyMemoryError::new_err("the picture does not fit in memory")),
    }
}

/// Reports progress and asks whether to stop.
fn look_around(
    py: Python,
    watch: &Watch,
    rows: usize,
    told: &mut usize,
    progress: Option<&Bound<PyAny>>,
    cancel: Option<&Bound<PyAny>>,
) -> PyResult<bool> {
    py.check_signals()?;
    let done = watch.rows_done.load(Ordering::Relaxed);
    if let Some(progress) = progress
        && done != *told
        && done < rows
    {
        *told = done;
        progress.call1((done, rows))?;
    }
    cancel.map_or(Ok(false), |cancel| cancel.call0()?.is_truthy())
}

fn counts<'py>(py: Python<'py>, tally: &Tally) -> PyResult<Bound<'py, PyDict>> {
    let counts = PyDict::new(py);
    counts.set_item("eye", tally.eye)?;
    counts.set_item("mirage", tally.mirage)?;
    counts.set_item("reflected", tally.reflected)?;
    counts.set_item("shadow", tally.shadow)?;
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

/// Ray paths without a picture: for each slope dz/dr from `height`, why the path ended ("ground", "top", "range",
/// "segments"), where (r, z), how many arcs it has, and its heights at the given distances, NaN beyond the end.
#[pyfunction]
fn trace_paths<'py>(
    py: Python<'py>,
    ir: &Bound<'py, PyAny>,
    height: f64,
    slopes: Vec<f64>,
    distances: Vec<f64>,
    finer: usize,
) -> PyResult<Paths<'py>> {
    let air = air_around(ir, height, finer)?;
    let mut path = Path::new(&air);
    let mut ends = Vec::with_capacity(slopes.len());
    let mut tips = Vec::with_capacity(2 * slopes.len());
    let mut arcs = Vec::with_capacity(slopes.len());
    let mut heights = Vec::with_capacity(slopes.len() * distances.len());
    for &slope in &slopes {
        finish(&mut path, height, slope);
        ends.push(end_name(path.end()));
        let (r, z, _) = path.tip();
        tips.extend([r, z]);
        arcs.push(path.arcs().len());
        let mut arc = 0;
        for &distance in &distances {
            let found = path.find(distance, arc).filter(|_| distance >= 0.0);
            arc = found.unwrap_or(arc);
            heights.push(found.map_or(f64::NAN, |i| path.arcs()[i].height(distance)));
        }
    }
    let tips = PyArray1::from_vec(py, tips).reshape([slopes.len(), 2])?;
    let heights = PyArray1::from_vec(py, heights).reshape([slopes.len(), distances.len()])?;
    Ok((ends, tips, arcs, heights))
}

/// Every layer crossing of one path: an array of rows (r, z), the eye first and the end last.
#[pyfunction]
fn trace_crossings<'py>(
    py: Python<'py>,
    ir: &Bound<'py, PyAny>,
    height: f64,
    slope: f64,
    finer: usize,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let air = air_around(ir, height, finer)?;
    let mut path = Path::new(&air);
    finish(&mut path, height, slope);
    let mut points = vec![0.0, height];
    points.extend(path.arcs().iter().flat_map(|arc| [arc.r1, arc.z1]));
    let rows = points.len() / 2;
    PyArray1::from_vec(py, points).reshape([rows, 2])
}

fn air_around(ir: &Bound<PyAny>, height: f64, finer: usize) -> PyResult<Atmosphere> {
    let air = ir::atmosphere(ir, finer)?
        .ok_or_else(|| PyValueError::new_err("the scene has no MIRAGE, so its rays are straight"))?;
    if air.holds(height) {
        Ok(air)
    } else {
        Err(PyValueError::new_err(format!(
            "the observer's height {height} lies outside of the temperature profile, {} to {}",
            air.bottom(),
            air.profile_top
        )))
    }
}

fn finish(path: &mut Path, height: f64, slope: f64) {
    path.start(height, slope);
    while path.arc(path.arcs().len()).is_some() {}
}

fn end_name(end: Option<End>) -> &'static str {
    match end {
        Some(End::Ground) => "ground",
        Some(End::Top) => "top",
        Some(End::Range) => "range",
        Some(End::Segments) | None => "segments",
    }
}

#[pymodule]
fn _kernel(module: &Bound<PyModule>) -> PyResult<()> {
    module.add_class::<Scene>()?;
    module.add_function(wrap_pyfunction!(trace_paths, module)?)?;
    module.add_function(wrap_pyfunction!(trace_crossings, module)?)?;
    module.add("VERSION", env!("CARGO_PKG_VERSION"))?;
    module.add("TEXTURE_KINDS", ir::TEXTURE_KINDS.to_vec())
}
