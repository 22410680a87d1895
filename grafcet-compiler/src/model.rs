//! The program with every name looked up and every type known: what checks and lowering read.
//!
//! Everything lies in one list for its kind, in source order, and refers to other things by index. Templates and
//! imports are gone: an instance is a graph like any other. What was wrong in the text is missing here, or of unknown
//! type, and has been reported; such a model is checked further and never lowered.

mod action;
mod address;
mod bound;
mod causality;
mod claim;
mod constant;
mod declaration;
mod expression;
mod hierarchy;
mod instance;
mod library;
mod missing;
mod names;
mod operator;
mod options;
mod resolver;
mod statement;
mod structure;
mod suggest;
mod target;
mod timing;

use std::collections::BTreeSet;
use std::ops::{Index, IndexMut, Range};

pub use crate::ast::{DeclarationKind, StepRole, Type};
pub use address::{Address, Area, Size};
pub use bound::{MAX_BOUND_DEPTH, MAX_BOUND_SIZE};
pub(crate) use causality::Causality;
pub use claim::{Claimed, Property, Test, TestStep, TestStepKind};
pub(crate) use expression::combine;
pub use expression::{Edge, Expression, ExpressionKind, Inside, System};
pub(crate) use hierarchy::Hierarchy;
pub use instance::MAX_REPEATED;
pub(crate) use library::load;
pub use operator::MAX_COMPARED;
pub(crate) use resolver::resolve;
pub use statement::{Action, Encloses, Momentary, OnEvent, Order, Situation, Stored, Target};

use crate::source::Span;

macro_rules! ids {
    ($($(#[$doc:meta])* $id:ident, $list:ident: $row:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $id(pub usize);

        impl Index<$id> for Model {
            type Output = $row;

            fn index(&self, id: $id) -> &$row {
                &self.$list[id.0]
            }
        }

        impl IndexMut<$id> for Model {
            fn index_mut(&mut self, id: $id) -> &mut $row {
                &mut self.$list[id.0]
            }
        }
    )*};
}

ids! {
    /// Index in [`Model::variables`].
    VariableId, variables: Variable;
    /// Index in [`Model::graphs`].
    GraphId, graphs: Graph;
    /// Index in [`Model::steps`].
    StepId, steps: Step;
    /// Index in [`Model::macros`].
    MacroId, macros: Macro;
    /// Index in [`Model::transitions`].
    TransitionId, transitions: Transition;
}

/// A whole application.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// The name behind `application`; the main file's stem when there is none.
    pub name: String,
    /// The level-1 text behind it.
    pub text: Option<String>,
    /// Where the application is named; the start of the main file when it is not.
    pub span: Span,
    /// The scan period in ms.
    pub period_ms: u32,
    /// `evolution stable`.
    pub stable: bool,
    /// Everything declared: the application's own first, then graph by graph.
    pub variables: Vec<Variable>,
    /// How many of them the application declares.
    pub globals: usize,
    /// The graphs and instances of the application in source order, then the plants.
    pub graphs: Vec<Graph>,
    /// The steps of all graphs, graph by graph.
    pub steps: Vec<Step>,
    /// The macro steps of all graphs, graph by graph, outer ones before inner ones.
    pub macros: Vec<Macro>,
    /// The transitions of all graphs, graph by graph.
    pub transitions: Vec<Transition>,
    /// Constants whose value a declaration, a preset or a binding of the controller takes.
    pub constants_read: BTreeSet<VariableId>,
    /// The tests.
    pub tests: Vec<Test>,
    /// The properties.
    pub properties: Vec<Property>,
}

impl Model {
    /// The graphs of the controller, in source order.
    pub fn controller(&self) -> impl DoubleEndedIterator<Item = GraphId> + '_ {
        self.graphs_of(false)
    }

    /// The plants, in source order.
    pub fn plants(&self) -> impl DoubleEndedIterator<Item = GraphId> + '_ {
        self.graphs_of(true)
    }

    fn graphs_of(&self, plant: bool) -> impl DoubleEndedIterator<Item = GraphId> + '_ {
        (0..self.graphs.len())
            .map(GraphId)
            .filter(move |id| self[*id].plant == plant)
    }

    /// The variables that one graph declares, or the application when there is none.
    pub fn declared_by(&self, owner: Option<GraphId>) -> impl Iterator<Item = VariableId> + use<> {
        let range = match owner {
            Some(graph) => self[graph].variables.clone(),
            None => 0..self.globals,
        };
        range.map(VariableId)
    }

    /// `name`, or `Graph:name` for what a graph declares.
    #[must_use]
    pub fn qualified(&self, variable: VariableId) -> String {
        let variable = &self[variable];
        match variable.owner {
            Some(graph) => format!("{}:{}", self[graph].name, variable.name),
            None => variable.name.clone(),
        }
    }

    /// The steps of a graph that are initial.
    pub fn initial_steps(&self, graph: GraphId) -> impl Iterator<Item = StepId> + '_ {
        self[graph].step_ids().filter(|step| self[*step].initial)
    }

    /// The steps named by a situation; none for `{*}`.
    #[must_use]
    pub fn steps_of(&self, graph: GraphId, situation: &Situation) -> Option<Vec<StepId>> {
        match situation {
            Situation::Steps(steps) => Some(steps.clone()),
            Situation::Initial => Some(self.initial_steps(graph).collect()),
            Situation::Current => None,
        }
    }
}

