//! A name for every variant of the syntax tree and of the tables. The matches have no arm for the rest, so that a new
//! variant has to be named here, and to occur.

use grafcet_compiler::ast::{
    Binary, BindingTarget, ConstantKind, DeclarationKind, Element, Event, ExpressionKind, Item,
    ScanOption, Situation, StatementKind, StepRole, Trigger, Type, Unary,
};
use grafcet_core::program::{
    Assignment, Crossing, Edge, Evolution, Forced, Op, Preset, Rest, Slot, Unit, Watch,
};

/// What has a name here.
pub trait Kind {
    /// The names of all variants.
    const ALL: &'static [&'static str];

    /// The name of this one.
    fn name(&self) -> &'static str;
}

/// Names the variants of types, and gives all the names together.
macro_rules! kinds {
    ($all:ident: $($type:ty { $($pattern:pat => $name:literal),+ $(,)? })+) => {
        $(impl Kind for $type {
            const ALL: &'static [&'static str] = &[$($name),+];

            fn name(&self) -> &'static str {
                match self {
                    $($pattern => $name),+
                }
            }
        })+

        pub fn $all() -> Vec<&'static str> {
            [$(<$type as Kind>::ALL),+].concat()
        }
    };
}

kinds! { syntax:
    ScanOption {
        Self::Period(_) => "scan",
        Self::Evolution { stable: false, .. } => "evolution scan",
        Self::Evolution { stable: true, .. } => "evolution stable",
    }
    Item {
        Self::Declaration(_) => "global declaration",
        Self::Graph(_) => "graph",
        Self::Template(_) => "template",
        Self::Instance(_) => "instance",
        Self::Plant(_) => "plant",
        Self::Property(_) => "property",
        Self::Test(_) => "test",
    }
    DeclarationKind {
        Self::Input => "input",
        Self::Output => "output",
        Self::Variable { retain: false } => "var",
        Self::Variable { retain: true } => "retain var",
        Self::Parameter => "parameter",
        Self::Constant => "const",
    }
    Type {
        Self::Bool => "bool",
        Self::Int => "int",
        Self::Time => "time",
    }
    ConstantKind {
        Self::Integer(_) => "constant integer",
        Self::Duration(_) => "constant duration",
        Self::Bool(_) => "constant Boolean",
        Self::Name(_, false) => "constant name",
        Self::Name(_, true) => "constant name with a minus sign",
        Self::Unreadable => "unreadable",
    }
    Element {
        Self::Declaration(_) => "local declaration",
        Self::Always(_) => "stand-alone action",
        Self::Step(_) => "step",
        Self::Macro(_) => "macro step",
        Self::Transition(_) => "transition",
    }
    StepRole {
        Self::Plain => "plain step",
        Self::Entry => "entry step",
        Self::Exit => "exit step",
    }
    Trigger {
        Self::AlwaysTrue => "trigger left out",
        Self::Expression(_) => "trigger",
        Self::Text(_) => "trigger of level 1",
    }
    StatementKind {
        Self::Momentary { condition: None, .. } => "momentary",
        Self::Momentary { condition: Some(_), .. } => "momentary IF",
        Self::Stored { condition: None, .. } => "stored",
        Self::Stored { condition: Some(_), .. } => "stored IF",
        Self::On { .. } => "on",
        Self::Force { condition: None, .. } => "F/",
        Self::Force { condition: Some(_), .. } => "F/ IF",
        Self::Text(_) => "action of level 1",
    }
    Event {
        Self::Activation => "on activation",
        Self::Deactivation => "on deactivation",
        Self::Expression(_) => "on event",
    }
    Situation {
        Self::Steps(_) => "{1, 3}",
        Self::Initial(_) => "{I}",
        Self::Current(_) => "{*}",
    }
    BindingTarget {
        Self::Address(_) => "bound to an address",
        Self::Expression(_) => "bound to an expression",
    }
    ExpressionKind {
        Self::Bool(_) => "Boolean literal",
        Self::Integer(_) => "integer",
        Self::Duration(_) => "duration",
        Self::Unreadable => "unreadable",
        Self::Ref(_) => "name",
        Self::Situation { equal: true, .. } => "S(G) =",
        Self::Situation { equal: false, .. } => "S(G) <>",
        Self::Timer { .. } => "T/e/preset",
        Self::Delay { off: None, .. } => "t1/e",
        Self::Delay { off: Some(_), .. } => "t1/e/t2",
        Self::Unary { .. } => "one operand",
        Self::Binary { .. } => "two operands",
    }
    Unary {
        Self::Not => "NOT",
        Self::Negate => "unary minus",
        Self::Rising => "↑",
        Self::Falling => "↓",
    }
    Binary {
        Self::And => "AND",
        Self::Or => "OR",
        Self::Xor => "XOR",
        Self::Equal => "=",
        Self::NotEqual => "<>",
        Self::Less => "<",
        Self::LessOrEqual => "<=",
        Self::Greater => ">",
        Self::GreaterOrEqual => ">=",
        Self::Add => "+",
        Self::Subtract => "-",
        Self::Multiply => "*",
        Self::Divide => "/",
        Self::Modulo => "MOD",
    }
}

