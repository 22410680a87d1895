//! Templates and their instances: an instance becomes a graph of its own.

use std::collections::{BTreeMap, BTreeSet};

use super::bound::Extent;
use super::constant::a;
use super::names::View;
use super::resolver::Resolver;
use super::{Binding, DeclarationKind, Expression, ExpressionKind, GraphId, Inside, VariableId};
use crate::ast::{self, BindingTarget};
use crate::diagnostic::{Diagnostic, Rule};
use crate::source::Span;

/// Bindings that are not looked up yet.
#[derive(Default)]
pub(super) struct Pending<'a> {
    waiting: BTreeMap<VariableId, &'a ast::Expression>,
    /// Those that are being looked up: one that is bound to itself is bound to nothing.
    running: BTreeSet<VariableId>,
    /// How large the expressions are that have been looked up.
    extents: BTreeMap<VariableId, Extent>,
    /// Templates with an instance.
    used: BTreeSet<String>,
}

/// How many bytes of text all instances together may repeat of their templates.
pub const MAX_REPEATED: usize = 4 << 20;

impl<'a> Resolver<'a> {
    /// Takes an instance and notes what its interface names are bound to.
    pub(super) fn take_instance(&mut self, instance: &'a ast::Instance) {
        let Some(template) = self.names.templates.get(&instance.template.text).copied() else {
            self.report_missing_template(&instance.template);
            self.names.broken.insert(instance.name.text.clone());
            return;
        };
        self.bindings.used.insert(template.name.text.clone());
        if !self.may_repeat(template, instance) {
            self.names.broken.insert(instance.name.text.clone());
            return;
        }
        let id = self.take_graph(&instance.name, template, Some(&template.name.text));
        let interface = self.interface(id, template);
        let mut bound: BTreeMap<&str, Span> = BTreeMap::new();
        for binding in &instance.bindings {
            if let Some(first) = bound.insert(&binding.name.text, binding.name.span) {
                let message = format!("`{}` is bound a second time", binding.name.text);
                let diagnostic = Diagnostic::new(Rule::TemplateBinding, binding.name.span, message)
                    .label(first, "the first binding is here");
                self.report(diagnostic);
                continue;
            }
            self.bind(id, template, &interface, binding);
        }
        self.report_unbound(&interface, instance, template, &bound);
    }

    /// Whether there is room for one more instance.
    fn may_repeat(&mut self, template: &ast::Graph, instance: &ast::Instance) -> bool {
        let within = self.repeated <= MAX_REPEATED;
        self.repeated += (template.span.end - template.span.start) as usize;
        if within && self.repeated > MAX_REPEATED {
            let message = format!(
                "the instances of templates come to more than {} MB of text",
                MAX_REPEATED >> 20
            );
            self.report(Diagnostic::new(
                Rule::OutOfRange,
                instance.name.span,
                message,
            ));
        }
        self.repeated <= MAX_REPEATED
    }

    fn report_missing_template(&mut self, name: &ast::Name) {
        if self.names.nameless_graph {
            return;
        }
        let help = self.suggest_or_list(&name.text, "", |resolver| {
            resolver
                .names
                .templates
                .keys()
                .map(String::as_str)
                .collect()
        });
        let message = format!("there is no template `{}`", name.text);
        self.report_with_help(
            Diagnostic::new(Rule::UnknownGraph, name.span, message),
            help,
        );
    }

    fn bind(
        &mut self,
        graph: GraphId,
        template: &ast::Graph,
        interface: &BTreeSet<VariableId>,
        binding: &'a ast::Binding,
    ) {
        let name = &binding.name;
        let declared = self.names.scopes[graph.0].names.get(&name.text).copied();
        let Some(id) = declared.filter(|id| interface.contains(id)) else {
            self.report_no_interface(interface, template, name, declared);
            return;
        };
        match (&binding.to, self.model[id].kind) {
            (BindingTarget::Address(_), DeclarationKind::Parameter) => {
                let message = format!("`{}` is a parameter: it is bound to a constant", name.text);
                self.report(Diagnostic::new(
                    Rule::TemplateBinding,
                    binding.span,
                    message,
                ));
            }
            (BindingTarget::Address(address), _) => {
                self.model[id].binding = Binding::Address;
                self.model[id].at = Some(address.span);
                self.model[id].address = self.address(address, id);
            }
            (BindingTarget::Expression(value), DeclarationKind::Parameter) => {
                self.bind_parameter(id, value)
            }
            (BindingTarget::Expression(value), _) => {
                self.bindings.waiting.insert(id, value);
            }
        }
    }

