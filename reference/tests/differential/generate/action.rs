//! Random statements.

use super::Generator;
use super::expression::{Expressions, Names, subset};
use super::outline::{Kind, Mode, Outline, Variable};
use crate::program::{Event, Expression, Situation, Statement, Type};

/// A variable that a statement may write, by the name it has there.
struct Target {
    name: String,
    ty: Type,
    mode: Mode,
    range: Option<(i32, i32)>,
    /// Constants may be stored in it.
    literals: bool,
}

impl Generator<'_> {
    pub fn expressions<'g>(&'g mut self, names: &'g Names) -> Expressions<'g> {
        Expressions {
            random: self.random,
            names,
            rank: None,
        }
    }

    /// The action of a step.
    pub fn step_action(&mut self, graph: usize, names: &Names) -> Vec<Statement> {
        let count = self.random.below(4);
        let mut statements: Vec<Statement> = (0..count)
            .filter_map(|_| self.step_statement(graph, names))
            .collect();
        if !statements.is_empty() && self.random.chance(5) {
            statements.push(Statement::Text("what it is for"));
        }
        statements
    }

    fn step_statement(&mut self, graph: usize, names: &Names) -> Option<Statement> {
        match self.random.below(100) {
            0..35 => self.momentary(graph, names),
            35..60 => self.stored(graph, names, true),
            60..72 => self.on(graph, names, Event::Activation),
            72..80 => self.on(graph, names, Event::Deactivation),
            80..90 if self.features.events => {
                let event = self.event(names);
                self.on(graph, names, Event::Expression(event))
            }
            90..100 => self.force(graph, names),
            _ => None,
        }
    }

    /// A stand-alone action.
    pub fn alone(&mut self, graph: usize, names: &Names) -> Vec<Statement> {
        let count = self.random.between(1, 3);
        let statements = (0..count).filter_map(|_| match self.random.below(100) {
            0..35 => self.momentary(graph, names),
            35..65 => self.stored(graph, names, true),
            65..80 => self.force_itself(graph, names),
            _ => self.force(graph, names),
        });
        statements.collect()
    }

    /// Statements of a `do` block.
    pub fn done(&mut self, graph: usize, names: &Names) -> Vec<Statement> {
        let count = self.random.between(1, 2);
        (0..count)
            .filter_map(|_| self.stored(graph, names, false))
            .collect()
    }

    fn on(&mut self, graph: usize, names: &Names, event: Event) -> Option<Statement> {
        let count = self.random.between(1, 2);
        let statements: Vec<Statement> = (0..count)
            .filter_map(|_| self.stored(graph, names, false))
            .collect();
        (!statements.is_empty()).then_some(Statement::On { event, statements })
    }

    /// An event, in which an edge occurs.
    fn event(&mut self, names: &Names) -> Expression {
        let depth = self.random.below(2);
        let edge = self.expressions(names).edge(depth);
        match self.random.below(5) {
            0 => Expression::binary("AND", edge, self.expressions(names).boolean(2)),
            1 => Expression::binary("AND", edge, self.expressions(names).comparison(2)),
            2 => Expression::binary("OR", edge, self.expressions(names).edge(0)),
            _ => edge,
        }
    }

    fn momentary(&mut self, graph: usize, names: &Names) -> Option<Statement> {
        let targets = self.targets(graph, |mode| matches!(mode, Mode::Momentary(_)));
        if targets.is_empty() {
            return None;
        }
        let count = self.random.between(1, 2);
        let chosen: Vec<&Target> = (0..count).map(|_| self.random.pick(&targets)).collect();
        let rank = chosen.iter().map(|target| match target.mode {
            Mode::Momentary(rank) => rank,
            _ => 0,
        });
        let rank = rank.min();
        let mut names_of_targets: Vec<String> = chosen.iter().map(|t| t.name.clone()).collect();
        names_of_targets.dedup();
        let condition = self.random.chance(65).then(|| {
            let depth = self.random.between(0, 3);
            let mut expressions = self.expressions(names);
            expressions.rank = rank;
            expressions.boolean(depth)
        });
        Some(Statement::Momentary {
            targets: names_of_targets,
            condition,
        })
    }

    fn stored(
        &mut self,
        graph: usize,
        names: &Names,
        mostly_conditional: bool,
    ) -> Option<Statement> {
        let targets = self.targets(graph, |mode| mode == Mode::Stored);
        if targets.is_empty() {
            return None;
        }
        let target = self.random.pick(&targets);
        let depth = self.random.between(0, 3);
        let value = match (target.ty, target.range) {
            (Type::Bool, _) => self.expressions(names).boolean(depth),
            (Type::Int, _) if self.random.chance(40) => Expression::binary(
                self.random.word(&["+", "-"]),
                Expression::leaf(&target.name),
                Expression::leaf("1"),
            ),
            // Constants have to be in the range of what they are stored in.
            (Type::Int, Some((low, _))) => {
                let operator = self.random.word(&["+", "-", "*", "MOD", "/"]);
                let value = self.expressions(names).integer(depth);
                match self.random.below(4) {
                    0 if target.literals => Expression::leaf(if low < 0 {
                        format!("({low})")
                    } else {
                        low.to_string()
                    }),
                    _ => Expression::binary(operator, Expression::leaf(&target.name), value),
                }
            }
            (Type::Int, None) => self.expressions(names).integer(depth),
            (Type::Time, Some(_)) => {
                let value = self.expressions(names).time(depth);
                Expression::binary(
                    self.random.word(&["+", "-"]),
                    Expression::leaf(&target.name),
                    value,
                )
            }
            (Type::Time, None) => self.expressions(names).time(depth),
        };
        let percent = if mostly_conditional { 70 } else { 30 };
        let condition = self.random.chance(percent).then(|| {
            let depth = self.random.between(0, 3);
            self.expressions(names).boolean(depth)
        });
        Some(Statement::Stored {
            target: target.name.clone(),
            value,
            condition,
        })
    }

    fn force(&mut self, graph: usize, names: &Names) -> Option<Statement> {
        let level = self.outlines[graph].level;
        let lower: Vec<Outline> = self
            .outlines
            .iter()
            .filter(|lower| lower.kind != Kind::Template && lower.level > level)
            .cloned()
            .collect();
        if !self.features.forcing || lower.is_empty() || self.outlines[graph].kind != Kind::Written
        {
            return None;
        }
        let lower = self.random.pick(&lower).clone();
        Some(self.order(&lower, names))
    }

    fn force_itself(&mut self, graph: usize, names: &Names) -> Option<Statement> {
        if !self.features.forcing {
            return None;
        }
        let itself = self.outlines[graph].clone();
        Some(self.order(&itself, names))
    }

    /// An order on a graph; seldom an unconditional one, which would let nothing else happen.
    fn order(&mut self, on: &Outline, names: &Names) -> Statement {
        let situation = match self.random.below(10) {
            0..2 => Situation::Initial,
            2..5 => Situation::Current,
            5 => Situation::Steps(Vec::new()),
            _ => Situation::Steps(subset(self.random, &on.steps, 3)),
        };
        let seldom = Expression::binary("AND", Expression::leaf("a"), Expression::leaf("b"));
        let mut expressions = self.expressions(names);
        let condition = match expressions.random.below(20) {
            0 => None,
            1..10 => Some(expressions.edge(1)),
            10..14 => Some(seldom),
            14..18 => Some(Expression::binary("AND", seldom, expressions.boolean(2))),
            _ => Some(expressions.boolean(2)),
        };
        Statement::Force {
            graph: on.name.clone(),
            situation,
            condition,
        }
    }

    /// What statements of a graph may write: what is its own, what is the application's, and what is a neighbour's.
    fn targets(&self, graph: usize, suits: impl Fn(Mode) -> bool) -> Vec<Target> {
        let own = &self.outlines[graph];
        let target = |name: String, variable: &Variable| {
            // A word holds 16 bits; what an instance binds to an output of its template holds nobody knows what.
            let unknown = own.kind == Kind::Template && variable.kind == "output";
            let narrow = unknown || variable.address.is_some();
            Target {
                name,
                ty: variable.ty,
                mode: variable.mode,
                range: variable.range.or(narrow.then_some((-32_768, 32_767))),
                literals: !unknown,
            }
        };
        let mine = own.variables.iter().map(|v| target(v.name.clone(), v));
        // A template's statements are its instances' too: what they write of the application has to suit them all.
        let rank_0 =
            |v: &Variable| own.kind == Kind::Written || !matches!(v.mode, Mode::Momentary(_));
        let globals = self
            .globals
            .iter()
            .filter(|v| rank_0(v) && !own.variables.iter().any(|mine| mine.name == v.name));
        let globals = globals.map(|v| target(v.name.clone(), v));
        let others = self.outlines.iter();
        let others = others.filter(|o| o.kind != Kind::Template && o.name != own.name);
        let neighbours = others.flat_map(|o| {
            let theirs = o.variables.iter().filter(|v| v.kind == "var" && rank_0(v));
            theirs
                .take(1)
                .map(|v| target(format!("{}:{}", o.name, v.name), v))
        });
        mine.chain(globals)
            .chain(neighbours)
            .filter(|t| suits(t.mode))
            .collect()
    }
}
