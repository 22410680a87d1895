//! From the path of a `plc.toml` to all that an image is made of.

use std::cell::RefCell;
use std::io;
use std::path::Path;

use grafcet_compiler::application::Application;
use grafcet_compiler::diagnostic::{self, Level};
use grafcet_compiler::render::{Style, render};
use grafcet_compiler::source::Sources;
use grafcet_compiler::{Compilation, Target, compile};

use crate::check::{Wiring, check};
use crate::file::{self, PlcFile, application_path};
use crate::rule::{Diagnostic, Rule};

/// What became of a `plc.toml`.
#[derive(Debug)]
pub struct Loaded {
    /// Every file that was read or looked for: the `plc.toml`, the program and its libraries.
    pub files: Vec<String>,
    /// The texts, for showing diagnostics.
    pub sources: Sources,
    /// What there is to say about the program, warnings too.
    pub program: Vec<diagnostic::Diagnostic>,
    /// What is wrong with the `plc.toml`.
    pub wiring: Vec<Diagnostic>,
    /// The program and its wiring, when there is no error in either.
    pub image: Option<(Application, Wiring)>,
}

impl Loaded {
    /// Everything that is wrong, as a person reads it, the `plc.toml` first.
    #[must_use]
    pub fn errors(&self) -> String {
        let wiring = render(&self.wiring, &self.sources, Style::default());
        wiring + &self.of_program(Level::Error)
    }

    /// What the compiler warns of, as a person reads it.
    #[must_use]
    pub fn warnings(&self) -> String {
        self.of_program(Level::Warning)
    }

    fn of_program(&self, level: Level) -> String {
        let program = self.program.iter().filter(|it| it.level() == level);
        let program: Vec<_> = program.cloned().collect();
        render(&program, &self.sources, Style::default())
    }
}

/// Reads a `plc.toml`, compiles its program and checks the one against the other.
///
/// # Errors
/// When the file itself cannot be read. Everything else is a diagnostic.
pub fn load(path: &str) -> io::Result<Loaded> {
    load_from(path, &|path| std::fs::read_to_string(path))
}

/// The same over files that `read` knows.
///
/// # Errors
/// When the file itself cannot be read. Everything else is a diagnostic.
pub fn load_from(path: &str, read: &dyn Fn(&str) -> io::Result<String>) -> io::Result<Loaded> {
    let text = read(path)?;
    let files = RefCell::new(vec![path.to_owned()]);
    let read = |path: String| {
        files.borrow_mut().push(path.clone());
        read(&path)
    };
    let compiled = application_path(&text).map(|program| {
        let program = beside(path, &program);
        let text = read(program.clone())?;
        let load = |library: &str| read(beside(&program, library));
        Ok(compile(&program, &text, &load, Target::Firmware))
    });
    let (compilation, unread) = match compiled {
        Some(Ok(compilation)) => (Some(compilation), None),
        Some(Err(error)) => (None, Some(error)),
        None => (None, None),
    };
    Ok(finish(path, &text, files.into_inner(), compilation, unread))
}

fn finish(
    path: &str,
    text: &str,
    files: Vec<String>,
    compilation: Option<Compilation>,
    unread: Option<io::Error>,
) -> Loaded {
    let (mut sources, program, application) = match compilation {
        Some(it) => (it.sources, it.diagnostics, it.application),
        None => (Sources::default(), Vec::new(), None),
    };
    let (file, mut wiring) = file::read(text, sources.add(path, text));
    let mut checked = None;
    if let Some(file) = &file {
        wiring.extend(unread.and_then(|error| no_application(file, &error)));
        let (sound, found) = check(file, application.as_ref());
        wiring.extend(found);
        checked = sound;
    }
    let image = application.zip(checked).filter(|_| wiring.is_empty());
    Loaded {
        files,
        sources,
        program,
        wiring,
        image,
    }
}

fn no_application(file: &PlcFile, error: &io::Error) -> Option<Diagnostic> {
    let path = file.application.as_ref()?;
    let reason = match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        _ => error.to_string(),
    };
    let message = format!("the program `{}` cannot be read: {reason}", path.value);
    Some(
        Diagnostic::new(Rule::NoApplication, path.span, message)
            .help("the path begins in the directory of this file"),
    )
}

/// A path that is relative to the directory of a file.
fn beside(file: &str, path: &str) -> String {
    match Path::new(file).parent() {
        Some(directory) => directory.join(path).to_string_lossy().into_owned(),
        None => path.to_owned(),
    }
}
