//! The tables of a scene in Python's hands: dictionaries of NumPy arrays, read where they lie.

use std::collections::HashMap;

use m3d_ir::{Column, Numbers, Tables};
use numpy::{Element, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A column's numbers: where Python has them, or copied where they do not lie one after the other.
enum Held<'py, T: Element> {
    There(PyReadonlyArrayDyn<'py, T>),
    Copied(Vec<T>),
}

impl<'py, T: Element + Copy> Held<'py, T> {
    fn of(array: &Bound<'py, PyArrayDyn<T>>) -> Self {
        let array = array.readonly();
        match array.as_slice() {
            Ok(_) => Self::There(array),
            Err(_) => Self::Copied(array.as_array().iter().copied().collect()),
        }
    }

    fn numbers(&self) -> &[T] {
        match self {
            // Empty never: `of` has looked.
            Self::There(array) => array.as_slice().unwrap_or_default(),
            Self::Copied(values) => values,
        }
    }
}

enum Typed<'py> {
    F64(Held<'py, f64>),
    I32(Held<'py, i32>),
    Bool(Held<'py, bool>),
}

pub struct PythonTables<'py> {
    columns: HashMap<(String, String), (usize, Typed<'py>)>,
}

impl<'py> PythonTables<'py> {
    /// All columns of the types that the kernel reads.
    pub fn of(tables: &Bound<'py, PyAny>) -> PyResult<Self> {
        let mut columns = HashMap::new();
        let entries = |of: &Bound<'py, PyAny>| -> PyResult<Bound<'py, PyDict>> {
            let wrong = || PyValueError::new_err("damaged scene: its tables are no dictionaries");
            of.cast::<PyDict>().cloned().map_err(|_| wrong())
        };
        for (table, held) in entries(tables)? {
            for (column, array) in entries(&held)? {
                if let Some(held) = typed(&array) {
                    columns.insert((table.extract()?, column.extract()?), held);
                }
            }
        }
        Ok(Self { columns })
    }
}

/// Axes that a column may have: its rows, and those of a matrix. An array may have more than Rust can read.
const MOST_AXES: usize = 3;

fn typed<'py>(array: &Bound<'py, PyAny>) -> Option<(usize, Typed<'py>)> {
    fn width<T: Element>(array: &Bound<PyArrayDyn<T>>) -> usize {
        array.shape().iter().skip(1).product()
    }
    if array.cast::<PyUntypedArray>().is_ok_and(|array| array.ndim() > MOST_AXES) {
        return None;
    }
    if let Ok(array) = array.cast::<PyArrayDyn<f64>>() {
        Some((width(array), Typed::F64(Held::of(array))))
    } else if let Ok(array) = array.cast::<PyArrayDyn<i32>>() {
        Some((width(array), Typed::I32(Held::of(array))))
    } else {
        let array = array.cast::<PyArrayDyn<bool>>().ok()?;
        Some((width(array), Typed::Bool(Held::of(array))))
    }
}

impl Tables for PythonTables<'_> {
    fn column(&self, table: &str, column: &str) -> Option<Column<'_>> {
        let (width, typed) = self.columns.get(&(table.to_owned(), column.to_owned()))?;
        let numbers = match typed {
            Typed::F64(held) => Numbers::F64(held.numbers()),
            Typed::I32(held) => Numbers::I32(held.numbers()),
            Typed::Bool(held) => Numbers::Bool(held.numbers()),
        };
        Some(Column { numbers, width: *width })
    }
}
