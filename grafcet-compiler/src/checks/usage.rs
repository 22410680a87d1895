//! What is declared and not used. Graphs count; plants and tests do not.

use std::collections::{BTreeMap, BTreeSet};

use crate::ast::DeclarationKind;
use crate::diagnostic::{Diagnostic, Rule};
use crate::model::{ExpressionKind, GraphId, Inside, Model, Type, VariableId};

/// Who reads and writes what, in the graphs of the controller.
struct Usage {
    read: BTreeSet<VariableId>,
    written: BTreeSet<VariableId>,
}

/// Warns of what nobody reads or writes, and of outputs that never become False again.
pub(super) fn advise(model: &Model, diagnostics: &mut Vec<Diagnostic>) {
    let usage = Usage::of(model);
    for id in (0..model.variables.len()).map(VariableId) {
        let in_plant = model[id].owner.is_some_and(|owner| model[owner].plant);
        if !in_plant {
            diagnostics.extend(usage.complaint(model, id));
        }
    }
    advise_never_cleared(model, diagnostics);
}

impl Usage {
    fn of(model: &Model) -> Usage {
        let mut usage = Usage {
            read: model.constants_read.clone(),
            written: BTreeSet::new(),
        };
        for graph in model.controller() {
            for expression in super::expressions_of(model, graph) {
                expression.visit(|expression| {
                    if let ExpressionKind::Variable(id) | ExpressionKind::Bound(id, _) =
                        expression.kind
                    {
                        usage.read.insert(id);
                    }
                    Inside::Visit
                });
            }
            for action in super::actions_of(model, graph) {
                let momentary = action.momentary.iter().flat_map(|it| &it.targets);
                let stored = action.all_stored().map(|it| &it.target);
                for target in momentary.chain(stored) {
                    usage.written.extend([target.variable, target.named]);
                }
            }
        }
        usage
    }

    fn complaint(&self, model: &Model, id: VariableId) -> Option<Diagnostic> {
        let variable = &model[id];
        let (read, written) = (self.read.contains(&id), self.written.contains(&id));
        let name = &variable.name;
        let (rule, message) = match variable.kind {
            DeclarationKind::Input if !read => {
                (Rule::Unused, format!("no graph reads the input `{name}`"))
            }
            DeclarationKind::Output if !written => (
                Rule::NeverWritten,
                format!("no graph writes the output `{name}`"),
            ),
            DeclarationKind::Parameter if !read => (
                Rule::Unused,
                format!("no graph reads the parameter `{name}`"),
            ),
            DeclarationKind::Constant if !read => (
                Rule::Unused,
                format!("no graph reads the constant `{name}`"),
            ),
            DeclarationKind::Variable { .. } => match (read, written) {
                (false, false) => (
                    Rule::Unused,
                    format!("no graph reads or writes the variable `{name}`"),
                ),
                (true, false) if variable.initial.is_none() => (
                    Rule::NeverWritten,
                    format!(
                        "the variable `{name}` is read, but no graph writes it and it has no initial value"
                    ),
                ),
                (false, true) => (
                    Rule::NeverRead,
                    format!("the variable `{name}` is written, but no graph reads it"),
                ),
                _ => return None,
            },
            _ => return None,
        };
        Some(Diagnostic::new(rule, variable.span, message))
    }
}

fn advise_never_cleared(model: &Model, diagnostics: &mut Vec<Diagnostic>) {
    // For each stored output whether some statement may store False.
    let mut cleared: BTreeMap<VariableId, bool> = BTreeMap::new();
    for action in model
        .controller()
        .flat_map(|graph: GraphId| super::actions_of(model, graph))
    {
        for stored in action.all_stored() {
            let may_clear = stored.value.constant(model) != Some(1);
            *cleared.entry(stored.target.variable).or_default() |= may_clear;
        }
    }
    for (id, _) in cleared.into_iter().filter(|(_, cleared)| !cleared) {
        let variable = &model[id];
        if variable.kind == DeclarationKind::Output && variable.ty == Type::Bool {
            let message = format!(
                "the output `{}` is set True and never False again",
                variable.name
            );
            let diagnostic = Diagnostic::new(Rule::NeverCleared, variable.span, message)
                .help(format!("write `{} = FALSE` where it ends", variable.name));
            diagnostics.push(diagnostic);
        }
    }
}
