//! Random graphs: structures that stay alive, and triggers that become True.

use super::Generator;
use super::expression::{Names, subset};
use super::outline::{Expansion, Kind, Mode, Outline, Variable};
use crate::program::{
    Binding, Element, Expression, Graph, Role, Situation, Statement, Step, Transition, Type,
};

impl Generator<'_> {
    /// The graph, template or instance with that index.
    pub fn graph(&mut self, index: usize) -> Graph {
        let outline = self.outlines[index].clone();
        match outline.kind {
            Kind::Instance(template) => Graph {
                name: outline.name.clone(),
                role: Role::Instance {
                    template: self.outlines[template].name.clone(),
                    bindings: self.bindings(&outline),
                },
                declarations: Vec::new(),
                elements: Vec::new(),
            },
            kind => {
                let names = self.names(Some(index));
                let mut elements = self.elements(index, &outline, &names);
                if index == 0 {
                    elements.push(Element::Always(vec![count_faults()]));
                }
                self.random.shuffle(&mut elements);
                Graph {
                    name: outline.name.clone(),
                    role: if kind == Kind::Template {
                        Role::Template
                    } else {
                        Role::Written
                    },
                    declarations: outline
                        .variables
                        .iter()
                        .map(Variable::declaration)
                        .collect(),
                    elements,
                }
            }
        }
    }

    fn elements(&mut self, index: usize, outline: &Outline, names: &Names) -> Vec<Element> {
        let mut elements = Vec::new();
        let outside: Vec<String> = outline
            .steps
            .iter()
            .filter(|id| outline.nodes.contains(id))
            .cloned()
            .collect();
        let first = self.random.pick(&outside).clone();
        for id in &outside {
            let initial = if *id == first { 94 } else { 12 };
            let initial = self.random.chance(initial);
            elements.push(Element::Step(self.step(index, id, "", initial, names)));
        }
        let mut number = 0;
        for expansion in &outline.macros {
            let element = self.macro_step(index, expansion, names, &mut number);
            elements.push(element);
        }
        for (entrance, exit) in self.arrows(&outline.nodes) {
            let transition = self.transition(index, &mut number, entrance, exit, names);
            elements.push(transition);
        }
        if self.random.chance(50) {
            let transition = self.revival(index, &mut number, &first, names);
            elements.push(transition);
        }
        for _ in 0..self.random.below(3) {
            let statements = self.alone(index, names);
            if !statements.is_empty() {
                elements.push(Element::Always(statements));
            }
        }
        elements
    }

    fn step(
        &mut self,
        index: usize,
        id: &str,
        role: &'static str,
        initial: bool,
        names: &Names,
    ) -> Step {
        let enclosed = self.outlines.clone();
        let enclosed = enclosed.iter().filter(|lower| {
            lower
                .enclosed_by
                .iter()
                .any(|(by, step)| *by == index && step == id)
        });
        let encloses = enclosed
            .map(|lower| (lower.name.clone(), subset(self.random, &lower.steps, 3)))
            .collect();
        Step {
            initial,
            role,
            id: id.to_owned(),
            encloses,
            statements: self.step_action(index, names),
        }
    }

    /// A macro step whose expansion goes from its entry through all that is inside to its exit.
    fn macro_step(
        &mut self,
        index: usize,
        expansion: &Expansion,
        names: &Names,
        number: &mut usize,
    ) -> Element {
        let mut elements = vec![Element::Step(self.step(
            index,
            &expansion.entry,
            "entry",
            false,
            names,
        ))];
        let mut chain = vec![expansion.entry.clone()];
        for id in &expansion.between {
            let initial = self.random.chance(8);
            elements.push(Element::Step(self.step(index, id, "", initial, names)));
            chain.push(id.clone());
        }
        if let Some(inner) = &expansion.inner {
            elements.push(self.macro_step(index, inner, names, number));
            chain.push(inner.id.clone());
        }
        elements.push(Element::Step(self.step(
            index,
            &expansion.exit,
            "exit",
            false,
            names,
        )));
        chain.push(expansion.exit.clone());
        for pair in chain.windows(2) {
            let (from, to) = (vec![pair[0].clone()], vec![pair[1].clone()]);
            elements.push(self.transition(index, number, from, to, names));
        }
        Element::Macro(expansion.id.clone(), elements)
    }

    /// Which steps the transitions leave and enter: a ring through all of them, and more.
    fn arrows(&mut self, nodes: &[String]) -> Vec<(Vec<String>, Vec<String>)> {
        let mut ring = nodes.to_vec();
        self.random.shuffle(&mut ring);
        let mut arrows = Vec::new();
        for (at, from) in ring.iter().enumerate() {
            let to = &ring[(at + 1) % ring.len()];
            let mut exit = vec![to.clone()];
            if self.random.chance(15) {
                exit.push(self.random.pick(nodes).clone());
            }
            arrows.push((vec![from.clone()], exit));
        }
        for _ in 0..self.random.below(4) {
            let some = |random: &mut crate::random::Random, most| subset(random, nodes, most);
            let one = vec![self.random.pick(nodes).clone()];
            arrows.push(match self.random.below(10) {
                // Source and sink transitions.
                0 => (Vec::new(), one),
                1 => (one, Vec::new()),
                // A self-loop.
                2 => (one.clone(), one),
                // AND divergence and convergence.
                3..6 => (one, some(self.random, 3)),
                6 => (some(self.random, 2), one),
                // An OR divergence.
                _ => (one, vec![self.random.pick(nodes).clone()]),
            });
        }
        for (entrance, exit) in &mut arrows {
            for steps in [entrance, exit] {
                steps.sort_unstable();
                steps.dedup();
            }
        }
        arrows.retain(|(entrance, exit)| !entrance.is_empty() || !exit.is_empty());
        arrows
    }

    /// A source transition for a graph that has lost its last step.
    fn revival(&mut self, index: usize, number: &mut usize, step: &str, names: &Names) -> Element {
        let empty = Expression::Situation(
            self.outlines[index].name.clone(),
            true,
            Situation::Steps(Vec::new()),
        );
        let input = Expression::leaf(self.random.word(&["a", "b", "c", "d"]));
        let element = self.transition(index, number, Vec::new(), vec![step.to_owned()], names);
        match element {
            Element::Transition(transition) => Element::Transition(Transition {
                trigger: Some(Expression::binary("AND", empty, input)),
                ..transition
            }),
            other => other,
        }
    }

    fn transition(
        &mut self,
        index: usize,
        number: &mut usize,
        entrance: Vec<String>,
        exit: Vec<String>,
        names: &Names,
    ) -> Element {
        *number += 1;
        let trigger = self.trigger(&entrance, names);
        let action = if self.random.chance(25) {
            self.done(index, names)
        } else {
            Vec::new()
        };
        Element::Transition(Transition {
            number: *number,
            entrance,
            exit,
            trigger,
            action,
        })
    }

    /// A trigger that has a good chance to become True.
    fn trigger(&mut self, entrance: &[String], names: &Names) -> Option<Expression> {
        let inputs = ["a", "b", "c", "d"];
        let input = Expression::leaf(self.random.word(&inputs));
        match self.random.below(100) {
            0..10 => None,
            10..12 => Some(Expression::leaf(self.random.word(&["True", "TRUE"]))),
            12..36 => Some(input),
            36..46 => Some(Expression::unary("↑", input)),
            46..54 => Some(Expression::unary("NOT", input)),
            54..70 if !entrance.is_empty() => {
                let enable = Expression::leaf(format!("X{}", self.random.pick(entrance)));
                let preset = self.random.word(&["10ms", "20ms", "30ms", "LAP", "delay"]);
                Some(Expression::Timer(
                    Box::new(enable),
                    Box::new(Expression::leaf(preset)),
                ))
            }
            70..93 => Some(Expression::binary(
                self.random.word(&["OR", "XOR"]),
                input,
                self.expressions(names).boolean(2),
            )),
            _ => {
                let depth = self.random.between(1, 3);
                Some(self.expressions(names).boolean(depth))
            }
        }
    }

    fn bindings(&mut self, instance: &Outline) -> Vec<Binding> {
        let names = self.names(None);
        let mut bindings = Vec::new();
        let number = if instance.name == "Saw1" { 1 } else { 2 };
        for variable in instance.interface() {
            let name = variable.name.clone();
            let target = self.binding_target(variable);
            let expression = match (variable.kind, variable.ty) {
                ("input", _) if self.random.chance(20) => {
                    let address = match variable.ty {
                        Type::Bool => format!("%IX9.{number}"),
                        _ => format!("%IW{}", 10 + 2 * number),
                    };
                    bindings.push(Binding::Address(name, address));
                    continue;
                }
                // What is bound reads no momentary variable: the template's outputs have the lowest rank.
                ("input", Type::Bool) if self.random.chance(35) => {
                    Expression::leaf(self.random.pick(&names.bits))
                }
                ("input", Type::Bool) => {
                    let mut expressions = self.expressions(&names);
                    expressions.rank = Some(0);
                    expressions.boolean(2)
                }
                // No constant, which could be too long for a preset.
                ("input", _) => {
                    let added = self.expressions(&names).integer(1);
                    Expression::binary("+", Expression::leaf("level"), added)
                }
                ("output", _) => match target {
                    Some(target) if self.random.chance(70) => Expression::leaf(target),
                    _ => {
                        let address = match variable.ty {
                            Type::Bool => format!("%QX9.{number}"),
                            _ => format!("%QW{}", 10 + 2 * number),
                        };
                        bindings.push(Binding::Address(name, address));
                        continue;
                    }
                },
                _ if self.random.chance(50) => continue,
                _ => {
                    let (low, _) = variable.range.unwrap_or((30, 30));
                    Expression::leaf(crate::render::Ms(low).to_string())
                }
            };
            bindings.push(Binding::Expression(name, expression));
        }
        bindings
    }

    /// A variable of the application that is written as this output is.
    fn binding_target(&mut self, output: &Variable) -> Option<String> {
        let momentary = |mode| matches!(mode, Mode::Momentary(_));
        let alike = |v: &&Variable| {
            v.ty == output.ty
                && matches!(v.kind, "output" | "var")
                && v.mode != Mode::Faults
                && momentary(v.mode) == momentary(output.mode)
        };
        let globals = self.globals.iter().filter(alike).map(|v| v.name.clone());
        let written = self.outlines.iter().filter(|o| o.kind == Kind::Written);
        let own = written.flat_map(|o| {
            let alike = o.variables.iter().filter(alike);
            alike.map(|v| format!("{}:{}", o.name, v.name))
        });
        let alike: Vec<String> = globals.chain(own).collect();
        (!alike.is_empty()).then(|| self.random.pick(&alike).clone())
    }
}

/// The only place that reads the count of faults, so that its moment in the scan is well defined.
fn count_faults() -> Statement {
    Statement::Stored {
        target: "faults".to_owned(),
        value: Expression::leaf("System:arithmetic_faults"),
        condition: None,
    }
}