    /// Inputs and outputs that a template declares without an address, and its parameters.
    fn interface(&self, graph: GraphId, template: &ast::Graph) -> BTreeSet<VariableId> {
        let declarations = template
            .elements
            .iter()
            .filter_map(|element| match element {
                ast::Element::Declaration(declaration) => Some(declaration),
                _ => None,
            });
        let addressed: BTreeSet<&str> = declarations
            .filter(|declaration| declaration.address.is_some())
            .flat_map(|declaration| &declaration.names)
            .map(|name| name.text.as_str())
            .collect();
        let names = self.model[graph].variables.clone().map(VariableId);
        names
            .filter(|id| match self.model[*id].kind {
                DeclarationKind::Parameter => true,
                DeclarationKind::Input | DeclarationKind::Output => {
                    !addressed.contains(self.model[*id].name.as_str())
                }
                DeclarationKind::Variable { .. } | DeclarationKind::Constant => false,
            })
            .collect()
    }

    fn report_no_interface(
        &mut self,
        interface: &BTreeSet<VariableId>,
        template: &ast::Graph,
        name: &ast::Name,
        declared: Option<VariableId>,
    ) {
        let message = format!(
            "the template `{}` has no interface name `{}`",
            template.name.text, name.text
        );
        let diagnostic = Diagnostic::new(Rule::TemplateBinding, name.span, message);
        match declared {
            Some(id) => {
                let place = self.model[id].span;
                let diagnostic = diagnostic.label(
                    place,
                    "declared inside the template, and not bound from outside",
                );
                self.report(diagnostic);
            }
            None => {
                let help = self.suggest_or_list(&name.text, "", |resolver| {
                    let names = interface.iter();
                    names.map(|id| resolver.model[*id].name.as_str()).collect()
                });
                self.report_with_help(diagnostic, help);
            }
        }
    }

    fn report_unbound(
        &mut self,
        interface: &BTreeSet<VariableId>,
        instance: &ast::Instance,
        template: &ast::Graph,
        bound: &BTreeMap<&str, Span>,
    ) {
        for id in interface {
            let variable = &self.model[*id];
            if variable.kind == DeclarationKind::Parameter
                || bound.contains_key(variable.name.as_str())
            {
                continue;
            }
            let message = format!(
                "`{}` of the template `{}` is not bound",
                variable.name, template.name.text
            );
            let name = &variable.name;
            let help = match variable.example_of_address() {
                Some(address) => format!("write `{name} at {address}` or `{name} = ..`"),
                None => format!("write `{name} = ..`"),
            };
            let diagnostic = Diagnostic::new(Rule::TemplateBinding, instance.name.span, message)
                .label(variable.span, "declared here")
                .help(help);
            self.report(diagnostic);
        }
    }

    /// Gives a parameter of an instance an initial value of its own.
    fn bind_parameter(&mut self, id: VariableId, value: &ast::Expression) {
        let expression = self.expression(value, View::Application);
        let Some(ty) = expression.ty else {
            return;
        };
        let (name, declared, place) = {
            let variable = &self.model[id];
            (variable.name.clone(), variable.ty, variable.span)
        };
        if ty != declared {
            let message = format!("`{name}` is {}, and this is {}", a(declared), a(ty));
            let diagnostic = Diagnostic::new(Rule::TypeMismatch, value.span, message)
                .label(place, "declared here");
            self.report(diagnostic);
            return;
        }
        let Some(constant) = expression.constant(&self.model) else {
            let message = format!("`{name}` is a parameter: it is bound to a constant");
            let diagnostic = Diagnostic::new(Rule::TemplateBinding, value.span, message)
                .label(place, "declared here");
            self.report(diagnostic);
            return;
        };
        expression.visit(|part| {
            if let ExpressionKind::Variable(constant) = part.kind {
                self.model.constants_read.insert(constant);
            }
            Inside::Visit
        });
        self.model[id].initial = Some(constant);
        self.model[id].initial_span = Some(value.span);
    }

