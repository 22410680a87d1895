//! Phases 6 and 7: what the actions do.

use std::collections::BTreeMap;

use grafcet_compiler::ast::{DeclarationKind, Event, Expression, Ref, Statement, StatementKind};
use grafcet_compiler::source::Span;

use crate::expression::Scope;
use crate::graph::Owner;
use crate::machine::{Fired, Machine};
use crate::name::Qualified;
use crate::value::Value;
use crate::watch::Pass;

/// Statements of which the edges and timers are evaluated together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// `do` blocks, and what stands under `on`.
    Immediate,
    /// Everything else that stores or is momentary.
    Plain,
}

/// An `on` statement that runs, with its graph.
pub type Due<'a> = (&'a str, &'a StatementKind);

/// Phase 7 at work.
#[derive(Debug, Default)]
pub struct Calculation<'a> {
    variables: BTreeMap<Qualified<'a>, bool>,
    /// The conditions that have been evaluated, by graph and statement.
    conditions: BTreeMap<(&'a str, Span), bool>,
}

/// A momentary statement.
#[derive(Clone, Copy)]
struct Momentary<'a> {
    graph: &'a str,
    owner: Owner<'a>,
    targets: &'a [Ref],
    condition: Option<&'a Expression>,
    span: Span,
}

impl<'a> Machine<'a> {
    /// Evaluates the edges and timers in these groups of statements.
    pub(crate) fn watch_actions(&mut self, groups: &[Group]) {
        let program = self.program;
        for graph in &program.graphs {
            let scope = Scope::of(graph.name);
            let blocks = graph.transitions.iter().filter_map(|t| t.action.as_ref());
            let of_transitions = blocks.flat_map(|block| &block.statements);
            let of_transitions = of_transitions.map(|statement| (Group::Immediate, statement));
            let others = graph
                .statements()
                .into_iter()
                .flat_map(|(_, s)| match &s.kind {
                    StatementKind::On { statements, .. } => {
                        statements.iter().map(|s| (Group::Immediate, s)).collect()
                    }
                    _ => vec![(Group::Plain, s)],
                });
            for (group, statement) in of_transitions.chain(others) {
                if groups.contains(&group) {
                    self.watch_statement(statement, &scope);
                }
            }
        }
    }

    fn watch_statement(&mut self, statement: &'a Statement, scope: &Scope<'a>) {
        let (value, condition) = match &statement.kind {
            StatementKind::Stored {
                value, condition, ..
            } => (Some(value), condition),
            StatementKind::Momentary { condition, .. } => (None, condition),
            _ => return,
        };
        for expression in value.into_iter().chain(condition) {
            self.watch(expression, scope, Pass::Compare);
        }
    }

    /// Phase 6, the statements that run because something happened.
    pub(crate) fn run_immediate(&mut self, fired: &Fired<'a>) {
        let program = self.program;
        for graph in &program.graphs {
            for (number, transition) in graph.transitions.iter().enumerate() {
                if let (true, Some(block)) = (
                    fired.transitions.contains(&(graph.name, number)),
                    &transition.action,
                ) {
                    self.run(graph.name, &block.statements);
                }
            }
        }
        for (graph, statement) in &fired.events {
            if let StatementKind::On { statements, .. } = statement {
                self.run(graph, statements);
            }
        }
        self.run_on(
            |event| matches!(event, Event::Deactivation),
            |now, before| before && !now,
        );
        self.run_on(
            |event| matches!(event, Event::Activation),
            |now, before| now && !before,
        );
    }

    /// Runs the `on` statements of a kind in the steps to which it happened.
    fn run_on(&mut self, kind: impl Fn(&Event) -> bool, happened: impl Fn(bool, bool) -> bool) {
        let program = self.program;
        for graph in &program.graphs {
            for (owner, statement) in graph.statements() {
                if let (Some(step), StatementKind::On { event, statements }) =
                    (owner, &statement.kind)
                {
                    let step = (graph.name, step);
                    if kind(event) && happened(self.active(step), self.was_active(step)) {
                        self.run(graph.name, statements);
                    }
                }
            }
        }
    }

