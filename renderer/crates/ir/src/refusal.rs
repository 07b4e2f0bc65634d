//! Why a scene is not rendered.

use std::fmt;

/// Why a scene is not rendered.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Refusal {
    /// Something is missing, of the wrong type, or contradicts something else.
    Damaged(String),
    /// It is well-formed, but more than can be rendered.
    Limit(String),
    /// It does not fit in memory.
    TooLarge,
}

/// What is read, or why not.
pub type Result<T> = std::result::Result<T, Refusal>;

pub fn damaged(what: impl Into<String>) -> Refusal {
    Refusal::Damaged(what.into())
}

impl fmt::Display for Refusal {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Damaged(what) => write!(out, "damaged scene: {what}"),
            Self::Limit(what) => out.write_str(what),
            Self::TooLarge => out.write_str("the scene does not fit in memory"),
        }
    }
}

impl std::error::Error for Refusal {}
