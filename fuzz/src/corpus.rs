//! Where inputs are kept: `fuzz/corpus/TARGET`, one file each. What once went wrong begins with the word for it, as
//! libFuzzer names it (`crash-`, `timeout-`), and stays, so that it does not go wrong again.

use std::path::{Path, PathBuf};
use std::{fs, io};

use crate::target::Target;

/// The directory of a target.
#[must_use]
pub fn directory(target: Target) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("corpus")
        .join(target.name())
}

/// Every kept input of a target with its name, in the order of the names.
///
/// # Errors
/// When the directory or a file cannot be read.
pub fn kept(target: Target) -> io::Result<Vec<(String, Vec<u8>)>> {
    let mut kept = Vec::new();
    for path in files(&directory(target), &|_| true)? {
        let name = path.file_name().unwrap_or_default();
        kept.push((name.to_string_lossy().into_owned(), fs::read(&path)?));
    }
    Ok(kept)
}

/// The files below a directory whose name fits, in the order of their paths.
///
/// # Errors
/// When a directory cannot be read.
pub fn files(directory: &Path, fits: &dyn Fn(&Path) -> bool) -> io::Result<Vec<PathBuf>> {
    let mut paths = Vec::new();
    for entry in fs::read_dir(directory)? {
        paths.push(entry?.path());
    }
    paths.sort();
    let mut found = Vec::new();
    for path in paths {
        if path.is_dir() {
            found.extend(files(&path, fits)?);
        } else if fits(&path) {
            found.push(path);
        }
    }
    Ok(found)
}

/// The texts of the repository below a directory whose file names end like that. Nothing when they are not there.
#[must_use]
pub fn repository(directory: &str, ending: &str) -> Vec<String> {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let fits = |path: &Path| path.to_string_lossy().ends_with(ending);
    let paths = files(&top.join(directory), &fits).unwrap_or_default();
    let texts = paths.iter().map(fs::read_to_string);
    texts.filter_map(Result::ok).collect()
}
