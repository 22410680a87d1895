//! The host tool: checks, lays out, runs, traces and tests GRAFCET programs.
//!
//! Exit codes: 0 all is well, 1 a program is refused or a test failed, 2 the command line or a file is wrong.

#![forbid(unsafe_code)]

mod commands;

use std::io;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use commands::{CommandError, Verdict, bound, check, fmt, symbols, test, trace};

/// Checks, runs and tests GRAFCET programs (IEC 60848) written as text.
#[derive(Parser)]
#[command(version, propagate_version = true, after_help = EXAMPLES)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

const EXAMPLES: &str = "\
Examples:
  grafcet check graphs/*.grafcet
  grafcet test graphs/line_switcher.grafcet
  grafcet fmt --check graphs/*.grafcet
  grafcet trace press.grafcet --stimulus press.csv --with Press --until 10000

Exit codes: 0 all is well, 1 a program is refused or a test failed, 2 wrong usage or a file
that cannot be used.";

#[derive(Subcommand)]
enum Command {
    Check(check::Arguments),
    Fmt(fmt::Arguments),
    Trace(trace::Arguments),
    Test(test::Arguments),
    Bound(bound::Arguments),
    Symbols(symbols::Arguments),
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let verdict = match arguments.command {
        Command::Check(arguments) => check::run(&arguments),
        Command::Fmt(arguments) => fmt::run(&arguments),
        Command::Trace(arguments) => trace::run(&arguments),
        Command::Test(arguments) => test::run(&arguments),
        Command::Bound(arguments) => bound::run(&arguments),
        Command::Symbols(arguments) => symbols::run(&arguments),
    };
    match verdict {
        Ok(Verdict::Good) => ExitCode::SUCCESS,
        Ok(Verdict::Bad) => ExitCode::from(1),
        // Whoever read our output has seen enough.
        Err(CommandError::Output(error)) if error.kind() == io::ErrorKind::BrokenPipe => {
            ExitCode::SUCCESS
        }
        Err(error) => {
            commands::complain(&error);
            ExitCode::from(2)
        }
    }
}
