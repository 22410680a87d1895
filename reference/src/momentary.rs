//! Phase 7: momentary variables.

use std::collections::BTreeMap;

use grafcet_compiler::ast::{Expression, StatementKind};
use grafcet_compiler::source::Span;

use crate::expression::Scope;
use crate::graph::Owner;
use crate::machine::Machine;
use crate::name::Qualified;
use crate::program::Program;
use crate::value::Value;

/// A momentary statement.
#[derive(Clone, Debug)]
pub struct Momentary<'a> {
    graph: &'a str,
    owner: Owner<'a>,
    targets: Vec<Qualified<'a>>,
    condition: Option<&'a Expression>,
    span: Span,
}

/// Phase 7 at work.
#[derive(Debug, Default)]
pub struct Calculation<'a> {
    variables: BTreeMap<Qualified<'a>, bool>,
    /// The conditions that have been evaluated, by graph and statement.
    conditions: BTreeMap<(&'a str, Span), bool>,
}

impl<'a> Program<'a> {
    pub(crate) fn find_momentary(&self) -> Vec<Momentary<'a>> {
        let mut all = Vec::new();
        for graph in &self.graphs {
            for (owner, statement) in &graph.statements {
                if let StatementKind::Momentary { targets, condition } = &statement.kind {
                    let targets = targets.iter();
                    all.push(Momentary {
                        graph: graph.name,
                        owner: *owner,
                        targets: targets.map(|t| self.target(graph.name, t)).collect(),
                        condition: condition.as_ref(),
                        span: statement.span,
                    });
                }
            }
        }
        all
    }
}

impl<'a> Machine<'a> {
    /// Phase 7. What a condition needs is calculated when it is read.
    pub(crate) fn calculate_momentary(&mut self) {
        let program = self.program;
        self.calculation = Some(Calculation::default());
        for target in program.momentary.iter().flat_map(|s| &s.targets) {
            let value = self.read(*target);
            self.values.insert(*target, value);
        }
        self.calculation = None;
    }

    /// The value of a variable; in phase 7, what a momentary one is now.
    pub(crate) fn read(&mut self, name: Qualified<'a>) -> Value {
        let program = self.program;
        let Some(calculation) = &self.calculation else {
            return self.values[&name];
        };
        if let Some(value) = calculation.variables.get(&name) {
            return Value::Bool(*value);
        }
        let all = program.momentary.iter();
        let mut statements = all.filter(|s| s.targets.contains(&name)).peekable();
        if statements.peek().is_none() {
            return self.values[&name];
        }
        let mut value = false;
        for statement in statements {
            if self.executes(statement.graph, statement.owner) {
                value |= self.condition(statement);
            }
        }
        if let Some(calculation) = &mut self.calculation {
            calculation.variables.insert(name, value);
        }
        Value::Bool(value)
    }

    /// The condition of a statement, evaluated once however many variables the statement names.
    fn condition(&mut self, statement: &Momentary<'a>) -> bool {
        let key = (statement.graph, statement.span);
        let calculation = self.calculation.as_ref();
        if let Some(value) = calculation.and_then(|c| c.conditions.get(&key)) {
            return *value;
        }
        let value = self.holds(statement.condition, &Scope::of(statement.graph));
        if let Some(calculation) = &mut self.calculation {
            calculation.conditions.insert(key, value);
        }
        value
    }
}
