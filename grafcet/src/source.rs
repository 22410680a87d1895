//! Programs from files.

use std::fs;
use std::io;
use std::path::Path;

use grafcet_compiler::{Compilation, Target, compile as compile_text};

/// Compiles a file; what it imports is looked for from its own directory on. What is wrong with the program is in
/// the diagnostics.
///
/// # Errors
/// When the file itself cannot be read as UTF-8 text.
pub fn compile(path: &Path, target: Target) -> io::Result<Compilation> {
    let text = fs::read_to_string(path)?;
    let directory = path.parent().unwrap_or(Path::new(""));
    let load = |library: &str| fs::read_to_string(directory.join(library));
    Ok(compile_text(&path.to_string_lossy(), &text, &load, target))
}
