//! A compiled scene as it comes: its header, read, and its tables, yet to be read.

use crate::generated::Globals;
use crate::header;
use crate::refusal::Result;
use crate::tables::{Table, Tables};

/// A compiled scene.
pub struct Ir<'a> {
    /// What the scene says once.
    pub globals: Globals,
    tables: &'a dyn Tables,
}

impl<'a> Ir<'a> {
    /// `header` is the JSON text that a `.m3ir` file begins with.
    pub fn new(header: &str, tables: &'a dyn Tables) -> Result<Self> {
        Ok(Self { globals: header::read(header)?, tables })
    }

    pub(crate) fn table(&self, name: &'static str) -> Table<'a> {
        Table::new(self.tables, name)
    }
}
