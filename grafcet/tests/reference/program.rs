//! Programs for the comparison: what a random program can hold, and its text.
//!
//! The declarations are the same in every program: Boolean inputs `a b c`, a number input `n`, stored Booleans
//! `s0 s1 s2`, momentary ones `m0 m1 m2`, numbers `i0 i1`, a time `w`, parameters `p` (int) and `d` (time). Graph `k`
//! is called `Gk`, its step with index `i` has the identifier `i + 1`.

use std::collections::BTreeSet;
use std::fmt::{self, Display, Formatter};

/// A random program.
#[derive(Clone, Debug)]
pub struct Program {
    pub stable: bool,
    pub graphs: Vec<Graph>,
}

#[derive(Clone, Debug)]
pub struct Graph {
    /// Statements of a stand-alone action before the steps.
    pub first: Vec<Statement>,
    pub steps: Vec<Step>,
    /// The last steps may form the expansion of a macro step `M1`: how many.
    pub expansion: usize,
    pub transitions: Vec<Transition>,
    /// Statements of a stand-alone action behind everything else.
    pub last: Vec<Statement>,
}

#[derive(Clone, Debug)]
pub struct Step {
    pub initial: bool,
    /// A graph that it encloses, and the set that it activates there.
    pub encloses: Option<(usize, BTreeSet<usize>)>,
    pub statements: Vec<Statement>,
}

#[derive(Clone, Debug)]
pub struct Transition {
    pub from: BTreeSet<usize>,
    pub to: BTreeSet<usize>,
    pub trigger: Boolean,
    pub action: Vec<Store>,
}

#[derive(Clone, Debug)]
pub enum Statement {
    /// `m0, m1 IF c`.
    Momentary(BTreeSet<usize>, Option<Boolean>),
    Stored(Store),
    OnActivation(Store),
    OnDeactivation(Store),
    OnEvent(Boolean, Store),
    /// `F/G1:{..} IF c`.
    Force(usize, Situation, Option<Boolean>),
}

#[derive(Clone, Debug)]
pub struct Store {
    pub what: Stored,
    pub condition: Option<Boolean>,
}

#[derive(Clone, Debug)]
pub enum Stored {
    Boolean(usize, Boolean),
    Number(usize, Number),
    Time(Time),
}

#[derive(Clone, Debug)]
pub enum Situation {
    Set(BTreeSet<usize>),
    Initial,
    Current,
}

#[derive(Clone, Debug)]
pub enum Boolean {
    Constant(bool),
    Input(usize),
    Stored(usize),
    Momentary(usize),
    Step(usize, usize),
    Macro(usize),
    FirstScan,
    Unstable,
    InSituation(usize, BTreeSet<usize>, bool),
    Compare(&'static str, Number, Number),
    Not(Box<Boolean>),
    And(Box<Boolean>, Box<Boolean>),
    Or(Box<Boolean>, Box<Boolean>),
    Xor(Box<Boolean>, Box<Boolean>),
    Rising(Box<Boolean>),
    Falling(Box<Boolean>),
    Timer(Box<Boolean>, Preset),
    OnDelay(Time, Box<Boolean>),
    OnOffDelay(Time, Box<Boolean>, Time),
}

#[derive(Clone, Debug)]
pub enum Preset {
    Time(Time),
    /// Seconds.
    Number(Number),
}

#[derive(Clone, Debug)]
pub enum Time {
    Milliseconds(i32),
    Variable,
    Parameter,
}

#[derive(Clone, Debug)]
pub enum Number {
    Constant(i32),
    Input,
    Variable(usize),
    Parameter,
    Negate(Box<Number>),
    Arithmetic(&'static str, Box<Number>, Box<Number>),
}

/// What stands before the graphs. The count of faults is stored last of all in a scan.
pub const DECLARATIONS: &str = "\
scan 1 s
input a, b, c
input n : int at %IW0 in -2 .. 2
output m0, m1, m2
output s0, s1, s2
var i0 : int = 1
var i1 : int = 0 in -3 .. 3
var w : time = 1 s in 0 s .. 3 s
var faults : int = 0
var unstable : bool = FALSE
parameter p : int = 1 in 0 .. 3
parameter d : time = 2 s in 0 s .. 3 s
";

/// The names of the inputs and parameters that a stimulus gives.
pub const GIVEN: [&str; 6] = ["a", "b", "c", "n", "p", "d"];

impl Display for Program {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(DECLARATIONS)?;
        if self.stable {
            writeln!(f, "evolution stable")?;
        }
        for (index, graph) in self.graphs.iter().enumerate() {
            graph.write(f, index)?;
        }
        // Behind all other stored statements, so that the order of faults within a scan does not matter.
        writeln!(
            f,
            "graph Last {{ initial step 1 {{ faults = System:arithmetic_faults; unstable = System:unstable }} }}"
        )
    }
}

impl Graph {
    /// The index of the first step of the expansion, when there is one.
    pub fn expansion_start(&self) -> Option<usize> {
        (self.expansion > 0).then_some(self.steps.len() - self.expansion)
    }

