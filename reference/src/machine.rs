//! The state of a program, and the scan (`semantics.md`, "State" to "`evolution stable`").

use std::collections::{BTreeMap, BTreeSet};

use grafcet_compiler::ast::{DeclarationKind, Event, Expression, StatementKind, Trigger, Type};

use crate::action::{Due, Group};
use crate::expression::{Place, Scope};
use crate::momentary::Calculation;
use crate::name::Qualified;
use crate::program::Program;
use crate::value::Value;
use crate::watch::{Memory, Pass};

/// Rounds after which an evolution that is not settled counts as unstable.
const MAX_ROUNDS: u32 = 100;

/// The active steps of each graph.
pub(crate) type Situation<'a> = BTreeMap<&'a str, BTreeSet<&'a str>>;

/// A program that runs.
#[derive(Debug)]
pub struct Machine<'a> {
    pub(crate) program: &'a Program<'a>,
    /// The time stamp of the scan, in ms since scan 0.
    pub(crate) now_ms: u64,
    pub(crate) first_scan: bool,
    started: bool,
    /// Everything that has a value and is no constant. Momentary variables are as the previous scan left them until
    /// phase 7 is over.
    pub(crate) values: BTreeMap<Qualified<'a>, Value>,
    /// What stands at the inputs: 0 until something else is given.
    samples: BTreeMap<Qualified<'a>, i32>,
    /// The inputs that were outside their range when they were sampled last.
    outside: BTreeSet<Qualified<'a>>,
    /// The situation before this scan or round.
    pub(crate) before: Situation<'a>,
    /// The situation as it stands.
    pub(crate) situation: Situation<'a>,
    /// When each step and macro step was activated last.
    pub(crate) since: BTreeMap<Qualified<'a>, u64>,
    /// The graphs that were under a valid order in the previous scan or round.
    pub(crate) ordered: BTreeSet<&'a str>,
    /// In scan 0: the initial enclosing steps to which enclosed graphs owe the situation that they keep.
    pub(crate) kept: BTreeMap<&'a str, BTreeSet<Qualified<'a>>>,
    pub(crate) memories: BTreeMap<Place<'a>, Memory>,
    /// What each edge and timer was when it was evaluated last.
    pub(crate) watched: BTreeMap<Place<'a>, bool>,
    pub(crate) faults: i32,
    pub(crate) unstable: bool,
    rounds: u32,
    pub(crate) recovered: bool,
    pub(crate) overruns: i32,
    /// The momentary variables while phase 7 calculates them.
    pub(crate) calculation: Option<Calculation<'a>>,
}

/// What fired, and what runs for it in phase 6.
pub(crate) struct Fired<'a> {
    /// Graph and number of place among its transitions, void evolutions left out.
    pub transitions: BTreeSet<(&'a str, usize)>,
    /// The `on event` statements whose event came.
    pub events: Vec<Due<'a>>,
}

impl<'a> Machine<'a> {
    /// A program before scan 0: variables have their initial values.
    #[must_use]
    pub fn new(program: &'a Program<'a>) -> Self {
        let variables = program.names.iter().copied();
        let variables = variables.filter(|n| program.kind(*n) != DeclarationKind::Constant);
        let empty: Situation<'a> = program
            .graphs
            .iter()
            .map(|g| (g.name, BTreeSet::new()))
            .collect();
        Machine {
            program,
            now_ms: 0,
            first_scan: false,
            started: false,
            values: variables
                .map(|name| (name, program.initial(name)))
                .collect(),
            samples: program.inputs().into_iter().map(|name| (name, 0)).collect(),
            outside: BTreeSet::new(),
            before: empty.clone(),
            situation: empty,
            since: BTreeMap::new(),
            ordered: BTreeSet::new(),
            kept: BTreeMap::new(),
            memories: BTreeMap::new(),
            watched: BTreeMap::new(),
            faults: 0,
            unstable: false,
            rounds: 0,
            recovered: false,
            overruns: 0,
            calculation: None,
        }
    }

    /// Sets `System:recovered`, before scan 0.
    pub fn set_recovered(&mut self, recovered: bool) {
        self.recovered = recovered;
    }

    /// Sets `System:overruns`.
    pub fn set_overruns(&mut self, overruns: i32) {
        self.overruns = overruns;
    }

    /// Gives a retained variable its stored value, before scan 0. One that is not valid is not taken: the declared
    /// value holds.
    pub fn restore(&mut self, name: Qualified<'a>, number: i32) -> bool {
        let ty = self.program.ty(name);
        let (low, high) = match ty {
            Type::Bool => (0, 1),
            Type::Int | Type::Time => self.program.range(name),
        };
        let valid = (low..=high).contains(&number);
        if valid {
            self.values.insert(name, Value::of(ty, number));
        }
        valid
    }

