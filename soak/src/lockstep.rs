//! Scan by scan in both interpreters.

use std::collections::{BTreeMap, VecDeque};
use std::fmt;

use grafcet::machine::Bench;
use grafcet::simulation::Simulation;
use grafcet::trace::Columns;
use grafcet_compiler::application::Application;
use grafcet_core::program::Slot;
use grafcet_reference::{Machine, Program, Qualified};

use crate::operator::{Act, Operator};
use crate::subject::Subject;
use crate::watch::{Fault, Watch};

/// Which scans the reference runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// Every one.
    EveryScan,
    /// Those that are not idle to the engine. When an idle one would have changed something the next of these differs.
    IdleSpared,
}

/// A program with its plant and its operators, in the engine and in the reference.
pub struct Lockstep<'a> {
    simulation: Simulation<'a>,
    columns: Columns<'a>,
    reference: Machine<'a>,
    mode: Reference,
    inputs: Vec<(Slot, Qualified<'a>)>,
    operator: Operator,
    /// By how many scans an act on an input is seen later, and the acts that are on their way.
    delays: BTreeMap<&'static str, u64>,
    under_way: VecDeque<(u64, Act)>,
    /// What has been reached.
    pub watch: Watch<'a>,
    /// Scans that have been run, scan 0 included, and those of them that were idle.
    pub scans: u64,
    /// Those of them in which the controller had nothing to do.
    pub idle: u64,
}

/// Why a run has failed.
#[derive(Debug)]
pub enum Failure {
    /// The rows of a scan differ.
    Differs(Vec<String>),
    /// Both are wrong.
    Fault(Fault),
    /// A machine that is left alone does not come to rest.
    Restless,
    /// At the end something has never happened.
    Missing(Vec<String>),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Differs(cells) => write!(f, "{}", cells.join("; ")),
            Failure::Fault(fault) => write!(f, "{fault}"),
            Failure::Restless => f.write_str("the machine is left alone and does not come to rest"),
            Failure::Missing(what) => write!(f, "{}", what.join("; ")),
        }
    }
}

impl<'a> Lockstep<'a> {
    /// Sets up both. Nothing has run yet. `delays` are those that a board's filters make of what is done to an input,
    /// in scans.
    #[must_use]
    pub fn new(
        subject: Subject,
        bench: &'a Bench<'a>,
        application: &'a Application,
        program: &'a Program<'a>,
        mode: Reference,
        seed: u64,
        delays: BTreeMap<&'static str, u64>,
    ) -> Self {
        let unit = &application.controller;
        let slot = |name: &str| {
            let mut variables = unit.symbols.variables.iter();
            variables.find(|it| it.name == name).map(|it| it.slot)
        };
        let inputs = program.inputs().into_iter();
        let mut lockstep = Lockstep {
            simulation: Simulation::new(bench, application, &[0]),
            columns: Columns::of(unit),
            reference: Machine::new(program),
            mode,
            inputs: inputs
                .filter_map(|name| Some((slot(name.1)?, name)))
                .collect(),
            operator: Operator::new(application, subject.habits(), seed),
            delays,
            under_way: VecDeque::new(),
            watch: Watch::new(unit, subject),
            scans: 0,
            idle: 0,
        };
        for act in lockstep.operator.leave(0) {
            obey(&mut lockstep.simulation, act);
        }
        lockstep.operator.set_out(0);
        lockstep
    }

    /// The time of the next scan in ms.
    #[must_use]
    pub fn next_ms(&self) -> u64 {
        if self.simulation.started() {
            self.simulation.time_ms() + self.simulation.period_ms()
        } else {
            0
        }
    }

    /// Runs the next scan. The answer: whether it was a full one, and what the operators did to inputs just before it,
    /// seen or not.
    ///
    /// # Errors
    /// When the two differ, or both are wrong.
    pub fn scan(&mut self) -> Result<(bool, Vec<Act>), Failure> {
        let now_ms = self.next_ms();
        let acts = self.operator.act(now_ms);
        for act in &acts {
            let delay = self.delays.get(act.what).copied().unwrap_or(0);
            self.under_way.push_back((self.scans + delay, *act));
        }
        if !self.under_way.is_empty() {
            let scan = self.scans;
            let simulation = &mut self.simulation;
            self.under_way.retain(|(due, act)| {
                if *due == scan {
                    obey(simulation, *act);
                }
                *due > scan
            });
        }
        let full = self.simulation.scan();
        self.scans += 1;
        self.idle += u64::from(!full);
        if full {
            let engine = self.simulation.controller().engine();
            self.watch.look(engine, now_ms).map_err(Failure::Fault)?;
        }
        if full || self.mode == Reference::EveryScan {
            self.compare(now_ms)?;
        }
        Ok((full, acts))
    }

    /// Runs the same scan in the reference, with the inputs that the engine saw, and compares what they leave.
    fn compare(&mut self, now_ms: u64) -> Result<(), Failure> {
        let images = self.simulation.images();
        for (slot, name) in &self.inputs {
            self.reference.set(*name, images.value(*slot));
        }
        self.reference.scan(now_ms);
        let rows = self.columns.row(now_ms, images).zip(self.reference.row());
        let differences: Vec<String> = self
            .columns
            .header()
            .zip(rows)
            .filter(|(_, (engine, reference))| engine != reference)
            .map(|(name, (engine, reference))| {
                format!("{name} is `{engine}`, in the reference `{reference}`")
            })
            .collect();
        if differences.is_empty() {
            Ok(())
        } else {
            Err(Failure::Differs(differences))
        }
    }

    /// The operators put everything as it usually is, and leave.
    pub fn leave(&mut self) {
        for act in self.operator.leave(self.next_ms()) {
            obey(&mut self.simulation, act);
        }
    }

    /// The operators come back.
    pub fn set_out(&mut self) {
        self.operator.set_out(self.next_ms());
    }

    /// Lets so many scans pass.
    pub fn leap(&mut self, scans: u64) {
        self.simulation.leap(scans);
    }

    /// The row of the latest scan.
    #[must_use]
    pub fn row(&self) -> String {
        let cells = self
            .columns
            .row(self.simulation.time_ms(), self.simulation.images());
        cells.collect::<Vec<_>>().join(",")
    }

    /// The header of the rows.
    #[must_use]
    pub fn header(&self) -> String {
        self.columns.header().collect::<Vec<_>>().join(",")
    }

    /// An input as the latest scan saw it.
    #[must_use]
    pub fn input(&self, slot: Slot) -> i32 {
        self.simulation.images().value(slot)
    }

    /// The scan period in ms.
    #[must_use]
    pub fn period_ms(&self) -> u64 {
        self.simulation.period_ms()
    }

    /// Looks at the timers of steps that are still active.
    ///
    /// # Errors
    /// When one is stuck.
    pub fn look_at_timers(&self) -> Result<(), Failure> {
        let now_ms = self.simulation.time_ms();
        self.watch.look_at_timers(now_ms).map_err(Failure::Fault)
    }

    /// What a person needs to see of a failure.
    #[must_use]
    pub fn report(&self, failure: &Failure) -> String {
        let diary = self.operator.diary().join("\n  ");
        let now_ms = self.simulation.time_ms();
        format!("at {now_ms} ms: {failure}\nwhat happened before:\n  {diary}")
    }
}

fn obey(simulation: &mut Simulation<'_>, act: Act) {
    match act.value {
        Some(value) => simulation.set(act.place, i32::from(value)),
        None => simulation.release(act.place),
    }
}
