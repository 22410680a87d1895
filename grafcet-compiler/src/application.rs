//! What the compiler hands on: tables for the engine, and what people call the things in them.

use grafcet_core::program::{
    Actors, Arm, Bit, Block, Code, Condition, Crossing, Dependent, Duties, Edges, Enclosing, Event,
    Evolution, Graph, Layout, Macro, Masks, Momentary, NumberRow, Op, Order, Program, Retained,
    Role, Run, Slot, Step, Stored, Target, Term, Timer, Transition, Watch,
};

use crate::ast::{DeclarationKind, Type};
use crate::source::Span;

/// A compiled application: the controller's program, and what stands around it in simulation.
#[derive(Clone, Debug)]
pub struct Application {
    /// The name behind `application`; the main file's stem when there is none.
    pub name: String,
    /// The level-1 text behind it.
    pub text: Option<String>,
    /// The controller.
    pub controller: Unit,
    /// The plants, in source order.
    pub plants: Vec<Plant>,
    /// The tests, in source order.
    pub tests: Vec<Test>,
}

/// A program with its names: the controller, a plant, or what observes them in a test.
#[derive(Clone, Debug)]
pub struct Unit {
    /// The tables.
    pub tables: Tables,
    /// The names.
    pub symbols: Symbols,
}

/// The tables of a [`Program`], owned. [`Tables::program`] borrows them.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "each field is documented at `Program`")]
pub struct Tables {
    pub period_ms: u32,
    pub evolution: Evolution,
    pub fingerprint: u32,
    pub layout: Layout,
    pub read_inputs: Vec<u32>,
    pub reads_first_scan: bool,
    pub crosses_at_once: bool,
    pub marks_all: bool,
    pub graphs: Vec<Graph>,
    pub roles: Vec<Role>,
    pub hierarchy: Vec<u16>,
    pub blocks: Vec<Block>,
    pub masks: Vec<Masks>,
    pub actors: Vec<Actors>,
    pub steps: Vec<Step>,
    pub duties: Vec<Duties>,
    pub macros: Vec<Macro>,
    pub transitions: Vec<Transition>,
    pub crossings: Vec<Crossing>,
    pub do_blocks: Vec<Run>,
    pub links: Vec<u16>,
    pub arms: Vec<Arm>,
    pub situations: Vec<u32>,
    pub enclosings: Vec<Enclosing>,
    pub orders: Vec<Order>,
    pub sources: Vec<u16>,
    pub lasting_in_steps: bool,
    pub momentary_varies: bool,
    pub stores_on_change: bool,
    pub stored: Vec<Stored>,
    pub events: Vec<Event>,
    pub always_stored: Run,
    pub targets: Vec<Target>,
    pub momentary: Vec<Momentary>,
    pub always_momentary: Run,
    pub dependent: Vec<Dependent>,
    pub edges: Vec<Edges>,
    pub watches: Vec<Watch>,
    pub trigger_watches: Run,
    pub round_watches: Run,
    pub action_watches: Run,
    pub conditions: Vec<Condition>,
    pub terms: Vec<Term>,
    pub timers: Vec<Timer>,
    pub codes: Vec<Code>,
    pub ops: Vec<Op>,
    pub numbers: Vec<NumberRow>,
    pub initially_true: Vec<Bit>,
    pub retained: Vec<Retained>,
}

impl Tables {
    /// The tables for an image in which nobody looks at what a scan has changed ([`Program::unwatched`]).
    #[must_use]
    pub fn unwatched(mut self) -> Self {
        let program = self.program().unwatched();
        (self.layout, self.marks_all) = (program.layout, program.marks_all);
        self
    }

    /// The program, as an engine takes it.
    #[must_use]
    pub fn program(&self) -> Program<'_> {
        Program {
            period_ms: self.period_ms,
            evolution: self.evolution,
            fingerprint: self.fingerprint,
            layout: self.layout,
            read_inputs: &self.read_inputs,
            reads_first_scan: self.reads_first_scan,
            crosses_at_once: self.crosses_at_once,
            marks_all: self.marks_all,
            graphs: &self.graphs,
            roles: &self.roles,
            hierarchy: &self.hierarchy,
            blocks: &self.blocks,
            masks: &self.masks,
            actors: &self.actors,
            steps: &self.steps,
            duties: &self.duties,
            macros: &self.macros,
            transitions: &self.transitions,
            crossings: &self.crossings,
            do_blocks: &self.do_blocks,
            links: &self.links,
            arms: &self.arms,
            situations: &self.situations,
            enclosings: &self.enclosings,
            orders: &self.orders,
            sources: &self.sources,
            lasting_in_steps: self.lasting_in_steps,
            momentary_varies: self.momentary_varies,
            stores_on_change: self.stores_on_change,
            stored: &self.stored,
            events: &self.events,
            always_stored: self.always_stored,
            targets: &self.targets,
            momentary: &self.momentary,
            always_momentary: self.always_momentary,
            dependent: &self.dependent,
            edges: &self.edges,
            watches: &self.watches,
            trigger_watches: self.trigger_watches,
            round_watches: self.round_watches,
            action_watches: self.action_watches,
            conditions: &self.conditions,
            terms: &self.terms,
            timers: &self.timers,
            codes: &self.codes,
            ops: &self.ops,
            numbers: &self.numbers,
            initially_true: &self.initially_true,
            retained: &self.retained,
        }
    }
}

