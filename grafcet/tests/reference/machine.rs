//! The second interpreter: `semantics.md` over sets and maps, written for obviousness, sharing nothing with the
//! engine.

use std::collections::{BTreeMap, BTreeSet};

use crate::expression::{Operators, Pass, Place};
use crate::program::{Boolean, Program, Situation, Statement, Store, Stored};

/// Milliseconds.
pub type T = i64;

/// The active steps of every graph.
pub type Situations = Vec<BTreeSet<usize>>;

/// A transition: its graph, and its place there.
pub type Fired = BTreeSet<(usize, usize)>;

pub struct Machine<'p> {
    pub program: &'p Program,
    pub now: T,
    /// The situations as they stand.
    pub x: Situations,
    /// The situations before this scan (round).
    pub before: Situations,
    pub since: BTreeMap<(usize, usize), T>,
    pub macro_since: BTreeMap<usize, T>,
    /// What the inputs `a b c n` were sampled as.
    pub given: [i32; 4],
    /// Whether `n` was outside its range.
    pub outside: bool,
    pub stored: [bool; 3],
    pub momentary: [bool; 3],
    pub numbers: [i32; 2],
    pub w: i32,
    pub p: i32,
    pub d: i32,
    pub faults: i32,
    /// What the last stored statement of every scan keeps of `faults` and `unstable`.
    pub kept: (i32, bool),
    pub first_scan: bool,
    pub unstable: bool,
    pub operators: Operators,
    /// True in phase 4.
    pub in_hierarchy: bool,
    /// The transitions that have fired since the start.
    pub ever_fired: Fired,
    /// The graphs that were under a valid order in the previous scan (round).
    pub held: BTreeSet<usize>,
}

impl<'p> Machine<'p> {
    pub fn new(program: &'p Program) -> Self {
        let nothing: Situations = vec![BTreeSet::new(); program.graphs.len()];
        Machine {
            program,
            now: 0,
            x: nothing.clone(),
            before: nothing,
            since: BTreeMap::new(),
            macro_since: BTreeMap::new(),
            given: [0; 4],
            outside: false,
            stored: [false; 3],
            momentary: [false; 3],
            numbers: [1, 0],
            w: 1000,
            p: 1,
            d: 2000,
            faults: 0,
            kept: (0, false),
            first_scan: true,
            unstable: false,
            operators: Operators::new(),
            in_hierarchy: false,
            held: BTreeSet::new(),
            ever_fired: Fired::new(),
        }
    }

    /// Phase 1: the inputs.
    pub fn sample(&mut self, a: bool, b: bool, c: bool, n: i32) {
        let clamped = n.clamp(-2, 2);
        let outside = clamped != n;
        self.faults += i32::from(outside && !self.outside);
        self.outside = outside;
        self.given = [a.into(), b.into(), c.into(), clamped];
    }

    /// New values of the parameters.
    pub fn set_p(&mut self, p: i32) {
        self.p = self.clamped(p.into(), 0, 3);
    }

    pub fn set_d(&mut self, d: i32) {
        self.d = self.clamped(d.into(), 0, 3000);
    }

    /// Scan 0.
    pub fn start(&mut self) {
        self.x = self.initial_situations();
        for graph in 0..self.x.len() {
            for step in self.x[graph].clone() {
                self.since.insert((graph, step), 0);
            }
            if self.macro_active(graph, &self.x) {
                self.macro_since.insert(graph, 0);
            }
        }
        self.watch_triggers(Pass::Scan0);
        self.settle_hierarchy(Pass::Scan0, &mut Fired::new());
        // What a forcing order has removed never was active.
        self.since.clear();
        self.macro_since.clear();
        self.stamp();
        self.watch_actions(Pass::Scan0, |_| true);
        self.run_changes(&Fired::new(), &BTreeSet::new());
        self.run_lasting();
        self.run_momentary();
    }

    /// Scan k > 0.
    pub fn scan(&mut self, now: T) {
        self.now = now;
        self.first_scan = false;
        if self.program.stable {
            self.unstable = !self.rounds();
            self.watch_actions(Pass::First, |statement| !is_change(statement));
        } else {
            let (fired, events) = self.evolve(Pass::First);
            self.watch_actions(Pass::First, |_| true);
            self.run_changes(&fired, &events);
        }
        self.run_lasting();
        self.run_momentary();
    }

