//! Random expressions of the right type.

use crate::program::{Expression, Situation};
use crate::random::Random;

/// What an expression may name where it stands.
#[derive(Clone, Debug, Default)]
pub struct Names {
    /// Booleans; a momentary variable with its rank among them.
    pub bools: Vec<(String, Option<usize>)>,
    pub ints: Vec<String>,
    pub times: Vec<String>,
    /// Bits of steps and macro steps.
    pub bits: Vec<String>,
    /// Graphs with their steps.
    pub graphs: Vec<(String, Vec<String>)>,
}

/// Makes expressions.
pub struct Expressions<'g> {
    pub random: &'g mut Random,
    pub names: &'g Names,
    /// Outside edges and timers, only momentary variables of a lower rank may be read, so that they never depend on
    /// each other in a ring. None: all of them may.
    pub rank: Option<usize>,
}

const INTEGERS: [&str; 12] = [
    "0",
    "1",
    "2",
    "3",
    "5",
    "7",
    "10",
    "100",
    "(-1)",
    "(-3)",
    "2147483647",
    "(-2147483648)",
];
const DURATIONS: [&str; 9] = [
    "0ms", "10ms", "15ms", "T#20ms", "30ms", "50ms", "0.1s", "1h", "0.02 s",
];

impl Expressions<'_> {
    /// A Boolean, at most so many operators deep.
    pub fn boolean(&mut self, depth: usize) -> Expression {
        if depth == 0 {
            return self.boolean_leaf();
        }
        match self.random.below(100) {
            0..15 => self.boolean_leaf(),
            15..27 => {
                let operand = self.boolean(depth - 1);
                Expression::unary(self.random.word(&["NOT", "!", "¬"]), operand)
            }
            27..52 => {
                let operator = self
                    .random
                    .word(&["AND", "&", "·", "OR", "|", "XOR", "=", "<>"]);
                let left = self.boolean(depth - 1);
                let right = self.boolean(depth - 1);
                Expression::binary(operator, left, right)
            }
            52..62 => self.comparison(depth - 1),
            62..77 => self.edge(depth - 1),
            77..88 => self.timer(depth - 1),
            88..95 => self.delay(depth - 1),
            _ => self.situation(),
        }
    }

    /// An edge.
    pub fn edge(&mut self, depth: usize) -> Expression {
        let operator = self.random.word(&["↑", "↓", "RE", "FE", "↑"]);
        let operand = self.watched(|inside| inside.boolean(depth));
        Expression::unary(operator, operand)
    }

    /// A number.
    pub fn integer(&mut self, depth: usize) -> Expression {
        if depth == 0 || self.random.chance(25) {
            return self.integer_leaf();
        }
        if self.random.chance(12) {
            return Expression::unary("-", self.integer(depth - 1));
        }
        let operator = self.random.word(&["+", "-", "*", "/", "MOD"]);
        let left = self.integer(depth - 1);
        let right = self.integer(depth - 1);
        Expression::binary(operator, left, right)
    }

    /// A duration.
    pub fn time(&mut self, depth: usize) -> Expression {
        if depth == 0 || self.random.chance(30) {
            return self.time_leaf();
        }
        match self.random.below(5) {
            0 => Expression::binary("+", self.time(depth - 1), self.time(depth - 1)),
            1 => Expression::binary("-", self.time(depth - 1), self.time(depth - 1)),
            2 => Expression::binary("*", self.time(depth - 1), self.integer(depth - 1)),
            3 => Expression::binary("*", self.integer(depth - 1), self.time(depth - 1)),
            _ => Expression::binary("/", self.time(depth - 1), self.integer(depth - 1)),
        }
    }

    /// A name or a short preset; a fast one, so that transitions fire.
    fn preset(&mut self) -> Expression {
        match self.random.below(10) {
            0..5 => Expression::leaf(self.random.word(&["0ms", "10ms", "20ms", "25ms", "40ms"])),
            5 => Expression::leaf(self.random.word(&["0", "1"])),
            6 if !self.names.ints.is_empty() => {
                Expression::leaf(self.random.pick(&self.names.ints))
            }
            6..8 if !self.names.times.is_empty() => {
                Expression::leaf(self.random.pick(&self.names.times))
            }
            8 => Expression::binary("+", self.time_leaf(), self.time_leaf()),
            _ => Expression::leaf(self.random.word(&DURATIONS)),
        }
    }

    pub fn timer(&mut self, depth: usize) -> Expression {
        self.watched(|inside| {
            let enable = inside.enable(depth);
            Expression::Timer(Box::new(enable), Box::new(inside.preset()))
        })
    }

    fn delay(&mut self, depth: usize) -> Expression {
        self.watched(|inside| {
            let on = inside.time_leaf();
            let enable = inside.enable(depth);
            let off = inside
                .random
                .chance(50)
                .then(|| Box::new(inside.time_leaf()));
            Expression::Delay(Box::new(on), Box::new(enable), off)
        })
    }

    fn enable(&mut self, depth: usize) -> Expression {
        if self.names.bits.is_empty() || self.random.chance(45) {
            return self.boolean(depth);
        }
        let bit = Expression::leaf(self.random.pick(&self.names.bits));
        if self.random.chance(15) {
            Expression::unary(self.random.word(&["↑", "↓"]), bit)
        } else {
            bit
        }
    }

    pub fn comparison(&mut self, depth: usize) -> Expression {
        let operator = self
            .random
            .word(&["=", "<>", "≠", "<", "<=", "≤", ">", ">=", "≥"]);
        if self.random.chance(75) {
            let left = self.integer(depth);
            let right = self.integer(depth);
            Expression::binary(operator, left, right)
        } else {
            let left = self.time(depth);
            let right = self.time(depth);
            Expression::binary(operator, left, right)
        }
    }

    fn situation(&mut self) -> Expression {
        if self.names.graphs.is_empty() {
            return self.boolean_leaf();
        }
        let (graph, steps) = self.random.pick(&self.names.graphs);
        let situation = if self.random.chance(30) {
            Situation::Initial
        } else {
            Situation::Steps(subset(self.random, steps, 2))
        };
        Expression::Situation(graph.clone(), self.random.chance(70), situation)
    }

    fn boolean_leaf(&mut self) -> Expression {
        let rank = self.rank.unwrap_or(usize::MAX);
        let names = self.names.bools.iter();
        let readable: Vec<&String> = names
            .filter(|(_, momentary)| momentary.is_none_or(|momentary| momentary < rank))
            .map(|(name, _)| name)
            .collect();
        match self.random.below(20) {
            0 => Expression::leaf(self.random.word(&["TRUE", "FALSE", "True"])),
            1..7 if !self.names.bits.is_empty() => {
                Expression::leaf(self.random.pick(&self.names.bits))
            }
            _ if readable.is_empty() => Expression::leaf("TRUE"),
            _ => Expression::leaf(*self.random.pick(&readable)),
        }
    }

    fn integer_leaf(&mut self) -> Expression {
        if self.names.ints.is_empty() || self.random.chance(35) {
            Expression::leaf(self.random.word(&INTEGERS))
        } else {
            Expression::leaf(self.random.pick(&self.names.ints))
        }
    }

    fn time_leaf(&mut self) -> Expression {
        if self.names.times.is_empty() || self.random.chance(60) {
            Expression::leaf(self.random.word(&DURATIONS))
        } else {
            Expression::leaf(self.random.pick(&self.names.times))
        }
    }

    /// Inside an edge or a timer, where names are no dependencies.
    fn watched(&mut self, make: impl FnOnce(&mut Expressions<'_>) -> Expression) -> Expression {
        make(&mut Expressions {
            random: self.random,
            names: self.names,
            rank: None,
        })
    }
}

/// At most so many of several, in their order; at least one, most of the time.
pub fn subset(random: &mut Random, from: &[String], most: usize) -> Vec<String> {
    if from.is_empty() || random.chance(10) {
        return Vec::new();
    }
    let mut places: Vec<usize> = (0..random.between(1, most))
        .map(|_| random.below(from.len()))
        .collect();
    places.sort_unstable();
    places.dedup();
    places
        .into_iter()
        .map(|place| from[place].clone())
        .collect()
}
