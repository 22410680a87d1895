//! What a name means where it stands (`language.md`, "Expressions").

use grafcet_compiler::ast::{BindingTarget, DeclarationKind, Expression, ExpressionKind, Ref};

use crate::graph::Graph;
use crate::program::Program;
use crate::value::Value;

/// A name with the graph that it belongs to; no graph (an empty name) is the application.
pub type Qualified<'a> = (&'a str, &'a str);

/// What a name means.
#[derive(Clone, Copy, Debug)]
pub enum Named<'a> {
    /// A variable, an input, an output or a parameter.
    Variable(Qualified<'a>),
    /// A constant.
    Constant(Value),
    /// The bit of a step or macro step.
    Step(Qualified<'a>),
    /// An input that an instance binds to this expression of the application.
    Bound(&'a Expression),
    /// `System:name`.
    System(&'a str),
}

impl<'a> Program<'a> {
    /// What `reference` means in a graph: it is looked up in the graph, then in the application.
    pub fn resolve(&self, graph: &'a str, reference: &'a Ref) -> Named<'a> {
        let place = (graph, reference.span);
        if let Some(known) = self.resolved.borrow().get(&place) {
            return *known;
        }
        let named = self.look_up(graph, reference);
        self.resolved.borrow_mut().insert(place, named);
        named
    }

    fn look_up(&self, graph: &'a str, reference: &'a Ref) -> Named<'a> {
        let name = reference.name.text.as_str();
        let found = match &reference.graph {
            Some(system) if system.text == "System" => Some(Named::System(name)),
            Some(other) => self.in_graph(self.graph(graph, &other.text), name),
            None if graph.is_empty() => self.in_application(name),
            None => self
                .in_graph(self.graph(graph, graph), name)
                .or_else(|| self.in_application(name)),
        };
        found.unwrap_or_else(|| panic!("nothing is called `{name}` in `{graph}`"))
    }

    /// The variable that a statement of a graph writes.
    pub fn target(&self, graph: &'a str, reference: &'a Ref) -> Qualified<'a> {
        match self.resolve(graph, reference) {
            Named::Variable(name) => name,
            other => panic!("a statement writes {other:?}"),
        }
    }

    fn in_application(&self, name: &'a str) -> Option<Named<'a>> {
        let (declaration, _) = self.declared.get(&("", name))?;
        Some(match declaration.kind {
            DeclarationKind::Constant => Named::Constant(self.constant_named("", name)),
            _ => Named::Variable(("", name)),
        })
    }

    fn in_graph(&self, graph: &Graph<'a>, name: &'a str) -> Option<Named<'a>> {
        if let Some((declaration, _)) = self.declared.get(&(graph.name, name)) {
            let bound = match graph.bindings.get(name) {
                Some(BindingTarget::Expression(bound)) => Some(bound),
                Some(BindingTarget::Address(_)) | None => None,
            };
            return Some(match (declaration.kind, bound) {
                (DeclarationKind::Constant, _) => {
                    Named::Constant(self.constant_named(graph.name, name))
                }
                (DeclarationKind::Input, Some(bound)) => Named::Bound(bound),
                (DeclarationKind::Output, Some(bound)) => self.bound_output(bound),
                _ => Named::Variable((graph.name, name)),
            });
        }
        let step = name.strip_prefix('X')?;
        let known =
            graph.macros.contains_key(step) || graph.steps.iter().any(|s| s.id.text == step);
        known.then_some(Named::Step((graph.name, step)))
    }

    fn bound_output(&self, bound: &'a Expression) -> Named<'a> {
        match &bound.kind {
            ExpressionKind::Ref(reference) => self.resolve("", reference),
            other => panic!("an output is bound to {other:?}"),
        }
    }
}
