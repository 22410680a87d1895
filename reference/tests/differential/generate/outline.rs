//! What a graph will contain, before anything names it.

use super::Generator;
use super::expression::Names;
use crate::program::Type;

/// A declared name.
#[derive(Clone, Debug)]
pub struct Variable {
    pub kind: &'static str,
    pub name: String,
    pub ty: Type,
    pub mode: Mode,
    pub address: Option<String>,
    pub initial: Option<String>,
    pub range: Option<(i32, i32)>,
}

/// How actions may use a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// They only read it.
    Read,
    Stored,
    /// Its rank: it depends on momentary variables of lower ranks only.
    Momentary(usize),
    /// It takes `System:arithmetic_faults`, once a scan, where the count is well defined.
    Faults,
}

impl Mode {
    /// Momentary, but nobody knows which.
    fn of_any_rank(self) -> Self {
        match self {
            Mode::Momentary(_) => Mode::Momentary(usize::MAX - 1),
            other => other,
        }
    }
}

/// A graph's names.
#[derive(Clone, Debug)]
pub struct Outline {
    pub name: String,
    pub kind: Kind,
    /// What it declares; of an instance, what its template declares.
    pub variables: Vec<Variable>,
    /// Its steps in source order, those of expansions among them.
    pub steps: Vec<String>,
    /// The steps outside of macro steps, and the macro steps.
    pub nodes: Vec<String>,
    pub macros: Vec<Expansion>,
    /// Orders and enclosings go from lower to higher levels only.
    pub level: usize,
    /// By these steps, each with its graph.
    pub enclosed_by: Vec<(usize, String)>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Written,
    Template,
    /// Of the template with that index.
    Instance(usize),
}

/// A macro step: entry, steps between, exit; and another one inside, after the steps between.
#[derive(Clone, Debug)]
pub struct Expansion {
    pub id: String,
    pub entry: String,
    pub between: Vec<String>,
    pub exit: String,
    pub inner: Option<Box<Expansion>>,
}

impl Expansion {
    fn steps(&self) -> Vec<String> {
        let mut steps = vec![self.entry.clone()];
        steps.extend(self.between.iter().cloned());
        steps.extend(self.inner.iter().flat_map(|inner| inner.steps()));
        steps.push(self.exit.clone());
        steps
    }

    fn ids(&self) -> Vec<String> {
        let inner = self.inner.iter().flat_map(|inner| inner.ids());
        [self.id.clone()].into_iter().chain(inner).collect()
    }
}

impl Outline {
    /// Whether a name that an instance binds: an input or output without an address, or a parameter.
    pub fn interface(&self) -> impl Iterator<Item = &Variable> {
        self.variables
            .iter()
            .filter(|v| matches!(v.kind, "input" | "output" | "parameter"))
    }
}

