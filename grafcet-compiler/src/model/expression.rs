//! Expressions with their types.

use super::{GraphId, MacroId, Model, Situation, StepId, VariableId};
use crate::ast::{Binary, DeclarationKind, Type};
use crate::source::Span;

pub use grafcet_core::program::Edge;

/// An expression with its place.
#[derive(Clone, Debug)]
pub struct Expression {
    /// What it is.
    pub kind: ExpressionKind,
    /// Its type; unknown when something in it was wrong, which has been reported.
    pub ty: Option<Type>,
    /// Where it stands.
    pub span: Span,
}

/// The kinds of expression.
#[derive(Clone, Debug)]
pub enum ExpressionKind {
    /// Something that was wrong.
    Unknown,
    /// A literal.
    Constant(i32),
    /// A declared name, a constant's too.
    Variable(VariableId),
    /// An interface name of an instance with what it is bound to.
    Bound(VariableId, Box<Expression>),
    /// A step bit.
    Step(StepId),
    /// The step bit of a macro step.
    Macro(MacroId),
    /// A `System:` name.
    System(System),
    /// `S(G) = {..}`.
    Situation {
        /// The graph.
        graph: GraphId,
        /// What it is compared with.
        situation: Situation,
        /// False for `<>`.
        equal: bool,
    },
    /// `T/enable/preset`.
    Timer {
        /// What starts it.
        enable: Box<Expression>,
        /// A `time`, or an `int` in seconds.
        preset: Box<Expression>,
    },
    /// `t1/e` or `t1/e/t2`.
    Delay {
        /// On-delay, a `time`.
        on: Box<Expression>,
        /// The Boolean.
        enable: Box<Expression>,
        /// Off-delay, a `time`.
        off: Option<Box<Expression>>,
    },
    /// `↑e` or `↓e`.
    Edge(Edge, Box<Expression>),
    /// `NOT e`.
    Not(Box<Expression>),
    /// `- e`.
    Negate(Box<Expression>),
    /// Two operands. Never the `/` of a delay.
    Binary(Binary, Box<Expression>, Box<Expression>),
}

/// The `System:` names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum System {
    /// `System:first_scan`.
    FirstScan,
    /// `System:unstable`.
    Unstable,
    /// `System:recovered`.
    Recovered,
    /// `System:overruns`.
    Overruns,
    /// `System:arithmetic_faults`.
    ArithmeticFaults,
}

impl System {
    /// All of them.
    pub const ALL: [System; 5] = [
        System::FirstScan,
        System::Unstable,
        System::Recovered,
        System::Overruns,
        System::ArithmeticFaults,
    ];

    /// The name behind `System:`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            System::FirstScan => "first_scan",
            System::Unstable => "unstable",
            System::Recovered => "recovered",
            System::Overruns => "overruns",
            System::ArithmeticFaults => "arithmetic_faults",
        }
    }

    /// Boolean or `int`.
    #[must_use]
    pub fn ty(self) -> Type {
        match self {
            System::FirstScan | System::Unstable | System::Recovered => Type::Bool,
            System::Overruns | System::ArithmeticFaults => Type::Int,
        }
    }
}

impl Expression {
    /// What stands where something was wrong.
    pub(super) fn unknown(span: Span) -> Self {
        Expression {
            kind: ExpressionKind::Unknown,
            ty: None,
            span,
        }
    }

    /// The expression that a chain of interface names stands for.
    #[must_use]
    pub fn bare(&self) -> &Expression {
        let mut expression = self;
        while let ExpressionKind::Bound(_, inner) = &expression.kind {
            expression = inner;
        }
        expression
    }

    /// A step bit or macro bit standing alone.
    #[must_use]
    pub fn is_step(&self) -> bool {
        matches!(
            self.bare().kind,
            ExpressionKind::Step(_) | ExpressionKind::Macro(_)
        )
    }

    /// The operands, outermost only.
    #[must_use]
    pub fn operands(&self) -> Vec<&Expression> {
        match &self.kind {
            ExpressionKind::Unknown
            | ExpressionKind::Constant(_)
            | ExpressionKind::Variable(_)
            | ExpressionKind::Step(_)
            | ExpressionKind::Macro(_)
            | ExpressionKind::System(_)
            | ExpressionKind::Situation { .. } => Vec::new(),
            ExpressionKind::Bound(_, inner)
            | ExpressionKind::Edge(_, inner)
            | ExpressionKind::Not(inner)
            | ExpressionKind::Negate(inner) => vec![inner],
            ExpressionKind::Timer { enable, preset } => vec![enable, preset],
            ExpressionKind::Delay { on, enable, off } => {
                let mut operands = vec![&**on, &**enable];
                operands.extend(off.as_deref());
                operands
            }
            ExpressionKind::Binary(_, left, right) => vec![left, right],
        }
    }