    /// The time stamp of the latest scan in ms since scan 0.
    #[must_use]
    pub fn time_ms(&self) -> u64 {
        self.now_ms
    }

    /// How many rounds the latest scan took; none of a program that does not evolve `stable`, and in scan 0.
    #[must_use]
    pub fn rounds(&self) -> u32 {
        self.rounds
    }

    /// The value of a variable.
    #[must_use]
    pub fn value(&self, name: Qualified<'a>) -> Option<Value> {
        self.values.get(&name).copied()
    }

    /// Gives an input its sample for the next scan, or a parameter a new value.
    pub fn set(&mut self, name: Qualified<'a>, number: i32) {
        if self.program.kind(name) == DeclarationKind::Input {
            self.samples.insert(name, number);
        } else {
            self.store(name, Value::of(self.program.ty(name), number));
        }
    }

    /// Runs scan 0, or a later one with its time stamp in ms since scan 0.
    pub fn scan(&mut self, time_ms: u64) {
        self.now_ms = time_ms;
        self.first_scan = !self.started;
        self.started = true;
        self.sample();
        if self.first_scan {
            self.initialise();
        } else if self.program.stable {
            self.settle();
        } else {
            let fired = self.round(Pass::Compare);
            self.watch_actions(&[Group::Immediate, Group::Plain]);
            self.run_immediate(&fired);
        }
        self.run_plain();
        self.calculate_momentary();
    }

    /// A fault in calculation.
    pub(crate) fn fault(&mut self) {
        self.faults = self.faults.saturating_add(1);
    }

    /// Stores a value, clamped to the range of the variable and counted if that changes it.
    pub(crate) fn store(&mut self, name: Qualified<'a>, value: Value) {
        let stored = match value {
            Value::Bool(_) => value,
            Value::Int(number) | Value::Time(number) => {
                let (low, high) = self.program.range(name);
                if !(low..=high).contains(&number) {
                    self.fault();
                }
                Value::of(value.ty(), number.clamp(low, high))
            }
        };
        self.values.insert(name, stored);
    }

    /// Phase 1.
    fn sample(&mut self) {
        for (name, number) in self.samples.clone() {
            let ty = self.program.ty(name);
            let (low, high) = self.program.range(name);
            let number = match Value::of(ty, number) {
                Value::Bool(_) => number,
                Value::Int(_) | Value::Time(_) => {
                    if (low..=high).contains(&number) {
                        self.outside.remove(&name);
                    } else if self.outside.insert(name) {
                        self.fault();
                    }
                    number.clamp(low, high)
                }
            };
            self.values.insert(name, Value::of(ty, number));
        }
    }

    /// Scan 0, items 2 to 4, up to the statements of phase 6 that the other scans share.
    fn initialise(&mut self) {
        self.take_initial_situation();
        self.watch_triggers(Pass::Prime);
        self.hierarchy(Pass::Prime);
        self.activate();
        self.watch_actions(&[Group::Immediate, Group::Plain]);
        self.run_immediate(&Fired {
            transitions: BTreeSet::new(),
            events: Vec::new(),
        });
    }

    /// The rounds of `evolution stable`.
    fn settle(&mut self) {
        let mut settled = false;
        for round in 1..=MAX_ROUNDS {
            self.rounds = round;
            let pass = if round == 1 {
                Pass::Compare
            } else {
                Pass::Later
            };
            let fired = self.round(pass);
            if round == 1 {
                self.watch_actions(&[Group::Immediate]);
            }
            self.run_immediate(&fired);
            if fired.transitions.is_empty() || self.situation == self.before {
                settled = true;
                break;
            }
        }
        self.unstable = !settled;
        self.watch_actions(&[Group::Plain]);
    }

