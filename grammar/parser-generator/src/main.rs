//! Writes the tree-sitter parser: `parser.c`, `node-types.json`, `grammar.json` and the headers.
//!
//! Without arguments it makes `grammar/src` of `grammar/grammar.js`, which node reads. `m3d-parser-generator GRAMMAR OUT`
//! makes the folder OUT of another file; a `grammar.json` is read without node.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use tree_sitter_generate::{OptLevel, generate_parser_in_directory};

/// The version of the parser tables' layout: the newest one that the Python bindings read.
const ABI: usize = 15;

fn main() -> ExitCode {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let arguments: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let (grammar, out) = match arguments.as_slice() {
        [] => (folder.join("grammar.js"), folder.join("src")),
        [grammar, out] => (grammar.clone(), out.clone()),
        _ => {
            eprintln!("usage: m3d-parser-generator [GRAMMAR OUT]");
            return ExitCode::from(2);
        }
    };
    let mut remarks = Vec::new();
    let written = generate_parser_in_directory(
        folder,
        Some(out),
        Some(grammar.clone()),
        ABI,
        None,
        Some("node"),
        true,
        OptLevel::default(),
        &mut remarks,
    );
    for remark in &remarks {
        eprintln!("{remark}");
    }
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{}: {error}", grammar.display());
            ExitCode::FAILURE
        }
    }
}
