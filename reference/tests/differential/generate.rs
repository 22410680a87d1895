//! Random programs that the compiler accepts, with every construct of the language.

mod action;
mod expression;
mod graph;
mod outline;

use crate::program::{Declaration, Program, Type};
use crate::random::Random;
use outline::{Mode, Outline, Variable};

/// Which constructs may occur.
#[derive(Clone, Copy, Debug)]
pub struct Features {
    pub forcing: bool,
    pub enclosing: bool,
    pub macros: bool,
    pub stable: bool,
    pub events: bool,
    pub templates: bool,
}

impl Features {
    pub const ALL: Features = Features {
        forcing: true,
        enclosing: true,
        macros: true,
        stable: true,
        events: true,
        templates: true,
    };

    /// Some of these, so that simple programs occur as well.
    fn some(self, random: &mut Random) -> Self {
        Features {
            forcing: self.forcing && random.chance(50),
            enclosing: self.enclosing && random.chance(40),
            macros: self.macros && random.chance(35),
            stable: self.stable && random.chance(35),
            events: self.events && random.chance(60),
            templates: self.templates && random.chance(30),
        }
    }
}

/// A program at work.
struct Generator<'r> {
    random: &'r mut Random,
    features: Features,
    globals: Vec<Variable>,
    /// Graphs, instances and templates in source order.
    outlines: Vec<Outline>,
    /// How many momentary variables there are: the next one's rank.
    momentary: usize,
}

/// A random program.
pub fn program(random: &mut Random, allowed: Features) -> Program {
    let features = allowed.some(random);
    let mut generator = Generator {
        random,
        features,
        globals: Vec::new(),
        outlines: Vec::new(),
        momentary: 0,
    };
    generator.declare_globals();
    generator.outline();
    let graphs = (0..generator.outlines.len())
        .map(|index| generator.graph(index))
        .collect();
    let library = generator.features.templates && generator.random.chance(40);
    let declarations = generator
        .globals
        .iter()
        .map(Variable::declaration)
        .collect();
    Program {
        stable: generator.features.stable,
        library,
        period_ms: *generator.random.pick(&[10, 10, 10, 5, 7]),
        declarations,
        graphs,
    }
}

impl Generator<'_> {
    fn declare_globals(&mut self) {
        for name in ["a", "b", "c", "d"] {
            let mut input = self.variable("input", name, Type::Bool, Mode::Read);
            input.initial = None;
            self.globals.push(input);
        }
        let mut level = self.variable("input", "level", Type::Int, Mode::Read);
        level.initial = None;
        level.range = None;
        if self.random.chance(60) {
            level.address = Some("%IW0".to_owned());
            level.range =
                *self
                    .random
                    .pick(&[None, Some((0, 10)), Some((0, 40_000)), Some((3, 5))]);
        }
        self.globals.push(level);
        self.globals
            .push(Variable::plain("output", "faults", Type::Int, Mode::Faults));
        for name in ["A", "B", "température", "LAMP"] {
            let kind = self.random.word(&["output", "output", "var", "retain var"]);
            let variable = self.boolean(kind, name);
            self.globals.push(variable);
        }
        for name in ["n", "m"] {
            let kind = self.random.word(&["output", "var", "retain var"]);
            let mut variable = self.variable(kind, name, Type::Int, Mode::Stored);
            if self.random.chance(30) {
                let letter = if kind == "output" { 'Q' } else { 'M' };
                let number = if name == "n" { 20 } else { 24 };
                variable.address = Some(format!("%{letter}W{number}"));
                variable.range = variable.range.filter(|(_, high)| *high < i32::MAX);
            }
            self.globals.push(variable);
        }
        let time = self.variable("var", "t", Type::Time, Mode::Stored);
        let preset = self.variable("parameter", "delay", Type::Time, Mode::Read);
        let limit = self.variable("parameter", "limit", Type::Int, Mode::Read);
        let enable = self.variable("parameter", "enable", Type::Bool, Mode::Read);
        let mut lap = Variable::plain("const", "LAP", Type::Time, Mode::Read);
        lap.initial = Some("20ms".to_owned());
        let mut few = Variable::plain("const", "FEW", Type::Int, Mode::Read);
        few.initial = Some(self.random.word(&["3", "-2", "16#1F"]).to_string());
        let mut most = Variable::plain("const", "LIMIT", Type::Int, Mode::Read);
        most.initial = Some("-FEW".to_owned());
        let mut on = Variable::plain("const", "ON", Type::Bool, Mode::Read);
        on.initial = Some("TRUE".to_owned());
        let mut interval = self.variable("input", "interval", Type::Time, Mode::Read);
        interval.initial = None;
        interval.range = None;
        let settings = [time, preset, limit, enable, lap, few, most, on, interval];
        self.globals.extend(settings);
        self.random.shuffle(&mut self.globals);
    }

    /// A Boolean that is written in one of both ways.
    fn boolean(&mut self, kind: &'static str, name: &str) -> Variable {
        if self.random.chance(50) {
            return self.variable(kind, name, Type::Bool, Mode::Stored);
        }
        let rank = self.momentary;
        self.momentary += 1;
        Variable::plain(kind, name, Type::Bool, Mode::Momentary(rank))
    }

    /// A variable, perhaps with a range and an initial value.
    fn variable(&mut self, kind: &'static str, name: &str, ty: Type, mode: Mode) -> Variable {
        let mut variable = Variable::plain(kind, name, ty, mode);
        if ty != Type::Bool && self.random.chance(50) {
            variable.range = Some(match ty {
                Type::Time => *self.random.pick(&[(0, 100), (20, 60), (-50, 1000)]),
                _ => *self
                    .random
                    .pick(&[(0, 10), (-3, 3), (5, 7), (-100, -2), (0, i32::MAX)]),
            });
        }
        if self.random.chance(50) {
            let (low, high) = variable.range.unwrap_or((-100, 100));
            let wide = (i64::from(high) - i64::from(low)).min(200) as usize;
            let value = low + self.random.below(wide + 1) as i32;
            variable.initial = Some(match ty {
                Type::Bool => (if value % 2 == 0 { "TRUE" } else { "FALSE" }).to_owned(),
                Type::Int => value.to_string(),
                Type::Time => crate::render::Ms(value).to_string(),
            });
        }
        variable
    }
}

impl Variable {
    fn plain(kind: &'static str, name: &str, ty: Type, mode: Mode) -> Self {
        Variable {
            kind,
            name: name.to_owned(),
            ty,
            mode,
            address: None,
            initial: None,
            range: None,
        }
    }

    fn declaration(&self) -> Declaration {
        Declaration {
            kind: self.kind,
            name: self.name.clone(),
            ty: self.ty,
            address: self.address.clone(),
            initial: self.initial.clone(),
            range: self.range,
        }
    }
}
