//! Programs as text.

use std::fmt::{self, Display, Formatter};

use crate::program::{
    Binding, Declaration, Element, Event, Expression, Graph, Program, Role, Situation, Statement,
    Step, Transition, Type,
};

/// Items separated by something.
struct Joined<'a, T>(&'a [T], &'a str);

impl<T: Display> Display for Joined<'_, T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for (index, item) in self.0.iter().enumerate() {
            if index > 0 {
                f.write_str(self.1)?;
            }
            item.fmt(f)?;
        }
        Ok(())
    }
}

/// ` IF c`, or nothing.
struct If<'a>(&'a Option<Expression>);

impl Display for If<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(condition) => write!(f, " IF {condition}"),
            None => Ok(()),
        }
    }
}

/// The text of a program: its main file, and a library if it has one.
#[derive(Clone, Debug)]
pub struct Text {
    pub main: String,
    pub library: Option<String>,
}

/// By which path the main file imports its library.
pub const LIBRARY: &str = "saw.grafcet";

impl Program {
    pub fn text(&self) -> Text {
        let is_template = |graph: &&Graph| matches!(graph.role, Role::Template);
        let templates: Vec<Graph> = self.graphs.iter().filter(is_template).cloned().collect();
        let mut main = String::new();
        if self.library {
            main += &format!("import \"{LIBRARY}\"\n");
        }
        main += &format!("scan {}ms\n", self.period_ms);
        main += &format!(
            "evolution {}\n",
            if self.stable { "stable" } else { "scan" }
        );
        main += &format!("{}\n", Joined(&self.declarations, "\n"));
        for graph in &self.graphs {
            if !(self.library && is_template(&graph)) {
                main += &format!("{graph}\n");
            }
        }
        let library = self.library.then(|| Joined(&templates, "\n").to_string());
        Text { main, library }
    }
}

impl Display for Text {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.main)?;
        match &self.library {
            Some(library) => write!(f, "// {LIBRARY}:\n{library}"),
            None => Ok(()),
        }
    }
}

impl Display for Declaration {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let ty = match self.ty {
            Type::Bool => "bool",
            Type::Int => "int",
            Type::Time => "time",
        };
        write!(f, "{} {} : {ty}", self.kind, self.name)?;
        if let Some(address) = &self.address {
            write!(f, " at {address}")?;
        }
        if let Some(initial) = &self.initial {
            write!(f, " = {initial}")?;
        }
        match (self.range, self.ty) {
            (Some((low, high)), Type::Time) => write!(f, " in {}..{}", Ms(low), Ms(high)),
            (Some((low, high)), _) => write!(f, " in {low}..{high}"),
            (None, _) => Ok(()),
        }
    }
}

/// A duration in ms, as it is written.
pub struct Ms(pub i32);

impl Display for Ms {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let sign = if self.0 < 0 { "-" } else { "" };
        write!(f, "{sign}{}ms", self.0.unsigned_abs())
    }
}

impl Display for Graph {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.role {
            Role::Instance { template, bindings } => {
                let bindings = Joined(bindings, "; ");
                return write!(f, "graph {} = {template} {{ {bindings} }}", self.name);
            }
            Role::Written => writeln!(f, "graph {} {{", self.name)?,
            Role::Template => writeln!(f, "template {} {{", self.name)?,
        }
        for declaration in &self.declarations {
            writeln!(f, "    {declaration}")?;
        }
        for element in &self.elements {
            writeln!(f, "    {element}")?;
        }
        write!(f, "}}")
    }
}

impl Display for Binding {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Binding::Expression(name, value) => write!(f, "{name} = {value}"),
            Binding::Address(name, address) => write!(f, "{name} at {address}"),
        }
    }
}

impl Display for Element {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Element::Always(statements) => write!(f, "always {{ {} }}", Joined(statements, "; ")),
            Element::Step(step) => step.fmt(f),
            Element::Transition(transition) => transition.fmt(f),
            Element::Macro(id, elements) => {
                write!(
                    f,
                    "macro step {id} {{\n        {}\n    }}",
                    Joined(elements, "\n        ")
                )
            }
        }
    }
}

impl Display for Step {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if !self.role.is_empty() {
            write!(f, "{} ", self.role)?;
        }
        if self.initial {
            f.write_str("initial ")?;
        }
        write!(f, "step {}", self.id)?;
        for (index, (graph, set)) in self.encloses.iter().enumerate() {
            let before = if index == 0 { " encloses " } else { ", " };
            write!(f, "{before}{graph}{{{}}}", Joined(set, ", "))?;
        }
        if !self.statements.is_empty() {
            write!(f, " {{ {} }}", Joined(&self.statements, "; "))?;
        }
        Ok(())
    }
}

impl Display for Transition {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "transition {}: ", self.number)?;
        write!(
            f,
            "{} -> {}",
            Joined(&self.entrance, ", "),
            Joined(&self.exit, ", ")
        )?;
        if let Some(trigger) = &self.trigger {
            write!(f, " when {trigger}")?;
        }
        if !self.action.is_empty() {
            write!(f, " do {{ {} }}", Joined(&self.action, "; "))?;
        }
        Ok(())
    }
}

impl Display for Statement {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Statement::Momentary { targets, condition } => {
                write!(f, "{}{}", Joined(targets, ", "), If(condition))
            }
            Statement::Stored {
                target,
                value,
                condition,
            } => write!(f, "{target} = {value}{}", If(condition)),
            Statement::On { event, statements } => {
                write!(f, "on {event} {{ {} }}", Joined(statements, "; "))
            }
            Statement::Force {
                graph,
                situation,
                condition,
            } => write!(f, "F/{graph}:{situation}{}", If(condition)),
            Statement::Text(text) => write!(f, "\"{text}\""),
        }
    }
}

impl Display for Event {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Event::Activation => f.write_str("activation"),
            Event::Deactivation => f.write_str("deactivation"),
            Event::Expression(event) => write!(f, "event ({event})"),
        }
    }
}

impl Display for Situation {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Situation::Steps(steps) => write!(f, "{{{}}}", Joined(steps, ", ")),
            Situation::Initial => f.write_str("{I}"),
            Situation::Current => f.write_str("{*}"),
        }
    }
}

/// Everything but names and literals stands in parentheses.
impl Display for Expression {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Expression::Leaf(text) => f.write_str(text),
            Expression::Unary(operator, operand) => write!(f, "({operator} {operand})"),
            Expression::Binary(operator, left, right) => write!(f, "({left} {operator} {right})"),
            Expression::Timer(enable, preset) => write!(f, "(T/{enable}/{preset})"),
            Expression::Delay(on, enable, off) => {
                let constant = matches!(&**enable, Expression::Leaf(text) if text.eq_ignore_ascii_case("true") || text.eq_ignore_ascii_case("false"));
                if constant {
                    write!(f, "({on}/({enable})")?;
                } else {
                    write!(f, "({on}/{enable}")?;
                }
                match off {
                    Some(off) => write!(f, "/{off})"),
                    None => f.write_str(")"),
                }
            }
            Expression::Situation(graph, equal, situation) => {
                let operator = if *equal { "=" } else { "<>" };
                write!(f, "(S({graph}) {operator} {situation})")
            }
        }
    }
}
