//! Names: what is declared where, and looking it up (`language.md`, "Expressions").

use std::collections::{BTreeMap, BTreeSet};

use super::resolver::Resolver;
use super::suggest::nearest;
use super::{DeclarationKind, GraphId, MacroId, StepId, System, VariableId};
use crate::ast;
use crate::diagnostic::{Diagnostic, Rule};
use crate::source::Span;

/// The names of an application.
#[derive(Default)]
pub(super) struct Names<'a> {
    /// What the application declares.
    pub application: BTreeMap<String, VariableId>,
    /// Graphs, instances and plants.
    pub graphs: BTreeMap<String, GraphId>,
    /// Templates, those of libraries too.
    pub templates: BTreeMap<String, &'a ast::Graph>,
    /// Instances of templates that there are not: nothing is known of them, and nothing is said of what they lack.
    pub broken: BTreeSet<String>,
    /// Names that are declared twice or cannot be read whole: what is meant is not known, and nothing is said of how
    /// they are used.
    pub disputed: BTreeSet<VariableId>,
    /// The application declares something without a name.
    pub nameless: bool,
    /// A graph, plant or template has no name.
    pub nameless_graph: bool,
    /// The names inside each graph.
    pub scopes: Vec<Scope>,
    /// The graphs and plants that have a name or a step bit, by [`Names::note_holders`].
    pub holders: BTreeMap<String, Vec<GraphId>>,
    /// The letters by which any steps are called.
    pub step_letters: BTreeSet<char>,
    /// Some graph has something without a name.
    pub nameless_inside: bool,
}

/// The names inside a graph.
#[derive(Default)]
pub(super) struct Scope {
    /// What it declares.
    pub names: BTreeMap<String, VariableId>,
    /// Steps and macro steps by their identifiers.
    pub steps: BTreeMap<String, StepName>,
    /// Identifiers that are given twice.
    pub disputed: BTreeSet<String>,
    /// A step or a declaration has no name, which has been reported: nothing is said of what is not found.
    pub nameless: bool,
    /// Step bits that are declared as names too: which is meant is not known, and nothing is said of their use.
    pub clashing: BTreeSet<String>,
}

/// What a step identifier stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StepName {
    Step(StepId),
    Macro(MacroId),
}

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Found {
    Variable(VariableId),
    Step(StepId),
    Macro(MacroId),
    System(System),
}

impl From<StepName> for Found {
    fn from(step: StepName) -> Self {
        match step {
            StepName::Step(id) => Found::Step(id),
            StepName::Macro(id) => Found::Macro(id),
        }
    }
}

/// From where a name is looked up.
#[derive(Clone, Copy)]
pub(super) enum View<'v> {
    /// Inside a graph of the controller.
    Graph(GraphId),
    /// Inside a plant.
    Plant(GraphId),
    /// Outside of all graphs: bindings and constants of the application.
    Application,
    /// In a test, or in a property.
    Claim {
        /// The plants that run with it.
        plants: &'v [GraphId],
        /// None of its plants is unknown, so that what is not found is not there.
        whole: bool,
    },
}

impl View<'_> {
    /// The graph or plant whose names come first.
    pub fn home(self) -> Option<GraphId> {
        match self {
            View::Graph(graph) | View::Plant(graph) => Some(graph),
            View::Application | View::Claim { .. } => None,
        }
    }
}

impl Names<'_> {
    /// Notes which graphs have which names, now that all of them are known.
    pub fn note_holders(&mut self) {
        for (index, scope) in self.scopes.iter().enumerate() {
            let first = scope.steps.keys().filter_map(|id| id.chars().next());
            self.step_letters
                .extend(first.filter(|c| !c.is_ascii_digit()));
            self.nameless_inside |= scope.nameless;
            let bits = scope.steps.keys().map(|id| format!("X{id}"));
            for name in scope.names.keys().cloned().chain(bits) {
                let holders = self.holders.entry(name).or_default();
                if holders.last() != Some(&GraphId(index)) {
                    holders.push(GraphId(index));
                }
            }
        }
    }
}

