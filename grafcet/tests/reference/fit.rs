//! Makes a draw a program that the compiler accepts.

use std::collections::BTreeSet;

use crate::program::{
    Boolean, Graph, Number, Preset, Program, Situation, Statement, Store, Stored, Transition,
};

/// What there is in a program, and what a condition may read of it.
struct Fitting {
    /// Steps of each graph.
    steps: Vec<usize>,
    /// Whether each graph has a macro step.
    macros: Vec<bool>,
}

/// Wraps indices round and takes out what is refused.
pub fn fit(mut program: Program) -> Program {
    for graph in &mut program.graphs {
        if graph.expansion + 1 > graph.steps.len() {
            graph.expansion = 0;
        }
    }
    let fitting = Fitting {
        steps: program
            .graphs
            .iter()
            .map(|graph| graph.steps.len())
            .collect(),
        macros: program
            .graphs
            .iter()
            .map(|graph| graph.expansion > 0)
            .collect(),
    };
    for (index, graph) in program.graphs.iter_mut().enumerate() {
        fitting.graph(graph, index);
    }
    program
}

impl Fitting {
    fn graph(&self, graph: &mut Graph, index: usize) {
        for statement in graph.first.iter_mut().chain(&mut graph.last) {
            self.statement(statement, index, true);
        }
        for step in &mut graph.steps {
            step.encloses = step.encloses.take().and_then(|(enclosed, set)| {
                let enclosed = self.inferior(enclosed, index)?;
                Some((enclosed, self.set(set, enclosed)))
            });
            for statement in &mut step.statements {
                self.statement(statement, index, false);
            }
        }
        let start = graph.expansion_start();
        for transition in &mut graph.transitions {
            self.transition(transition, index, start);
        }
    }

    fn transition(&self, transition: &mut Transition, index: usize, start: Option<usize>) {
        transition.from = self.set(std::mem::take(&mut transition.from), index);
        transition.to = self.set(std::mem::take(&mut transition.to), index);
        if transition.from.is_empty() && transition.to.is_empty() {
            transition.from.insert(0);
        }
        if let Some(start) = start {
            keep_to_one_side(transition, start, self.steps[index] - 1);
        }
        self.boolean(&mut transition.trigger, usize::MAX);
        for store in &mut transition.action {
            self.store(store);
        }
    }

    /// A graph below this one; none below the last.
    fn inferior(&self, graph: usize, index: usize) -> Option<usize> {
        let below = self.steps.len() - index - 1;
        (below > 0).then(|| index + 1 + graph % below)
    }

    fn set(&self, set: BTreeSet<usize>, graph: usize) -> BTreeSet<usize> {
        set.into_iter()
            .map(|step| step % self.steps[graph])
            .collect()
    }

    fn statement(&self, statement: &mut Statement, index: usize, always: bool) {
        match statement {
            Statement::Momentary(targets, condition) => {
                let bound = targets.first().copied().unwrap_or(0);
                if let Some(condition) = condition {
                    self.boolean(condition, bound);
                }
            }
            Statement::Stored(store) => self.store(store),
            Statement::OnActivation(store) | Statement::OnDeactivation(store) => {
                self.store(store);
                if always {
                    *statement = Statement::Stored(store.clone());
                }
            }
            Statement::OnEvent(event, store) => {
                self.store(store);
                self.boolean(event, usize::MAX);
                if always {
                    *statement = Statement::Stored(store.clone());
                } else if !event.has_edge() {
                    *event = Boolean::Rising(Box::new(event.clone()));
                }
            }
            Statement::Force(graph, situation, condition) => {
                match self.inferior(*graph, index) {
                    // A stand-alone action may force its own graph.
                    _ if always && *graph == index => {}
                    Some(inferior) => *graph = inferior,
                    None => {
                        *statement = Statement::Momentary([0].into(), Some(Boolean::Input(0)));
                        return;
                    }
                }
                if let Situation::Set(set) = situation {
                    *set = self.set(std::mem::take(set), *graph);
                }
                if let Some(condition) = condition {
                    self.boolean(condition, usize::MAX);
                }
            }
        }
    }

