//! The text as a tree: what `language.md` calls the structure, before any name is looked up.
//!
//! The tree keeps every element in source order with its place, so that checks can point at it and a formatter
//! can print it again. It says nothing about meaning: `X3` is a name here.

mod claim;
mod expression;

pub use claim::{Property, PropertyKind, Test, TestStep, TestStepKind};
pub use expression::{Binary, Expression, ExpressionKind, Unary};

use crate::source::Span;

/// A name or word with its place; the text is in Unicode NFC.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Name {
    /// The name, NFC.
    pub text: String,
    /// Where it stands.
    pub span: Span,
}

/// A text in quotation marks: the level-1 text of the element it follows.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Text {
    /// What stands between the quotation marks.
    pub text: String,
    /// Where it stands, marks included.
    pub span: Span,
}

/// `name` or `Graph:name`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Ref {
    /// The graph (or plant, or `System`) in front of the colon.
    pub graph: Option<Name>,
    /// The name itself; step bits (`X3`, `XM5`) are names too.
    pub name: Name,
    /// Both together.
    pub span: Span,
}

/// One file.
#[derive(Clone, Debug, Default, Hash)]
pub struct File {
    /// `import "path"`.
    pub imports: Vec<Text>,
    /// `application NAME "text"`.
    pub application: Option<(Name, Option<Text>)>,
    /// `scan` and `evolution`, in source order.
    pub options: Vec<ScanOption>,
    /// Everything else, in source order.
    pub items: Vec<Item>,
}

/// An option of the application.
#[derive(Clone, Debug, Hash)]
pub enum ScanOption {
    /// `scan 10ms`: the period.
    Period(Constant),
    /// `evolution scan` or `evolution stable`.
    Evolution {
        /// True for `stable`.
        stable: bool,
        /// The whole option.
        span: Span,
    },
}

/// A top-level element.
#[derive(Clone, Debug, Hash)]
pub enum Item {
    /// A global declaration.
    Declaration(Declaration),
    /// `graph NAME { .. }`.
    Graph(Graph),
    /// `template NAME { .. }`.
    Template(Graph),
    /// `graph NAME = TEMPLATE { .. }`.
    Instance(Instance),
    /// `plant NAME { .. }`.
    Plant(Graph),
    /// `property "text": ..`.
    Property(Property),
    /// `test "text" { .. }`.
    Test(Test),
}

/// What a declaration declares.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DeclarationKind {
    /// `input`.
    Input,
    /// `output`.
    Output,
    /// `var`, or `retain var`.
    Variable {
        /// Survives power.
        retain: bool,
    },
    /// `parameter`: an operator's setting, retained.
    Parameter,
    /// `const`.
    Constant,
}

/// A declared type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Type {
    /// `bool`.
    Bool,
    /// `int`: 32 bits, signed.
    Int,
    /// `time`: 32 bits, signed, milliseconds.
    Time,
}

/// `input start, stop : bool at %IX0.0 = 1 in 0..5 "text"`.
#[derive(Clone, Debug, Hash)]
pub struct Declaration {
    /// What is declared.
    pub kind: DeclarationKind,
    /// One or more names; none where they are missing.
    pub names: Vec<Name>,
    /// The type, when written.
    pub ty: Option<(Type, Span)>,
    /// The address as written (`%IX0.0`), not yet checked.
    pub address: Option<Name>,
    /// The value behind `=`.
    pub initial: Option<Constant>,
    /// The range behind `in`.
    pub range: Option<(Constant, Constant)>,
    /// Level-1 text.
    pub text: Option<Text>,
    /// Its type may stand in a part that cannot be read.
    pub doubtful: bool,
    /// The whole declaration.
    pub span: Span,
}

/// A constant as written, sign included.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Constant {
    /// What it is.
    pub kind: ConstantKind,
    /// Where, the sign included.
    pub span: Span,
}

/// The kinds of constant.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum ConstantKind {
    /// An integer, sign applied; beyond 64 bits it is saturated (out of range of any type).
    Integer(i64),
    /// A duration in milliseconds, sign applied, saturated likewise.
    Duration(i64),
    /// `TRUE` or `FALSE`.
    Bool(bool),
    /// The name of a `const`, and whether a minus sign stands before it.
    Name(Name, bool),
    /// A number or duration that cannot be read, which has been reported.
    Unreadable,
}

/// The body of a graph, a template or a plant.
#[derive(Clone, Debug, Hash)]
pub struct Graph {
    /// Its name.
    pub name: Name,
    /// Level-1 text.
    pub text: Option<Text>,
    /// What is inside, in source order.
    pub elements: Vec<Element>,
    /// The whole graph.
    pub span: Span,
}

/// An element of a graph.
#[derive(Clone, Debug, Hash)]
pub enum Element {
    /// A local declaration.
    Declaration(Declaration),
    /// A stand-alone action.
    Always(Always),
    /// A step.
    Step(Step),
    /// A macro step with its expansion.
    Macro(Macro),
    /// A transition.
    Transition(Transition),
}

/// `always "text" { .. }`: a stand-alone action.
#[derive(Clone, Debug, Hash)]
pub struct Always {
    /// Level-1 text.
    pub text: Option<Text>,
    /// The action.
    pub block: Block,
    /// The whole element.
    pub span: Span,
}

