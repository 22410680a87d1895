//! What is said when a name is not found: with the nearest name, or with where it is to be found.

use super::GraphId;
use super::names::{View, step_of};
use super::resolver::Resolver;
use crate::ast;
use crate::diagnostic::{Diagnostic, Rule};
use crate::literals;
use crate::source::Span;

impl Resolver<'_> {
    /// Nothing by that name.
    pub(super) fn report_missing(&mut self, name: &ast::Name, view: View) {
        if let View::Claim { whole, .. } = view
            && !(whole && self.names.broken.is_empty())
        {
            // It may belong to a plant or a template that there is not, which has been said.
            return;
        }
        if let Some(step) = step_of(&name.text)
            && self.looks_like_a_step(step, view)
        {
            match view.home() {
                Some(home) => self.report_missing_step(home, name, step),
                None if self.may_be_nameless(view) || self.report_leading_zeros(name, step) => {}
                None => {
                    let message = match view {
                        View::Claim { .. } => format!("no graph has a step {step}"),
                        _ => format!("`{}` is a step bit, but of which graph?", name.text),
                    };
                    let diagnostic = Diagnostic::new(Rule::UnknownStep, name.span, message);
                    let help = matches!(view, View::Application)
                        .then(|| format!("write `Graph:{}`", name.text));
                    self.report_with_help(diagnostic, help);
                }
            }
            return;
        }
        let nearest = self.suggest(&name.text, "", |resolver| {
            let names = &resolver.names;
            let plants = match view {
                View::Claim { plants, .. } => plants,
                _ => &[],
            };
            let scopes = view.home().into_iter().chain(plants.iter().copied());
            let inside = scopes.flat_map(|graph| names.scopes[graph.0].names.keys());
            let all = inside.chain(names.application.keys());
            all.map(String::as_str).collect()
        });
        if nearest.is_none() && self.may_be_nameless(view) {
            return;
        }
        let help = nearest.or_else(|| self.elsewhere(&name.text, view));
        let diagnostic = Diagnostic::new(
            Rule::UnknownName,
            name.span,
            format!("nothing is called `{}` here", name.text),
        );
        self.report_with_help(diagnostic, help);
    }

    /// Whether what is not found may be what was declared without a name.
    fn may_be_nameless(&self, view: View) -> bool {
        let inside = match view.home() {
            Some(home) => self.names.scopes[home.0].nameless,
            None => self.names.nameless_inside,
        };
        self.names.nameless || inside
    }

    /// Whether `X` and this identifier are meant as a step bit: digits always are; a letter and digits only where some
    /// step is called by that letter, for the valve `XV101` is a name.
    fn looks_like_a_step(&self, id: &str, view: View) -> bool {
        let Some(letter) = id.chars().next().filter(|c| !c.is_ascii_digit()) else {
            return true;
        };
        let Some(home) = view.home() else {
            return self.names.step_letters.contains(&letter);
        };
        let mut same_letter = self.names.scopes[home.0].steps.range(letter.to_string()..);
        same_letter
            .next()
            .is_some_and(|(id, _)| id.starts_with(letter))
    }

    /// Reports an identifier such as `07`, which names no step and cannot: whether it is one.
    fn report_leading_zeros(&mut self, name: &ast::Name, step: &str) -> bool {
        let Err((bad, Some(meant))) = literals::step_identifier(step) else {
            return false;
        };
        let prefix = name.text.strip_suffix(step).unwrap_or("");
        let diagnostic = Diagnostic::new(Rule::BadLiteral, name.span, bad.message)
            .help(format!("write `{prefix}{meant}`"));
        self.report(diagnostic);
        true
    }

    /// Advice when another graph, or a plant that does not run here, has the name.
    fn elsewhere(&self, name: &str, view: View) -> Option<String> {
        let owner = *self.names.holders.get(name)?.first()?;
        let graph = &self.model[owner];
        match (view, graph.plant) {
            (View::Claim { .. }, true) => Some(format!(
                "the plant `{0}` has it: write `with {0}` behind the test's text",
                graph.name
            )),
            (_, true) => None,
            (_, false) => Some(format!(
                "the graph `{0}` has it: write `{0}:{name}`",
                graph.name
            )),
        }
    }

    /// Nothing by that name in that graph.
    pub(super) fn report_missing_inside(&mut self, graph: GraphId, name: &ast::Name) {
        if let Some(step) = step_of(&name.text)
            && self.looks_like_a_step(step, View::Graph(graph))
        {
            self.report_missing_step(graph, name, step);
            return;
        }
        let graph_name = self.model[graph].name.clone();
        let nearest = self.suggest(&name.text, &format!("{graph_name}:"), |resolver| {
            resolver.names.scopes[graph.0]
                .names
                .keys()
                .map(String::as_str)
                .collect()
        });
        let global = self.names.application.contains_key(&name.text);
        let help = nearest.or_else(|| {
            global.then(|| format!("the application declares it: write `{}` alone", name.text))
        });
        let diagnostic = Diagnostic::new(
            Rule::UnknownName,
            name.span,
            format!("the graph `{graph_name}` declares no `{}`", name.text),
        );
        self.report_with_help(diagnostic, help);
    }

    /// Reports that a graph has no such step; `name` is the place, `X7` or `7`.
    pub(super) fn report_missing_step(&mut self, graph: GraphId, name: &ast::Name, step: &str) {
        if self.names.scopes[graph.0].nameless || self.report_leading_zeros(name, step) {
            return;
        }
        let prefix = name.text.strip_suffix(step).unwrap_or("");
        let called = self.called(graph, name.span);
        let help = self.suggest_or_list(step, prefix, |resolver| {
            resolver.names.scopes[graph.0]
                .steps
                .keys()
                .map(String::as_str)
                .collect()
        });
        let diagnostic = Diagnostic::new(
            Rule::UnknownStep,
            name.span,
            format!("the graph `{called}` has no step {step}"),
        );
        self.report_with_help(diagnostic, help);
    }

    /// No graph by that name.
    pub(super) fn report_missing_graph(&mut self, name: &ast::Name) {
        if self.names.nameless_graph {
            return;
        }
        let diagnostic = Diagnostic::new(
            Rule::UnknownGraph,
            name.span,
            format!("there is no graph `{}`", name.text),
        );
        let help = if self.names.templates.contains_key(&name.text) {
            Some(format!(
                "`{0}` is a template: name an instance of it, `graph G = {0}`",
                name.text
            ))
        } else {
            self.suggest_or_list(&name.text, "", |resolver| {
                resolver.names.graphs.keys().map(String::as_str).collect()
            })
        };
        self.report_with_help(diagnostic, help);
    }

    /// What a graph is called at a place: in the text of its template by the template's name, so that what all
    /// instances have in common is said once.
    fn called(&self, graph: GraphId, place: Span) -> String {
        let graph = &self.model[graph];
        let within = |text: Span| {
            text.file == place.file && text.start <= place.start && place.end <= text.end
        };
        let template = graph
            .template
            .as_ref()
            .and_then(|name| self.names.templates.get(name));
        match template {
            Some(template) if within(template.span) => template.name.text.clone(),
            _ => graph.name.clone(),
        }
    }
}
