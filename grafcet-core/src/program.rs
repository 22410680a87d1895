//! A compiled program: the one lowered form that is verified, simulated and executed.
//!
//! Rows refer to each other by index and to runs of rows by [`Run`]. All Booleans of a program - inputs, steps,
//! variables, the results of edges and timers - are bits of one image, so that a conjunction of any of them is a
//! comparison of masked words. All numbers are slots of one array.

/// A Boolean of the image: bit `0 & 31` of word `0 >> 5`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Bit(pub u16);

impl Bit {
    /// `System:first_scan`.
    pub const FIRST_SCAN: Bit = Bit(0);
    /// `System:unstable`.
    pub const UNSTABLE: Bit = Bit(1);
    /// `System:recovered`.
    pub const RECOVERED: Bit = Bit(2);

    /// Index of the word of the image.
    #[must_use]
    pub const fn word(self) -> usize {
        (self.0 >> 5) as usize
    }

    /// The bit within its word.
    #[must_use]
    pub const fn mask(self) -> u32 {
        1 << (self.0 & 31)
    }
}

/// A number: an `int`, or a `time` in milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Number(pub u16);

impl Number {
    /// `System:overruns`.
    pub const OVERRUNS: Number = Number(0);
    /// `System:arithmetic_faults`.
    pub const ARITHMETIC_FAULTS: Number = Number(1);
}

/// Where a value lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Slot {
    /// A Boolean.
    Bit(Bit),
    /// An `int` or a `time`.
    Number(Number),
}

/// A time stamp: the latest rise of a step, a macro step or a timer's enable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Stamp(pub u16);

/// Consecutive rows of a table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Run {
    /// Index of the first row.
    pub start: u16,
    /// How many rows.
    pub len: u16,
}

impl Run {
    /// No rows.
    pub const EMPTY: Run = Run { start: 0, len: 0 };

    /// The rows of the run; none when the run leaves the table, which a checked table never does.
    #[must_use]
    pub fn of<T>(self, table: &[T]) -> &[T] {
        let start = self.start as usize;
        table.get(start..start + self.len as usize).unwrap_or(&[])
    }

    /// The indices of the rows.
    #[must_use]
    pub fn indices(self) -> core::ops::Range<usize> {
        self.start as usize..self.start as usize + self.len as usize
    }
}

/// A run of [`Op`]s in [`Program::ops`] that leaves one value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Code {
    /// Index of the first operation.
    pub start: u32,
    /// How many operations, at least one.
    pub len: u16,
}

/// When something holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Condition {
    /// Always.
    Always,
    /// When all [`Term`]s of the run hold: a conjunction of literals.
    All(Run),
    /// When the code leaves a value other than 0.
    Code(Code),
}

/// Part of a conjunction: true when `image[word] & mask == state` (the file-based GRAFCET of the documents).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Term {
    /// Word of the image.
    pub word: u16,
    /// The bits looked at.
    pub mask: u32,
    /// How they must stand.
    pub state: u32,
}

/// One postfix operation on a stack of 32-bit values; False is 0 and True is 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// Pushes a constant.
    Constant(i32),
    /// Pushes a Boolean of the image.
    Bit(Bit),
    /// Pushes a number.
    Number(Number),
    /// Boolean negation.
    Not,
    /// Boolean and.
    And,
    /// Boolean or.
    Or,
    /// Boolean exclusive or.
    Xor,
    /// Saturating negation.
    Negate,
    /// Saturating sum.
    Add,
    /// Saturating difference.
    Subtract,
    /// Saturating product.
    Multiply,
    /// Quotient, truncated toward zero; by zero 0, counted.
    Divide,
    /// Remainder with the sign of the dividend; by zero 0, counted.
    Modulo,
    /// `=`.
    Equal,
    /// `<>`.
    NotEqual,
    /// `<`.
    Less,
    /// `<=`.
    LessOrEqual,
    /// `>`.
    Greater,
    /// `>=`.
    GreaterOrEqual,
    /// Pops a preset and pushes `T/Xn/preset` for a step (or macro step) bit standing alone.
    StepTimer {
        /// The step or macro step.
        step: Bit,
        /// Its time of activation.
        activated: Stamp,
        /// The unit of the preset.
        unit: Unit,
    },
}

