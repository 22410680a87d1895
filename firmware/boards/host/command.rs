//! The command line of the soft PLC.

use std::cell::Cell;
use std::io::{self, BufReader};
use std::path::{Path, PathBuf};
use std::process::{self, ExitCode};
use std::rc::Rc;
use std::{env, fs};

use clap::Parser;
use embassy_executor::Executor;
use embassy_futures::select::{Either, select};
use embassy_time::{Duration, Timer};
use static_cell::StaticCell;

use super::clock::simulate;
use super::lines;
use super::machine::{Machine, Parts};
use super::script::Outcome;
use super::server::{Terminals, serve};
use super::soft_plc;
use crate::application::{
    ANALOGUE_INPUTS, ANALOGUE_LABELS, DEMONSTRATION, INPUT_LABELS, INPUTS, NAMES, OUTPUT_LABELS,
    OUTPUTS, PLANTS, PROGRAM,
};

/// How long a program without a demonstration runs in simulated time, unless said.
const UNSCRIPTED: Duration = Duration::from_secs(60);

/// Runs the control program of this image as a soft PLC: the tasks and tables of the firmware, on this computer,
/// against the plants of the program. If the program has a test named "demonstration", it is played.
#[derive(Parser)]
#[command(version, after_help = HELP)]
struct Arguments {
    /// Run in simulated time: as fast as it goes, and with the same times in every line
    #[arg(long)]
    fast: bool,

    /// Stop after so many seconds [default: with the demonstration, or never]
    #[arg(long = "for", value_name = "SECONDS", value_parser = clap::value_parser!(u64).range(..=1_000_000_000))]
    seconds: Option<u64>,

    /// Keep retained variables and parameters in this file [default: one that is gone afterwards]
    #[arg(long, value_name = "FILE")]
    retain: Option<PathBuf>,

    /// Be the plants for a controller that runs elsewhere: answer lines on standard input
    #[arg(long, conflicts_with_all = ["fast", "seconds", "retain"])]
    plant_server: bool,
}

const HELP: &str = "\
Each line begins with the time in seconds:
  -- TEXT                 what happens around the controller
  inputs, outputs         what changed at its terminals; of a number, each eighth of its scale
  GRAPH T7: {3} -> {5}    a transition that fired, the steps it left and entered

Exit codes: 0 all went as claimed, 1 the demonstration failed, 2 wrong usage or a file that cannot be used.";

/// Runs the command line of this process.
#[must_use]
pub fn run() -> ExitCode {
    let arguments = Arguments::parse();
    let machine = Machine::new(Parts {
        period_ms: PROGRAM.period_ms,
        inputs: &INPUTS,
        analogue: &ANALOGUE_INPUTS,
        analogue_labels: &ANALOGUE_LABELS,
        outputs: &OUTPUTS,
        plants: &PLANTS,
        script: DEMONSTRATION.as_ref(),
    });
    if arguments.plant_server {
        return serve_plants(machine);
    }
    let (path, temporary) = match &arguments.retain {
        Some(path) => (path.clone(), false),
        None => (
            env::temp_dir().join(format!("plc-{}.retain", process::id())),
            true,
        ),
    };
    let ended = play(machine, &path, &arguments);
    if temporary {
        // When it cannot be removed, the system's own cleaning of its directory does it.
        let _ = fs::remove_file(&path);
    }
    match ended {
        Ok(Some(Outcome::Failed(text))) => {
            eprintln!("error: the demonstration failed at: {text}");
            ExitCode::from(1)
        }
        Ok(Some(Outcome::Held) | None) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: cannot use {}: {error}", path.display());
            ExitCode::from(2)
        }
    }
}

fn play(machine: Machine, retain: &Path, arguments: &Arguments) -> io::Result<Option<Outcome>> {
    let mut limit = arguments.seconds.map(Duration::from_secs);
    lines::show(format_args!(
        "{}: the soft PLC, {} time",
        NAMES.application,
        if arguments.fast { "simulated" } else { "real" }
    ));
    if arguments.fast {
        if DEMONSTRATION.is_none() {
            limit = limit.or(Some(UNSCRIPTED));
        }
        // A PLC always waits for its next scan at least, so that time never stands still.
        return simulate(limited(machine, retain.to_owned(), limit)).unwrap_or(Ok(None));
    }
    static EXECUTOR: StaticCell<Executor> = StaticCell::new();
    let ended = Rc::new(Cell::new(None));
    let end = ended.clone();
    let task = soft_plc(machine, retain.to_owned(), limit, ended.clone());
    EXECUTOR.init(Executor::new()).run_until(
        |spawner| match task {
            Ok(task) => spawner.spawn(task),
            Err(_) => ended.set(Some(Ok(None))),
        },
        || {
            let value = end.take();
            let over = value.is_some();
            end.set(value);
            over
        },
    );
    end.take().unwrap_or(Ok(None))
}

#[embassy_executor::task]
async fn soft_plc(
    machine: Machine,
    retain: PathBuf,
    limit: Option<Duration>,
    ended: Rc<Cell<Option<io::Result<Option<Outcome>>>>>,
) {
    ended.set(Some(limited(machine, retain, limit).await));
}

/// Runs the soft PLC to its end, or for so long. None when time was over first.
async fn limited(
    machine: Machine,
    retain: PathBuf,
    limit: Option<Duration>,
) -> io::Result<Option<Outcome>> {
    let plc = soft_plc::run(machine, &retain);
    let Some(limit) = limit else {
        return plc.await.map(Some);
    };
    match select(plc, Timer::after(limit)).await {
        Either::First(ended) => ended.map(Some),
        Either::Second(()) => Ok(None),
    }
}

fn serve_plants(mut machine: Machine) -> ExitCode {
    let terminals = Terminals {
        period_ms: PROGRAM.period_ms,
        layout: &PROGRAM.layout,
        inputs: &INPUTS,
        input_labels: &INPUT_LABELS,
        analogue_labels: &ANALOGUE_LABELS,
        outputs: &OUTPUTS,
        output_labels: &OUTPUT_LABELS,
    };
    let (requests, answers) = (BufReader::new(io::stdin()), io::stdout().lock());
    match serve(&mut machine, &terminals, requests, answers) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}