    /// Visits the expression and everything in it, outer ones first.
    pub fn visit<'e>(&'e self, mut visitor: impl FnMut(&'e Expression) -> Inside) {
        let mut waiting = vec![self];
        while let Some(expression) = waiting.pop() {
            if visitor(expression) == Inside::Visit {
                waiting.extend(expression.operands().into_iter().rev());
            }
        }
    }

    /// Whether anything in it, or itself, satisfies the predicate.
    pub fn contains(&self, mut predicate: impl FnMut(&Expression) -> bool) -> bool {
        let mut found = false;
        self.visit(|expression| {
            found |= predicate(expression);
            if found { Inside::Skip } else { Inside::Visit }
        });
        found
    }

    /// Whether it is an edge, which is evaluated in a phase of its own.
    #[must_use]
    pub fn is_edge(&self) -> bool {
        matches!(self.kind, ExpressionKind::Edge(..))
    }

    /// Whether it is an edge or a timer: what is inside is evaluated before the actions.
    #[must_use]
    pub fn is_watch(&self) -> bool {
        matches!(
            self.kind,
            ExpressionKind::Edge(..) | ExpressionKind::Timer { .. } | ExpressionKind::Delay { .. }
        )
    }

    /// Whether it is made of literals and constants only, all of which have a value.
    #[must_use]
    pub fn is_of_constants(&self, model: &Model) -> bool {
        !self.contains(|it| match it.kind {
            ExpressionKind::Variable(id) => {
                model[id].kind != DeclarationKind::Constant || model[id].initial.is_none()
            }
            ExpressionKind::Constant(_) => false,
            _ => it.operands().is_empty(),
        })
    }

    /// The value, when constants alone decide it. Arithmetic that would be a fault decides nothing.
    #[must_use]
    pub fn constant(&self, model: &Model) -> Option<i32> {
        match &self.kind {
            ExpressionKind::Constant(value) => Some(*value),
            ExpressionKind::Variable(id) => {
                let variable = &model[*id];
                (variable.kind == DeclarationKind::Constant)
                    .then_some(variable.initial)
                    .flatten()
            }
            ExpressionKind::Bound(_, inner) => inner.constant(model),
            ExpressionKind::Not(inner) => inner.constant(model).map(|value| i32::from(value == 0)),
            ExpressionKind::Negate(inner) => inner.constant(model)?.checked_neg(),
            ExpressionKind::Binary(operator, left, right) => {
                combine(*operator, left.constant(model), right.constant(model))
            }
            _ => None,
        }
    }
}

/// Whether a visitor wants to see what is inside an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inside {
    /// Go on inside.
    Visit,
    /// Leave it out.
    Skip,
}

/// The value of an operator on constants; `AND` with False and `OR` with True need one of them only.
pub(crate) fn combine(operator: Binary, left: Option<i32>, right: Option<i32>) -> Option<i32> {
    match operator {
        Binary::And if left == Some(0) || right == Some(0) => return Some(0),
        Binary::Or if left == Some(1) || right == Some(1) => return Some(1),
        _ => {}
    }
    let (left, right) = (left?, right?);
    match operator {
        Binary::And => Some(left & right),
        Binary::Or => Some(left | right),
        Binary::Xor => Some(left ^ right),
        Binary::Equal => Some(i32::from(left == right)),
        Binary::NotEqual => Some(i32::from(left != right)),
        Binary::Less => Some(i32::from(left < right)),
        Binary::LessOrEqual => Some(i32::from(left <= right)),
        Binary::Greater => Some(i32::from(left > right)),
        Binary::GreaterOrEqual => Some(i32::from(left >= right)),
        Binary::Add => left.checked_add(right),
        Binary::Subtract => left.checked_sub(right),
        Binary::Multiply => left.checked_mul(right),
        Binary::Divide => left.checked_div(right),
        Binary::Modulo if right == 0 => None,
        // The one overflow, -2^31 MOD -1, has the exact remainder 0.
        Binary::Modulo => Some(left.checked_rem(right).unwrap_or(0)),
    }
}