/// What one unit of a preset is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unit {
    /// A `time`: milliseconds.
    Milliseconds,
    /// An `int`: seconds.
    Seconds,
}

/// An edge or a timer with a memory of its own, evaluated in every scan where it stands. Its result is a bit of the
/// image, which expressions read like any other. An operator inside another one stands before it in the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Watch {
    /// `↑e` or `↓e`.
    Edge {
        /// The Boolean that is watched.
        operand: Condition,
        /// Which edge.
        edge: Edge,
        /// What it was in the scan before.
        last: Bit,
        /// The result.
        result: Bit,
        /// True for `↑` of a step or macro bit standing alone in an action or forcing condition: it counts as False
        /// before scan 0. All other edges are False in scan 0.
        from_false: bool,
    },
    /// `T/e/preset` on anything but a step bit standing alone.
    Timer {
        /// What starts it.
        enable: Condition,
        /// The time that has to pass.
        preset: Code,
        /// The unit of the preset.
        unit: Unit,
        /// The enable in the evaluation before.
        last: Bit,
        /// When it rose.
        risen: Stamp,
        /// The result.
        result: Bit,
    },
    /// `t1/e` on anything but a step bit standing alone.
    OnDelay {
        /// The Boolean.
        enable: Condition,
        /// `t1` in milliseconds.
        delay: Code,
        /// The enable in the evaluation before.
        last: Bit,
        /// When it rose.
        risen: Stamp,
        /// The result.
        result: Bit,
    },
    /// The second half of `t1/e/t2`: True while `on` is, and for `t2` after it last became False.
    OffDelay {
        /// `t1/e`.
        on: Condition,
        /// `t2` in milliseconds.
        hold: Code,
        /// `on` in the evaluation before.
        last: Bit,
        /// When it fell.
        fallen: Stamp,
        /// The result.
        result: Bit,
    },
    /// A Boolean that has to be evaluated here and in every scan (an `on event` expression, a timer on a step bit
    /// whose preset can fault), but only while the gate, if there is one, is True; otherwise its result is False.
    Value {
        /// The Boolean.
        condition: Condition,
        /// Evaluated only while this step is active.
        gate: Option<Bit>,
        /// The result.
        result: Bit,
    },
}

/// The two edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Edge {
    /// `↑`.
    Rising,
    /// `↓`.
    Falling,
}

/// How a program evolves within a scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Evolution {
    /// One firing a scan (`evolution scan`, the default).
    Scan,
    /// Rounds until nothing fires (`evolution stable`, IEC 60848).
    Stable,
}

/// A graph: a run of steps, a run of transitions and the words of its situation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Graph {
    /// Rows of [`Program::steps`]. Step `i` of the run is bit `i` of the graph's situation words.
    pub steps: Run,
    /// Words of the image with the situation, used by this graph alone.
    pub words: Run,
    /// Rows of [`Program::transitions`].
    pub transitions: Run,
    /// Rows of [`Program::armed_by`]: its transitions without entrance steps.
    pub sources: Run,
    /// First word in [`Program::situations`] of the initial situation.
    pub initial: u16,
    /// Rows of [`Program::enclosings`]: the steps that enclose this graph; empty for a graph of its own.
    pub enclosings: Run,
    /// Rows of [`Program::orders`]: forcing by its stand-alone actions, other graphs only.
    pub orders: Run,
    /// Rows of [`Program::orders`]: forcing of itself by its stand-alone actions.
    pub self_orders: Run,
    /// Rows of [`Program::watches`]: edges and timers in the forcing conditions of this graph, self-forcing excepted.
    pub watches: Run,
    /// Rows of [`Program::watches`]: edges and timers in the conditions of its self-forcing.
    pub self_watches: Run,
}

