//! Constants: literals and the values of `const` declarations, which may stand in any order.

use std::collections::{BTreeMap, BTreeSet};

use super::names::{Found, View};
use super::resolver::Resolver;
use super::{DeclarationKind, Type, VariableId};
use crate::ast::{self, ConstantKind};
use crate::diagnostic::{Diagnostic, Rule};
use crate::source::Span;

/// Constants without a value yet.
#[derive(Default)]
pub(super) struct Pending<'a> {
    waiting: BTreeMap<VariableId, &'a ast::Constant>,
    /// Those whose value is being found out: one that needs itself has none.
    running: BTreeSet<VariableId>,
}

impl<'a> Pending<'a> {
    /// Takes note of a constant's value as written.
    pub fn add(&mut self, id: VariableId, value: &'a ast::Constant) {
        self.waiting.insert(id, value);
    }
}

impl Resolver<'_> {
    /// The value of a constant that must have the type; nothing when it has not, which is reported.
    pub(super) fn constant(
        &mut self,
        constant: &ast::Constant,
        ty: Type,
        view: View,
    ) -> Option<i32> {
        let span = constant.span;
        match (&constant.kind, ty) {
            (ConstantKind::Integer(value), Type::Int) => self.fits(*value, ty, span),
            (ConstantKind::Duration(value), Type::Time) => self.fits(*value, ty, span),
            (ConstantKind::Unreadable, _) => None,
            (ConstantKind::Bool(value), Type::Bool) => Some(i32::from(*value)),
            (ConstantKind::Name(name, negative), _) => {
                let value = self.named_constant(name, ty, view)?;
                match (negative, ty) {
                    (false, _) => Some(value),
                    (true, Type::Bool) => {
                        let message = "a Boolean has no sign";
                        self.report(
                            Diagnostic::new(Rule::TypeMismatch, span, message)
                                .help("write `NOT`, or the other value"),
                        );
                        None
                    }
                    (true, _) => self.fits(-i64::from(value), ty, span),
                }
            }
            (kind, _) => {
                let found = match kind {
                    ConstantKind::Integer(_) => Type::Int,
                    ConstantKind::Duration(_) => Type::Time,
                    ConstantKind::Bool(_) | ConstantKind::Name(..) | ConstantKind::Unreadable => {
                        Type::Bool
                    }
                };
                let diagnostic = Diagnostic::new(
                    Rule::TypeMismatch,
                    span,
                    format!("{} is needed here, and this is {}", a(ty), a(found)),
                );
                let help = match (found, ty) {
                    (Type::Int, Type::Time) => {
                        Some("give it a unit, as in `2s` or `500ms`".to_owned())
                    }
                    (Type::Int, Type::Bool) => Some(
                        "write `TRUE` or `FALSE`; a number is declared with `: int`".to_owned(),
                    ),
                    (Type::Time, Type::Bool) => {
                        Some("a duration is declared with `: time`".to_owned())
                    }
                    _ => None,
                };
                self.report_with_help(diagnostic, help);
                None
            }
        }
    }

    fn named_constant(&mut self, name: &ast::Name, ty: Type, view: View) -> Option<i32> {
        let reference = ast::Ref {
            graph: None,
            name: name.clone(),
            span: name.span,
        };
        let found = self.find_read(&reference, view)?;
        let id = match found {
            Found::Variable(id) if self.model[id].kind == DeclarationKind::Constant => id,
            _ => {
                let message = format!(
                    "`{}` is not a constant, and a constant is needed here",
                    name.text
                );
                self.report(Diagnostic::new(Rule::TypeMismatch, name.span, message));
                return None;
            }
        };
        let declared = self.model[id].ty;
        if declared != ty {
            let (message, place) = (
                format!(
                    "{} is needed here, and `{}` is {}",
                    a(ty),
                    name.text,
                    a(declared)
                ),
                self.model[id].span,
            );
            self.report(
                Diagnostic::new(Rule::TypeMismatch, name.span, message)
                    .label(place, "declared here"),
            );
            return None;
        }
        if matches!(view, View::Application | View::Graph(_)) {
            self.model.constants_read.insert(id);
        }
        self.value_of(id, name.span)
    }

    /// The value of a declared constant; `span` is where it is asked for.
    pub(super) fn value_of(&mut self, id: VariableId, span: Span) -> Option<i32> {
        if self.constants.running.contains(&id) {
            let message = format!("the constant `{}` needs its own value", self.model[id].name);
            self.report(Diagnostic::new(Rule::TypeMismatch, span, message));
            return None;
        }
        // A constant may stand for another, and that for a third: the last of such a chain is found out first.
        let mut chain = Vec::new();
        let mut next = Some(id);
        while let Some(id) = next
            && self.constants.waiting.contains_key(&id)
            && self.constants.running.insert(id)
        {
            chain.push(id);
            next = self.needed_for(id);
        }
        for id in chain.into_iter().rev() {
            if let Some(constant) = self.constants.waiting.remove(&id) {
                let view = self.view_of(self.model[id].owner);
                self.model[id].initial = self.constant(constant, self.model[id].ty, view);
            }
            self.constants.running.remove(&id);
        }
        self.model[id].initial
    }

    /// The constant that another one stands for, as far as that is evident.
    fn needed_for(&self, id: VariableId) -> Option<VariableId> {
        let ConstantKind::Name(name, _) = &self.constants.waiting.get(&id)?.kind else {
            return None;
        };
        let home = self.model[id].owner;
        let inside = home.and_then(|home| self.names.scopes[home.0].names.get(&name.text));
        inside
            .or_else(|| self.names.application.get(&name.text))
            .copied()
    }

    /// How names look from inside a graph, or from the application.
    pub(super) fn view_of(&self, owner: Option<super::GraphId>) -> View<'static> {
        match owner {
            None => View::Application,
            Some(graph) if self.model[graph].plant => View::Plant(graph),
            Some(graph) => View::Graph(graph),
        }
    }

    /// A literal within 32 bits.
    pub(super) fn fits(&mut self, value: i64, ty: Type, span: Span) -> Option<i32> {
        let fitting = i32::try_from(value).ok();
        if fitting.is_none() {
            let message = match ty {
                Type::Time => "a time holds at most 24 days".to_owned(),
                Type::Bool | Type::Int => {
                    format!("an int holds {} to {}", i32::MIN, i32::MAX)
                }
            };
            self.report(Diagnostic::new(Rule::OutOfRange, span, message));
        }
        fitting
    }

    /// Reports a constant outside the range of what it is stored in. `what` names that.
    pub(super) fn check_limits(&mut self, value: i32, id: VariableId, span: Span) {
        let variable = &self.model[id];
        let (low, high) = variable.limits();
        if value < low || high < value {
            let diagnostic = Diagnostic::new(
                Rule::OutOfRange,
                span,
                format!(
                    "`{}` holds {} to {}, not {}",
                    variable.name,
                    shown(low, variable.ty),
                    shown(high, variable.ty),
                    shown(value, variable.ty)
                ),
            )
            .label(variable.span, "declared here");
            self.report(diagnostic);
        }
    }
}

/// A type with its article.
pub(super) fn a(ty: Type) -> &'static str {
    match ty {
        Type::Bool => "a Boolean",
        Type::Int => "an int",
        Type::Time => "a time",
    }
}

/// A value as it is written.
pub(super) fn shown(value: i32, ty: Type) -> String {
    match ty {
        Type::Bool => if value == 0 { "FALSE" } else { "TRUE" }.to_owned(),
        Type::Int => value.to_string(),
        Type::Time if value % 1000 == 0 => format!("{}s", value / 1000),
        Type::Time => format!("{value}ms"),
    }
}
