//! Phase 6: what the actions store.

use grafcet_compiler::ast::{Event, Expression, Statement, StatementKind};

use crate::expression::Scope;
use crate::graph::Owner;
use crate::machine::{Fired, Machine};
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

impl<'a> Machine<'a> {
    /// Evaluates the edges and timers in these groups of statements.
    pub(crate) fn watch_actions(&mut self, groups: &[Group]) {
        let program = self.program;
        for graph in &program.graphs {
            let scope = Scope::of(graph.name);
            let blocks = graph.transitions.iter().filter_map(|t| t.action.as_ref());
            let of_transitions = blocks.flat_map(|block| &block.statements);
            let of_transitions = of_transitions.map(|statement| (Group::Immediate, statement));
            let others = graph.statements.iter().flat_map(|&(_, s)| match &s.kind {
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
            for &(owner, statement) in &graph.statements {
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
                for &(owner, statement) in &graph.statements {
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

    /// Whether an action is executed: its step is active, or it stands alone.
    pub(crate) fn executes(&self, graph: &'a str, owner: Owner<'a>) -> bool {
        owner.is_none_or(|step| self.active((graph, step)))
    }

    /// Whether there is no condition, or it is True.
    pub(crate) fn holds(&mut self, condition: Option<&'a Expression>, scope: &Scope<'a>) -> bool {
        condition.is_none_or(|condition| self.evaluate(condition, scope).truth())
    }
}