impl<'a> Resolver<'a> {
    /// What a name stands for; nothing when that is wrong, which is then reported.
    pub(super) fn find(&mut self, name: &ast::Ref, view: View) -> Option<Found> {
        let found = match &name.graph {
            Some(graph) if graph.text == "System" => self.find_system(&name.name),
            Some(graph) => {
                let graph = self.find_graph(graph, view)?;
                let inside = self.find_inside(graph, &name.name.text);
                if inside.is_none() {
                    self.report_missing_inside(graph, &name.name);
                }
                inside
            }
            None => self.find_unqualified(&name.name, view),
        }?;
        (!self.is_disputed(found, &name.name.text)).then_some(found)
    }

    /// What a name that is read stands for; nothing when that is wrong, which is then reported.
    pub(super) fn find_read(&mut self, name: &ast::Ref, view: View) -> Option<Found> {
        let found = self.find(name, view)?;
        self.admit(found, name.span, view).then_some(found)
    }

    /// Whether a name is given twice, which has been reported.
    fn is_disputed(&self, found: Found, name: &str) -> bool {
        let graph = match found {
            Found::Variable(id) => return self.names.disputed.contains(&id),
            Found::Step(id) => self.model[id].graph,
            Found::Macro(id) => self.model[id].graph,
            Found::System(_) => return false,
        };
        self.names.scopes[graph.0].clashing.contains(name)
    }

    fn find_system(&mut self, name: &ast::Name) -> Option<Found> {
        let found = System::ALL.into_iter().find(|it| it.name() == name.text);
        if found.is_none() {
            let known = System::ALL.map(System::name);
            let nearest = nearest(&name.text, &known);
            self.report_with_help(
                Diagnostic::new(
                    Rule::UnknownName,
                    name.span,
                    format!("there is no `System:{}`", name.text),
                ),
                Some(match nearest {
                    Some(nearest) => format!("did you mean `System:{nearest}`?"),
                    None => format!("there are `System:{}`", known.join("`, `System:")),
                }),
            );
        }
        found.map(Found::System)
    }

    fn find_unqualified(&mut self, name: &ast::Name, view: View) -> Option<Found> {
        if let Some(home) = view.home()
            && let Some(found) = self.find_inside(home, &name.text)
        {
            return Some(found);
        }
        if let Some(id) = self.names.application.get(&name.text) {
            return Some(Found::Variable(*id));
        }
        if let View::Claim { plants, .. } = view {
            return self.find_in_claim(name, plants, view);
        }
        // `System` alone has been reported as reserved.
        if name.text != "System" {
            self.report_missing(name, view);
        }
        None
    }

    /// In a test or a property, what only one graph has may go unqualified; what no graph has, but one of the plants.
    fn find_in_claim(&mut self, name: &ast::Name, plants: &[GraphId], view: View) -> Option<Found> {
        let holders = self.names.holders.get(&name.text);
        let holders = holders.map_or(&[][..], Vec::as_slice);
        // Plants stand behind the graphs of the controller; two of a kind are too many.
        let of_graphs = holders
            .iter()
            .take_while(|graph| !self.model[**graph].plant);
        let mut holding: Vec<GraphId> = of_graphs.take(2).copied().collect();
        if holding.is_empty() && plants.len() < holders.len() {
            let running = plants.iter().filter(|it| holders.binary_search(it).is_ok());
            holding.extend(running.take(2));
        } else if holding.is_empty() {
            let running = holders.iter().filter(|it| plants.contains(it));
            holding.extend(running.take(2));
        }
        let inside = |graph: GraphId| Some((graph, self.find_inside(graph, &name.text)?));
        let found: Vec<(GraphId, Found)> = holding.into_iter().filter_map(inside).collect();
        match found.as_slice() {
            [(_, only)] => Some(*only),
            [] => {
                self.report_missing(name, view);
                None
            }
            [(first, _), (second, _), ..] => {
                let (first, second) = (&self.model[*first].name, &self.model[*second].name);
                let text = &name.text;
                let (rule, what) = match step_of(text) {
                    Some(_) => (Rule::UnknownStep, "a step bit"),
                    None => (Rule::UnknownName, "a name"),
                };
                let diagnostic = Diagnostic::new(
                    rule,
                    name.span,
                    format!("`{text}` is {what} of more than one graph"),
                )
                .help(format!("say which: `{first}:{text}` or `{second}:{text}`"));
                self.report(diagnostic);
                None
            }
        }
    }

