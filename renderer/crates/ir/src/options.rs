//! Render options as a scene has them. Made by `make generate` from renderer/m3d_render/options.py.

use m3d_kernel::options::Options;

use crate::ir::Ir;

/// What the scene says, and what is meant where nothing is asked for.
pub fn options(ir: &Ir) -> Options {
    let said = &ir.globals;
    Options {
        straight: false,
        shadows: said.shadows,
        depth: usize::try_from(said.depth).unwrap_or(1),
        normalize: false,
        log_scale: said.log_scale,
        samples: 1,
        refract_reflections: said.refract_reflections,
    }
}
