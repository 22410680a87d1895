//! Imports: libraries of templates, each read once.

use std::collections::BTreeSet;
use std::io;

use crate::ast;
use crate::diagnostic::{Diagnostic, Rule};
use crate::source::Sources;

/// Parses the main file and every library that it imports, directly or not. Paths are relative to the file that
/// imports; `load` gets them relative to the directory of the main file, with `/` between their parts.
pub(crate) fn load(
    path: &str,
    text: &str,
    load: &dyn Fn(&str) -> io::Result<String>,
    sources: &mut Sources,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<ast::File> {
    let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
    let mut paths = vec![name.to_owned()];
    let mut seen = BTreeSet::from([plain(name)]);
    let main = sources.add(path, text);
    let mut files = vec![crate::parse(main, text, diagnostics)];
    let mut next = 0;
    while next < files.len() {
        for import in files[next].imports.clone() {
            let library = join(&paths[next], &import.text);
            if !seen.insert(plain(&library)) {
                continue;
            }
            let shown = join(path, &library);
            match load(&library) {
                Ok(text) => {
                    let file = sources.add(shown, text.clone());
                    files.push(crate::parse(file, &text, diagnostics));
                    paths.push(library);
                }
                Err(error) => {
                    let message =
                        format!("the library `{shown}` cannot be read: {}", reason(&error));
                    let diagnostic = Diagnostic::new(Rule::UnknownName, import.span, message)
                        .help("the path is relative to this file");
                    diagnostics.push(diagnostic);
                }
            }
        }
        next += 1;
    }
    files
}

/// The same words on every system.
fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        io::ErrorKind::InvalidData => "it is not UTF-8 text".to_owned(),
        io::ErrorKind::IsADirectory => "it is a directory".to_owned(),
        _ => error.to_string(),
    }
}

/// The path of a library from the path of the file that imports it.
fn join(from: &str, import: &str) -> String {
    if import.starts_with('/') {
        return import.to_owned();
    }
    match from.rsplit_once(['/', '\\']) {
        Some((directory, _)) => format!("{directory}/{import}"),
        None => import.to_owned(),
    }
}

/// A path without `.` and inner `..`, by which a file is known again.
fn plain(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split(['/', '\\']) {
        match part {
            "." => {}
            ".." if parts
                .last()
                .is_some_and(|last| *last != ".." && !last.is_empty()) =>
            {
                parts.pop();
            }
            _ => parts.push(part),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_import_is_relative_to_its_file() {
        assert_eq!(
            join("plant/main.grafcet", "lib/saw.grafcet"),
            "plant/lib/saw.grafcet"
        );
        assert_eq!(join("main.grafcet", "saw.grafcet"), "saw.grafcet");
        assert_eq!(
            join("plant/main.grafcet", "/lib/saw.grafcet"),
            "/lib/saw.grafcet"
        );
    }

    #[test]
    fn one_file_by_two_paths_is_one_file() {
        assert_eq!(plain("a/./b/../c.grafcet"), plain("a/c.grafcet"));
        assert_eq!(plain("../a/b.grafcet"), "../a/b.grafcet");
        assert_eq!(plain("/../a"), "/../a");
    }
}