/// A step: what it arms and what it does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Step {
    /// Rows of [`Program::armed_by`]: transitions that have this step as their first entrance step.
    pub transitions: Run,
    /// Rows of [`Program::momentary`]: statements that depend on no momentary variable.
    pub momentary: Run,
    /// Rows of [`Program::stored`]: statements without `on`.
    pub stored: Run,
    /// Rows of [`Program::stored`]: `on activation`.
    pub on_activation: Run,
    /// Rows of [`Program::stored`]: `on deactivation`.
    pub on_deactivation: Run,
    /// Rows of [`Program::events`]: `on event`.
    pub on_event: Run,
    /// Rows of [`Program::orders`]: forcing by this step.
    pub orders: Run,
    /// Where its time of activation is kept, when a timer reads it.
    pub activated: Option<Stamp>,
}

/// A macro step: its bit is True while any step of its expansion is active.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Macro {
    /// The step bit `XM5`.
    pub bit: Bit,
    /// The graph it belongs to.
    pub graph: u16,
    /// Rows of [`Program::steps`]: its expansion, nested expansions included.
    pub steps: Run,
    /// Where its time of activation is kept, when a timer reads it.
    pub activated: Option<Stamp>,
}

/// A transition.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Transition {
    /// Rows of [`Program::links`]: entrance steps.
    pub entrance: Run,
    /// Rows of [`Program::links`]: exit steps.
    pub exit: Run,
    /// The trigger.
    pub trigger: Condition,
    /// Rows of [`Program::stored`]: the `do` block.
    pub actions: Run,
}

/// A step that encloses a graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Enclosing {
    /// The enclosing step.
    pub step: Bit,
    /// First word in [`Program::situations`] of the set that its activation gives.
    pub situation: u16,
    /// For an initial step, first word in [`Program::situations`] of what the graph takes in scan 0: its own initial
    /// steps, or the set when it has none.
    pub at_start: Option<u16>,
}

/// A forcing statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Order {
    /// The graph that is forced.
    pub graph: u16,
    /// Place in the source among the orders of one graph: of two valid ones the later wins.
    pub rank: u16,
    /// Into what.
    pub situation: Forced,
    /// The condition behind `IF`.
    pub condition: Condition,
}

/// The situation that an order asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Forced {
    /// The set whose words start there in [`Program::situations`]; `{I}` and `{}` too.
    Set(u16),
    /// `{*}`: the situation before this scan.
    Current,
}

/// A stored statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Stored {
    /// What is stored where.
    pub assignment: Assignment,
    /// The condition behind `IF`.
    pub condition: Condition,
}

/// What a stored statement stores.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Assignment {
    /// A Boolean.
    Bit(Bit, Condition),
    /// A number, clamped to the range of its slot.
    Number(Number, Code),
}

/// `on event e`: statements that run when the event comes while their step is active.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Event {
    /// The event, as a watch of the triggers left it.
    pub event: Bit,
    /// Rows of [`Program::stored`].
    pub stored: Run,
}

/// A momentary statement: its variables are True while its owner is active and the condition holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Momentary {
    /// Rows of [`Program::links`]: the variables.
    pub targets: Run,
    /// The condition behind `IF`.
    pub condition: Condition,
}

/// A momentary statement whose condition reads momentary variables of the same scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Dependent {
    /// The step; none for a stand-alone action.
    pub owner: Option<Bit>,
    /// The statement.
    pub statement: Momentary,
}

/// A number's first value and its limits, `-2^31 .. 2^31 - 1` when none is declared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct NumberRow {
    /// Value in scan 0, within the limits.
    pub initial: i32,
    /// Lowest value.
    pub min: i32,
    /// Highest value.
    pub max: i32,
}

/// A variable or parameter that survives power.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Retained {
    /// Where its value lives.
    pub slot: Slot,
    /// What it is called in the store: a hash of its qualified name, its type and its range, so that a changed program
    /// keeps what still fits.
    pub key: u32,
}

