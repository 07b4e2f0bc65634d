//! A `.m3ir` file in memory: a NumPy archive, stored without compression (docs/m3ir.md).

use std::collections::HashMap;
use std::io::Read;

use rawzip::{CompressionMethod, ZipArchive};

use crate::refusal::{Refusal, Result, damaged};
use crate::tables::{Column, Numbers, Tables};

enum Typed {
    F64(Vec<f64>),
    I32(Vec<i32>),
    Bool(Vec<bool>),
}

/// The header and the columns of a file. Columns of types that the kernel does not read are left out.
pub struct Archive {
    /// A JSON text.
    pub header: String,
    columns: HashMap<String, (usize, Typed)>,
}

impl Archive {
    /// What the bytes of a file hold.
    pub fn read(file: &[u8]) -> Result<Self> {
        let broken = |error: rawzip::Error| damaged(error.to_string());
        let archive = ZipArchive::from_slice(file).map_err(|_| damaged("it is not an .m3ir file"))?;
        let mut entries = archive.entries();
        let mut header = None;
        let mut columns = HashMap::new();
        while let Some(entry) = entries.next_entry().map_err(broken)? {
            if entry.compression_method() != CompressionMethod::STORE {
                return Err(damaged("it is compressed"));
            }
            let path = entry.file_path().try_normalize().map_err(broken)?;
            let name = path.as_ref().trim_end_matches(".npy");
            let stored = archive.get_entry(entry.wayfinder()).map_err(broken)?;
            // Stored as it is, an entry takes no more memory than the file.
            let mut bytes = Vec::new();
            bytes.try_reserve(stored.data().len()).map_err(|_| Refusal::TooLarge)?;
            let reading = stored.verifying_reader(stored.data()).read_to_end(&mut bytes);
            reading.map_err(|error| damaged(format!("{name}: {error}")))?;
            let array = Array::read(&bytes).ok_or_else(|| damaged(format!("{name} is no NumPy array")))?;
            if name == "header" {
                header = String::from_utf8(array.data.to_vec()).ok();
            } else if let Some(typed) = array.typed() {
                columns.insert(name.to_owned(), (array.width, typed));
            }
        }
        Ok(Self { header: header.ok_or_else(|| damaged("it has no header"))?, columns })
    }
}

impl Tables for Archive {
    fn column(&self, table: &str, column: &str) -> Option<Column<'_>> {
        let (width, typed) = self.columns.get(&format!("{table}.{column}"))?;
        let numbers = match typed {
            Typed::F64(numbers) => Numbers::F64(numbers),
            Typed::I32(numbers) => Numbers::I32(numbers),
            Typed::Bool(numbers) => Numbers::Bool(numbers),
        };
        Some(Column { numbers, width: *width })
    }
}

/// An array in NumPy's own format: a magic text, a version, and a dictionary before its data.
struct Array<'a> {
    kind: &'a str,
    width: usize,
    data: &'a [u8],
}

impl<'a> Array<'a> {
    fn read(bytes: &'a [u8]) -> Option<Self> {
        let (version, rest) = bytes.strip_prefix(b"\x93NUMPY")?.split_at_checked(2)?;
        let (length, rest) = if version[0] == 1 {
            let (length, rest) = rest.split_first_chunk()?;
            (u16::from_le_bytes(*length) as usize, rest)
        } else {
            let (length, rest) = rest.split_first_chunk()?;
            (u32::from_le_bytes(*length) as usize, rest)
        };
        let (dictionary, data) = rest.split_at_checked(length)?;
        let dictionary = std::str::from_utf8(dictionary).ok()?;
        let after = |key: &str| dictionary.split_once(key).map(|(_, value)| value.trim_start());
        if !after("'fortran_order':")?.starts_with("False") {
            return None;
        }
        let kind = after("'descr':")?.strip_prefix('\'')?.split('\'').next()?;
        let shape = after("'shape':")?.strip_prefix('(')?.split(')').next()?;
        let sides = shape.split(',').map(str::trim).filter(|side| !side.is_empty());
        let sides: Vec<usize> = sides.map(|side| side.parse().ok()).collect::<Option<_>>()?;
        let width = sides.iter().skip(1).try_fold(1usize, |product, &side| product.checked_mul(side))?;
        Some(Self { kind, width, data })
    }

    fn typed(&self) -> Option<Typed> {
        Some(match self.kind {
            "<f8" => Typed::F64(self.data.as_chunks().0.iter().copied().map(f64::from_le_bytes).collect()),
            "<i4" => Typed::I32(self.data.as_chunks().0.iter().copied().map(i32::from_le_bytes).collect()),
            "|b1" => Typed::Bool(self.data.iter().map(|&byte| byte != 0).collect()),
            _ => return None,
        })
    }
}