/// What a step is inside a macro's expansion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StepRole {
    /// An ordinary step.
    Plain,
    /// The entry step of an expansion.
    Entry,
    /// The exit step of an expansion.
    Exit,
}

/// `initial step 3 "text" encloses G{1} { .. }`.
#[derive(Clone, Debug, Hash)]
pub struct Step {
    /// Active when the graph is initialised.
    pub initial: bool,
    /// `entry` or `exit` in an expansion.
    pub role: StepRole,
    /// The identifier: digits, or a capital letter and digits.
    pub id: Name,
    /// Level-1 text.
    pub text: Option<Text>,
    /// Enclosed graphs with their activated sets.
    pub encloses: Vec<(Name, Set)>,
    /// The action; an absent block and an empty one are the same.
    pub block: Option<Block>,
    /// The whole element.
    pub span: Span,
}

/// `macro step M5 "text" { .. }`.
#[derive(Clone, Debug, Hash)]
pub struct Macro {
    /// The identifier.
    pub id: Name,
    /// Level-1 text.
    pub text: Option<Text>,
    /// Steps, macros and transitions of the expansion, in source order.
    pub elements: Vec<Element>,
    /// The whole element.
    pub span: Span,
}

/// `transition 7 "text": 3, 4 -> 5 when .. do { .. }`.
#[derive(Clone, Debug, Hash)]
pub struct Transition {
    /// The number as written, with its value. Its text is kept for messages.
    pub number: Name,
    /// Level-1 text.
    pub text: Option<Text>,
    /// Entrance steps (or macro steps); empty for a source transition.
    pub entrance: Vec<Name>,
    /// Exit steps (or macro steps); empty for a sink transition.
    pub exit: Vec<Name>,
    /// The trigger.
    pub trigger: Trigger,
    /// The `do` block.
    pub action: Option<Block>,
    /// The whole element.
    pub span: Span,
}

/// A trigger as written.
#[derive(Clone, Debug, Hash)]
pub enum Trigger {
    /// No `when`, or `when =1`.
    AlwaysTrue,
    /// `when expression`.
    Expression(Expression),
    /// `when "text"`: level 1.
    Text(Text),
}

/// `{ .. }` with statements.
#[derive(Clone, Debug, Default, Hash)]
pub struct Block {
    /// The statements in source order.
    pub statements: Vec<Statement>,
    /// The braces and all between.
    pub span: Span,
}

/// A statement with its place.
#[derive(Clone, Debug, Hash)]
pub struct Statement {
    /// What it does.
    pub kind: StatementKind,
    /// The whole statement.
    pub span: Span,
}

/// The kinds of statement.
#[derive(Clone, Debug, Hash)]
pub enum StatementKind {
    /// `A, B IF c`.
    Momentary {
        /// The Boolean variables.
        targets: Vec<Ref>,
        /// The condition behind `IF`.
        condition: Option<Expression>,
    },
    /// `a = e IF c`.
    Stored {
        /// The variable.
        target: Ref,
        /// What is stored.
        value: Expression,
        /// The condition behind `IF`.
        condition: Option<Expression>,
    },
    /// `on activation: ..`, `on event e { .. }`.
    On {
        /// When.
        event: Event,
        /// Stored statements.
        statements: Vec<Statement>,
    },
    /// `F/G:{1,2} IF c`.
    Force {
        /// The graph that is forced.
        graph: Name,
        /// Into what.
        situation: Situation,
        /// The condition behind `IF`.
        condition: Option<Expression>,
    },
    /// Level 1: a text only.
    Text(Text),
}

/// When the statements of an `on` run.
#[derive(Clone, Debug, Hash)]
pub enum Event {
    /// `on activation`.
    Activation,
    /// `on deactivation`.
    Deactivation,
    /// `on event expression`.
    Expression(Expression),
}

/// `{1, 3}`: named steps.
#[derive(Clone, Debug, Hash)]
pub struct Set {
    /// The step identifiers.
    pub steps: Vec<Name>,
    /// The braces and all between.
    pub span: Span,
}

/// The situation named by a forcing order or compared with `S(G)`.
#[derive(Clone, Debug, Hash)]
pub enum Situation {
    /// `{1, 3}` or `{}`.
    Steps(Set),
    /// `{I}`: the initial situation.
    Initial(Span),
    /// `{*}`: the situation it has. Never in a comparison.
    Current(Span),
}

/// `graph G = T { a at %IX0.0; b = c; }`.
#[derive(Clone, Debug, Hash)]
pub struct Instance {
    /// The new graph.
    pub name: Name,
    /// The template.
    pub template: Name,
    /// The bindings.
    pub bindings: Vec<Binding>,
    /// The whole element.
    pub span: Span,
}

/// One binding of an instance.
#[derive(Clone, Debug, Hash)]
pub struct Binding {
    /// The interface name.
    pub name: Name,
    /// What it is bound to.
    pub to: BindingTarget,
    /// The whole binding.
    pub span: Span,
}

/// What an interface name is bound to.
#[derive(Clone, Debug, Hash)]
pub enum BindingTarget {
    /// `at %IX0.0`.
    Address(Name),
    /// `= expression`.
    Expression(Expression),
}
