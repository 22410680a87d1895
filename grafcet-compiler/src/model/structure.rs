//! Graphs: their steps, macro steps and transitions, before any expression is looked at.

use std::collections::BTreeMap;

use super::names::{Scope, StepName, View};
use super::resolver::Resolver;
use super::{Action, Graph, GraphId, Macro, MacroId, Step, StepId, StepRole, Transition, Trigger};
use crate::ast::{self, Element};
use crate::diagnostic::{Diagnostic, Rule};
use crate::source::Span;

/// The text of a graph, taken apart.
pub(super) struct Body<'a> {
    pub always: Vec<&'a ast::Always>,
    /// In the order of [`Graph::steps`].
    pub steps: Vec<&'a ast::Step>,
    pub transitions: Vec<&'a ast::Transition>,
}

impl<'a> Resolver<'a> {
    /// Takes a graph and makes its steps and names known. `template` is set for the body of an instance.
    pub(super) fn take_graph(
        &mut self,
        name: &ast::Name,
        body: &'a ast::Graph,
        template: Option<&str>,
    ) -> GraphId {
        let id = GraphId(self.model.graphs.len());
        self.take_graph_name(name, id);
        self.add_graph(id, name, body, template);
        id
    }

    /// Takes a plant.
    pub(super) fn take_plant(&mut self, body: &'a ast::Graph) {
        let id = self.take_graph(&body.name, body, None);
        for element in &body.elements {
            if let Element::Declaration(declaration) = element {
                self.refuse_terminals_of_plant(declaration);
            }
        }
        self.model[id].plant = true;
    }

    fn refuse_terminals_of_plant(&mut self, declaration: &ast::Declaration) {
        use ast::DeclarationKind::{Input, Output};
        if matches!(declaration.kind, Input | Output) {
            let diagnostic = Diagnostic::new(
                Rule::Syntax,
                declaration.span,
                "a plant declares no inputs and outputs: it writes the inputs of the application and reads its outputs",
            )
            .help("declare it in the application, or as a `var` of the plant");
            self.report(diagnostic);
        }
    }

    fn take_graph_name(&mut self, name: &ast::Name, id: GraphId) {
        const WHAT: &str = "graph, plant or template";
        if name.text.is_empty() {
            self.names.nameless_graph = true;
            return;
        }
        if let Some(first) = self.names.graphs.get(&name.text) {
            let first = self.model[*first].span;
            return self.report_duplicate(WHAT, name, first);
        }
        if let Some(template) = self.names.templates.get(&name.text) {
            let template = template.name.span;
            self.report_duplicate(WHAT, name, template);
        }
        self.names.graphs.insert(name.text.clone(), id);
    }

    pub(super) fn add_graph(
        &mut self,
        id: GraphId,
        name: &ast::Name,
        body: &'a ast::Graph,
        template: Option<&str>,
    ) {
        let model = &mut self.model;
        let (variables, steps) = (model.variables.len(), model.steps.len());
        let (macros, transitions) = (model.macros.len(), model.transitions.len());
        model.graphs.push(Graph {
            name: name.text.clone(),
            text: body.text.as_ref().map(|text| text.text.clone()),
            template: template.map(str::to_owned),
            plant: false,
            variables: variables..variables,
            steps: steps..steps,
            macros: macros..macros,
            transitions: transitions..transitions,
            always: Vec::new(),
            span: name.span,
        });
        self.names.scopes.push(Scope::default());
        self.bodies.push(Body {
            always: Vec::new(),
            steps: Vec::new(),
            transitions: Vec::new(),
        });
        self.take_elements(id, &body.elements, None);
        self.take_transitions(id);
        let model = &mut self.model;
        let graph = &mut model.graphs[id.0];
        graph.variables.end = model.variables.len();
        graph.steps.end = model.steps.len();
        graph.macros.end = model.macros.len();
        graph.transitions.end = model.transitions.len();
    }

    fn take_elements(&mut self, graph: GraphId, elements: &'a [Element], parent: Option<MacroId>) {
        for element in elements {
            match element {
                Element::Declaration(declaration) => self.declare(declaration, Some(graph)),
                Element::Always(always) => self.bodies[graph.0].always.push(always),
                Element::Step(step) => self.take_step(graph, step, parent),
                Element::Macro(outer) => self.take_macro(graph, outer, parent),
                Element::Transition(transition) => {
                    self.bodies[graph.0].transitions.push(transition)
                }
            }
        }
    }