    fn write(&self, f: &mut Formatter<'_>, index: usize) -> fmt::Result {
        writeln!(f, "graph G{index} {{")?;
        write_always(f, &self.first)?;
        let outer = self.expansion_start().unwrap_or(self.steps.len());
        let (outside, inside): (Vec<&Transition>, Vec<&Transition>) =
            self.transitions.iter().partition(|t| !self.is_inside(t));
        for step in 0..outer {
            self.write_step(f, step)?;
        }
        let mut number = 0;
        if self.expansion > 0 {
            writeln!(f, "macro step M1 {{")?;
            for step in outer..self.steps.len() {
                self.write_step(f, step)?;
            }
            for transition in inside {
                number += 1;
                self.write_transition(f, number, transition)?;
            }
            writeln!(f, "}}")?;
        }
        for transition in outside {
            number += 1;
            self.write_transition(f, number, transition)?;
        }
        write_always(f, &self.last)?;
        writeln!(f, "}}")
    }

    /// Whether a transition belongs to the expansion: none of its steps is outside.
    pub fn is_inside(&self, transition: &Transition) -> bool {
        let mut steps = transition.from.iter().chain(&transition.to);
        self.expansion_start()
            .is_some_and(|start| steps.all(|step| *step >= start) && !self.passes(transition))
    }

    /// Whether a transition enters the entry or leaves the exit: it is written with the macro step.
    fn passes(&self, transition: &Transition) -> bool {
        self.expansion_start().is_some_and(|start| {
            transition.to.contains(&start) || transition.from.contains(&(self.steps.len() - 1))
        })
    }

    /// The transitions in source order: those of the expansion stand before the others.
    pub fn transitions_in_order(&self) -> impl Iterator<Item = &Transition> {
        let inside = self.transitions.iter().filter(|t| self.is_inside(t));
        let outside = self.transitions.iter().filter(|t| !self.is_inside(t));
        inside.chain(outside)
    }

    fn write_step(&self, f: &mut Formatter<'_>, index: usize) -> fmt::Result {
        let step = &self.steps[index];
        let role = match self.expansion_start() {
            Some(start) if index == start => "entry ",
            Some(_) if index + 1 == self.steps.len() => "exit ",
            _ => "",
        };
        let initial = if step.initial { "initial " } else { "" };
        write!(f, "{role}{initial}step {}", index + 1)?;
        if let Some((graph, set)) = &step.encloses {
            write!(f, " encloses G{graph}{}", Set(set))?;
        }
        writeln!(f, " {{")?;
        for statement in &step.statements {
            writeln!(f, "{statement}")?;
        }
        writeln!(f, "}}")
    }

    fn write_transition(
        &self,
        f: &mut Formatter<'_>,
        number: usize,
        transition: &Transition,
    ) -> fmt::Result {
        let outside = !self.is_inside(transition);
        let name = |step: &usize| match self.expansion_start() {
            Some(start) if outside && *step >= start => "M1".to_owned(),
            _ => (step + 1).to_string(),
        };
        let from: Vec<String> = transition.from.iter().map(name).collect();
        let to: Vec<String> = transition.to.iter().map(name).collect();
        write!(
            f,
            "transition {number}: {} -> {} when {} do {{ ",
            from.join(", "),
            to.join(", "),
            transition.trigger
        )?;
        for store in &transition.action {
            write!(f, "{store}; ")?;
        }
        writeln!(f, "}}")
    }
}

fn write_always(f: &mut Formatter<'_>, statements: &[Statement]) -> fmt::Result {
    writeln!(f, "always {{")?;
    for statement in statements {
        writeln!(f, "{statement}")?;
    }
    writeln!(f, "}}")
}

/// `{1, 2}`.
struct Set<'a>(&'a BTreeSet<usize>);

