//! Properties and tests.

use super::{Constant, Expression, Name, Ref, Text};
use crate::source::Span;

/// `property "text": never expression`.
#[derive(Clone, Debug, Hash)]
pub struct Property {
    /// What it says.
    pub text: Text,
    /// What must hold.
    pub kind: PropertyKind,
    /// The whole element.
    pub span: Span,
}

/// What a property asks for.
#[derive(Clone, Debug, Hash)]
pub enum PropertyKind {
    /// `never e`.
    Never(Expression),
    /// `always e`.
    Always(Expression),
    /// `reachable e`.
    Reachable(Expression),
    /// `recoverable e`.
    Recoverable(Expression),
    /// `after e within d expect e`.
    After {
        /// What starts the time.
        trigger: Expression,
        /// The time allowed.
        within: Constant,
        /// What must come.
        expect: Expression,
    },
}

/// `test "text" with A, B { .. }`.
#[derive(Clone, Debug, Hash)]
pub struct Test {
    /// What it claims.
    pub text: Text,
    /// The plants it runs with.
    pub plants: Vec<Name>,
    /// Its steps.
    pub steps: Vec<TestStep>,
    /// The whole element.
    pub span: Span,
}

/// A step of a test with its place.
#[derive(Clone, Debug, Hash)]
pub struct TestStep {
    /// What it does.
    pub kind: TestStepKind,
    /// The whole step.
    pub span: Span,
}

/// What a step of a test does.
#[derive(Clone, Debug, Hash)]
pub enum TestStepKind {
    /// `set a, b = 3`; no constant means True.
    Set(Vec<(Ref, Option<Constant>)>),
    /// `clear a, b`.
    Clear(Vec<Ref>),
    /// `release a, b`.
    Release(Vec<Ref>),
    /// `pulse a for 50 ms`.
    Pulse(Ref, Constant),
    /// `wait 100 ms`.
    Wait(Constant),
    /// `wait 3 scans`.
    WaitScans(i64),
    /// `wait until e within d`.
    WaitUntil(Expression, Constant),
    /// `expect e`.
    Expect(Expression),
    /// `never e`.
    Never(Expression),
    /// `always e`.
    Always(Expression),
    /// `power cycle`.
    PowerCycle,
}