    fn store(&self, store: &mut Store) {
        match &mut store.what {
            Stored::Boolean(_, value) => self.boolean(value, usize::MAX),
            // A constant outside the range of its variable is refused.
            Stored::Number(_, value) if value.is_constant() => {
                let constant = std::mem::replace(value, Number::Input);
                *value = Number::Arithmetic("+", Box::new(constant), Box::new(Number::Input));
            }
            Stored::Number(..) | Stored::Time(_) => {}
        }
        if let Some(condition) = &mut store.condition {
            self.boolean(condition, usize::MAX);
        }
    }

    /// `bound`: outside edges and timers only momentary variables below it may be read, so that none depend on each
    /// other in a ring.
    fn boolean(&self, expression: &mut Boolean, bound: usize) {
        let graphs = self.steps.len();
        match expression {
            Boolean::Momentary(index) if *index >= bound => *expression = Boolean::Input(*index),
            Boolean::Step(graph, step) => {
                *graph %= graphs;
                *step %= self.steps[*graph];
            }
            Boolean::Macro(graph) => {
                *graph %= graphs;
                if !self.macros[*graph] {
                    *expression = Boolean::Step(*graph, 0);
                }
            }
            Boolean::InSituation(graph, set, _) => {
                *graph %= graphs;
                *set = self.set(std::mem::take(set), *graph);
            }
            Boolean::Not(e) => self.boolean(e, bound),
            Boolean::And(left, right) | Boolean::Or(left, right) | Boolean::Xor(left, right) => {
                self.boolean(left, bound);
                self.boolean(right, bound);
            }
            Boolean::Rising(e) | Boolean::Falling(e) | Boolean::OnDelay(_, e) => {
                self.boolean(e, usize::MAX);
            }
            Boolean::Timer(e, preset) => {
                self.boolean(e, usize::MAX);
                // So is a constant preset beyond 24 days.
                if let Preset::Number(number) = preset
                    && number.is_constant()
                {
                    *number = Number::Parameter;
                }
            }
            Boolean::OnOffDelay(_, e, _) => self.boolean(e, usize::MAX),
            Boolean::Constant(_)
            | Boolean::Input(_)
            | Boolean::Stored(_)
            | Boolean::Momentary(_)
            | Boolean::FirstScan
            | Boolean::Unstable
            | Boolean::Compare(..) => {}
        }
    }
}

/// A transition joins steps of the expansion among each other, but for its entry and exit, or steps outside it, the
/// macro step among them.
fn keep_to_one_side(transition: &mut Transition, entry: usize, exit: usize) {
    let steps = transition.from.iter().chain(&transition.to);
    if steps.clone().all(|step| *step >= entry) {
        transition.from.remove(&exit);
        transition.to.remove(&entry);
        if transition.from.is_empty() && transition.to.is_empty() {
            transition.from.insert(entry);
        }
        return;
    }
    let outside = |set: &BTreeSet<usize>, through: usize| -> BTreeSet<usize> {
        set.iter()
            .map(|step| if *step >= entry { through } else { *step })
            .collect()
    };
    transition.from = outside(&transition.from, exit);
    transition.to = outside(&transition.to, entry);
}

impl Boolean {
    fn has_edge(&self) -> bool {
        match self {
            Boolean::Rising(_) | Boolean::Falling(_) => true,
            Boolean::Not(e) | Boolean::Timer(e, _) => e.has_edge(),
            Boolean::OnDelay(_, e) | Boolean::OnOffDelay(_, e, _) => e.has_edge(),
            Boolean::And(left, right) | Boolean::Or(left, right) | Boolean::Xor(left, right) => {
                left.has_edge() || right.has_edge()
            }
            _ => false,
        }
    }
}

impl Number {
    fn is_constant(&self) -> bool {
        match self {
            Number::Constant(_) => true,
            Number::Input | Number::Variable(_) | Number::Parameter => false,
            Number::Negate(value) => value.is_constant(),
            Number::Arithmetic(_, left, right) => left.is_constant() && right.is_constant(),
        }
    }
}
