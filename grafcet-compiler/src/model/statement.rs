//! Actions: statements sorted by when they run, each group in source order.

use super::{Expression, GraphId, StepId, VariableId};
use crate::source::Span;

/// The statements of a step, of a stand-alone action or of a transition's `do`.
#[derive(Clone, Debug, Default)]
pub struct Action {
    /// `A, B IF c`.
    pub momentary: Vec<Momentary>,
    /// `a = e IF c`, in a step without `on`.
    pub stored: Vec<Stored>,
    /// Stored `on activation`.
    pub on_activation: Vec<Stored>,
    /// Stored `on deactivation`.
    pub on_deactivation: Vec<Stored>,
    /// Stored `on event`.
    pub on_event: Vec<OnEvent>,
    /// Forcing.
    pub orders: Vec<Order>,
}

impl Action {
    /// All stored statements, those under `on` too.
    pub fn all_stored(&self) -> impl Iterator<Item = &Stored> {
        let events = self.on_event.iter().flat_map(|event| &event.stored);
        self.stored
            .iter()
            .chain(&self.on_activation)
            .chain(&self.on_deactivation)
            .chain(events)
    }

    /// All expressions, conditions and events and values.
    pub fn expressions(&self) -> impl Iterator<Item = &Expression> {
        let momentary = self.momentary.iter().filter_map(|it| it.condition.as_ref());
        let orders = self.orders.iter().filter_map(|it| it.condition.as_ref());
        let events = self.on_event.iter().map(|it| &it.event);
        let stored = self
            .all_stored()
            .flat_map(|it| std::iter::once(&it.value).chain(&it.condition));
        momentary.chain(stored).chain(events).chain(orders)
    }
}

/// A variable that an action writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Target {
    /// The variable that is written.
    pub variable: VariableId,
    /// The name by which the statement calls it: an interface name of an instance, or the variable itself.
    pub named: VariableId,
    /// Where it is named.
    pub span: Span,
}

/// A momentary statement.
#[derive(Clone, Debug)]
pub struct Momentary {
    /// The Boolean variables.
    pub targets: Vec<Target>,
    /// The condition behind `IF`.
    pub condition: Option<Expression>,
    /// The statement.
    pub span: Span,
}

/// A stored statement.
#[derive(Clone, Debug)]
pub struct Stored {
    /// The variable.
    pub target: Target,
    /// What is stored.
    pub value: Expression,
    /// The condition behind `IF`.
    pub condition: Option<Expression>,
    /// The statement.
    pub span: Span,
}

/// `on event e`.
#[derive(Clone, Debug)]
pub struct OnEvent {
    /// The event.
    pub event: Expression,
    /// What is stored when it comes.
    pub stored: Vec<Stored>,
}

/// A forcing statement.
#[derive(Clone, Debug)]
pub struct Order {
    /// The graph that is forced.
    pub graph: GraphId,
    /// Into what.
    pub situation: Situation,
    /// The condition behind `IF`.
    pub condition: Option<Expression>,
    /// The statement.
    pub span: Span,
}

/// A situation as the text names it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Situation {
    /// `{1, 3}` or `{}`.
    Steps(Vec<StepId>),
    /// `{I}`.
    Initial,
    /// `{*}`.
    Current,
}

/// A graph that a step encloses.
#[derive(Clone, Debug)]
pub struct Encloses {
    /// The graph.
    pub graph: GraphId,
    /// The set that the step's activation gives.
    pub steps: Vec<StepId>,
    /// Where the graph is named.
    pub span: Span,
}
