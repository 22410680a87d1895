//! `grafcet fmt`: the one layout of a program's text.

use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use anstyle::Style;
use clap::Args;
use grafcet_compiler::format::{Unformatted, format};
use grafcet_compiler::render::render;
use grafcet_compiler::source::{FileId, Sources};
use similar::{ChangeTag, TextDiff};
use tempfile::NamedTempFile;

use super::{CommandError, GREEN, RED, STYLE, Verdict, complain};

/// Lay programs out in the one canonical way
///
/// Only white space changes. A file with errors of syntax is left as it is.
#[derive(Args)]
#[command(after_help = "\
Examples:
  grafcet fmt press.grafcet
  grafcet fmt --check graphs/*.grafcet
  grafcet fmt - < press.grafcet

Exit codes: 0 all is well, 1 a file does not fit the grammar (with --check: or has another
layout), 2 a file cannot be read or written.")]
pub struct Arguments {
    /// Programs; - reads standard input and writes standard output
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Write nothing; show what would change, and exit with 1 if anything would
    #[arg(long)]
    check: bool,
}

/// What is to be done with a text.
enum Text {
    /// Nothing.
    Right,
    /// To be replaced.
    Another(String),
    /// It is refused, and the reason said.
    Refused,
}

/// Lays out every file, also behind one that cannot be read.
pub fn run(arguments: &Arguments) -> Result<Verdict, CommandError> {
    let mut out = anstream::stdout().lock();
    let mut verdict = Verdict::Good;
    let mut unusable = None;
    for path in &arguments.files {
        let done = if path == Path::new("-") {
            standard(arguments.check, &mut out)
        } else {
            file(path, arguments.check, &mut out)
        };
        match done {
            Ok(Verdict::Good) => {}
            Ok(Verdict::Bad) => verdict = Verdict::Bad,
            Err(error @ CommandError::Output(_)) => return Err(error),
            Err(error) => {
                if let Some(before) = unusable.replace(error) {
                    complain(&before);
                }
            }
        }
    }
    unusable.map_or(Ok(verdict), Err)
}

fn standard(check: bool, out: &mut dyn Write) -> Result<Verdict, CommandError> {
    let name = Path::new("<standard input>");
    let mut text = String::new();
    let read = io::stdin().lock().read_to_string(&mut text);
    read.map_err(CommandError::file(name))?;
    match (laid_out(name, &text)?, check) {
        (Text::Refused, _) => Ok(Verdict::Bad),
        (Text::Right, true) => Ok(Verdict::Good),
        (Text::Another(new), true) => show(name, &text, &new, out),
        (Text::Right, false) => {
            out.write_all(text.as_bytes())?;
            Ok(Verdict::Good)
        }
        (Text::Another(new), false) => {
            out.write_all(new.as_bytes())?;
            Ok(Verdict::Good)
        }
    }
}

fn file(path: &Path, check: bool, out: &mut dyn Write) -> Result<Verdict, CommandError> {
    let text = fs::read_to_string(path).map_err(CommandError::file(path))?;
    match laid_out(path, &text)? {
        Text::Refused => Ok(Verdict::Bad),
        Text::Right => Ok(Verdict::Good),
        Text::Another(new) if check => show(path, &text, &new, out),
        Text::Another(new) => {
            replace(path, &new).map_err(CommandError::file(path))?;
            Ok(Verdict::Good)
        }
    }
}

/// A text in its layout; what is wrong with it is said on standard error.
fn laid_out(path: &Path, text: &str) -> Result<Text, CommandError> {
    match format(FileId(0), text) {
        Ok(new) if new == text => Ok(Text::Right),
        Ok(new) => Ok(Text::Another(new)),
        Err(Unformatted::Wrong(diagnostics)) => {
            let mut sources = Sources::default();
            sources.add(path.to_string_lossy(), text);
            // The exit code says it again.
            let _ = write!(
                anstream::stderr(),
                "{}",
                render(&diagnostics, &sources, STYLE)
            );
            Ok(Text::Refused)
        }
        Err(Unformatted::Otherwise) => Err(CommandError::Layout(path.to_owned())),
    }
}

/// Shows what would change.
fn show(path: &Path, old: &str, new: &str, out: &mut dyn Write) -> Result<Verdict, CommandError> {
    /// A diff of a long text is only as short as it can be made in that time.
    const PATIENCE: Duration = Duration::from_millis(500);
    writeln!(out, "{} would change:", path.display())?;
    let diff = TextDiff::configure().timeout(PATIENCE).diff_lines(old, new);
    for hunk in diff.unified_diff().context_radius(1).iter_hunks() {
        writeln!(out, "{}", hunk.header())?;
        for change in hunk.iter_changes() {
            let style = match change.tag() {
                ChangeTag::Delete => RED,
                ChangeTag::Insert => GREEN,
                ChangeTag::Equal => Style::new(),
            };
            let line = change.value().trim_end_matches(['\r', '\n']);
            writeln!(out, "{style}{}{line}{style:#}", change.tag())?;
        }
    }
    Ok(Verdict::Bad)
}

/// Writes a file as a whole or not at all; links to it and its permissions stay.
fn replace(path: &Path, text: &str) -> io::Result<()> {
    let path = fs::canonicalize(path)?;
    let permissions = fs::metadata(&path)?.permissions();
    if permissions.readonly() {
        return Err(io::ErrorKind::PermissionDenied.into());
    }
    let mut new = NamedTempFile::new_in(path.parent().unwrap_or(Path::new("")))?;
    new.write_all(text.as_bytes())?;
    new.as_file().set_permissions(permissions)?;
    new.as_file().sync_all()?;
    new.persist(&path)?;
    Ok(())
}
