//! The trace (`semantics.md`, "The trace").

use grafcet_compiler::ast::{BindingTarget, DeclarationKind, Type};

use crate::machine::Machine;
use crate::name::Qualified;
use crate::program::Program;

impl<'a> Program<'a> {
    /// The header of the trace.
    #[must_use]
    pub fn header(&self) -> Vec<String> {
        let graphs = self.graphs.iter().map(|graph| graph.name.to_owned());
        let columns = self.columns.iter().map(|(graph, name)| match *graph {
            "" => (*name).to_owned(),
            graph => format!("{graph}:{name}"),
        });
        ["time_ms".to_owned()]
            .into_iter()
            .chain(graphs)
            .chain(columns)
            .collect()
    }

    /// The variables that have a column: every output, then every variable and parameter.
    pub(crate) fn find_columns(&self) -> Vec<Qualified<'a>> {
        let bound = |name| self.declared[&name].1.is_some();
        let names = || self.names.iter().copied();
        let outputs = names().filter(|n| self.kind(*n) == DeclarationKind::Output && !bound(*n));
        let inner = names().filter(|name| {
            matches!(
                self.kind(*name),
                DeclarationKind::Variable { .. } | DeclarationKind::Parameter
            )
        });
        outputs.chain(inner).collect()
    }

    /// The inputs that a stimulus may give: those that are not bound to an expression.
    #[must_use]
    pub fn inputs(&self) -> Vec<Qualified<'a>> {
        let elsewhere = |name| matches!(self.declared[&name].1, Some(BindingTarget::Expression(_)));
        let names = self.names.iter().copied();
        names
            .filter(|name| self.kind(*name) == DeclarationKind::Input && !elsewhere(*name))
            .collect()
    }

    /// The parameters, which a stimulus may give too.
    #[must_use]
    pub fn parameters(&self) -> Vec<Qualified<'a>> {
        let names = self.names.iter().copied();
        names
            .filter(|name| self.kind(*name) == DeclarationKind::Parameter)
            .collect()
    }

    /// Whether a variable is a Boolean.
    #[must_use]
    pub fn is_boolean(&self, name: Qualified<'a>) -> bool {
        self.ty(name) == Type::Bool
    }

    /// What survives power: retained variables and parameters.
    #[must_use]
    pub fn retained(&self) -> Vec<Qualified<'a>> {
        let names = self.names.iter().copied();
        names
            .filter(|name| {
                matches!(
                    self.kind(*name),
                    DeclarationKind::Variable { retain: true } | DeclarationKind::Parameter
                )
            })
            .collect()
    }
}

impl Machine<'_> {
    /// The row of the latest scan.
    #[must_use]
    pub fn row(&self) -> Vec<String> {
        let situations = self.program.graphs.iter().map(|graph| {
            let active = &self.situation[graph.name];
            let ids = graph.steps.iter().map(|step| step.id.text.as_str());
            let ids: Vec<&str> = ids.filter(|id| active.contains(id)).collect();
            ids.join(" ")
        });
        let values = self
            .program
            .columns
            .iter()
            .map(|name| self.values[name].number().to_string());
        [self.now_ms.to_string()]
            .into_iter()
            .chain(situations)
            .chain(values)
            .collect()
    }
}
