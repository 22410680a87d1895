//! What actions write.

use super::names::{Found, View};
use super::resolver::Resolver;
use super::{DeclarationKind, Target, VariableId};
use crate::ast;
use crate::diagnostic::{Diagnostic, Rule};
use crate::source::Span;

impl Resolver<'_> {
    /// The variable that a statement writes; nothing when it may not, which is reported.
    pub(super) fn target(&mut self, name: &ast::Ref, view: View) -> Option<Target> {
        let span = name.span;
        match self.find(name, view)? {
            Found::Variable(named) => {
                self.settle_binding(named, span);
                let refusal = match view {
                    View::Plant(plant) => self.refused_to_plant(named, plant),
                    _ => self.refused_to_graph(named),
                };
                if let Some((rule, message, help)) = refusal {
                    let place = self.model[named].span;
                    let diagnostic =
                        Diagnostic::new(rule, span, message).label(place, "declared here");
                    self.report_with_help(diagnostic, help);
                    return None;
                }
                Some(Target {
                    variable: self.written_through(named),
                    named,
                    span,
                })
            }
            Found::Step(_) | Found::Macro(_) => {
                let diagnostic = Diagnostic::new(
                    Rule::WriteToStepBit,
                    span,
                    format!(
                        "`{}` is a step bit: only transitions and forcing activate steps",
                        name.name.text
                    ),
                )
                .help("force its graph: `F/Graph:{..}`");
                self.report(diagnostic);
                None
            }
            Found::System(system) => {
                let message = format!("`System:{}` can only be read", system.name());
                self.report(Diagnostic::new(Rule::WriteToConstant, span, message));
                None
            }
        }
    }

    fn refused_to_graph(&self, id: VariableId) -> Option<(Rule, String, Option<String>)> {
        let variable = &self.model[id];
        let name = &variable.name;
        match variable.kind {
            DeclarationKind::Input => Some((
                Rule::WriteToInput,
                format!("`{name}` is an input, and an action cannot write it"),
                Some("write an output or a variable".to_owned()),
            )),
            DeclarationKind::Constant => Some((
                Rule::WriteToConstant,
                format!("`{name}` is a constant, and an action cannot write it"),
                Some("declare it with `var`".to_owned()),
            )),
            DeclarationKind::Parameter => Some((
                Rule::WriteToConstant,
                format!(
                    "`{name}` is a parameter: the operator sets it, and an action cannot write it"
                ),
                Some("declare it with `var`, or `retain var`".to_owned()),
            )),
            DeclarationKind::Output | DeclarationKind::Variable { .. } => None,
        }
    }

    /// A plant writes inputs and its own variables.
    fn refused_to_plant(
        &self,
        id: VariableId,
        plant: super::GraphId,
    ) -> Option<(Rule, String, Option<String>)> {
        let variable = &self.model[id];
        let name = &variable.name;
        match variable.kind {
            DeclarationKind::Input if variable.binding.is_alias() => Some((
                Rule::WriteToInput,
                format!("`{name}` is bound to an expression: it is no input of its own"),
                Some("write the inputs in that expression".to_owned()),
            )),
            DeclarationKind::Input => None,
            DeclarationKind::Variable { .. } if variable.owner == Some(plant) => None,
            DeclarationKind::Output => Some((
                Rule::WriteToConstant,
                format!("`{name}` is an output: a plant can only read it"),
                Some("a plant writes inputs and its own variables".to_owned()),
            )),
            DeclarationKind::Variable { .. } => Some((
                Rule::WriteToConstant,
                format!("`{name}` is a variable of the controller: a plant cannot write it"),
                Some("a plant writes inputs and its own variables".to_owned()),
            )),
            _ => self.refused_to_graph(id),
        }
    }

    /// Reports a constant that what it is stored in cannot hold.
    pub(super) fn check_stored(&mut self, target: Target, value: &super::Expression) {
        if let Some(constant) = value.constant(&self.model) {
            self.check_limits(constant, target.variable, value.span);
        }
    }

    /// Reports a type that does not go with the variable.
    pub(super) fn check_assigned(&mut self, target: Target, value: &super::Expression) -> bool {
        let variable = &self.model[target.variable];
        let Some(ty) = value.ty.filter(|ty| *ty != variable.ty) else {
            return true;
        };
        let message = format!(
            "`{}` is {}, and this is {}",
            variable.name,
            super::constant::a(variable.ty),
            super::constant::a(ty)
        );
        let diagnostic = Diagnostic::new(Rule::TypeMismatch, value.span, message)
            .label(variable.span, "declared here");
        let truth = value
            .constant(&self.model)
            .is_some_and(|value| value == 0 || value == 1);
        let help = advice(variable.ty, ty, truth);
        self.report_with_help(diagnostic, help);
        false
    }

    /// Reports a momentary action on a number.
    pub(super) fn check_momentary(&mut self, target: Target) -> bool {
        let variable = &self.model[target.variable];
        if variable.ty == super::Type::Bool {
            return true;
        }
        self.report_momentary_number(&variable.name.clone(), variable.span, target.span);
        false
    }

    fn report_momentary_number(&mut self, name: &str, declared: Span, span: Span) {
        let message = format!(
            "`{name}` is a number: a momentary action makes a Boolean True while it is executed"
        );
        let diagnostic = Diagnostic::new(Rule::MomentaryNumber, span, message)
            .label(declared, "declared here")
            .help(format!("store a value: `{name} = ..`"));
        self.report(diagnostic);
    }
}

/// What to do about a value of another type; `truth` says that it is the number 0 or 1.
fn advice(declared: super::Type, found: super::Type, truth: bool) -> Option<String> {
    use super::Type::{Bool, Int, Time};
    let advice = match (declared, found) {
        (Time, Int) => "give it a unit, as in `2s`",
        (Int, Time) => "declare the variable with `: time`",
        (Bool, Int) if truth => "write `TRUE` or `FALSE`",
        (Bool, _) => "compare it with something, as in `n > 0`",
        (_, Bool) => "a Boolean is never a number: write two statements, one with `IF`",
        _ => return None,
    };
    Some(advice.to_owned())
}