    /// Phases 2 to 5.
    fn round(&mut self, pass: Pass) -> Fired<'a> {
        self.before = self.situation.clone();
        self.watch_triggers(pass);
        let events = self.due_events();
        let mut transitions = self.fire();
        let own_evolution = self.hierarchy(pass);
        transitions.retain(|(graph, _)| own_evolution.contains(graph));
        self.activate();
        Fired {
            transitions,
            events,
        }
    }

    /// Phase 2, the edges and timers: of triggers, and of events, which are evaluated as in a trigger.
    fn watch_triggers(&mut self, pass: Pass) {
        let program = self.program;
        for graph in &program.graphs {
            let scope = Scope::of(graph.name);
            for transition in &graph.transitions {
                if let Trigger::Expression(trigger) = &transition.trigger {
                    self.watch(trigger, &scope, pass);
                }
            }
            for (_, statement) in &graph.statements {
                if let Some(event) = event_of(&statement.kind) {
                    self.watch(event, &scope, pass);
                }
            }
        }
    }

    /// Phase 2, the events of the steps that are active before this scan or round.
    fn due_events(&mut self) -> Vec<Due<'a>> {
        let program = self.program;
        let mut due = Vec::new();
        for graph in &program.graphs {
            let scope = Scope::of(graph.name);
            for (owner, statement) in &graph.statements {
                let active = owner.is_some_and(|step| self.situation[graph.name].contains(step));
                if let (true, Some(event)) = (active, event_of(&statement.kind))
                    && self.evaluate(event, &scope).truth()
                {
                    due.push((graph.name, &statement.kind));
                }
            }
        }
        due
    }

    /// Phases 2 and 3: which transitions are armed, have a True trigger and so fire together.
    fn fire(&mut self) -> BTreeSet<(&'a str, usize)> {
        let program = self.program;
        let mut fired = BTreeSet::new();
        for graph in &program.graphs {
            let scope = Scope::of(graph.name);
            for (number, transition) in graph.transitions.iter().enumerate() {
                let entrance = graph.entrance_steps(transition);
                let armed = if entrance.is_empty() {
                    self.may_run(graph.name)
                } else {
                    entrance.is_subset(&self.situation[graph.name])
                };
                let trigger = |machine: &mut Self| match &transition.trigger {
                    Trigger::AlwaysTrue => true,
                    Trigger::Expression(trigger) => machine.evaluate(trigger, &scope).truth(),
                    Trigger::Text(_) => panic!("a level-1 trigger does not run"),
                };
                if armed && trigger(self) {
                    fired.insert((graph.name, number));
                }
            }
        }
        for graph in &program.graphs {
            let transitions = || {
                let all = graph.transitions.iter().enumerate();
                all.filter(|(number, _)| fired.contains(&(graph.name, *number)))
            };
            let left: BTreeSet<&str> = transitions()
                .flat_map(|(_, t)| graph.entrance_steps(t))
                .collect();
            let entered = transitions().flat_map(|(_, t)| graph.exit_steps(t));
            let situation = &self.situation[graph.name] - &left;
            let situation = situation.into_iter().chain(entered).collect();
            self.situation.insert(graph.name, situation);
        }
        fired
    }

    /// Whether a graph is not enclosed, or one of its enclosing steps is active.
    pub(crate) fn may_run(&self, graph: &'a str) -> bool {
        let enclosings = self.program.enclosings(graph);
        let mut steps = enclosings.iter().map(|(step, _)| *step);
        enclosings.is_empty() || steps.any(|step| self.active(step))
    }

    /// Phase 5.
    fn activate(&mut self) {
        let program = self.program;
        for graph in &program.graphs {
            let steps = graph.steps.iter().map(|step| step.id.text.as_str());
            for id in steps.chain(graph.macros.keys().copied()) {
                let step = (graph.name, id);
                if self.active(step) && !self.was_active(step) {
                    self.since.insert(step, self.now_ms);
                }
            }
        }
    }

    /// The bit of a step or macro step.
    pub(crate) fn active(&self, step: Qualified<'a>) -> bool {
        self.active_in(&self.situation, step)
    }

    /// Its bit before this scan or round.
    pub(crate) fn was_active(&self, step: Qualified<'a>) -> bool {
        self.active_in(&self.before, step)
    }

    fn active_in(&self, situation: &Situation<'a>, (graph, id): Qualified<'a>) -> bool {
        let active = &situation[graph];
        match self.program.graph(graph, graph).macros.get(id) {
            Some(expansion) => !expansion.steps.is_disjoint(active),
            None => active.contains(id),
        }
    }

    /// When a step or macro step was activated last; now, if that is in this scan.
    pub(crate) fn activated_at(&self, step: Qualified<'a>) -> Option<u64> {
        if self.active(step) && !self.was_active(step) {
            Some(self.now_ms)
        } else {
            self.since.get(&step).copied()
        }
    }
}

/// The expression behind `on event`.
fn event_of(statement: &StatementKind) -> Option<&Expression> {
    match statement {
        StatementKind::On {
            event: Event::Expression(event),
            ..
        } => Some(event),
        _ => None,
    }
}
