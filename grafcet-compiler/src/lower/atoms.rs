//! What expressions read: the things that have a place in an image.

use std::collections::BTreeSet;

use crate::model::{
    DeclarationKind, Expression, ExpressionKind, Inside, MacroId, Model, StepId, System, Type,
    VariableId,
};

/// Something with a value of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Atom {
    System(System),
    Variable(VariableId),
    Step(StepId),
    Macro(MacroId),
}

impl Atom {
    /// Boolean or number.
    pub fn ty(self, model: &Model) -> Type {
        match self {
            Atom::System(system) => system.ty(),
            Atom::Variable(id) => model[id].ty,
            Atom::Step(_) | Atom::Macro(_) => Type::Bool,
        }
    }

    /// What people call it.
    pub fn name(self, model: &Model) -> String {
        match self {
            Atom::System(system) => format!("System:{}", system.name()),
            Atom::Variable(id) => model.qualified(id),
            Atom::Step(id) => format!("{}:X{}", model[model[id].graph].name, model[id].id),
            Atom::Macro(id) => format!("{}:X{}", model[model[id].graph].name, model[id].id),
        }
    }
}

/// Adds what an expression reads, constants left out.
pub(super) fn collect(model: &Model, expression: &Expression, into: &mut BTreeSet<Atom>) {
    expression.visit(|expression| {
        into.extend(named(model, expression));
        if let ExpressionKind::Situation { graph, .. } = &expression.kind {
            into.extend(model[*graph].step_ids().map(Atom::Step));
        }
        Inside::Visit
    });
}

/// Adds what an expression reads by a name of its own: not the steps of a situation.
pub(super) fn collect_named(model: &Model, expression: &Expression, into: &mut BTreeSet<Atom>) {
    expression.visit(|expression| {
        into.extend(named(model, expression));
        Inside::Visit
    });
}

fn named(model: &Model, expression: &Expression) -> Option<Atom> {
    match &expression.kind {
        ExpressionKind::Variable(id) if model[*id].kind != DeclarationKind::Constant => {
            Some(Atom::Variable(*id))
        }
        ExpressionKind::Step(id) => Some(Atom::Step(*id)),
        ExpressionKind::Macro(id) => Some(Atom::Macro(*id)),
        ExpressionKind::System(system) => Some(Atom::System(*system)),
        _ => None,
    }
}