/// How many of everything a program's memory holds, and where in the image what lies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Layout {
    /// Words of the image. Word 0 holds the `System:` bits.
    pub words: u16,
    /// Words with Boolean inputs.
    pub inputs: Run,
    /// Words with steps, graph by graph.
    pub situations: Run,
    /// Words with macro step bits.
    pub macros: Run,
    /// Words with variables and outputs that are the object of momentary actions: cleared in phase 7.
    pub momentary: Run,
    /// Numbers that are inputs.
    pub number_inputs: Run,
    /// Words with one bit for each number that is an input: True while its sample lies outside its range.
    pub outside: Run,
    /// Numbers in all, the `System:` numbers first.
    pub numbers: u16,
    /// Time stamps.
    pub stamps: u16,
    /// Depth of the stack that the deepest code needs.
    pub stack: u16,
    /// Words with one bit for each transition.
    pub fired: u16,
}

impl Layout {
    /// Words with the bits of steps and macro steps: what is remembered of the scan before.
    #[must_use]
    pub const fn situation_words(&self) -> usize {
        self.situations.len as usize + self.macros.len as usize
    }
}

/// A compiled program.
///
/// Every table is in source order unless its field says otherwise, so that rules of precedence that end in "in
/// source order" are the order of rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Program<'a> {
    /// Scan period in ms, at least 1.
    pub period_ms: u32,
    /// How it evolves.
    pub evolution: Evolution,
    /// Hash of everything else here: the same program has the same fingerprint on every machine.
    pub fingerprint: u32,
    /// Sizes and places.
    pub layout: Layout,
    /// The graphs.
    pub graphs: &'a [Graph],
    /// Indices of the graphs in the order of phase 4: superiors first.
    pub hierarchy: &'a [u16],
    /// The steps of all graphs.
    pub steps: &'a [Step],
    /// Macro steps, inner ones before outer ones.
    pub macros: &'a [Macro],
    /// The transitions of all graphs.
    pub transitions: &'a [Transition],
    /// Runs of bits: entrances and exits of transitions, variables of momentary statements.
    pub links: &'a [Bit],
    /// Indices of transitions: those of each step, those of each graph without entrance.
    pub armed_by: &'a [u16],
    /// Words of situations; a situation has as many as its graph.
    pub situations: &'a [u32],
    /// Steps that enclose graphs, for each enclosed graph in source order.
    pub enclosings: &'a [Enclosing],
    /// Forcing statements.
    pub orders: &'a [Order],
    /// Stored statements.
    pub stored: &'a [Stored],
    /// `on event` statements.
    pub events: &'a [Event],
    /// Rows of `stored`: those of stand-alone actions.
    pub always_stored: Run,
    /// Momentary statements that depend on no momentary variable.
    pub momentary: &'a [Momentary],
    /// Rows of `momentary`: those of stand-alone actions.
    pub always_momentary: Run,
    /// Momentary statements that read momentary variables, each behind those it depends on.
    pub dependent: &'a [Dependent],
    /// Edges and timers.
    pub watches: &'a [Watch],
    /// Rows of `watches`: those in triggers and events (phase 2).
    pub trigger_watches: Run,
    /// Rows of `watches`: those in `do` and `on` statements of a program that evolves `stable`.
    pub round_watches: Run,
    /// Rows of `watches`: those in all other actions (before phase 6).
    pub action_watches: Run,
    /// Conjunctions.
    pub terms: &'a [Term],
    /// Postfix code.
    pub ops: &'a [Op],
    /// Numbers with first values and limits.
    pub numbers: &'a [NumberRow],
    /// Booleans that are True before scan 0.
    pub initially_true: &'a [Bit],
    /// What survives power.
    pub retained: &'a [Retained],
}

/// What a program calls its things; kept apart so that an image without log lines does not carry it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Names<'a> {
    /// The application.
    pub application: &'a str,
    /// The graphs.
    pub graphs: &'a [&'a str],
    /// The identifiers of the steps, `3` or `E5`.
    pub steps: &'a [&'a str],
    /// The numbers of the transitions.
    pub transitions: &'a [u32],
    /// The retained variables and parameters, qualified, in the order of [`Program::retained`].
    pub retained: &'a [&'a str],
}
