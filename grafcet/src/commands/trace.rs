//! `grafcet trace`: a program run on a stimulus, scan by scan.

use std::fs::File;
use std::io::{self, BufWriter};
use std::path::PathBuf;

use clap::Args;
use grafcet::machine::Bench;
use grafcet::simulation::Simulation;
use grafcet::stimulus::Stimulus;
use grafcet::trace;
use grafcet_compiler::application::Application;

use super::{CommandError, Verdict, accepted};

/// Run a program on a stimulus and print what every scan leaves, as CSV
#[derive(Args)]
#[command(after_help = "\
The stimulus is CSV: a column time_ms, and one for each input or parameter that is given.
A row holds from its time on; an empty cell keeps the value. Inputs without a column are 0,
or what a plant writes.

  time_ms,start,delay
  0,0,2000
  50,1,

Examples:
  grafcet trace drill.grafcet --stimulus drill.csv
  grafcet trace drill.grafcet --with Press --until 10000 -o drill.trace.csv")]
pub struct Arguments {
    /// The program
    file: PathBuf,
    /// What inputs and parameters are given, and when
    #[arg(long, value_name = "CSV", required_unless_present = "until")]
    stimulus: Option<PathBuf>,
    /// Time of the last scan in ms [default: the last row of the stimulus]
    #[arg(long, value_name = "MS")]
    until: Option<u64>,
    /// A plant that runs with the controller; may be given more than once
    #[arg(long, value_name = "PLANT")]
    with: Vec<String>,
    /// Where to write the trace [default: standard output]
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
}

/// Traces a program that is accepted.
pub fn run(arguments: &Arguments) -> Result<Verdict, CommandError> {
    let Some((_, application)) = accepted(&arguments.file)? else {
        return Ok(Verdict::Bad);
    };
    let plants = plants(&application, &arguments.with)?;
    let stimulus = stimulus(&application, arguments)?;
    let until_ms = arguments.until.unwrap_or(stimulus.end_ms());
    let bench = Bench::new();
    let simulation = Simulation::new(&bench, &application, &plants);
    let unit = &application.controller;
    match &arguments.output {
        Some(path) => File::create(path)
            .and_then(|file| trace::write(unit, simulation, &stimulus, until_ms, file))
            .map_err(CommandError::file(path))?,
        None => {
            let out = BufWriter::new(io::stdout().lock());
            trace::write(unit, simulation, &stimulus, until_ms, out)?;
        }
    }
    Ok(Verdict::Good)
}

/// The indices of the plants with these names.
fn plants(application: &Application, names: &[String]) -> Result<Vec<usize>, CommandError> {
    let index = |name: &String| {
        let mut plants = application.plants.iter();
        plants.position(|plant| plant.name == *name).ok_or_else(|| {
            let known: Vec<&str> = application.plants.iter().map(|p| p.name.as_str()).collect();
            CommandError::Usage(match known.as_slice() {
                [] => format!("no plant is called `{name}`: the program has none"),
                _ => format!("no plant is called `{name}`; there is {}", known.join(", ")),
            })
        })
    };
    names.iter().map(index).collect()
}

fn stimulus(application: &Application, arguments: &Arguments) -> Result<Stimulus, CommandError> {
    let Some(path) = &arguments.stimulus else {
        return Ok(Stimulus::default());
    };
    let file = File::open(path).map_err(CommandError::file(path))?;
    Stimulus::read(file, &application.controller.symbols).map_err(|error| CommandError::Stimulus {
        path: path.clone(),
        error,
    })
}