impl Display for Set<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let steps: Vec<String> = self.0.iter().map(|step| (step + 1).to_string()).collect();
        write!(f, "{{{}}}", steps.join(", "))
    }
}

/// ` IF c`.
struct If<'a>(&'a Option<Boolean>);

impl Display for If<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(condition) => write!(f, " IF {condition}"),
            None => Ok(()),
        }
    }
}

impl Display for Statement {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Statement::Momentary(targets, condition) => {
                let targets: Vec<String> = targets.iter().map(|m| format!("m{m}")).collect();
                write!(f, "{}{}", targets.join(", "), If(condition))
            }
            Statement::Stored(store) => store.fmt(f),
            Statement::OnActivation(store) => write!(f, "on activation: {store}"),
            Statement::OnDeactivation(store) => write!(f, "on deactivation: {store}"),
            Statement::OnEvent(event, store) => write!(f, "on event {event}: {store}"),
            Statement::Force(graph, situation, condition) => {
                write!(f, "F/G{graph}:{situation}{}", If(condition))
            }
        }
    }
}

impl Display for Store {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.what {
            Stored::Boolean(index, value) => write!(f, "s{index} = {value}")?,
            Stored::Number(index, value) => write!(f, "i{index} = {value}")?,
            Stored::Time(value) => write!(f, "w = {value}")?,
        }
        If(&self.condition).fmt(f)
    }
}

impl Display for Situation {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Situation::Set(set) => Set(set).fmt(f),
            Situation::Initial => f.write_str("{I}"),
            Situation::Current => f.write_str("{*}"),
        }
    }
}

impl Display for Boolean {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Boolean::Constant(true) => f.write_str("True"),
            Boolean::Constant(false) => f.write_str("False"),
            Boolean::Input(index) => f.write_str(GIVEN[*index]),
            Boolean::Stored(index) => write!(f, "s{index}"),
            Boolean::Momentary(index) => write!(f, "m{index}"),
            Boolean::Step(graph, step) => write!(f, "G{graph}:X{}", step + 1),
            Boolean::Macro(graph) => write!(f, "G{graph}:XM1"),
            Boolean::FirstScan => f.write_str("System:first_scan"),
            Boolean::Unstable => f.write_str("System:unstable"),
            Boolean::InSituation(graph, set, true) => write!(f, "(S(G{graph}) = {})", Set(set)),
            Boolean::InSituation(graph, set, false) => write!(f, "(S(G{graph}) <> {})", Set(set)),
            Boolean::Compare(operator, left, right) => write!(f, "({left} {operator} {right})"),
            Boolean::Not(e) => write!(f, "(NOT {e})"),
            Boolean::And(left, right) => write!(f, "({left} AND {right})"),
            Boolean::Or(left, right) => write!(f, "({left} OR {right})"),
            Boolean::Xor(left, right) => write!(f, "({left} XOR {right})"),
            Boolean::Rising(e) => write!(f, "(↑{e})"),
            Boolean::Falling(e) => write!(f, "(↓{e})"),
            Boolean::Timer(enable, Preset::Time(preset)) => write!(f, "(T/{enable}/{preset})"),
            Boolean::Timer(enable, Preset::Number(preset)) => write!(f, "(T/{enable}/({preset}))"),
            Boolean::OnDelay(on, e) => write!(f, "({on}/({e}))"),
            Boolean::OnOffDelay(on, e, off) => write!(f, "({on}/({e})/{off})"),
        }
    }
}

impl Display for Time {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Time::Milliseconds(ms) => write!(f, "{ms}ms"),
            Time::Variable => f.write_str("w"),
            Time::Parameter => f.write_str("d"),
        }
    }
}

impl Display for Number {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Number::Constant(value) => write!(f, "{value}"),
            Number::Input => f.write_str("n"),
            Number::Variable(index) => write!(f, "i{index}"),
            Number::Parameter => f.write_str("p"),
            Number::Negate(value) => write!(f, "(-{value})"),
            Number::Arithmetic(operator, left, right) => write!(f, "({left} {operator} {right})"),
        }
    }
}