kinds! { tables:
    Evolution {
        Self::Scan => "Evolution::Scan",
        Self::Stable => "Evolution::Stable",
    }
    Slot {
        Self::Bit(_) => "Slot::Bit",
        Self::Number(_) => "Slot::Number",
    }
    Rest {
        Self::None => "Rest::None",
        Self::Elapsed(_) => "Rest::Elapsed",
        Self::Running(_) => "Rest::Running",
        Self::Code(_) => "Rest::Code",
        Self::Logic(_) => "Rest::Logic",
    }
    Preset {
        Self::Constant(_) => "Preset::Constant",
        Self::Number(_, Unit::Milliseconds) => "Preset::Number in ms",
        Self::Number(_, Unit::Seconds) => "Preset::Number in s",
    }
    Crossing {
        Self::Within { .. } => "Crossing::Within",
        Self::Across { .. } => "Crossing::Across",
    }
    Op {
        Self::Constant(_) => "Op::Constant",
        Self::Bit(_) => "Op::Bit",
        Self::Number(_) => "Op::Number",
        Self::Elapsed(_) => "Op::Elapsed",
        Self::AndElapsed(_) => "Op::AndElapsed",
        Self::Not => "Op::Not",
        Self::And => "Op::And",
        Self::Or => "Op::Or",
        Self::Xor => "Op::Xor",
        Self::Negate => "Op::Negate",
        Self::Add => "Op::Add",
        Self::Subtract => "Op::Subtract",
        Self::Multiply => "Op::Multiply",
        Self::Divide => "Op::Divide",
        Self::Modulo => "Op::Modulo",
        Self::Equal => "Op::Equal",
        Self::NotEqual => "Op::NotEqual",
        Self::Less => "Op::Less",
        Self::LessOrEqual => "Op::LessOrEqual",
        Self::Greater => "Op::Greater",
        Self::GreaterOrEqual => "Op::GreaterOrEqual",
        Self::StepTimer { .. } => "Op::StepTimer",
    }
    Unit {
        Self::Milliseconds => "Unit::Milliseconds",
        Self::Seconds => "Unit::Seconds",
    }
    Watch {
        Self::Edge { .. } => "Watch::Edge",
        Self::Timer { .. } => "Watch::Timer",
        Self::OnDelay { .. } => "Watch::OnDelay",
        Self::OffDelay { .. } => "Watch::OffDelay",
        Self::Value { gate: None, .. } => "Watch::Value",
        Self::Value { gate: Some(_), .. } => "Watch::Value with a gate",
    }
    Edge {
        Self::Rising => "Edge::Rising",
        Self::Falling => "Edge::Falling",
    }
    Forced {
        Self::Set(_) => "Forced::Set",
        Self::Current => "Forced::Current",
    }
    Assignment {
        Self::Bit(..) => "Assignment::Bit",
        Self::Number(..) => "Assignment::Number",
    }
}