/// A declared name.
#[derive(Clone, Debug)]
pub struct Variable {
    /// The name, not qualified.
    pub name: String,
    /// The graph (or plant) that declares it; none for the application.
    pub owner: Option<GraphId>,
    /// Input, output, variable, parameter or constant.
    pub kind: DeclarationKind,
    /// Its type.
    pub ty: Type,
    /// Its address.
    pub address: Option<Address>,
    /// Where an address is written, a right one or not.
    pub at: Option<Span>,
    /// The lowest and highest value, where one is declared or an address sets it.
    pub range: Option<(i32, i32)>,
    /// The declared initial value, for a constant its value.
    pub initial: Option<i32>,
    /// Where the initial value stands.
    pub initial_span: Option<Span>,
    /// Level-1 text.
    pub text: Option<String>,
    /// What an instance binds it to.
    pub binding: Binding,
    /// The name in its declaration.
    pub span: Span,
}

impl Variable {
    /// The lowest and highest value.
    #[must_use]
    pub fn limits(&self) -> (i32, i32) {
        match self.ty {
            Type::Bool => (0, 1),
            Type::Int | Type::Time => self.range.unwrap_or((i32::MIN, i32::MAX)),
        }
    }

    /// An address that would do for an input or output; a time has none.
    pub(crate) fn example_of_address(&self) -> Option<&'static str> {
        match (self.kind, self.ty) {
            (DeclarationKind::Input, Type::Bool) => Some("%IX0.0"),
            (DeclarationKind::Input, Type::Int) => Some("%IW0"),
            (DeclarationKind::Output, Type::Bool) => Some("%QX0.0"),
            (DeclarationKind::Output, Type::Int) => Some("%QW0"),
            _ => None,
        }
    }

    /// The value in scan 0: what is declared, or 0 and False, or the nearest bound.
    #[must_use]
    pub fn first_value(&self) -> i32 {
        let (low, high) = self.limits();
        self.initial.unwrap_or(0).max(low).min(high)
    }
}

/// What an instance binds an interface name to.
#[derive(Clone, Debug)]
pub enum Binding {
    /// Not an interface name.
    None,
    /// An address of its own.
    Address,
    /// An expression (an input) or a variable (an output) that it stands for: it has no place of its own.
    Expression(Box<Expression>),
}

impl Binding {
    /// The name stands for something else.
    #[must_use]
    pub fn is_alias(&self) -> bool {
        matches!(self, Binding::Expression(_))
    }
}

/// A graph, an instance of a template or a plant.
#[derive(Clone, Debug)]
pub struct Graph {
    /// The name.
    pub name: String,
    /// Level-1 text.
    pub text: Option<String>,
    /// The template that it is an instance of: in its own text, that name means this graph.
    pub template: Option<String>,
    /// It stands in for the machine.
    pub plant: bool,
    /// What it declares: indices in [`Model::variables`].
    pub variables: Range<usize>,
    /// Indices in [`Model::steps`].
    pub steps: Range<usize>,
    /// Indices in [`Model::macros`].
    pub macros: Range<usize>,
    /// Indices in [`Model::transitions`].
    pub transitions: Range<usize>,
    /// Its stand-alone actions, in source order.
    pub always: Vec<Action>,
    /// The name in the text.
    pub span: Span,
}

impl Graph {
    /// What its own text calls it.
    #[must_use]
    pub fn own_name(&self) -> &str {
        self.template.as_deref().unwrap_or(&self.name)
    }

    /// Its steps.
    pub fn step_ids(&self) -> impl DoubleEndedIterator<Item = StepId> + use<> {
        self.steps.clone().map(StepId)
    }

    /// Its macro steps.
    pub fn macro_ids(&self) -> impl DoubleEndedIterator<Item = MacroId> + use<> {
        self.macros.clone().map(MacroId)
    }

    /// Its transitions.
    pub fn transition_ids(&self) -> impl DoubleEndedIterator<Item = TransitionId> + use<> {
        self.transitions.clone().map(TransitionId)
    }
}

/// A step.
#[derive(Clone, Debug)]
pub struct Step {
    /// The graph it belongs to.
    pub graph: GraphId,
    /// The identifier.
    pub id: String,
    /// Level-1 text.
    pub text: Option<String>,
    /// Active when its graph is initialised.
    pub initial: bool,
    /// `entry` or `exit` in an expansion.
    pub role: StepRole,
    /// The macro step whose expansion it belongs to, the innermost.
    pub parent: Option<MacroId>,
    /// The graphs that it encloses.
    pub encloses: Vec<Encloses>,
    /// What it does.
    pub action: Action,
    /// The identifier in the text.
    pub span: Span,
}

/// A macro step.
#[derive(Clone, Debug)]
pub struct Macro {
    /// The graph it belongs to.
    pub graph: GraphId,
    /// The identifier.
    pub id: String,
    /// Level-1 text.
    pub text: Option<String>,
    /// The macro step whose expansion it belongs to.
    pub parent: Option<MacroId>,
    /// Its expansion, nested ones included: indices in [`Model::steps`].
    pub steps: Range<usize>,
    /// Its entry step.
    pub entry: Option<StepId>,
    /// Its exit step.
    pub exit: Option<StepId>,
    /// The identifier in the text.
    pub span: Span,
}

/// A transition.
#[derive(Clone, Debug)]
pub struct Transition {
    /// The graph it belongs to.
    pub graph: GraphId,
    /// Its number.
    pub number: u32,
    /// Level-1 text.
    pub text: Option<String>,
    /// The steps that it leaves.
    pub entrance: Vec<StepId>,
    /// The steps that it enters.
    pub exit: Vec<StepId>,
    /// Its trigger.
    pub trigger: Trigger,
    /// Its `do` block: stored statements only.
    pub action: Action,
    /// The number in the text.
    pub span: Span,
}

/// When a transition fires.
#[derive(Clone, Debug)]
pub enum Trigger {
    /// Always: `True`, `=1` or nothing.
    Always,
    /// When the expression is True.
    Expression(Expression),
    /// A text only (level 1), or something that was wrong.
    Unknown,
}
