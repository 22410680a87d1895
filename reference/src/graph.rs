//! A graph as sets and lists: its instance made, its macro steps opened.

use std::collections::{BTreeMap, BTreeSet};

use grafcet_compiler::ast::{
    BindingTarget, Block, Declaration, Element, Graph as Tree, Instance, Macro, Situation,
    Statement, StatementKind, Step, StepRole, Transition,
};

/// A graph.
#[derive(Debug, Default)]
pub struct Graph<'a> {
    pub name: &'a str,
    /// The template's own name, which means the instance inside it.
    pub template: Option<&'a str>,
    /// The steps in source order, those of expansions among them.
    pub steps: Vec<&'a Step>,
    pub macros: BTreeMap<&'a str, Expansion<'a>>,
    /// The transitions in source order, those of expansions among them.
    pub transitions: Vec<&'a Transition>,
    pub bindings: BTreeMap<&'a str, &'a BindingTarget>,
    pub declarations: Vec<&'a Declaration>,
    /// The statements of its stand-alone actions and steps with their owners, in source order.
    pub statements: Vec<(Owner<'a>, &'a Statement)>,
}

/// What is inside a macro step.
#[derive(Debug, Default)]
pub struct Expansion<'a> {
    pub entry: &'a str,
    pub exit: &'a str,
    /// All its steps, those of inner macro steps too.
    pub steps: BTreeSet<&'a str>,
}

/// Who executes an action: a step while it is active, or nobody: it stands alone.
pub type Owner<'a> = Option<&'a str>;

impl<'a> Graph<'a> {
    /// A graph that is written out.
    pub fn of(tree: &'a Tree) -> Self {
        let mut graph = Graph {
            name: &tree.name.text,
            ..Graph::default()
        };
        graph.open(&tree.elements, &[]);
        graph
            .statements
            .sort_by_key(|(_, statement)| statement.span.start);
        graph
    }

    /// A graph that is made from a template.
    pub fn instance(instance: &'a Instance, template: &'a Tree) -> Self {
        let bindings = instance.bindings.iter();
        Graph {
            name: &instance.name.text,
            template: Some(&template.name.text),
            bindings: bindings.map(|b| (b.name.text.as_str(), &b.to)).collect(),
            ..Graph::of(template)
        }
    }

    /// The situation that a set names; none for `{*}`.
    pub fn named_situation(&self, situation: &'a Situation) -> Option<BTreeSet<&'a str>> {
        match situation {
            Situation::Steps(set) => Some(set.steps.iter().map(|id| id.text.as_str()).collect()),
            Situation::Initial(_) => Some(self.initial_steps()),
            Situation::Current(_) => None,
        }
    }

    /// The steps declared `initial`.
    pub fn initial_steps(&self) -> BTreeSet<&'a str> {
        let initial = self.steps.iter().filter(|step| step.initial);
        initial.map(|step| step.id.text.as_str()).collect()
    }

    /// The steps that must be active for a transition: a macro step is left from its exit step.
    pub fn entrance_steps(&self, transition: &'a Transition) -> BTreeSet<&'a str> {
        let ids = transition.entrance.iter().map(|id| id.text.as_str());
        ids.map(|id| self.macros.get(id).map_or(id, |expansion| expansion.exit))
            .collect()
    }

    /// The steps that a transition activates: a macro step is entered at its entry step.
    pub fn exit_steps(&self, transition: &'a Transition) -> BTreeSet<&'a str> {
        let ids = transition.exit.iter().map(|id| id.text.as_str());
        ids.map(|id| self.macros.get(id).map_or(id, |expansion| expansion.entry))
            .collect()
    }

    /// Whether one of its statements forces a graph that `is_it` recognises.
    pub fn forces(&self, is_it: impl Fn(&str) -> bool) -> bool {
        self.statements.iter().any(|(_, statement)| {
            matches!(&statement.kind, StatementKind::Force { graph, .. } if is_it(&graph.text))
        })
    }

    /// Takes the elements of a graph, or of an expansion inside all these macro steps.
    fn open(&mut self, elements: &'a [Element], around: &[&'a str]) {
        for element in elements {
            match element {
                Element::Declaration(declaration) => self.declarations.push(declaration),
                Element::Always(always) => self.act(None, Some(&always.block)),
                Element::Transition(transition) => self.transitions.push(transition),
                Element::Step(step) => self.step(step, around),
                Element::Macro(inner) => self.expansion(inner, around),
            }
        }
    }

    fn step(&mut self, step: &'a Step, around: &[&'a str]) {
        self.steps.push(step);
        self.act(Some(&step.id.text), step.block.as_ref());
        for outer in around {
            self.macros
                .entry(outer)
                .or_default()
                .steps
                .insert(&step.id.text);
        }
        if let Some(innermost) = around.last() {
            let expansion = self.macros.entry(innermost).or_default();
            match step.role {
                StepRole::Entry => expansion.entry = &step.id.text,
                StepRole::Exit => expansion.exit = &step.id.text,
                StepRole::Plain => {}
            }
        }
    }

    fn act(&mut self, owner: Owner<'a>, block: Option<&'a Block>) {
        let statements = block.iter().flat_map(|block| &block.statements);
        self.statements
            .extend(statements.map(|statement| (owner, statement)));
    }

    fn expansion(&mut self, inner: &'a Macro, around: &[&'a str]) {
        let mut around = around.to_vec();
        around.push(&inner.id.text);
        self.open(&inner.elements, &around);
    }
}
