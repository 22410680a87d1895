//! A program as a value: it is generated and shrunk in this form, and rendered to text.

/// A program; its graphs and templates in source order.
#[derive(Clone, Debug)]
pub struct Program {
    pub stable: bool,
    /// The templates stand in a library of their own.
    pub library: bool,
    pub period_ms: u32,
    pub declarations: Vec<Declaration>,
    pub graphs: Vec<Graph>,
}

#[derive(Clone, Debug)]
pub struct Declaration {
    /// `input`, `retain var`, ...
    pub kind: &'static str,
    pub name: String,
    pub ty: Type,
    pub address: Option<String>,
    pub initial: Option<String>,
    pub range: Option<(i32, i32)>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    Bool,
    Int,
    Time,
}

#[derive(Clone, Debug)]
pub struct Graph {
    pub name: String,
    pub role: Role,
    pub declarations: Vec<Declaration>,
    pub elements: Vec<Element>,
}

#[derive(Clone, Debug)]
pub enum Role {
    Written,
    Template,
    Instance {
        template: String,
        bindings: Vec<Binding>,
    },
}

/// What stands in an instance: `name` bound to an expression, or to an address.
#[derive(Clone, Debug)]
pub enum Binding {
    Expression(String, Expression),
    Address(String, String),
}

#[derive(Clone, Debug)]
pub enum Element {
    Always(Vec<Statement>),
    Step(Step),
    Macro(String, Vec<Element>),
    Transition(Transition),
}

#[derive(Clone, Debug)]
pub struct Step {
    pub initial: bool,
    /// Empty, `entry` or `exit`.
    pub role: &'static str,
    pub id: String,
    /// Graph and set.
    pub encloses: Vec<(String, Vec<String>)>,
    pub statements: Vec<Statement>,
}

#[derive(Clone, Debug)]
pub struct Transition {
    pub number: usize,
    pub entrance: Vec<String>,
    pub exit: Vec<String>,
    pub trigger: Option<Expression>,
    pub action: Vec<Statement>,
}

#[derive(Clone, Debug)]
pub enum Statement {
    Momentary {
        targets: Vec<String>,
        condition: Option<Expression>,
    },
    Stored {
        target: String,
        value: Expression,
        condition: Option<Expression>,
    },
    On {
        event: Event,
        statements: Vec<Statement>,
    },
    Force {
        graph: String,
        situation: Situation,
        condition: Option<Expression>,
    },
    /// Level 1.
    Text(&'static str),
}

#[derive(Clone, Debug)]
pub enum Event {
    Activation,
    Deactivation,
    Expression(Expression),
}

#[derive(Clone, Debug)]
pub enum Situation {
    Steps(Vec<String>),
    Initial,
    Current,
}

#[derive(Clone, Debug)]
pub enum Expression {
    /// A name or a literal.
    Leaf(String),
    Unary(&'static str, Box<Expression>),
    Binary(&'static str, Box<Expression>, Box<Expression>),
    /// `T/enable/preset`.
    Timer(Box<Expression>, Box<Expression>),
    /// `t1/e` or `t1/e/t2`.
    Delay(Box<Expression>, Box<Expression>, Option<Box<Expression>>),
    /// `S(graph) = situation`, or `<>`.
    Situation(String, bool, Situation),
}

impl Expression {
    pub fn leaf(text: impl Into<String>) -> Self {
        Expression::Leaf(text.into())
    }

    pub fn unary(operator: &'static str, operand: Expression) -> Self {
        Expression::Unary(operator, Box::new(operand))
    }

    pub fn binary(operator: &'static str, left: Expression, right: Expression) -> Self {
        Expression::Binary(operator, Box::new(left), Box::new(right))
    }
}