    /// Looks up all bindings.
    pub(super) fn take_bindings(&mut self) {
        let waiting: Vec<(VariableId, Span)> = self
            .bindings
            .waiting
            .iter()
            .map(|(id, value)| (*id, value.span))
            .collect();
        for (id, span) in waiting {
            self.settle_binding(id, span);
        }
    }

    /// Looks up what an interface name is bound to, if that has not been done; `span` is where it is asked for.
    pub(super) fn settle_binding(&mut self, id: VariableId, span: Span) {
        if self.bindings.running.contains(&id) {
            let message = format!("`{}` is bound to itself", self.model.qualified(id));
            self.report(Diagnostic::new(Rule::TemplateBinding, span, message));
            self.model[id].binding = Binding::Expression(Box::new(Expression::unknown(span)));
            return;
        }
        let Some(text) = self.bindings.waiting.remove(&id) else {
            return;
        };
        self.bindings.running.insert(id);
        let value = self.expression(text, View::Application);
        self.bindings.running.remove(&id);
        let value = self.check_binding(id, value);
        self.bindings.extents.insert(id, Extent::of(&value));
        self.model[id].binding = Binding::Expression(Box::new(value));
    }

    /// Whether an interface name is bound to something that has not been looked up.
    pub(super) fn is_waiting(&self, id: VariableId) -> bool {
        self.bindings.waiting.contains_key(&id)
    }

    /// How large the expression is that an interface name stands for.
    pub(super) fn extent_of(&self, id: VariableId) -> Extent {
        let known = self.bindings.extents.get(&id).copied();
        known.unwrap_or(Extent::ONE)
    }

    fn check_binding(&mut self, id: VariableId, value: Expression) -> Expression {
        let (span, variable) = (value.span, &self.model[id]);
        let (declared, place) = (variable.ty, variable.span);
        let name = variable.name.clone();
        if variable.kind == DeclarationKind::Output
            && value.ty.is_some()
            && !self.is_writable(&value)
        {
            let message = format!("`{name}` is an output: it is bound to an address or a variable");
            let diagnostic = Diagnostic::new(Rule::TemplateBinding, span, message)
                .label(place, "declared here")
                .help("bind it to an output or a variable of the application");
            self.report(diagnostic);
            return Expression::unknown(span);
        }
        match value.ty {
            Some(ty) if ty != declared => {
                let message = format!("`{name}` is {}, and this is {}", a(declared), a(ty));
                let diagnostic = Diagnostic::new(Rule::TypeMismatch, span, message)
                    .label(place, "declared here");
                self.report(diagnostic);
                Expression::unknown(span)
            }
            _ => value,
        }
    }

    fn is_writable(&self, value: &Expression) -> bool {
        match value.bare().kind {
            ExpressionKind::Variable(id) => matches!(
                self.model[id].kind,
                DeclarationKind::Output | DeclarationKind::Variable { .. }
            ),
            _ => false,
        }
    }

    /// Looks into templates without an instance, for what is wrong in them; nothing of them stays in the model.
    pub(super) fn take_unused_templates(&mut self) {
        let unused: Vec<&'a ast::Graph> = self
            .names
            .templates
            .iter()
            .filter(|(name, _)| !self.bindings.used.contains(*name))
            .map(|(_, template)| *template)
            .collect();
        for template in unused {
            let id = GraphId(self.model.graphs.len());
            let lengths = (
                self.model.variables.len(),
                self.model.steps.len(),
                self.model.macros.len(),
                self.model.transitions.len(),
            );
            self.add_graph(id, &template.name, template, Some(&template.name.text));
            self.settle_declarations();
            self.refuse_names_of_step_bits(id);
            self.take_body(id);
            self.model.graphs.truncate(id.0);
            self.names.scopes.truncate(id.0);
            self.bodies.truncate(id.0);
            self.model.variables.truncate(lengths.0);
            self.model.steps.truncate(lengths.1);
            self.model.macros.truncate(lengths.2);
            self.model.transitions.truncate(lengths.3);
        }
    }
}
