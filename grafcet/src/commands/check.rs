//! `grafcet check`: what the compiler says.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use grafcet_compiler::Target;
use grafcet_compiler::diagnostic::Level;
use grafcet_compiler::render::{render, render_json};

use super::{CommandError, STYLE, Verdict, compile, complain};

/// Check programs and say what is wrong with them
#[derive(Args)]
#[command(after_help = "\
Examples:
  grafcet check graphs/line_switcher.grafcet
  grafcet check --deny warnings graphs/*.grafcet
  grafcet check --drawing draft.grafcet
  grafcet check --format json press.grafcet | jq .rule

Exit codes: 0 accepted, 1 refused, 2 a file cannot be read.")]
pub struct Arguments {
    /// Programs
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Refuse programs with warnings too
    #[arg(long, value_name = "WHAT")]
    deny: Option<Deny>,
    /// Accept actions and triggers that are only a text (level 1), for graphs that are only drawn
    #[arg(long)]
    drawing: bool,
    /// How to say it; json gives one object a line: rule, level, message, file, line, column, end, help
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Deny {
    Warnings,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Human,
    Json,
}

/// Checks every file, also behind one that cannot be read.
pub fn run(arguments: &Arguments) -> Result<Verdict, CommandError> {
    let mut out = anstream::stdout().lock();
    let (mut errors, mut warnings) = (0, 0);
    let (mut unreadable, mut checked) = (None, false);
    let target = match arguments.drawing {
        true => Target::Drawing,
        false => Target::Host,
    };
    for path in &arguments.files {
        let compilation = match compile(path, target) {
            Ok(compilation) => compilation,
            Err(error) => {
                if let Some(before) = unreadable.replace(error) {
                    complain(&before);
                }
                continue;
            }
        };
        checked = true;
        for diagnostic in &compilation.diagnostics {
            match diagnostic.level() {
                Level::Error => errors += 1,
                Level::Warning => warnings += 1,
            }
        }
        match arguments.format {
            Format::Human => write!(
                out,
                "{}",
                render(&compilation.diagnostics, &compilation.sources, STYLE)
            )?,
            Format::Json => write!(
                out,
                "{}",
                render_json(&compilation.diagnostics, &compilation.sources)
            )?,
        }
    }
    if arguments.format == Format::Human && checked {
        summarise(&mut anstream::stderr(), errors, warnings)?;
    }
    match unreadable {
        Some(error) => Err(error),
        None if errors > 0 => Ok(Verdict::Bad),
        None if warnings > 0 && arguments.deny == Some(Deny::Warnings) => Ok(Verdict::Bad),
        None => Ok(Verdict::Good),
    }
}

fn summarise(to: &mut dyn Write, errors: usize, warnings: usize) -> io::Result<()> {
    let count = |number, what| match number {
        1 => format!("1 {what}"),
        _ => format!("{number} {what}s"),
    };
    writeln!(
        to,
        "{}, {}",
        count(errors, "error"),
        count(warnings, "warning")
    )
}