impl Generator<'_> {
    /// Decides what graphs there are.
    pub fn outline(&mut self) {
        for index in 0..self.random.between(1, 4) {
            let outline = self.outline_of(["Main", "G2", "Füller", "Cell4"][index], Kind::Written);
            self.outlines.push(outline);
        }
        if self.features.templates {
            let mut template = self.outline_of("Saw", Kind::Template);
            self.add_interface(&mut template);
            let at = self.outlines.len();
            for name in ["Saw1", "Saw2"] {
                self.outlines.push(Outline {
                    name: name.to_owned(),
                    kind: Kind::Instance(at),
                    ..template.clone()
                });
            }
            self.outlines.insert(at, template);
        }
        self.set_levels();
        self.enclose();
    }

    fn set_levels(&mut self) {
        let mut levels: Vec<usize> = (0..self.outlines.len()).collect();
        self.random.shuffle(&mut levels);
        for (outline, level) in self.outlines.iter_mut().zip(levels) {
            outline.level = level;
        }
        // What a template orders, each of its instances does.
        for index in 0..self.outlines.len() {
            let instances = self.outlines.iter();
            let instances = instances.filter(|o| o.kind == Kind::Instance(index));
            if let Some(highest) = instances.map(|o| o.level).max() {
                self.outlines[index].level = highest;
            }
        }
    }

    /// Decides which steps enclose which graphs.
    fn enclose(&mut self) {
        if !self.features.enclosing {
            return;
        }
        for lower in 0..self.outlines.len() {
            let level = self.outlines[lower].level;
            let superior = |o: &Outline| !matches!(o.kind, Kind::Instance(_)) && o.level < level;
            let superiors: Vec<usize> = (0..self.outlines.len())
                .filter(|at| superior(&self.outlines[*at]))
                .collect();
            if superiors.is_empty()
                || self.outlines[lower].kind == Kind::Template
                || self.random.chance(25)
            {
                continue;
            }
            for _ in 0..self.random.between(1, 3) {
                let superior = *self.random.pick(&superiors);
                let step = self.random.pick(&self.outlines[superior].steps).clone();
                let by = &mut self.outlines[lower].enclosed_by;
                if !by.contains(&(superior, step.clone())) {
                    by.push((superior, step));
                }
            }
        }
    }

    fn outline_of(&mut self, name: &str, kind: Kind) -> Outline {
        // Once in a while more steps than a machine word has bits.
        let most = if self.random.chance(3) { 40 } else { 5 };
        let mut nodes: Vec<String> = (1..=self.random.between(2, most))
            .map(|id| {
                if id < 10 && self.random.chance(10) {
                    format!("E{id}")
                } else {
                    id.to_string()
                }
            })
            .collect();
        let mut steps = nodes.clone();
        let mut macros = Vec::new();
        if self.features.macros && self.random.chance(60) {
            let expansion = self.expansion(50);
            steps.extend(expansion.steps());
            nodes.push(expansion.id.clone());
            macros.push(expansion);
        }
        let mut outline = Outline {
            name: name.to_owned(),
            kind,
            variables: Vec::new(),
            steps,
            nodes,
            macros,
            level: 0,
            enclosed_by: Vec::new(),
        };
        if self.random.chance(60) {
            // A name of the application too: the graph's own hides it.
            let own = self.random.word(&["own", "LAMP"]);
            let variable = if kind == Kind::Template {
                self.variable("var", own, Type::Bool, Mode::Stored)
            } else {
                self.boolean("var", own)
            };
            outline.variables.push(variable);
        }
        if self.random.chance(60) {
            let own = self.random.word(&["count", "n"]);
            let variable = self.variable("var", own, Type::Int, Mode::Stored);
            outline.variables.push(variable);
        }
        if kind == Kind::Written && self.random.chance(25) {
            self.add_own_terminals(&mut outline);
        }
        outline
    }

    /// An input, an output and a parameter that a graph declares for itself.
    fn add_own_terminals(&mut self, outline: &mut Outline) {
        let mut sensor = self.variable("input", "sensor", Type::Bool, Mode::Read);
        sensor.initial = None;
        let valve = self.boolean("output", "valve");
        let mut few = Variable::plain("const", "FEW", Type::Int, Mode::Read);
        few.initial = Some("LIMIT".to_owned());
        let pause = self.variable("parameter", "pause", Type::Time, Mode::Read);
        outline.variables.extend([sensor, valve, few, pause]);
    }

    fn expansion(&mut self, first: usize) -> Expansion {
        let nested = first < 70 && self.random.chance(35);
        Expansion {
            id: format!("M{first}"),
            entry: format!("E{first}"),
            between: (1..=self.random.below(3))
                .map(|id| (first + id).to_string())
                .collect(),
            exit: format!("S{first}"),
            inner: nested.then(|| Box::new(self.expansion(first + 10))),
        }
    }

    fn add_interface(&mut self, template: &mut Outline) {
        let mut run = self.variable("input", "run", Type::Bool, Mode::Read);
        let mut amount = self.variable("input", "amount", Type::Int, Mode::Read);
        for input in [&mut run, &mut amount] {
            input.initial = None;
            input.range = None;
        }
        // Rank 0: what writes it reads no momentary variable, whatever an instance binds it to.
        let mut done = self.variable("output", "done", Type::Bool, Mode::Stored);
        if self.random.chance(50) {
            done.mode = Mode::Momentary(0);
        }
        done.initial = None;
        let pause = self.variable("parameter", "pause", Type::Time, Mode::Read);
        let total = Variable::plain("output", "total", Type::Int, Mode::Stored);
        template.variables.extend([run, amount, done, total, pause]);
    }

    /// What the expressions of a graph may name; without a graph, those of the application.
    pub fn names(&self, graph: Option<usize>) -> Names {
        let mut names = Names::default();
        for system in ["first_scan", "unstable", "recovered"] {
            names.bools.push((format!("System:{system}"), None));
        }
        names.ints.push("System:overruns".to_owned());
        let own = graph.map(|graph| &self.outlines[graph]);
        for variable in &self.globals {
            let hidden =
                own.is_some_and(|own| own.variables.iter().any(|v| v.name == variable.name));
            if !hidden {
                names.add(variable.name.clone(), variable);
            }
        }
        for (index, outline) in self.outlines.iter().enumerate() {
            let here = graph == Some(index);
            if outline.kind == Kind::Template && !here {
                continue;
            }
            for (place, variable) in outline.variables.iter().enumerate() {
                let qualified = format!("{}:{}", outline.name, variable.name);
                let terminal = matches!(variable.kind, "input" | "output");
                if here && place % 2 == 0 {
                    names.add(variable.name.clone(), variable);
                } else if terminal && matches!(outline.kind, Kind::Instance(_)) {
                    // What an instance binds stands for something else, which must not be itself.
                    if graph.is_some() {
                        let mut bound = variable.clone();
                        bound.mode = bound.mode.of_any_rank();
                        names.add(qualified, &bound);
                    }
                } else {
                    names.add(qualified, variable);
                }
            }
            if here && outline.kind == Kind::Template {
                // It may be bound to a step bit.
                names.bits.push("run".to_owned());
            }
            let bits = outline.steps.iter().cloned();
            for id in bits.chain(outline.macros.iter().flat_map(Expansion::ids)) {
                names.bits.push(if here {
                    format!("X{id}")
                } else {
                    format!("{}:X{id}", outline.name)
                });
            }
            names
                .graphs
                .push((outline.name.clone(), outline.steps.clone()));
        }
        names
    }
}

impl Names {
    fn add(&mut self, name: String, variable: &Variable) {
        match variable.ty {
            Type::Bool => {
                let rank = match variable.mode {
                    Mode::Momentary(rank) => Some(rank),
                    _ => None,
                };
                self.bools.push((name, rank));
            }
            Type::Int if variable.mode != Mode::Faults => self.ints.push(name),
            Type::Int => {}
            Type::Time => self.times.push(name),
        }
    }
}
