//! What an expression is worth.

use grafcet_compiler::ast::{Binary, Expression, ExpressionKind, Type, Unary};
use grafcet_compiler::source::Span;

use crate::machine::Machine;
use crate::name::{Named, Qualified};
use crate::value::{self, Calculated, Value};

/// Where an operator stands: the graph and the place in the text; for one in an expression that an instance binds to
/// an input, the place of the input before it.
pub type Place<'a> = Vec<(&'a str, Span)>;

/// Where an expression stands.
#[derive(Clone, Debug)]
pub struct Scope<'a> {
    /// The graph in which its names are looked up; empty for the application.
    pub graph: &'a str,
    around: Place<'a>,
}

/// An on-delay, or an on-and-off-delay.
#[derive(Clone, Copy, Debug)]
pub struct Delay<'a> {
    pub on: &'a Expression,
    pub enable: &'a Expression,
    pub off: Option<&'a Expression>,
}

impl<'a> Scope<'a> {
    /// In the text of a graph.
    pub fn of(graph: &'a str) -> Self {
        Scope {
            graph,
            around: Place::new(),
        }
    }

    /// In the expression to which an instance binds an input that is used at `span`.
    pub fn bound(&self, span: Span) -> Self {
        Scope {
            graph: "",
            around: self.place(span),
        }
    }

    /// The place of an operator.
    pub fn place(&self, span: Span) -> Place<'a> {
        let mut place = self.around.clone();
        place.push((self.graph, span));
        place
    }
}

impl<'a> Machine<'a> {
    /// The value of an expression. Edges and timers are what they were when they were evaluated last; both sides of
    /// every operator are evaluated.
    pub(crate) fn evaluate(&mut self, expression: &'a Expression, scope: &Scope<'a>) -> Value {
        if self.delay(expression, scope).is_some() {
            return self.observed(expression, scope);
        }
        match &expression.kind {
            ExpressionKind::Bool(value) => Value::Bool(*value),
            ExpressionKind::Integer(value) => Value::Int(literal(*value)),
            ExpressionKind::Duration(ms) => Value::Time(literal(*ms)),
            ExpressionKind::Unreadable => panic!("a program with errors is not run"),
            ExpressionKind::Ref(reference) => match self.program.resolve(scope.graph, reference) {
                Named::Variable(name) => self.read(name),
                Named::Constant(value) => value,
                Named::Step(step) => Value::Bool(self.active(step)),
                Named::Bound(bound) => self.evaluate(bound, &scope.bound(expression.span)),
                Named::System(name) => self.system(name),
            },
            ExpressionKind::Situation {
                graph,
                situation,
                equal,
            } => {
                let graph = self.program.graph(scope.graph, &graph.text);
                let named = graph.named_situation(situation);
                let same = named.as_ref() == Some(&self.situation[graph.name]);
                Value::Bool(same == *equal)
            }
            ExpressionKind::Timer { .. }
            | ExpressionKind::Delay { .. }
            | ExpressionKind::Unary {
                operator: Unary::Rising | Unary::Falling,
                ..
            } => self.observed(expression, scope),
            ExpressionKind::Unary {
                operator: Unary::Not,
                operand,
            } => Value::Bool(!self.evaluate(operand, scope).truth()),
            ExpressionKind::Unary {
                operator: Unary::Negate,
                operand,
            } => {
                let operand = self.evaluate(operand, scope);
                self.count(value::negated(operand))
            }
            ExpressionKind::Binary {
                operator,
                left,
                right,
                ..
            } => {
                let left = self.evaluate(left, scope);
                let right = self.evaluate(right, scope);
                self.count(value::binary(*operator, left, right))
            }
        }
    }

    /// The delay that an expression is. `a / b` is one when `b` is Boolean.
    pub(crate) fn delay(&self, expression: &'a Expression, scope: &Scope<'a>) -> Option<Delay<'a>> {
        match &expression.kind {
            ExpressionKind::Delay { on, enable, off } => Some(Delay {
                on,
                enable,
                off: off.as_deref(),
            }),
            ExpressionKind::Binary {
                operator: Binary::Divide,
                left,
                right,
                ..
            } => {
                if self.type_of(right, scope) == Type::Bool {
                    return Some(Delay {
                        on: left,
                        enable: right,
                        off: None,
                    });
                }
                let delay = self.delay(left, scope)?;
                Some(Delay {
                    off: Some(right),
                    ..delay
                })
            }
            _ => None,
        }
    }

    /// The step or macro step whose bit an expression is, standing alone.
    pub(crate) fn step_alone(
        &self,
        expression: &'a Expression,
        scope: &Scope<'a>,
    ) -> Option<Qualified<'a>> {
        let ExpressionKind::Ref(reference) = &expression.kind else {
            return None;
        };
        match self.program.resolve(scope.graph, reference) {
            Named::Step(step) => Some(step),
            Named::Bound(bound) => self.step_alone(bound, &scope.bound(expression.span)),
            _ => None,
        }
    }

    fn observed(&self, operator: &'a Expression, scope: &Scope<'a>) -> Value {
        Value::Bool(self.watched[&scope.place(operator.span)])
    }

    fn count(&mut self, calculated: Calculated) -> Value {
        if calculated.fault {
            self.fault();
        }
        calculated.value
    }

    fn system(&self, name: &str) -> Value {
        match name {
            "first_scan" => Value::Bool(self.first_scan),
            "unstable" => Value::Bool(self.unstable),
            "recovered" => Value::Bool(self.recovered),
            "overruns" => Value::Int(self.overruns),
            "arithmetic_faults" => Value::Int(self.faults),
            other => panic!("there is no `System:{other}`"),
        }
    }

    fn type_of(&self, expression: &'a Expression, scope: &Scope<'a>) -> Type {
        match &expression.kind {
            ExpressionKind::Integer(_) => Type::Int,
            ExpressionKind::Duration(_) => Type::Time,
            ExpressionKind::Ref(reference) => match self.program.resolve(scope.graph, reference) {
                Named::Variable(name) => self.program.ty(name),
                Named::Constant(value) => value.ty(),
                Named::Step(_) => Type::Bool,
                Named::Bound(bound) => self.type_of(bound, &scope.bound(expression.span)),
                Named::System(name) => self.system(name).ty(),
            },
            ExpressionKind::Unary {
                operator: Unary::Negate,
                operand,
            } => self.type_of(operand, scope),
            ExpressionKind::Binary { .. } if self.delay(expression, scope).is_some() => Type::Bool,
            ExpressionKind::Binary {
                operator,
                left,
                right,
                ..
            } => {
                let left = self.type_of(left, scope);
                value::result_type(*operator, left, self.type_of(right, scope))
            }
            _ => Type::Bool,
        }
    }
}

/// The compiler has refused literals that do not fit.
fn literal(wide: i64) -> i32 {
    i32::try_from(wide).unwrap_or_else(|_| panic!("{wide} is no number"))
}
