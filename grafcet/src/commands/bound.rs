//! `grafcet bound`: what a scan takes at most.

use std::io::Write;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use grafcet::bound::{Clocks, json, text};

use super::{CommandError, Verdict, accepted};

/// State how long one scan of a program takes at most
#[derive(Args)]
#[command(after_help = "\
The figures are an upper bound of the instructions that any scan behind scan 0 executes, whatever
the inputs do, computed from the program's compiled tables: what every scan does, and for each
graph the steps that take the most of those that can be active together. Microseconds are two
cycles an instruction at the clock. Of a program that evolves `stable` the bound says how many rounds
there are, and is of all of them.

\"flashed\" is code that is compiled as in the image for the Pico; the other rows are compiled as by
script/bench-image. The bound was calibrated by counting, with code and tables in
memory without wait states. It does not cover interrupts, reading and writing pins, the log, writing
to flash, and waiting for code in an external flash (the Pico's).

Examples:
  grafcet bound graphs/line_switcher.grafcet
  grafcet bound --m4-mhz 168 press.grafcet
  grafcet bound --format json press.grafcet | jq .m0plus.instructions

Exit codes: 0 stated, 1 the program is refused, 2 the file cannot be read.")]
pub struct Arguments {
    /// The program
    file: PathBuf,
    /// Clock of the Cortex-M0+ in MHz; 125 is the Pico's
    #[arg(long, value_name = "MHZ", default_value_t = 125, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    m0plus_mhz: u32,
    /// Clock of the Cortex-M4 in MHz; 64 is a slow one
    #[arg(long, value_name = "MHZ", default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    m4_mhz: u32,
    /// How to say it; json gives one object, by processor, with the work counted by kind
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Human,
    Json,
}

/// Prints the bound of a program that is accepted.
pub fn run(arguments: &Arguments) -> Result<Verdict, CommandError> {
    let Some((_, application)) = accepted(&arguments.file)? else {
        return Ok(Verdict::Bad);
    };
    let clocks = Clocks {
        m0plus: arguments.m0plus_mhz,
        m4: arguments.m4_mhz,
    };
    let unit = &application.controller;
    let mut out = anstream::stdout().lock();
    match arguments.format {
        Format::Human => write!(out, "{}", text(unit, clocks))?,
        Format::Json => writeln!(out, "{}", json(unit, clocks))?,
    }
    Ok(Verdict::Good)
}