    fn take_step(&mut self, graph: GraphId, step: &'a ast::Step, parent: Option<MacroId>) {
        let id = StepId(self.model.steps.len());
        self.register_step(graph, &step.id, StepName::Step(id));
        self.bodies[graph.0].steps.push(step);
        self.model.steps.push(Step {
            graph,
            id: step.id.text.clone(),
            text: step.text.as_ref().map(|text| text.text.clone()),
            initial: step.initial,
            role: step.role,
            parent,
            encloses: Vec::new(),
            action: Action::default(),
            span: step.id.span,
        });
    }

    fn take_macro(&mut self, graph: GraphId, text: &'a ast::Macro, parent: Option<MacroId>) {
        let id = MacroId(self.model.macros.len());
        self.register_step(graph, &text.id, StepName::Macro(id));
        let first = self.model.steps.len();
        self.model.macros.push(Macro {
            graph,
            id: text.id.text.clone(),
            text: text.text.as_ref().map(|text| text.text.clone()),
            parent,
            steps: first..first,
            entry: None,
            exit: None,
            span: text.id.span,
        });
        self.take_elements(graph, &text.elements, Some(id));
        self.model[id].steps.end = self.model.steps.len();
        self.model[id].entry = self.the_one(id, StepRole::Entry, "entry");
        self.model[id].exit = self.the_one(id, StepRole::Exit, "exit");
    }

    /// The one entry (or exit) step of an expansion.
    fn the_one(&mut self, of: MacroId, role: StepRole, word: &str) -> Option<StepId> {
        let steps = self.model[of].steps.clone().map(StepId);
        let found: Vec<StepId> = steps
            .filter(|step| self.model[*step].role == role && self.model[*step].parent == Some(of))
            .collect();
        let name = &self.model[of];
        match found.as_slice() {
            [only] => return Some(*only),
            [] => {
                let message = format!("the macro step {} has no {word} step", name.id);
                let diagnostic = Diagnostic::new(Rule::MacroShape, name.span, message)
                    .help(format!("write `{word} step ..` in its expansion"));
                self.report(diagnostic);
            }
            [first, others @ ..] => {
                for second in others {
                    let diagnostic = Diagnostic::new(
                        Rule::MacroShape,
                        self.model[*second].span,
                        format!(
                            "a second {word} step of the macro step {}",
                            self.model[of].id
                        ),
                    )
                    .label(self.model[*first].span, "the first one is here");
                    self.report(diagnostic);
                }
            }
        }
        found.first().copied()
    }

    fn register_step(&mut self, graph: GraphId, name: &ast::Name, step: StepName) {
        let scope = &mut self.names.scopes[graph.0];
        if name.text.is_empty() {
            scope.nameless = true;
            return;
        }
        let steps = &mut scope.steps;
        let Some(first) = steps.get(&name.text).copied() else {
            steps.insert(name.text.clone(), step);
            return;
        };
        self.names.scopes[graph.0]
            .disputed
            .insert(name.text.clone());
        let first = self.place_of(first);
        let message = format!(
            "a second step {} in the graph `{}`",
            name.text,
            self.model[graph].own_name()
        );
        let diagnostic = Diagnostic::new(Rule::DuplicateStep, name.span, message)
            .label(first, "the first one is here");
        self.report(diagnostic);
    }

    pub(super) fn place_of(&self, step: StepName) -> Span {
        match step {
            StepName::Step(id) => self.model[id].span,
            StepName::Macro(id) => self.model[id].span,
        }
    }

    /// Adds the transitions of a graph with their links, still without triggers.
    fn take_transitions(&mut self, graph: GraphId) {
        let mut numbers: BTreeMap<u32, Span> = BTreeMap::new();
        for transition in std::mem::take(&mut self.bodies[graph.0].transitions) {
            let number = self.transition_number(graph, &transition.number, &mut numbers);
            let entrance = self.links(graph, &transition.entrance);
            let exit = self.links(graph, &transition.exit);
            let names = || transition.entrance.iter().chain(&transition.exit);
            let disputed = &self.names.scopes[graph.0].disputed;
            if !names().any(|name| disputed.contains(&name.text)) {
                self.check_joins(transition, &entrance, &exit);
            }
            let left = entrance.iter().filter_map(|(step, _)| match step {
                StepName::Step(id) => Some(*id),
                StepName::Macro(id) => self.model[*id].exit,
            });
            let left = unique(left);
            let entered = exit.iter().filter_map(|(step, _)| match step {
                StepName::Step(id) => Some(*id),
                StepName::Macro(id) => self.model[*id].entry,
            });
            let entered = unique(entered);
            self.model.transitions.push(Transition {
                graph,
                number,
                text: transition.text.as_ref().map(|text| text.text.clone()),
                entrance: left,
                exit: entered,
                trigger: Trigger::Unknown,
                action: Action::default(),
                span: transition.number.span,
            });
            self.bodies[graph.0].transitions.push(transition);
        }
    }

