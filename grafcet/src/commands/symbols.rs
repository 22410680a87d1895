//! `grafcet symbols`: where everything lies in the images.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;

use super::{CommandError, Verdict, accepted};

/// Print where steps and variables lie in the images of a program, as JSON
#[derive(Args)]
#[command(after_help = "\
Example:
  grafcet symbols graphs/line_switcher.grafcet | jq .variables.Locked")]
pub struct Arguments {
    /// The program
    file: PathBuf,
}

/// Prints the symbols of a program that is accepted.
pub fn run(arguments: &Arguments) -> Result<Verdict, CommandError> {
    let Some((_, application)) = accepted(&arguments.file)? else {
        return Ok(Verdict::Bad);
    };
    let mut out = anstream::stdout().lock();
    writeln!(out, "{}", grafcet::symbols::json(&application))?;
    Ok(Verdict::Good)
}