    /// Phase 6, the rest: stand-alone actions, then the actions of the active steps.
    pub(crate) fn run_plain(&mut self) {
        let program = self.program;
        for stands_alone in [true, false] {
            for graph in &program.graphs {
                for (owner, statement) in graph.statements() {
                    if owner.is_none() == stands_alone && self.executes(graph.name, owner) {
                        self.run(graph.name, std::slice::from_ref(statement));
                    }
                }
            }
        }
    }

    /// Runs the stored ones of these statements.
    fn run(&mut self, graph: &'a str, statements: &'a [Statement]) {
        let scope = Scope::of(graph);
        for statement in statements {
            let StatementKind::Stored {
                target,
                value,
                condition,
            } = &statement.kind
            else {
                continue;
            };
            if self.holds(condition.as_ref(), &scope) {
                let value = self.evaluate(value, &scope);
                self.store(self.program.target(graph, target), value);
            }
        }
    }

    fn executes(&self, graph: &'a str, owner: Owner<'a>) -> bool {
        owner.is_none_or(|step| self.active((graph, step)))
    }

    fn holds(&mut self, condition: Option<&'a Expression>, scope: &Scope<'a>) -> bool {
        condition.is_none_or(|condition| self.evaluate(condition, scope).truth())
    }

    /// Phase 7. What a condition needs is calculated when it is read.
    pub(crate) fn calculate_momentary(&mut self) {
        self.calculation = Some(Calculation::default());
        let mut targets = Vec::new();
        for statement in self.momentary() {
            for target in statement.targets {
                targets.push(self.program.target(statement.graph, target));
            }
        }
        for target in targets {
            let value = self.read(target);
            self.values.insert(target, value);
        }
        self.calculation = None;
    }

    /// The value of a variable; in phase 7, what a momentary one is now.
    pub(crate) fn read(&mut self, name: Qualified<'a>) -> Value {
        let Some(calculation) = &self.calculation else {
            return self.values[&name];
        };
        if let Some(value) = calculation.variables.get(&name) {
            return Value::Bool(*value);
        }
        if self.program.kind(name) == DeclarationKind::Input {
            return self.values[&name];
        }
        let statements = self.momentary().into_iter();
        let statements: Vec<Momentary<'a>> = statements
            .filter(|s| {
                s.targets
                    .iter()
                    .any(|t| self.program.target(s.graph, t) == name)
            })
            .collect();
        if statements.is_empty() {
            return self.values[&name];
        }
        let mut value = false;
        for statement in statements {
            if self.executes(statement.graph, statement.owner) {
                value |= self.momentary_condition(statement);
            }
        }
        if let Some(calculation) = &mut self.calculation {
            calculation.variables.insert(name, value);
        }
        Value::Bool(value)
    }

    /// The condition of a momentary statement, evaluated once however many variables it names.
    fn momentary_condition(&mut self, statement: Momentary<'a>) -> bool {
        let key = (statement.graph, statement.span);
        let known = self
            .calculation
            .as_ref()
            .and_then(|c| c.conditions.get(&key));
        if let Some(value) = known {
            return *value;
        }
        let value = self.holds(statement.condition, &Scope::of(statement.graph));
        if let Some(calculation) = &mut self.calculation {
            calculation.conditions.insert(key, value);
        }
        value
    }

    /// Every momentary statement, whether or not it is executed.
    fn momentary(&self) -> Vec<Momentary<'a>> {
        let mut all = Vec::new();
        for graph in &self.program.graphs {
            for (owner, statement) in graph.statements() {
                if let StatementKind::Momentary { targets, condition } = &statement.kind {
                    all.push(Momentary {
                        graph: graph.name,
                        owner,
                        targets,
                        condition: condition.as_ref(),
                        span: statement.span,
                    });
                }
            }
        }
        all
    }
}
