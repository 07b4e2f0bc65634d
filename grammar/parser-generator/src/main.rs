//! Writes a tree-sitter parser: `m3d-parser-generator GRAMMAR OUT` makes `parser.c`, `node-types.json`, `grammar.json`
//! and the headers in the folder OUT. GRAMMAR is `grammar.js` (read by node) or `src/grammar.json` (read as it is).

use std::process::ExitCode;

use tree_sitter_generate::{OptLevel, generate_parser_in_directory};

/// The version of the parser tables' layout: the newest one that the Python bindings read.
const ABI: usize = 15;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [grammar, out] = arguments.as_slice() else {
        eprintln!("usage: m3d-parser-generator GRAMMAR OUT");
        return ExitCode::from(2);
    };
    let mut remarks = Vec::new();
    let written = generate_parser_in_directory(
        ".",
        Some(out),
        Some(grammar),
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
            eprintln!("{grammar}: {error}");
            ExitCode::FAILURE
        }
    }
}