    /// Rounds until nothing fires or the situation is the one before; False when 100 were not enough.
    fn rounds(&mut self) -> bool {
        for round in 0..100 {
            let pass = if round == 0 {
                Pass::First
            } else {
                Pass::LaterRound
            };
            let (fired, events) = self.evolve(pass);
            if pass == Pass::First {
                self.watch_actions(pass, is_change);
            }
            self.run_changes(&fired, &events);
            if fired.is_empty() || self.x == self.before {
                return true;
            }
        }
        false
    }

    /// Phases 2 to 5: the transitions that fired, and the places of the events that came.
    fn evolve(&mut self, pass: Pass) -> (Fired, BTreeSet<(usize, usize, usize)>) {
        self.before = self.x.clone();
        self.watch_triggers(pass);
        let events = self.events();
        let mut fired = self.fire();
        self.settle_hierarchy(pass, &mut fired);
        self.stamp();
        self.ever_fired.extend(&fired);
        (fired, events)
    }

    fn watch_triggers(&mut self, pass: Pass) {
        for graph in &self.program.graphs {
            for transition in &graph.transitions {
                self.watch(&transition.trigger, Place::Trigger, pass);
            }
            for step in &graph.steps {
                for statement in &step.statements {
                    if let Statement::OnEvent(event, _) = statement {
                        self.watch(event, Place::Trigger, pass);
                    }
                }
            }
        }
    }

    /// The events that come while their step is active: graph, step and place of the statement.
    fn events(&mut self) -> BTreeSet<(usize, usize, usize)> {
        let mut events = BTreeSet::new();
        for (graph, step) in active(&self.before) {
            for (index, statement) in self.program.graphs[graph].steps[step]
                .statements
                .iter()
                .enumerate()
            {
                if let Statement::OnEvent(event, _) = statement
                    && self.holds(event)
                {
                    events.insert((graph, step, index));
                }
            }
        }
        events
    }

    /// Phase 3.
    fn fire(&mut self) -> Fired {
        let mut fired = Fired::new();
        for (index, graph) in self.program.graphs.iter().enumerate() {
            let may_start = !self.is_enclosed(index) || self.is_enclosed_actively(index);
            for (place, transition) in graph.transitions_in_order().enumerate() {
                let armed = match transition.from.is_empty() {
                    true => may_start,
                    false => transition.from.is_subset(&self.before[index]),
                };
                if armed && self.holds(&transition.trigger) {
                    fired.insert((index, place));
                }
            }
        }
        for (index, graph) in self.program.graphs.iter().enumerate() {
            let all: Vec<_> = graph.transitions_in_order().enumerate().collect();
            let those = all
                .iter()
                .filter(|(place, _)| fired.contains(&(index, *place)));
            for (_, transition) in those.clone() {
                self.x[index].retain(|step| !transition.from.contains(step));
            }
            for (_, transition) in those {
                self.x[index].extend(&transition.to);
            }
        }
        fired
    }

    /// Phase 5: times of activation.
    fn stamp(&mut self) {
        for (graph, step) in active(&self.x) {
            if !self.before[graph].contains(&step) {
                self.since.insert((graph, step), self.now);
            }
        }
        for graph in 0..self.x.len() {
            if self.macro_active(graph, &self.x) && !self.macro_active(graph, &self.before) {
                self.macro_since.insert(graph, self.now);
            }
        }
    }

    pub fn macro_active(&self, graph: usize, situations: &Situations) -> bool {
        let start = self.program.graphs[graph].expansion_start();
        start.is_some_and(|start| situations[graph].iter().any(|step| *step >= start))
    }

    /// Edges and timers in those statements that are chosen.
    fn watch_actions(&mut self, pass: Pass, chosen: fn(&Statement) -> bool) {
        let program = self.program;
        for graph in &program.graphs {
            let steps = graph.steps.iter().flat_map(|step| &step.statements);
            for statement in graph.first.iter().chain(steps).chain(&graph.last) {
                if chosen(statement) {
                    self.watch_statement(statement, pass);
                }
            }
            for store in graph.transitions.iter().flat_map(|t| &t.action) {
                // A `do` is a change like `on activation`.
                if chosen(&Statement::OnActivation(store.clone())) {
                    self.watch_store(store, pass);
                }
            }
        }
    }

    fn watch_statement(&mut self, statement: &Statement, pass: Pass) {
        match statement {
            Statement::Momentary(_, Some(condition)) => self.watch(condition, Place::Action, pass),
            Statement::Stored(store)
            | Statement::OnActivation(store)
            | Statement::OnDeactivation(store)
            | Statement::OnEvent(_, store) => self.watch_store(store, pass),
            // Forcing conditions have their own time, in phase 4.
            Statement::Momentary(_, None) | Statement::Force(..) => {}
        }
    }

