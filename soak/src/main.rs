//! `soak`: what `script/soak` runs on x86, and what tells the emulated board what happens at its pins.

#![forbid(unsafe_code)]

mod play;
mod progress;

use std::io::ErrorKind;
use std::process::ExitCode;

use clap::{Parser, Subcommand, ValueEnum};
use grafcet_soak::stretch::{Broken, DAY_MS, Outcome, Pace, Stretch, YEAR_MS};
use grafcet_soak::subject::Subject;

use progress::Progress;

/// Runs the line switcher and the drilling station for long, with random operators, in the engine and in the second
/// interpreter.
#[derive(Parser)]
#[command(version, propagate_version = true, after_help = HELP)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

const HELP: &str = "\
Examples:
  soak days 1                              every scan of a day in both interpreters
  soak years 5 --seed 7 drilling_station   pauses of hours and days are leapt over

Exit codes: 0 they agree and no timer is stuck, 1 something is wrong, 2 wrong usage.";

#[derive(Subcommand)]
enum Command {
    /// Compare the two interpreters in every scan of so many days.
    Days(Long),
    /// The same for years: operators work for minutes and are away for up to twenty days, which is leapt over as soon as the
    /// machine rests; of the other scans the reference is spared those in which nothing is new.
    Years(Long),
    /// Print what happens at the pins of a board, and what it has to make of it, a line for each scan.
    Play(play::Arguments),
}

#[derive(clap::Args)]
struct Long {
    /// For how long: a number such as 30 or 0.5
    #[arg(value_parser = positive)]
    long: f64,
    /// What happens: other numbers are other days
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Which program [default: both, one after the other]
    program: Vec<Name>,
}

/// The programs as they are called.
#[derive(Clone, Copy, ValueEnum)]
#[value(rename_all = "snake_case")]
enum Name {
    LineSwitcher,
    DrillingStation,
}

impl Name {
    fn subject(self) -> Subject {
        match self {
            Name::LineSwitcher => Subject::LineSwitcher,
            Name::DrillingStation => Subject::DrillingStation,
        }
    }
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        // Ten thousand years of milliseconds fit by far.
        Ok(number) if number > 0.0 && number <= 1e4 => Ok(number),
        _ => Err("a number above 0 and up to 10000 is needed".to_owned()),
    }
}

fn main() -> ExitCode {
    match Arguments::parse().command {
        Command::Days(long) => long.run(("days", DAY_MS), Pace::EveryScan),
        Command::Years(long) => long.run(("years", YEAR_MS), Pace::YEARS),
        Command::Play(arguments) => match play::run(&arguments) {
            Ok(()) => ExitCode::SUCCESS,
            // Whoever read our output has seen enough: of a pipe, or of the socket that Node.js makes of one.
            Err(play::Stopped::Output(error))
                if matches!(
                    error.kind(),
                    ErrorKind::BrokenPipe | ErrorKind::ConnectionReset
                ) =>
            {
                ExitCode::SUCCESS
            }
            Err(stopped) => {
                eprintln!("error: {stopped}");
                ExitCode::FAILURE
            }
        },
    }
}

impl Long {
    fn run(&self, (unit, unit_ms): (&str, u64), pace: Pace) -> ExitCode {
        let chosen = self.program.iter().map(|name| name.subject());
        let mut subjects: Vec<Subject> = chosen.collect();
        if subjects.is_empty() {
            subjects = Subject::ALL.to_vec();
        }
        let mut code = ExitCode::SUCCESS;
        for subject in subjects {
            let stretch = Stretch {
                subject,
                seed: self.seed,
                long_ms: (self.long * unit_ms as f64) as u64,
                pace,
            };
            let mut progress = Progress::new(subject.name(), stretch.long_ms, (unit, unit_ms));
            let ended = stretch.run(&mut |now_ms, scans| progress.show(now_ms, scans));
            progress.end();
            match ended {
                Ok(outcome) => print(subject, &outcome, (self.long, unit)),
                Err(broken) => {
                    self.complain(subject, &broken, unit);
                    code = ExitCode::FAILURE;
                }
            }
        }
        code
    }

    fn complain(&self, subject: Subject, broken: &Broken, unit: &str) {
        let Long { long, seed, .. } = self;
        let name = subject.name();
        eprintln!("error: {name}, seed {seed}: {broken}");
        eprintln!("help: script/soak --{unit} {long} --seed {seed} {name} does the same again");
    }
}

fn print(subject: Subject, outcome: &Outcome, (long, unit): (f64, &str)) {
    println!(
        "{}: {long} {unit}, {} scans ({} idle, {} more leapt over), {} transitions fired: both interpreters agree",
        subject.name(),
        outcome.scans,
        outcome.idle,
        outcome.leapt,
        outcome.fired,
    );
    for (step, count, longest_ms) in &outcome.timed {
        println!("  step {step} was left {count} times, after {longest_ms} ms at the latest");
    }
    if !outcome.missing.is_empty() {
        println!("  too short for everything: {}", outcome.missing.join("; "));
    }
}
