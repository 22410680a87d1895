//! The tests of the language (`semantics.md`, "Tests").
//!
//! Scan 0 runs before the first step that needs a scan: every `wait`, `pulse`, `expect`, `never` and `always` does,
//! after a power cycle again.

use std::collections::{BTreeMap, VecDeque};

use grafcet_compiler::application::{
    Application, Claim, GraphSymbol, Place, Test, TestStep, TestStepKind,
};
use grafcet_compiler::source::Span;

use crate::images::situation;
use crate::machine::{Bench, Machine};
use crate::simulation::Simulation;
use crate::table::Table;
use grafcet_core::images::Images;
use grafcet_core::program::Slot;

/// How many scans before a failure are shown.
const SHOWN_SCANS: usize = 8;

/// Of more graphs than this, only those are shown whose situation changed in the scans shown, or whose steps the test
/// asks for.
const SHOWN_GRAPHS: usize = 3;

/// Why a test failed.
#[derive(Clone, Debug)]
pub struct Failure {
    /// What was claimed.
    pub claimed: Claimed,
    /// Where it is claimed.
    pub span: Span,
    /// The step of the test that ran when it failed.
    pub during: Span,
    /// The time stamp of the scan after which it failed, in ms since the controller's scan 0.
    pub time_ms: u64,
    /// The names in the claim and their values then.
    pub values: Vec<(String, i32)>,
    /// The scan after which it failed and those before it: situations, and the names in the claim.
    pub last_scans: Table,
}

/// The kinds of claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Claimed {
    /// `expect`.
    Expect,
    /// `never`.
    Never,
    /// `always`.
    Always,
    /// `wait until`.
    WaitUntil {
        /// The time allowed, in ms.
        within_ms: u32,
    },
}

/// Runs a test of an application; `each_scan` sees the simulation after every scan.
///
/// # Errors
/// The first claim that does not hold.
pub fn run(
    application: &Application,
    test: &Test,
    each_scan: impl FnMut(&Simulation<'_>),
) -> Result<(), Box<Failure>> {
    let bench = Bench::new();
    let mut run = Run {
        application,
        test,
        simulation: Simulation::new(&bench, application, &test.plants),
        observer: bench.machine(&test.observer.tables),
        standing: Vec::new(),
        mentioned: mentioned(test),
        past: VecDeque::new(),
        during: test.span,
        each_scan,
    };
    for step in &test.steps {
        run.step(step)?;
    }
    Ok(())
}

/// Every place that a claim of the test mentions, once, with its index among them.
fn mentioned(test: &Test) -> BTreeMap<Place, usize> {
    let mut places = BTreeMap::new();
    for claim in test.steps.iter().filter_map(|step| claim_of(&step.kind)) {
        for (_, place) in &claim.mentions {
            let index = places.len();
            places.entry(*place).or_insert(index);
        }
    }
    places
}

fn claim_of(kind: &TestStepKind) -> Option<&Claim> {
    match kind {
        TestStepKind::WaitUntil { claim, .. }
        | TestStepKind::Expect(claim)
        | TestStepKind::Never(claim)
        | TestStepKind::Always(claim) => Some(claim),
        TestStepKind::Set(_)
        | TestStepKind::Release(_)
        | TestStepKind::Pulse { .. }
        | TestStepKind::Wait { .. }
        | TestStepKind::WaitScans(_)
        | TestStepKind::PowerCycle => None,
    }
}

/// A test at work.
struct Run<'a, 'b, F> {
    application: &'a Application,
    test: &'a Test,
    simulation: Simulation<'b>,
    observer: Machine<'b>,
    /// What must hold after every scan from now on.
    standing: Vec<Standing<'a>>,
    mentioned: BTreeMap<Place, usize>,
    past: VecDeque<Past>,
    /// The step that runs.
    during: Span,
    each_scan: F,
}

/// A `never` or an `always`.
#[derive(Clone, Copy)]
struct Standing<'a> {
    claimed: Claimed,
    claim: &'a Claim,
    span: Span,
}

/// What a scan left.
struct Past {
    time_ms: u64,
    image: Vec<u32>,
    /// The values of the places mentioned.
    values: Vec<i32>,
}

impl<'a, F: FnMut(&Simulation<'_>)> Run<'a, '_, F> {
    fn step(&mut self, step: &'a TestStep) -> Result<(), Box<Failure>> {
        self.during = step.span;
        match &step.kind {
            TestStepKind::Set(values) => {
                for (place, value) in values {
                    self.simulation.set(*place, *value);
                }
            }
            TestStepKind::Release(places) => {
                for place in places {
                    self.simulation.release(*place);
                }
            }
            TestStepKind::Pulse { place, ms } => {
                self.start()?;
                self.simulation.set(*place, 1);
                self.scan_for(*ms)?;
                self.simulation.set(*place, 0);
            }
            TestStepKind::Wait { ms } => {
                self.start()?;
                self.scan_for(*ms)?;
            }
            TestStepKind::WaitScans(scans) => {
                self.start()?;
                for _ in 0..*scans {
                    self.scan()?;
                }
            }
            TestStepKind::WaitUntil { claim, within_ms } => {
                self.start()?;
                self.wait_until(claim, *within_ms)?;
            }
            TestStepKind::Expect(claim) => {
                self.start()?;
                self.check(Claimed::Expect, claim, step.span)?;
            }
            TestStepKind::Never(claim) => self.stand(Claimed::Never, claim, step.span)?,
            TestStepKind::Always(claim) => self.stand(Claimed::Always, claim, step.span)?,
            TestStepKind::PowerCycle => self.simulation.power_cycle(),
        }
        Ok(())
    }

