//! Looks over the syntax tree of a program.

use grafcet_compiler::ast::{
    BindingTarget, Block, Constant, Declaration, Element, Event, Expression, ExpressionKind, File,
    Graph, Instance, Item, ScanOption, Situation, Statement, StatementKind, Step, Transition,
    Trigger,
};
use grafcet_compiler::parse;
use grafcet_compiler::source::FileId;

use crate::Seen;
use crate::kinds::Kind;

/// What is not a variant of its own in the tree, but of `language.md`'s structure.
pub const FEATURES: &[&str] = &[
    "import",
    "application text",
    "several names",
    "address",
    "initial value",
    "range",
    "text of a declaration",
    "text of a graph",
    "text of a step",
    "text of a transition",
    "text of a stand-alone action",
    "text of a macro step",
    "initial step",
    "step without a block",
    "encloses",
    "encloses several",
    "initial step encloses",
    "nested macro step",
    "source transition",
    "sink transition",
    "self-loop",
    "several entrance steps",
    "several exit steps",
    "do",
    "several variables",
    "name of another graph",
    "System:",
    "{}",
    "F/{}",
    "F/{I}",
    "F/{*}",
    "F/{1}",
    "self-forcing",
    "instance without a block",
];

/// What has no part in an image: claims and machines, what only people can carry out, and what nobody can read.
pub const NOT_IN_AN_IMAGE: &[&str] = &[
    "plant",
    "property",
    "test",
    "trigger of level 1",
    "unreadable",
];

/// Looks over a text that is known to be well-formed.
pub fn look(text: &str, seen: &mut Seen) {
    let mut found = Vec::new();
    let file = parse(FileId(0), text, &mut found);
    assert!(found.is_empty(), "{found:?}");
    Look {
        seen,
        graph: String::new(),
    }
    .file(&file);
}

struct Look<'a> {
    seen: &'a mut Seen,
    /// The graph that is looked over.
    graph: String,
}

