//! A panic of the kernel is a fault of ours. Python gets it as a `RuntimeError`, and the terminal gets nothing.

use std::any::Any;
use std::panic::{AssertUnwindSafe, PanicHookInfo, catch_unwind, set_hook};
use std::sync::{Mutex, PoisonError};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// What the last panic, of whichever thread, was about.
static LAST: Mutex<String> = Mutex::new(String::new());

/// From now on a panic is noted where Rust would print it.
pub fn note_panics() {
    set_hook(Box::new(|info: &PanicHookInfo| {
        let what = said(info.payload());
        let place = info.location().map_or(String::new(), |place| {
            let name = place.file().rsplit(['/', '\\']).next().unwrap_or_default();
            format!(" ({name}:{})", place.line())
        });
        *LAST.lock().unwrap_or_else(PoisonError::into_inner) = format!("{what}{place}");
    }));
}

/// The text that a panic carries.
fn said(payload: &dyn Any) -> &str {
    let text = payload.downcast_ref::<&str>().copied();
    text.or_else(|| payload.downcast_ref::<String>().map(String::as_str)).unwrap_or("no reason is given")
}

/// What `work` returns; a RuntimeError where it panics.
pub fn guarded<T>(work: impl FnOnce() -> PyResult<T>) -> PyResult<T> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| Err(failed()))
}

/// The error for a panic that was caught here, or in a thread that has been joined.
pub fn failed() -> PyErr {
    let noted = LAST.lock().unwrap_or_else(PoisonError::into_inner);
    PyRuntimeError::new_err(format!("a panic in the kernel: {noted}; please report this scene"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_an_error_that_says_what_and_where() {
        note_panics();
        let rows = Vec::<usize>::new();
        let error = guarded(|| Ok(rows[rows.len() + 2])).unwrap_err();
        Python::initialize();
        let message = Python::attach(|py| error.value(py).to_string());
        assert!(
            message
                .starts_with("a panic in the kernel: index out of bounds: the len is 0 but the index is 2")
        );
        assert!(message.contains("fault.rs:"), "{message}");
        assert_eq!(guarded(|| Ok(3)).ok(), Some(3));
    }
}