    /// A step bit or a declared name of one graph.
    pub(super) fn find_inside(&self, graph: GraphId, name: &str) -> Option<Found> {
        let scope = &self.names.scopes[graph.0];
        let step = step_of(name).and_then(|id| scope.steps.get(id).copied());
        match step {
            Some(step) => Some(step.into()),
            None => scope.names.get(name).copied().map(Found::Variable),
        }
    }

    /// A graph by its name, when it may be named from here.
    pub(super) fn find_graph(&mut self, name: &ast::Name, view: View) -> Option<GraphId> {
        if let Some(home) = view.home()
            && self.model[home].template.as_deref() == Some(name.text.as_str())
        {
            return Some(home);
        }
        let Some(graph) = self.names.graphs.get(&name.text).copied() else {
            if !self.names.broken.contains(&name.text) {
                self.report_missing_graph(name);
            }
            return None;
        };
        let plant = self.model[graph].plant;
        let refusal = match view {
            View::Graph(_) | View::Application if plant => Some((
                format!(
                    "`{}` is a plant: it stands in for the machine, and no graph can name it",
                    name.text
                ),
                "a graph knows the machine by its inputs and outputs".to_owned(),
            )),
            View::Plant(home) if plant && graph != home => Some((
                format!(
                    "`{}` is another plant: plants meet in the inputs and outputs only",
                    name.text
                ),
                "read the input that the other plant writes".to_owned(),
            )),
            View::Claim { plants, .. } if plant && !plants.contains(&graph) => Some((
                format!("the plant `{}` does not run here", name.text),
                format!("write `with {}` behind the test's text", name.text),
            )),
            _ => None,
        };
        match refusal {
            Some((message, help)) => {
                let diagnostic = Diagnostic::new(Rule::UnknownGraph, name.span, message).help(help);
                self.report(diagnostic);
                None
            }
            None => Some(graph),
        }
    }

    /// Whether what was found may be named from here: a plant sees the machine's side of the terminals only.
    fn admit(&mut self, found: Found, span: Span, view: View) -> bool {
        let View::Plant(home) = view else {
            return true;
        };
        let what = match found {
            Found::System(_) => return true,
            Found::Step(id) if self.model[id].graph == home => return true,
            Found::Macro(id) if self.model[id].graph == home => return true,
            Found::Step(_) | Found::Macro(_) => "a step of a graph",
            Found::Variable(id) => {
                let variable = &self.model[id];
                match variable.kind {
                    DeclarationKind::Variable { .. } if variable.owner != Some(home) => {
                        "an internal variable of the application"
                    }
                    _ => return true,
                }
            }
        };
        let diagnostic = Diagnostic::new(
            Rule::UnknownName,
            span,
            format!("a plant cannot see {what}: it stands in for the machine"),
        )
        .help("a plant reads outputs, inputs, parameters and constants");
        self.report(diagnostic);
        false
    }
}

/// The step identifier in a step bit: `3` in `X3`, `M5` in `XM5`.
pub(super) fn step_of(name: &str) -> Option<&str> {
    let id = name.strip_prefix('X')?;
    let digits = id
        .strip_prefix(|c: char| c.is_ascii_uppercase())
        .unwrap_or(id);
    let is_number = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    is_number.then_some(id)
}
