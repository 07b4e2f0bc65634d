//! Colour: of a surface under its lights, of the sky, and of the haze before them. Thesis 3.4, 7.5.5.1.

pub mod haze;
pub mod highlight;
pub mod illumination;
pub mod scatter;
pub mod sky;