    fn transition_number(
        &mut self,
        graph: GraphId,
        name: &ast::Name,
        numbers: &mut BTreeMap<u32, Span>,
    ) -> u32 {
        let Ok(number) = name.text.replace('_', "").parse::<u32>() else {
            let message = format!("a transition's number is at most {}", u32::MAX);
            self.report(Diagnostic::new(Rule::OutOfRange, name.span, message));
            return 0;
        };
        if let Some(first) = numbers.get(&number) {
            let message = format!(
                "a second transition {number} in the graph `{}`",
                self.model[graph].own_name()
            );
            let diagnostic = Diagnostic::new(Rule::DuplicateTransition, name.span, message)
                .label(*first, "the first one is here");
            self.report(diagnostic);
        } else {
            numbers.insert(number, name.span);
        }
        number
    }

    fn links(&mut self, graph: GraphId, names: &[ast::Name]) -> Vec<(StepName, Span)> {
        let mut links = Vec::with_capacity(names.len());
        for name in names {
            match self.names.scopes[graph.0].steps.get(&name.text) {
                Some(step) => links.push((*step, name.span)),
                None => self.report_missing_step(graph, name, &name.text),
            }
        }
        links
    }

    /// A transition stays within one expansion; its entry and exit steps are joined through the macro step.
    fn check_joins(
        &mut self,
        transition: &ast::Transition,
        entrance: &[(StepName, Span)],
        exit: &[(StepName, Span)],
    ) {
        let mut all = entrance.iter().chain(exit);
        let Some((first, first_span)) = all.next() else {
            return;
        };
        let level = self.level(*first);
        if let Some((_, span)) = all.find(|(step, _)| self.level(*step) != level) {
            let number = &transition.number.text;
            let message = format!(
                "transition {number} joins a step inside an expansion with one outside of it"
            );
            let diagnostic = Diagnostic::new(Rule::MacroShape, *span, message)
                .label(*first_span, "not in the same expansion as this one")
                .help("enter and leave an expansion through its macro step");
            self.report(diagnostic);
            return;
        }
        let role = |step: StepName| match step {
            StepName::Step(id) => self.model[id].role,
            StepName::Macro(_) => StepRole::Plain,
        };
        let wrong = |links: &[(StepName, Span)], wrong: StepRole| {
            links
                .iter()
                .find(|(step, _)| role(*step) == wrong)
                .map(|(_, span)| *span)
        };
        let entered = wrong(exit, StepRole::Entry);
        let left = wrong(entrance, StepRole::Exit);
        if let Some(span) = entered {
            let message = "the entry step of an expansion is entered from within";
            let diagnostic = Diagnostic::new(Rule::MacroShape, span, message)
                .help("only a transition to the macro step enters it");
            self.report(diagnostic);
        }
        if let Some(span) = left {
            let message = "the exit step of an expansion is left from within";
            let diagnostic = Diagnostic::new(Rule::MacroShape, span, message)
                .help("only a transition from the macro step leaves it");
            self.report(diagnostic);
        }
    }

    /// The expansion that a step or macro step stands in.
    fn level(&self, step: StepName) -> Option<MacroId> {
        match step {
            StepName::Step(id) => self.model[id].parent,
            StepName::Macro(id) => self.model[id].parent,
        }
    }

    /// The steps of a set: of that graph, and never macro steps.
    pub(super) fn set(&mut self, graph: GraphId, set: &ast::Set) -> Vec<StepId> {
        let mut steps = Vec::with_capacity(set.steps.len());
        for name in &set.steps {
            match self.names.scopes[graph.0].steps.get(&name.text).copied() {
                Some(StepName::Step(id)) => steps.push(id),
                Some(StepName::Macro(id)) => {
                    let message = format!(
                        "{} is a macro step, and a situation is made of steps",
                        name.text
                    );
                    let diagnostic = Diagnostic::new(Rule::UnknownStep, name.span, message)
                        .label(self.model[id].span, "its expansion is here")
                        .help("name the steps of its expansion");
                    self.report(diagnostic);
                }
                None => self.report_missing_step(graph, name, &name.text),
            }
        }
        unique(steps.into_iter())
    }

    /// The view of a graph's own text.
    pub(super) fn inside(&self, graph: GraphId) -> View<'static> {
        self.view_of(Some(graph))
    }
}

/// Without repetitions, in the order of the first mention.
fn unique(steps: impl Iterator<Item = StepId>) -> Vec<StepId> {
    let mut seen = std::collections::BTreeSet::new();
    steps.filter(|step| seen.insert(*step)).collect()
}
