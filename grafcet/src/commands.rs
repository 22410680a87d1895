//! The subcommands, and what they have in common.

pub mod bound;
pub mod check;
pub mod fmt;
pub mod symbols;
pub mod test;
pub mod trace;

use std::fmt::{Display, Formatter};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anstyle::{AnsiColor, Style};
use grafcet::stimulus::StimulusError;
use grafcet_compiler::application::Application;
use grafcet_compiler::diagnostic::{Diagnostic, Level};
use grafcet_compiler::render::{self, render};
use grafcet_compiler::source::Sources;
use grafcet_compiler::{Compilation, Target};

pub const RED: Style = AnsiColor::Red.on_default().bold();
pub const GREEN: Style = AnsiColor::Green.on_default();

/// With colours: the streams take them out where no terminal shows them.
pub const STYLE: render::Style = render::Style { color: true };

/// What a command found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// All is well.
    Good,
    /// A program is refused, or a test failed.
    Bad,
}

/// Why a command could not do its work.
#[derive(Debug)]
pub enum CommandError {
    /// A file cannot be read or written.
    File {
        /// The file.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
    /// A stimulus is wrong.
    Stimulus {
        /// The file.
        path: PathBuf,
        /// What is wrong where.
        error: StimulusError,
    },
    /// The arguments ask for something that is not there.
    Usage(String),
    /// The layout of a file would not say what the file says: a defect of the formatter.
    Layout(PathBuf),
    /// Standard output does not take any more.
    Output(io::Error),
}

impl CommandError {
    /// For `map_err` on what is done with a file.
    pub fn file(path: &Path) -> impl FnOnce(io::Error) -> CommandError {
        let path = path.to_owned();
        move |error| CommandError::File { path, error }
    }
}

impl From<io::Error> for CommandError {
    fn from(error: io::Error) -> Self {
        CommandError::Output(error)
    }
}

impl Display for CommandError {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            CommandError::File { path, error } => {
                write!(f, "{}: {}", path.display(), reason(error))
            }
            CommandError::Stimulus { path, error } => {
                write!(f, "{}:{}: {error}", path.display(), error.line)
            }
            CommandError::Usage(text) => f.write_str(text),
            CommandError::Layout(path) => write!(
                f,
                "{}: left as it is: in its new layout it would be read otherwise, please report this",
                path.display()
            ),
            CommandError::Output(error) => write!(f, "standard output: {}", reason(error)),
        }
    }
}

/// What went wrong, without the number that the operating system has for it.
fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        io::ErrorKind::IsADirectory => "is a directory".to_owned(),
        io::ErrorKind::InvalidData => "is not UTF-8 text".to_owned(),
        _ => error.to_string(),
    }
}

/// Says on standard error, in one line, why a command could not do its work.
pub fn complain(error: &CommandError) {
    // Where even this cannot be said, the exit code still says it.
    let _ = writeln!(anstream::stderr(), "{RED}error{RED:#}: {error}");
}

/// Compiles a file.
pub fn compile(path: &Path, target: Target) -> Result<Compilation, CommandError> {
    grafcet::source::compile(path, target).map_err(CommandError::file(path))
}

/// Compiles a file; when it is refused, the errors are said on standard error and there is no application.
pub fn accepted(path: &Path) -> Result<Option<(Sources, Application)>, CommandError> {
    let compilation = compile(path, Target::Host)?;
    if let Some(application) = compilation.application {
        return Ok(Some((compilation.sources, application)));
    }
    let errors: Vec<Diagnostic> = compilation
        .diagnostics
        .into_iter()
        .filter(|diagnostic| diagnostic.level() == Level::Error)
        .collect();
    // The exit code says it again.
    let _ = write!(
        anstream::stderr(),
        "{}",
        render(&errors, &compilation.sources, STYLE)
    );
    Ok(None)
}
