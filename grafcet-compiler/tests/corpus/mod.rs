//! The programs of the repository, right and wrong ones, taken apart and put together otherwise.

use std::fs;
use std::path::{Path, PathBuf};

/// Every file below a directory whose name ends so, in a fixed order.
pub fn files(directory: &Path, extension: &str) -> Vec<PathBuf> {
    let mut paths: Vec<PathBuf> = fs::read_dir(directory)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    let mut found = Vec::new();
    for path in paths {
        if path.is_dir() {
            found.extend(files(&path, extension));
        } else if path.extension().is_some_and(|it| it == extension) {
            found.push(path);
        }
    }
    found
}

/// The control programs, and the small programs that break one rule each.
pub fn programs() -> Vec<String> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut paths = files(&here.join("../graphs"), "grafcet");
    paths.extend(files(&here.join("tests/rules"), "txt"));
    let mut programs = Vec::new();
    for path in paths {
        let text = fs::read_to_string(path).unwrap();
        programs.extend(text.split("== ").map(str::to_owned));
    }
    programs.retain(|program| program.len() > 20);
    programs
}

/// Words, signs and the white space between them.
pub fn pieces(text: &str) -> Vec<&str> {
    let mut pieces = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word = |c: char| c.is_alphanumeric() || c == '_';
        let end = if word(first) {
            rest.find(|c| !word(c)).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let (piece, behind) = rest.split_at(end);
        pieces.push(piece);
        rest = behind;
    }
    pieces
}
