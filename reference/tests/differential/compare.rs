//! One program in the engine and in the reference, row by row.

use std::collections::BTreeMap;
use std::fmt;

use grafcet::images::Images;
use grafcet::memory::Vectors;
use grafcet::trace::Columns;
use grafcet_compiler::application::{Application, Unit};
use grafcet_compiler::render::{Style, render};
use grafcet_compiler::source::FileId;
use grafcet_compiler::{Target, ast, compile, parse};
use grafcet_core::engine::Engine;
use grafcet_core::program::Slot;
use grafcet_reference::{Machine, Program, Qualified};

use crate::stimulus::{Scan, full_name};

/// What a comparison has come upon.
#[derive(Debug)]
pub enum Failure {
    /// The compiler refuses the program.
    Refused(String),
    /// The headers differ.
    Header {
        engine: Vec<String>,
        reference: Vec<String>,
    },
    /// The rows differ, for the first time in this scan.
    Row {
        scan: usize,
        differences: Vec<String>,
    },
    /// One of both has panicked.
    Panic(String),
}

impl Failure {
    /// Whether another failure is of the same kind, so that shrinking stays with one fault.
    pub fn is_like(&self, other: &Failure) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Refused(diagnostics) => write!(f, "the compiler refuses it:\n{diagnostics}"),
            Failure::Header { engine, reference } => {
                write!(f, "the headers differ:\n{engine:?}\n{reference:?}")
            }
            Failure::Row { scan, differences } => {
                write!(
                    f,
                    "scan {scan} differs (engine, reference): {}",
                    differences.join("; ")
                )
            }
            Failure::Panic(message) => write!(f, "a panic: {message}"),
        }
    }
}

/// What was seen of the engine at work.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    pub programs: usize,
    pub scans: usize,
    pub transitions: usize,
    /// Transitions that fired at least once.
    pub fired: usize,
    pub steps: usize,
    /// Steps that were active after a scan at least once.
    pub active: usize,
    /// Scans times graphs under a forcing order.
    pub forced: usize,
    /// Programs in which a calculation went wrong.
    pub with_faults: usize,
}

impl Tally {
    pub fn add(&mut self, other: Tally) {
        self.programs += other.programs;
        self.scans += other.scans;
        self.transitions += other.transitions;
        self.fired += other.fired;
        self.steps += other.steps;
        self.active += other.active;
        self.forced += other.forced;
        self.with_faults += other.with_faults;
    }
}

/// The syntax tree of a program that is known to be well-formed.
pub fn tree(text: &str) -> ast::File {
    parse(FileId(0), text, &mut Vec::new())
}

/// Compiles a program.
pub fn application(text: &str) -> Result<Application, Failure> {
    let missing = |_: &str| Err(std::io::ErrorKind::NotFound.into());
    let compilation = compile("random.grafcet", text, &missing, Target::Host);
    let errors: Vec<_> = compilation
        .diagnostics
        .iter()
        .filter(|d| d.level() == grafcet_compiler::diagnostic::Level::Error)
        .cloned()
        .collect();
    let refused = || Failure::Refused(render(&errors, &compilation.sources, Style::default()));
    let application = compilation.application.clone().ok_or_else(refused)?;
    match application.controller.tables.program().unsoundness() {
        None => Ok(application),
        Some(fault) => Err(Failure::Refused(format!("unsound tables: {fault:?}"))),
    }
}

/// Runs a program in both and compares every row.
pub fn compare(text: &str, stimulus: &[Scan]) -> Result<Tally, Failure> {
    let run = || -> Result<Tally, Failure> {
        let application = application(text)?;
        let tree = tree(text);
        let reference = Program::new(&tree, &[]);
        Comparison::run(&application.controller, &reference, stimulus)
    };
    std::panic::catch_unwind(run).unwrap_or_else(|panic| {
        let message = panic
            .downcast_ref::<String>()
            .cloned()
            .or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned()));
        Err(Failure::Panic(message.unwrap_or_default()))
    })
}

struct Comparison<'a> {
    unit: &'a Unit,
    slots: BTreeMap<&'a str, Slot>,
    columns: Columns<'a>,
    reference: &'a Program<'a>,
    inputs: BTreeMap<String, Qualified<'a>>,
    parameters: BTreeMap<String, Qualified<'a>>,
}