impl Look<'_> {
    fn note(&mut self, name: &'static str, occurs: bool) {
        if occurs {
            self.seen.insert(name);
        }
    }

    fn kind(&mut self, kind: &impl Kind) {
        self.seen.insert(kind.name());
    }

    fn file(&mut self, file: &File) {
        self.note("import", !file.imports.is_empty());
        let text = file
            .application
            .as_ref()
            .and_then(|(_, text)| text.as_ref());
        self.note("application text", text.is_some());
        for option in &file.options {
            self.kind(option);
            if let ScanOption::Period(period) = option {
                self.constant(period);
            }
        }
        for item in &file.items {
            self.kind(item);
            match item {
                Item::Declaration(declaration) => self.declaration(declaration),
                Item::Graph(graph) | Item::Template(graph) => self.graph(graph),
                Item::Instance(instance) => self.instance(instance),
                Item::Plant(_) | Item::Property(_) | Item::Test(_) => {}
            }
        }
    }

    fn declaration(&mut self, declaration: &Declaration) {
        self.kind(&declaration.kind);
        if let Some((ty, _)) = &declaration.ty {
            self.kind(ty);
        }
        self.note("several names", declaration.names.len() > 1);
        self.note("address", declaration.address.is_some());
        self.note("initial value", declaration.initial.is_some());
        self.note("range", declaration.range.is_some());
        self.note("text of a declaration", declaration.text.is_some());
        let range = declaration.range.iter().flat_map(|(low, high)| [low, high]);
        for constant in declaration.initial.iter().chain(range) {
            self.constant(constant);
        }
    }

    fn constant(&mut self, constant: &Constant) {
        self.kind(&constant.kind);
    }

    fn instance(&mut self, instance: &Instance) {
        self.note("instance without a block", instance.bindings.is_empty());
        for binding in &instance.bindings {
            self.kind(&binding.to);
            if let BindingTarget::Expression(value) = &binding.to {
                self.expression(value);
            }
        }
    }

    fn graph(&mut self, graph: &Graph) {
        self.graph.clone_from(&graph.name.text);
        self.note("text of a graph", graph.text.is_some());
        self.elements(&graph.elements, false);
    }

    fn elements(&mut self, elements: &[Element], in_a_macro: bool) {
        for element in elements {
            self.kind(element);
            match element {
                Element::Declaration(declaration) => self.declaration(declaration),
                Element::Always(always) => {
                    self.note("text of a stand-alone action", always.text.is_some());
                    self.block(&always.block);
                }
                Element::Step(step) => self.step(step),
                Element::Macro(it) => {
                    self.note("text of a macro step", it.text.is_some());
                    self.note("nested macro step", in_a_macro);
                    self.elements(&it.elements, true);
                }
                Element::Transition(transition) => self.transition(transition),
            }
        }
    }

    fn step(&mut self, step: &Step) {
        self.kind(&step.role);
        self.note("initial step", step.initial);
        self.note("text of a step", step.text.is_some());
        self.note("step without a block", step.block.is_none());
        self.note("encloses", !step.encloses.is_empty());
        self.note("encloses several", step.encloses.len() > 1);
        self.note(
            "initial step encloses",
            step.initial && !step.encloses.is_empty(),
        );
        step.block.iter().for_each(|block| self.block(block));
    }

    fn transition(&mut self, transition: &Transition) {
        let (entrance, exit) = (&transition.entrance, &transition.exit);
        self.note("text of a transition", transition.text.is_some());
        self.note("source transition", entrance.is_empty());
        self.note("sink transition", exit.is_empty());
        self.note("several entrance steps", entrance.len() > 1);
        self.note("several exit steps", exit.len() > 1);
        let stays = entrance
            .iter()
            .any(|step| exit.iter().any(|it| it.text == step.text));
        self.note("self-loop", stays);
        self.note("do", transition.action.is_some());
        self.kind(&transition.trigger);
        if let Trigger::Expression(expression) = &transition.trigger {
            self.expression(expression);
        }
        transition.action.iter().for_each(|block| self.block(block));
    }

    fn block(&mut self, block: &Block) {
        block.statements.iter().for_each(|it| self.statement(it));
    }

    fn statement(&mut self, statement: &Statement) {
        self.kind(&statement.kind);
        match &statement.kind {
            StatementKind::Momentary { targets, condition } => {
                self.note("several variables", targets.len() > 1);
                condition.iter().for_each(|it| self.expression(it));
            }
            StatementKind::Stored {
                value, condition, ..
            } => {
                self.expression(value);
                condition.iter().for_each(|it| self.expression(it));
            }
            StatementKind::On { event, statements } => {
                self.kind(event);
                if let Event::Expression(event) = event {
                    self.expression(event);
                }
                statements.iter().for_each(|it| self.statement(it));
            }
            StatementKind::Force {
                graph,
                situation,
                condition,
            } => {
                let itself = graph.text == self.graph;
                self.note("self-forcing", itself);
                self.situation(situation);
                let order = match situation {
                    Situation::Steps(set) if set.steps.is_empty() => "F/{}",
                    Situation::Steps(_) => "F/{1}",
                    Situation::Initial(_) => "F/{I}",
                    Situation::Current(_) => "F/{*}",
                };
                self.note(order, true);
                condition.iter().for_each(|it| self.expression(it));
            }
            StatementKind::Text(_) => {}
        }
    }

    fn situation(&mut self, situation: &Situation) {
        self.kind(situation);
        if let Situation::Steps(set) = situation {
            self.note("{}", set.steps.is_empty());
        }
    }

    fn expression(&mut self, expression: &Expression) {
        self.kind(&expression.kind);
        match &expression.kind {
            ExpressionKind::Bool(_)
            | ExpressionKind::Integer(_)
            | ExpressionKind::Duration(_)
            | ExpressionKind::Unreadable => {}
            ExpressionKind::Ref(name) => {
                let graph = name.graph.as_ref().map(|graph| graph.text.as_str());
                self.note("System:", graph == Some("System"));
                self.note(
                    "name of another graph",
                    graph.is_some_and(|it| it != "System"),
                );
            }
            ExpressionKind::Situation { situation, .. } => self.situation(situation),
            ExpressionKind::Timer { enable, preset } => {
                self.expression(enable);
                self.expression(preset);
            }
            ExpressionKind::Delay { on, enable, off } => {
                self.expression(on);
                self.expression(enable);
                off.iter().for_each(|it| self.expression(it));
            }
            ExpressionKind::Unary { operator, operand } => {
                self.kind(operator);
                self.expression(operand);
            }
            ExpressionKind::Binary {
                operator,
                left,
                right,
                ..
            } => {
                self.kind(operator);
                self.expression(left);
                self.expression(right);
            }
        }
    }
}