    fn watch_store(&mut self, store: &Store, pass: Pass) {
        if let Stored::Boolean(_, value) = &store.what {
            self.watch(value, Place::Action, pass);
        }
        if let Some(condition) = &store.condition {
            self.watch(condition, Place::Action, pass);
        }
    }

    /// Phase 6: `do`, `on event`, `on deactivation`, `on activation`.
    fn run_changes(&mut self, fired: &Fired, events: &BTreeSet<(usize, usize, usize)>) {
        let program = self.program;
        for (graph, place) in fired {
            let transition = program.graphs[*graph].transitions_in_order().nth(*place);
            for store in &transition.expect("it fired").action {
                self.store(store);
            }
        }
        for (graph, step, index) in events {
            if let Statement::OnEvent(_, store) =
                &program.graphs[*graph].steps[*step].statements[*index]
            {
                self.store(store);
            }
        }
        for (graph, step) in active(&self.before) {
            if !self.x[graph].contains(&step) {
                for statement in &program.graphs[graph].steps[step].statements {
                    if let Statement::OnDeactivation(store) = statement {
                        self.store(store);
                    }
                }
            }
        }
        for (graph, step) in active(&self.x) {
            if !self.before[graph].contains(&step) {
                for statement in &program.graphs[graph].steps[step].statements {
                    if let Statement::OnActivation(store) = statement {
                        self.store(store);
                    }
                }
            }
        }
    }

    /// Phase 6: stand-alone actions, then active steps.
    fn run_lasting(&mut self) {
        for statement in self.executed() {
            if let Statement::Stored(store) = statement {
                self.store(store);
            }
        }
        self.kept = (self.faults, self.unstable);
    }

    /// The statements of stand-alone actions and active steps, in the order of phase 6.
    fn executed(&self) -> Vec<&'p Statement> {
        let program = self.program;
        let always = program
            .graphs
            .iter()
            .flat_map(|graph| graph.first.iter().chain(&graph.last));
        let steps = active(&self.x);
        let steps = steps
            .iter()
            .flat_map(|(graph, step)| &program.graphs[*graph].steps[*step].statements);
        always.chain(steps).collect()
    }

    fn store(&mut self, store: &Store) {
        if !self.condition(&store.condition) {
            return;
        }
        match &store.what {
            Stored::Boolean(index, value) => self.stored[*index] = self.holds(value),
            Stored::Number(index, value) => {
                let value = self.number(value).into();
                let (min, max) = if *index == 1 {
                    (-3, 3)
                } else {
                    (i32::MIN, i32::MAX)
                };
                self.numbers[*index] = self.clamped(value, min, max);
            }
            Stored::Time(value) => {
                let value = self.time(value).into();
                self.w = self.clamped(value, 0, 3000);
            }
        }
    }

    /// Phase 7. `m0` depends on none of the others, `m1` on `m0` at most, `m2` on both.
    fn run_momentary(&mut self) {
        let executed = self.executed();
        self.momentary = [false; 3];
        for first in 0..3 {
            for statement in &executed {
                if let Statement::Momentary(targets, condition) = statement
                    && targets.first() == Some(&first)
                    && self.condition(condition)
                {
                    for target in targets {
                        self.momentary[*target] = true;
                    }
                }
            }
        }
    }

    /// The row of the trace.
    pub fn row(&self) -> Vec<String> {
        let mut row = vec![self.now.to_string()];
        for situation in &self.x {
            let steps: Vec<String> = situation
                .iter()
                .map(|step| (step + 1).to_string())
                .collect();
            row.push(steps.join(" "));
        }
        row.push("1".to_owned());
        row.extend(self.momentary.map(|m| i32::from(m).to_string()));
        row.extend(self.stored.map(|s| i32::from(s).to_string()));
        row.extend(self.numbers.map(|i| i.to_string()));
        let (faults, unstable) = self.kept;
        row.extend(
            [self.w, faults, unstable.into(), self.p, self.d].map(|value| value.to_string()),
        );
        row
    }
}

/// `do` and `on` statements: they belong to a change.
fn is_change(statement: &Statement) -> bool {
    matches!(
        statement,
        Statement::OnActivation(_) | Statement::OnDeactivation(_) | Statement::OnEvent(..)
    )
}

/// The active steps, in source order.
fn active(situations: &Situations) -> Vec<(usize, usize)> {
    let graphs = situations.iter().enumerate();
    graphs
        .flat_map(|(graph, steps)| steps.iter().map(move |step| (graph, *step)))
        .collect()
}

/// An order: the graph that is forced, into what, and when.
pub type Order<'p> = (usize, &'p Situation, &'p Option<Boolean>);
