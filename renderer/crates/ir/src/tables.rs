//! The tables of a scene, wherever their numbers lie: in Python's arrays, or in a file.
//!
//! Nothing of them is trusted. Whatever reads a column says which numbers it may hold, and gets an error otherwise.

use std::ops::Range;

use glam::{DMat4, DVec3};

use crate::refusal::{Refusal, Result, damaged};

/// A shape may reach so far from the origin, in any direction. Beyond, the fourth power of a coordinate, which facets
/// and rectangles take, is no longer a number.
const FARTHEST: f64 = 1e75;

/// The numbers of a column, entry after entry.
#[derive(Clone, Copy, Debug)]
pub enum Numbers<'a> {
    /// NumPy's float64.
    F64(&'a [f64]),
    /// int32.
    I32(&'a [i32]),
    /// bool.
    Bool(&'a [bool]),
}

/// A column. An entry is 1 number, 3 of a vector, or 16 of a matrix by rows.
#[derive(Clone, Copy, Debug)]
pub struct Column<'a> {
    /// All numbers of the column.
    pub numbers: Numbers<'a>,
    /// How many of them are one entry.
    pub width: usize,
}

/// Whoever holds the tables of a scene.
pub trait Tables {
    /// A column of a table; None where there is none, or it is of a type that no column has.
    fn column(&self, table: &str, column: &str) -> Option<Column<'_>>;
}

/// What a column can be made of.
pub trait Number: Copy {
    fn of<'a>(numbers: &Numbers<'a>) -> Option<&'a [Self]>;
}

impl Number for f64 {
    fn of<'a>(numbers: &Numbers<'a>) -> Option<&'a [Self]> {
        if let Numbers::F64(numbers) = numbers { Some(numbers) } else { None }
    }
}

impl Number for i32 {
    fn of<'a>(numbers: &Numbers<'a>) -> Option<&'a [Self]> {
        if let Numbers::I32(numbers) = numbers { Some(numbers) } else { None }
    }
}

impl Number for bool {
    fn of<'a>(numbers: &Numbers<'a>) -> Option<&'a [Self]> {
        if let Numbers::Bool(numbers) = numbers { Some(numbers) } else { None }
    }
}

/// A coordinate, or a length.
pub fn coordinate(value: f64, what: impl FnOnce() -> String) -> Result<f64> {
    if !value.is_finite() {
        Err(damaged(format!("{} is not a finite number", what())))
    } else if value.abs() > FARTHEST {
        let what = what();
        Err(Refusal::Limit(format!("{what} is {value:e}: up to {FARTHEST:e} can be rendered")))
    } else {
        Ok(value)
    }
}

/// An empty vector with room for so many.
fn room<T>(count: usize) -> Result<Vec<T>> {
    let mut made = Vec::new();
    made.try_reserve_exact(count).map_err(|_| Refusal::TooLarge)?;
    Ok(made)
}

/// One table.
#[derive(Clone, Copy)]
pub struct Table<'a> {
    tables: &'a dyn Tables,
    name: &'static str,
}

impl<'a> Table<'a> {
    pub fn new(tables: &'a dyn Tables, name: &'static str) -> Self {
        Self { tables, name }
    }

    /// The numbers of a column with so many an entry.
    fn entries<T: Number>(&self, column: &str, width: usize) -> Result<&'a [T]> {
        let found = self.tables.column(self.name, column).filter(|found| found.width == width);
        found
            .and_then(|found| T::of(&found.numbers))
            .filter(|numbers| numbers.len().is_multiple_of(width))
            .ok_or_else(|| damaged(format!("{}.{column} is missing or of the wrong type", self.name)))
    }

    /// A column of any numbers, one a row.
    pub fn plain<T: Number>(&self, column: &str) -> Result<&'a [T]> {
        self.entries(column, 1)
    }

    /// A column of finite numbers.
    pub fn numbers(&self, column: &str) -> Result<&'a [f64]> {
        let values: &[f64] = self.plain(column)?;
        match values.iter().position(|value| !value.is_finite()) {
            Some(row) => Err(self.not_finite(column, row)),
            None => Ok(values),
        }
    }

    fn not_finite(&self, column: &str, row: usize) -> Refusal {
        damaged(format!("{}.{column}, row {row}, is not a finite number", self.name))
    }

    /// A column of three numbers a row.
    pub fn threes<T: Number>(&self, column: &str) -> Result<&'a [[T; 3]]> {
        Ok(self.entries(column, 3)?.as_chunks().0)
    }

    /// A column of finite vectors.
    pub fn vectors(&self, column: &str) -> Result<Vec<DVec3>> {
        let threes = self.threes::<f64>(column)?;
        let mut values = room(threes.len())?;
        values.extend(threes.iter().copied().map(DVec3::from));
        match values.iter().position(|value: &DVec3| !value.is_finite()) {
            Some(row) => Err(self.not_finite(column, row)),
            None => Ok(values),
        }
    }

    /// A column of vectors within reach.
    pub fn positions(&self, column: &str) -> Result<Vec<DVec3>> {
        let values = self.vectors(column)?;
        let largest = |value: &DVec3| value.abs().max_element();
        if let Some(row) = values.iter().position(|value| largest(value) > FARTHEST) {
            coordinate(largest(&values[row]), || format!("{}.{column}, row {row},", self.name))?;
        }
        Ok(values)
    }

    /// Matrices that act on row vectors become ones that act on columns, as glam has them.
    pub fn matrices(&self, column: &str) -> Result<Vec<DMat4>> {
        let matrices = self.entries::<f64>(column, 16)?.as_chunks().0;
        Ok(matrices.iter().map(DMat4::from_cols_array).collect())
    }

    pub fn entry<T: Copy>(&self, column: &[T], row: usize) -> Result<T> {
        column.get(row).copied().ok_or_else(|| damaged(format!("{} has no row {row}", self.name)))
    }
}

/// Rows of a table of which each belongs to one row of another at most.
pub struct Owned {
    what: &'static str,
    pub length: usize,
    taken: usize,
}

impl Owned {
    pub fn new(what: &'static str, length: usize) -> Self {
        Self { what, length, taken: 0 }
    }

    /// Rows `first`..`first + count`.
    pub fn take(&mut self, first: i32, count: i32) -> Result<Range<usize>> {
        let (what, length) = (self.what, self.length);
        let range = usize::try_from(first).ok().zip(usize::try_from(count).ok());
        let Some((first, count)) = range.filter(|(first, count)| first + count <= length) else {
            return Err(damaged(format!(
                "{what} {first} to {} do not exist",
                i64::from(first) + i64::from(count)
            )));
        };
        self.taken += count;
        if self.taken > length {
            return Err(damaged(format!("some rows of {what} belong to more than one")));
        }
        Ok(first..first + count)
    }
}
