//! What happens at the pins of a board, for the tests in the emulator.

use std::collections::BTreeMap;
use std::fmt;
use std::io::{self, BufWriter, Write};

use grafcet::machine::Bench;
use grafcet_compiler::application::VariableSymbol;
use grafcet_compiler::ast::DeclarationKind;
use grafcet_reference::Program;
use grafcet_soak::lockstep::{Failure, Lockstep, Reference};
use grafcet_soak::subject::{Kind, Refused, Subject};

use crate::Name;

/// Times between two looks at timers that have not ended, in scans.
const LOOK_SCANS: u64 = 100;

/// Prints a header and then for each scan the levels of the inputs as they are wired just before it, without anything
/// between them, a space, and the row of the trace on which both interpreters agree.
#[derive(clap::Args)]
pub struct Arguments {
    /// Which program
    program: Name,
    /// What happens
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// For how many scans
    #[arg(long)]
    scans: u64,
    /// By how many scans a filter delays an input, as NAME=SCANS; for inputs that no plant writes
    #[arg(long = "delay", value_name = "NAME=SCANS", value_parser = delay)]
    delays: Vec<(String, u64)>,
}

fn delay(text: &str) -> Result<(String, u64), String> {
    let (name, scans) = text.split_once('=').ok_or("NAME=SCANS is needed")?;
    let scans = scans.parse().map_err(|error| format!("{scans}: {error}"))?;
    Ok((name.to_owned(), scans))
}

/// Why the printing ended too early.
#[derive(Debug)]
pub enum Stopped {
    Output(io::Error),
    Refused(Refused),
    /// There is no such input, or a plant writes it.
    NotGiven(String),
    Failed(String),
}

impl fmt::Display for Stopped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Stopped::Output(error) => write!(f, "the output: {error}"),
            Stopped::Refused(refused) => write!(f, "{refused}"),
            Stopped::NotGiven(name) => write!(f, "no operator gives an input called {name}"),
            Stopped::Failed(report) => f.write_str(report),
        }
    }
}

impl From<io::Error> for Stopped {
    fn from(error: io::Error) -> Self {
        Stopped::Output(error)
    }
}

/// Prints it.
pub fn run(arguments: &Arguments) -> Result<(), Stopped> {
    let subject = arguments.program.subject();
    let application = subject.application().map_err(Stopped::Refused)?;
    let variables = &application.controller.symbols.variables;
    let is_input = |variable: &&VariableSymbol| variable.kind == DeclarationKind::Input;
    let inputs: Vec<&VariableSymbol> = variables.iter().filter(is_input).collect();
    let mut given = given(subject, &inputs);
    let (bench, tree) = (Bench::new(), subject.tree());
    let program = Program::new(&tree, &[]);
    let mut lockstep = Lockstep::new(
        subject,
        &bench,
        &application,
        &program,
        Reference::EveryScan,
        arguments.seed,
        delays(&arguments.delays, &given)?,
    );
    let mut out = BufWriter::new(io::stdout().lock());
    let names: Vec<&str> = inputs.iter().map(|input| input.name.as_str()).collect();
    writeln!(out, "{} {}", names.join(","), lockstep.header())?;
    for scan in 0..arguments.scans {
        let failed = |lockstep: &Lockstep<'_>, failure: &Failure| {
            Stopped::Failed(format!(
                "seed {}: {}",
                arguments.seed,
                lockstep.report(failure)
            ))
        };
        match lockstep.scan() {
            Ok((_, acts)) => {
                for act in acts {
                    if let (Some(level), Some(value)) = (given.get_mut(act.what), act.value) {
                        *level = value;
                    }
                }
            }
            Err(failure) => return Err(failed(&lockstep, &failure)),
        }
        if scan % LOOK_SCANS == 0
            && let Err(failure) = lockstep.look_at_timers()
        {
            return Err(failed(&lockstep, &failure));
        }
        for input in &inputs {
            let seen = || lockstep.input(input.slot) != 0;
            let level = given.get(input.name.as_str()).copied();
            write!(out, "{}", u8::from(level.unwrap_or_else(seen)))?;
        }
        writeln!(out, " {}", lockstep.row())?;
    }
    out.flush()?;
    Ok(())
}

/// The inputs that operators alone give, at their usual levels.
fn given(subject: Subject, inputs: &[&VariableSymbol]) -> BTreeMap<&'static str, bool> {
    let habits = subject.habits().iter();
    habits
        .filter(|habit| habit.kind == Kind::Given)
        .filter(|habit| inputs.iter().any(|input| input.name == habit.what))
        .map(|habit| (habit.what, habit.usual))
        .collect()
}

fn delays(
    asked: &[(String, u64)],
    given: &BTreeMap<&'static str, bool>,
) -> Result<BTreeMap<&'static str, u64>, Stopped> {
    let delay = |(name, scans): &(String, u64)| {
        let input = given.get_key_value(name.as_str());
        let (name, _) = input.ok_or_else(|| Stopped::NotGiven(name.clone()))?;
        Ok((*name, *scans))
    };
    asked.iter().map(delay).collect()
}