    /// Runs scan 0 if it has not run since power came.
    fn start(&mut self) -> Result<(), Box<Failure>> {
        if self.simulation.started() {
            Ok(())
        } else {
            self.scan()
        }
    }

    /// Runs as many scans as fit into a time, rounded up.
    fn scan_for(&mut self, ms: u32) -> Result<(), Box<Failure>> {
        for _ in 0..self.scans_in(ms) {
            self.scan()?;
        }
        Ok(())
    }

    fn scans_in(&self, ms: u32) -> u64 {
        u64::from(ms).div_ceil(self.simulation.period_ms().max(1))
    }

    fn wait_until(&mut self, claim: &Claim, within_ms: u32) -> Result<(), Box<Failure>> {
        for _ in 0..self.scans_in(within_ms) {
            if self.holds(claim) {
                return Ok(());
            }
            self.scan()?;
        }
        self.check(Claimed::WaitUntil { within_ms }, claim, self.during)
    }

    fn stand(
        &mut self,
        claimed: Claimed,
        claim: &'a Claim,
        span: Span,
    ) -> Result<(), Box<Failure>> {
        self.start()?;
        self.check(claimed, claim, span)?;
        self.standing.push(Standing {
            claimed,
            claim,
            span,
        });
        Ok(())
    }

    fn scan(&mut self) -> Result<(), Box<Failure>> {
        self.simulation.scan();
        for (place, slot) in &self.test.observer.reads {
            self.observer.sample(*slot, self.simulation.value(*place));
        }
        self.observer.scan(self.simulation.elapsed_ms());
        self.remember();
        (self.each_scan)(&self.simulation);
        for index in 0..self.standing.len() {
            if let Some(standing) = self.standing.get(index).copied() {
                self.check(standing.claimed, standing.claim, standing.span)?;
            }
        }
        Ok(())
    }

    /// Whether the claim's expression was True after the latest scan.
    fn holds(&self, claim: &Claim) -> bool {
        self.observer.engine().bit(claim.result)
    }

    fn check(&self, claimed: Claimed, claim: &Claim, span: Span) -> Result<(), Box<Failure>> {
        if self.holds(claim) != (claimed == Claimed::Never) {
            return Ok(());
        }
        let values = claim.mentions.iter();
        Err(Box::new(Failure {
            claimed,
            span,
            during: self.during,
            time_ms: self.simulation.time_ms(),
            values: values
                .map(|(name, place)| (name.clone(), self.simulation.value(*place)))
                .collect(),
            last_scans: self.last_scans(claim),
        }))
    }

    fn remember(&mut self) {
        let mut values = vec![0; self.mentioned.len()];
        for (place, index) in &self.mentioned {
            if let Some(value) = values.get_mut(*index) {
                *value = self.simulation.value(*place);
            }
        }
        if self.past.len() == SHOWN_SCANS {
            self.past.pop_front();
        }
        self.past.push_back(Past {
            time_ms: self.simulation.time_ms(),
            image: self.simulation.images().image.to_vec(),
            values,
        });
    }

    /// Whether a claim of the test reads a step bit or the situation of a graph.
    fn asks_for(&self, graph: &GraphSymbol) -> bool {
        let mut reads = self.test.observer.reads.iter();
        reads.any(|(place, _)| {
            let mut steps = graph.steps.iter();
            steps.any(|step| *place == Place::Controller(Slot::Bit(step.bit)))
        })
    }

    fn last_scans(&self, claim: &Claim) -> Table {
        let mut table = Table::default();
        let times = self.past.iter().map(|past| past.time_ms.to_string());
        table.column("time_ms", times);
        let controller = &self.application.controller;
        let many = controller.symbols.graphs.len() > SHOWN_GRAPHS;
        for (index, graph) in controller.symbols.graphs.iter().enumerate() {
            let situations = self.past.iter().map(|past| {
                let images = Images {
                    image: &past.image,
                    numbers: &[],
                };
                situation(controller, index, images)
            });
            let situations: Vec<String> = situations.collect();
            let moved = situations
                .windows(2)
                .any(|pair| pair.first() != pair.last());
            if moved || !many || self.asks_for(graph) {
                table.column(&graph.name, situations);
            }
        }
        for (name, place) in &claim.mentions {
            let index = self.mentioned.get(place).copied().unwrap_or(usize::MAX);
            let values = self.past.iter().map(|past| past.values.get(index));
            let cells = values.map(|value| value.map_or_else(String::new, i32::to_string));
            table.column(name, cells);
        }
        table
    }
}
