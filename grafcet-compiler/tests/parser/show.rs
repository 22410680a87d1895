//! Trees as text, for claims that can be read.

use grafcet_compiler::ast::{
    Binary, Block, Constant, ConstantKind, Event, Expression, ExpressionKind, Name, Ref, Set,
    Situation, Statement, StatementKind, Trigger, Unary,
};

pub fn trigger(trigger: &Trigger) -> String {
    match trigger {
        Trigger::AlwaysTrue => "always true".to_owned(),
        Trigger::Expression(inner) => expression(inner),
        Trigger::Text(text) => format!("{:?}", text.text),
    }
}

pub fn expression(shown: &Expression) -> String {
    match &shown.kind {
        ExpressionKind::Unreadable => "?".to_owned(),
        ExpressionKind::Bool(value) => value.to_string(),
        ExpressionKind::Integer(value) => value.to_string(),
        ExpressionKind::Duration(ms) => format!("{ms}ms"),
        ExpressionKind::Ref(inner) => reference(inner),
        ExpressionKind::Situation {
            graph,
            situation: inner,
            equal,
        } => {
            let sign = if *equal { "=" } else { "<>" };
            format!("(S {} {sign} {})", graph.text, situation(inner))
        }
        ExpressionKind::Timer { enable, preset } => {
            format!("(T {} {})", expression(enable), expression(preset))
        }
        ExpressionKind::Delay { on, enable, off } => {
            let off = off.iter().map(|off| format!(" {}", expression(off)));
            let off: String = off.collect();
            format!("(delay {} {}{off})", expression(on), expression(enable))
        }
        ExpressionKind::Unary { operator, operand } => {
            let sign = match operator {
                Unary::Not => "NOT",
                Unary::Negate => "-",
                Unary::Rising => "↑",
                Unary::Falling => "↓",
            };
            format!("({sign} {})", expression(operand))
        }
        ExpressionKind::Binary {
            operator,
            left,
            right,
            ..
        } => {
            let sign = match operator {
                Binary::And => "AND",
                Binary::Or => "OR",
                Binary::Xor => "XOR",
                Binary::Equal => "=",
                Binary::NotEqual => "<>",
                Binary::Less => "<",
                Binary::LessOrEqual => "<=",
                Binary::Greater => ">",
                Binary::GreaterOrEqual => ">=",
                Binary::Add => "+",
                Binary::Subtract => "-",
                Binary::Multiply => "*",
                Binary::Divide => "/",
                Binary::Modulo => "MOD",
            };
            format!("({sign} {} {})", expression(left), expression(right))
        }
    }
}

pub fn reference(shown: &Ref) -> String {
    match &shown.graph {
        Some(graph) => format!("{}:{}", graph.text, shown.name.text),
        None => shown.name.text.clone(),
    }
}

pub fn names(shown: &[Name]) -> String {
    let names: Vec<_> = shown.iter().map(|name| name.text.as_str()).collect();
    names.join(" ")
}

pub fn set(shown: &Set) -> String {
    format!("{{{}}}", names(&shown.steps))
}

pub fn situation(shown: &Situation) -> String {
    match shown {
        Situation::Steps(steps) => set(steps),
        Situation::Initial(_) => "{I}".to_owned(),
        Situation::Current(_) => "{*}".to_owned(),
    }
}

pub fn constant(shown: &Constant) -> String {
    match &shown.kind {
        ConstantKind::Integer(value) => value.to_string(),
        ConstantKind::Duration(ms) => format!("{ms}ms"),
        ConstantKind::Bool(value) => value.to_string(),
        ConstantKind::Name(name, false) => name.text.clone(),
        ConstantKind::Name(name, true) => format!("-{}", name.text),
        ConstantKind::Unreadable => "?".to_owned(),
    }
}

fn condition(shown: &Option<Expression>) -> String {
    shown
        .as_ref()
        .map(|inner| format!(" IF {}", expression(inner)))
        .unwrap_or_default()
}

pub fn statement(shown: &Statement) -> String {
    match &shown.kind {
        StatementKind::Momentary {
            targets,
            condition: inner,
        } => {
            let targets: Vec<_> = targets.iter().map(reference).collect();
            format!("{}{}", targets.join(", "), condition(inner))
        }
        StatementKind::Stored {
            target,
            value,
            condition: inner,
        } => {
            format!(
                "{} = {}{}",
                reference(target),
                expression(value),
                condition(inner)
            )
        }
        StatementKind::On { event, statements } => {
            let event = match event {
                Event::Activation => "activation".to_owned(),
                Event::Deactivation => "deactivation".to_owned(),
                Event::Expression(inner) => format!("event {}", expression(inner)),
            };
            let statements: Vec<_> = statements.iter().map(statement).collect();
            format!("on {event}: [{}]", statements.join("; "))
        }
        StatementKind::Force {
            graph,
            situation: inner,
            condition: when,
        } => {
            format!("F/{}:{}{}", graph.text, situation(inner), condition(when))
        }
        StatementKind::Text(text) => format!("{:?}", text.text),
    }
}

pub fn block(shown: &Block) -> String {
    let statements: Vec<_> = shown.statements.iter().map(statement).collect();
    statements.join("; ")
}