/// The names of a program, in source order.
#[derive(Clone, Debug, Default)]
pub struct Symbols {
    /// The graphs, with their steps and transitions, in the order of [`Tables::graphs`].
    pub graphs: Vec<GraphSymbol>,
    /// Inputs, outputs, variables and parameters (constants have no slot): globals first, then graph by graph.
    pub variables: Vec<VariableSymbol>,
}

/// A graph's names.
#[derive(Clone, Debug)]
pub struct GraphSymbol {
    /// The name.
    pub name: String,
    /// Level-1 text.
    pub text: Option<String>,
    /// The steps in source order, macro steps left out.
    pub steps: Vec<StepSymbol>,
    /// The numbers of its transitions in source order, with the steps they leave and enter, as written.
    pub transitions: Vec<TransitionSymbol>,
    /// The graph.
    pub span: Span,
}

/// A step's names.
#[derive(Clone, Debug)]
pub struct StepSymbol {
    /// The identifier, `3` or `E5`.
    pub id: String,
    /// Its bit.
    pub bit: Bit,
    /// Level-1 text.
    pub text: Option<String>,
    /// The step.
    pub span: Span,
}

/// A transition's names.
#[derive(Clone, Debug)]
pub struct TransitionSymbol {
    /// The number.
    pub number: u32,
    /// The transition.
    pub span: Span,
}

/// A declared name with a place in the images.
#[derive(Clone, Debug)]
pub struct VariableSymbol {
    /// `name`, or `Graph:name` for what a graph declares.
    pub name: String,
    /// Index in [`Symbols::graphs`] of the graph that declares it.
    pub graph: Option<usize>,
    /// Input, output, variable or parameter.
    pub kind: DeclarationKind,
    /// The type.
    pub ty: Type,
    /// Where it lives.
    pub slot: Slot,
    /// Its address, canonical (`%IX0.0`, `%IW2`), when it has one.
    pub address: Option<String>,
    /// Lowest and highest value of a number.
    pub range: Option<(i32, i32)>,
    /// Value in scan 0.
    pub initial: i32,
    /// Level-1 text.
    pub text: Option<String>,
    /// An interface name that an instance binds to an address: it is wired, and has no column in a trace. A name that
    /// is bound to anything else stands for that, has no place of its own and is not listed.
    pub bound: bool,
    /// The declaration's name.
    pub span: Span,
}

/// A plant: a graph in the machine's place, with the wires between it and the controller.
#[derive(Clone, Debug)]
pub struct Plant {
    /// The name.
    pub name: String,
    /// Its program.
    pub unit: Unit,
    /// From the controller's images to the plant's inputs.
    pub reads: Vec<Wire>,
    /// From the plant's outputs to the controller's inputs.
    pub writes: Vec<Wire>,
}

/// A value carried from one program's images to another's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wire {
    /// Where it is read.
    pub from: Slot,
    /// Where it is written.
    pub to: Slot,
}

/// A test, lowered.
#[derive(Clone, Debug)]
pub struct Test {
    /// What it claims.
    pub name: String,
    /// Indices in [`Application::plants`].
    pub plants: Vec<usize>,
    /// What it does.
    pub steps: Vec<TestStep>,
    /// A program without graphs that follows every expression of the test, scan for scan.
    pub observer: Observer,
    /// The test.
    pub span: Span,
}

/// A program without graphs: its watches are the expressions of a test, its results are their values.
#[derive(Clone, Debug)]
pub struct Observer {
    /// The tables.
    pub tables: Tables,
    /// What it sees.
    pub reads: Vec<(Place, Slot)>,
}

/// A value of the controller or of a plant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    /// In the controller's images.
    Controller(Slot),
    /// In the images of the plant with that index in [`Application::plants`].
    Plant(usize, Slot),
}

/// A step of a test.
#[derive(Clone, Debug)]
pub struct TestStep {
    /// What it does.
    pub kind: TestStepKind,
    /// Where it is written.
    pub span: Span,
}

/// What a step of a test does.
#[derive(Clone, Debug)]
pub enum TestStepKind {
    /// Writes inputs, parameters or a plant's own variables; an input stays overridden.
    Set(Vec<(Place, i32)>),
    /// Gives inputs back to the plant.
    Release(Vec<Place>),
    /// Sets, runs so many ms, clears.
    Pulse {
        /// What is pulsed.
        place: Place,
        /// For how long, in ms.
        ms: u32,
    },
    /// Runs as many scans as fit into so many ms, rounded up.
    Wait {
        /// For how long, in ms.
        ms: u32,
    },
    /// Runs so many scans.
    WaitScans(u32),
    /// Runs until the claim holds, at most so many ms.
    WaitUntil {
        /// What is waited for.
        claim: Claim,
        /// At most so long, in ms.
        within_ms: u32,
    },
    /// The claim holds now.
    Expect(Claim),
    /// The claim is False now and after every later scan.
    Never(Claim),
    /// The claim is True now and after every later scan.
    Always(Claim),
    /// Power is lost and comes back; what is retained is kept.
    PowerCycle,
}

/// An expression of a test.
#[derive(Clone, Debug)]
pub struct Claim {
    /// The observer's bit with its value after the latest scan.
    pub result: Bit,
    /// The names in it with the places of their values, to show when it fails.
    pub mentions: Vec<(String, Place)>,
}
