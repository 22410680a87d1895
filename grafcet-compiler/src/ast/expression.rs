//! Expressions.

use super::{Name, Ref, Situation};
use crate::source::Span;

/// An expression with its place.
#[derive(Clone, Debug, Hash)]
pub struct Expression {
    /// What it is.
    pub kind: ExpressionKind,
    /// The whole expression, its parentheses not included.
    pub span: Span,
}

/// The kinds of expression.
#[derive(Clone, Debug, Hash)]
pub enum ExpressionKind {
    /// `TRUE`, `FALSE` in any case.
    Bool(bool),
    /// An integer, never negative except as the one literal `-n` directly before digits; saturated to 64 bits.
    Integer(i64),
    /// A duration in milliseconds, saturated to 64 bits.
    Duration(i64),
    /// A number or duration that cannot be read, which has been reported.
    Unreadable,
    /// A variable, a step bit or a `System:` name.
    Ref(Ref),
    /// `S(Graph) = {..}`, or `<>`.
    Situation {
        /// The graph.
        graph: Name,
        /// What it is compared with.
        situation: Situation,
        /// False for `<>`.
        equal: bool,
    },
    /// `T/enable/preset`.
    Timer {
        /// What starts it.
        enable: Box<Expression>,
        /// A duration, an integer (seconds), a name or an expression.
        preset: Box<Expression>,
    },
    /// `t1/e` or `t1/e/t2`.
    Delay {
        /// On-delay.
        on: Box<Expression>,
        /// The Boolean.
        enable: Box<Expression>,
        /// Off-delay.
        off: Option<Box<Expression>>,
    },
    /// One operand.
    Unary {
        /// The operator.
        operator: Unary,
        /// Its operand.
        operand: Box<Expression>,
    },
    /// Two operands.
    Binary {
        /// The operator.
        operator: Binary,
        /// Where it stands.
        operator_span: Span,
        /// Left of it.
        left: Box<Expression>,
        /// Right of it.
        right: Box<Expression>,
    },
}

/// Operators with one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unary {
    /// `NOT`.
    Not,
    /// `-`.
    Negate,
    /// `↑`.
    Rising,
    /// `↓`.
    Falling,
}

/// Operators with two operands. `/` between a time and a Boolean is a [`ExpressionKind::Delay`]; where only types
/// can tell (`a/b` of two names), the parser leaves a [`Binary::Divide`] and the checks decide.
///
/// Operators of one strength are joined from the left, `1s/a/2s` as `(1s/a)/2s`. A chain of `AND`, of `OR` or of `XOR`
/// is a balanced tree in source order, so that its depth grows with the logarithm of its length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binary {
    /// `AND`.
    And,
    /// `OR`.
    Or,
    /// `XOR`.
    Xor,
    /// `=`.
    Equal,
    /// `<>`.
    NotEqual,
    /// `<`.
    Less,
    /// `<=`.
    LessOrEqual,
    /// `>`.
    Greater,
    /// `>=`.
    GreaterOrEqual,
    /// `+`.
    Add,
    /// `-`.
    Subtract,
    /// `*`.
    Multiply,
    /// `/`.
    Divide,
    /// `MOD`.
    Modulo,
}
