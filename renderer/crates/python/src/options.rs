//! Render options from Python. Made by `make generate` from renderer/m3d_render/options.py.

use m3d_kernel::options::Options;
use pyo3::prelude::*;

/// The options in a dictionary.
pub fn options(given: &Bound<PyAny>) -> PyResult<Options> {
    Ok(Options {
        straight: given.get_item("straight")?.extract()?,
        shadows: given.get_item("shadows")?.extract()?,
        depth: given.get_item("depth")?.extract()?,
        normalize: given.get_item("normalize")?.extract()?,
        log_scale: given.get_item("log_scale")?.extract()?,
        samples: given.get_item("samples")?.extract()?,
        refract_reflections: given.get_item("refract_reflections")?.extract()?,
    })
}