impl<'a> Comparison<'a> {
    fn run(
        unit: &'a Unit,
        reference: &'a Program<'a>,
        stimulus: &[Scan],
    ) -> Result<Tally, Failure> {
        let named = |names: Vec<Qualified<'a>>| -> BTreeMap<String, Qualified<'a>> {
            let names = names.into_iter();
            names.map(|name| (full_name(name), name)).collect()
        };
        let comparison = Comparison {
            unit,
            slots: unit
                .symbols
                .variables
                .iter()
                .map(|v| (v.name.as_str(), v.slot))
                .collect(),
            columns: Columns::of(unit),
            inputs: named(reference.inputs()),
            parameters: named(reference.parameters()),
            reference,
        };
        comparison.compare(stimulus)
    }

    fn compare(&self, stimulus: &[Scan]) -> Result<Tally, Failure> {
        let engine: Vec<String> = self.columns.header().map(str::to_owned).collect();
        let reference = self.reference.header();
        if engine != reference {
            return Err(Failure::Header { engine, reference });
        }
        let tables = self.unit.tables.program();
        let mut vectors = Vectors::new(&tables);
        let mut engine = Engine::new(&tables, vectors.memory());
        let mut machine = Machine::new(self.reference);
        let mut inputs: BTreeMap<&str, i32> = BTreeMap::new();
        let mut seen = Seen::default();
        let mut time_ms = 0;
        let mut started = false;
        for (number, scan) in stimulus.iter().enumerate() {
            if let Some(recovered) = scan.power_cycle {
                let names = self.reference.retained().into_iter();
                let kept: Vec<(Qualified<'a>, i32)> = names
                    .filter_map(|name| Some((name, machine.value(name)?.number())))
                    .collect();
                machine = Machine::new(self.reference);
                machine.set_recovered(recovered);
                drop(engine);
                vectors = Vectors::new(&tables);
                engine = Engine::new(&tables, vectors.memory());
                for (name, value) in kept {
                    machine.restore(name, value);
                    engine.restore(self.slots[full_name(name).as_str()], value);
                }
                engine.set_recovered(recovered);
                started = false;
            }
            if let Some(overruns) = scan.overruns {
                machine.set_overruns(overruns as i32);
                engine.set_overruns(overruns);
            }
            for (name, value) in &scan.given {
                if self.inputs.contains_key(name) {
                    inputs.insert(name, *value);
                } else if let Some(parameter) = self.parameters.get(name) {
                    machine.set(*parameter, *value);
                    engine.set_parameter(self.slots[name.as_str()], *value);
                }
            }
            for (name, value) in &inputs {
                machine.set(self.inputs[*name], *value);
                match self.slots[*name] {
                    Slot::Bit(bit) => engine.set_input(bit, *value != 0),
                    Slot::Number(number) => engine.sample_number(number, *value),
                }
            }
            if started {
                time_ms += scan.periods * self.reference.period_ms;
                engine.scan(time_ms);
            } else {
                time_ms = 0;
                engine.start();
                started = true;
            }
            machine.scan(time_ms);
            seen.look(&engine);
            self.same_rows(number, time_ms, &engine, &machine)?;
        }
        Ok(seen.tally(stimulus.len(), &engine))
    }

    fn same_rows(
        &self,
        scan: usize,
        time_ms: u64,
        engine: &Engine<'_, '_>,
        machine: &Machine<'_>,
    ) -> Result<(), Failure> {
        let images = Images {
            image: engine.image(),
            numbers: engine.numbers(),
        };
        let cells = self.columns.row(time_ms, images).zip(machine.row());
        let differences: Vec<String> = self
            .columns
            .header()
            .zip(cells)
            .filter(|(_, (engine, reference))| engine != reference)
            .map(|(name, (engine, reference))| format!("{name}: `{engine}`, `{reference}`"))
            .collect();
        if differences.is_empty() {
            Ok(())
        } else {
            Err(Failure::Row { scan, differences })
        }
    }
}

/// What happened at least once.
#[derive(Default)]
struct Seen {
    fired: BTreeMap<usize, ()>,
    active: BTreeMap<(usize, usize), ()>,
    forced: usize,
}

impl Seen {
    fn look(&mut self, engine: &Engine<'_, '_>) {
        self.fired
            .extend(engine.fired().map(|transition| (transition, ())));
        for graph in 0..engine.program().graphs.len() {
            self.active
                .extend(engine.active_steps(graph).map(|step| ((graph, step), ())));
            self.forced += usize::from(engine.graph_forced(graph));
        }
    }

    fn tally(&self, scans: usize, engine: &Engine<'_, '_>) -> Tally {
        let faults = engine.value(Slot::Number(
            grafcet_core::program::Number::ARITHMETIC_FAULTS,
        ));
        Tally {
            programs: 1,
            scans,
            transitions: engine.program().transitions.len(),
            fired: self.fired.len(),
            steps: engine.program().steps.len(),
            active: self.active.len(),
            forced: self.forced,
            with_faults: usize::from(faults > 0),
        }
    }
}
