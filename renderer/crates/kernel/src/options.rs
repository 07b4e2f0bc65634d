//! What may be asked of every pixel. Made by `make generate` from renderer/m3d_render/options.py.

#[derive(Clone, PartialEq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Options {
    /// Straight rays, whatever MIRAGE says.
    pub straight: bool,
    /// Cast shadows, even if the scene does not say so.
    pub shadows: bool,
    /// Level of the last mirror ray; the eye ray is 1.
    pub depth: usize,
    /// Divide by the largest value, before LOGSCALE, instead of clipping.
    pub normalize: bool,
    /// LOGSCALE, instead of the scene's; above 1.
    pub log_scale: f64,
    /// Rays a pixel, spread by a smooth filter: no jagged edges (1).
    pub samples: usize,
    /// The air bends mirror rays too, even if the scene does not say so.
    pub refract_reflections: bool,
}
