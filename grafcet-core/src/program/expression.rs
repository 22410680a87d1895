//! Conditions, values, and the edges and timers that remember.

use super::{Bit, Number, Run, Since, Stamp};

/// A run of [`Op`]s in [`Program::ops`](super::Program::ops) that leaves one value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Code {
    /// Index of the first operation.
    pub start: u32,
    /// How many operations, at least one.
    pub len: u16,
}

impl Code {
    /// The operations; none when the code leaves the table, which that of a checked table never does.
    pub(crate) fn of(self, ops: &[Op]) -> &[Op] {
        let start = self.start as usize;
        ops.get(start..start + self.len as usize).unwrap_or(&[])
    }
}

/// When something holds: when all terms hold, and then the rest does.
///
/// The terms are a conjunction of literals as mask and state words (the file-based GRAFCET of the documents). What
/// can fault is never behind a term: it has to be counted whatever the other operands of an `AND` are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Condition {
    /// Rows of [`Program::terms`](super::Program::terms).
    pub terms: Run,
    /// What has to hold as well.
    pub rest: Rest,
}

impl Condition {
    /// Always.
    pub const ALWAYS: Condition = Condition {
        terms: Run::EMPTY,
        rest: Rest::None,
    };
}

/// What a condition asks for beside its terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Rest {
    /// Nothing.
    None,
    /// That the timer in this row of [`Program::timers`](super::Program::timers) has run out.
    Elapsed(u16),
    /// That it has not.
    Running(u16),
    /// That the code in this row of [`Program::codes`](super::Program::codes) leaves a value other than 0.
    Code(u16),
    /// The same for code on nothing but Booleans, never more than 32 of them at once.
    Logic(u16),
}

/// `T/Xn/preset` for a step (or macro step) bit standing alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Timer {
    /// One that is asked for only while the step is active: in its actions, and in the triggers of transitions that it
    /// enables. Behind [`Timer::LONGEST_OWN_MS`] it may not tell how long that is.
    Own {
        /// Since when it is.
        since: Since,
        /// The time that has to pass.
        preset: Preset,
    },
    /// Any other.
    Any {
        /// The step or macro step.
        step: Bit,
        /// Its time of activation.
        activated: Stamp,
        /// The time that has to pass.
        preset: Preset,
    },
}

impl Timer {
    /// No preset of a [`Timer::Own`] is longer, in ms: 24 days, more than any number of ms is.
    pub const LONGEST_OWN_MS: u32 = 1 << 31;

    /// The time that has to pass.
    #[must_use]
    pub const fn preset(self) -> Preset {
        match self {
            Timer::Own { preset, .. } | Timer::Any { preset, .. } => preset,
        }
    }
}

/// The preset of a step's timer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Preset {
    /// So many milliseconds.
    Constant(i32),
    /// What a number holds.
    Number(Number, Unit),
}

impl Preset {
    /// Whether it is counted in milliseconds.
    #[inline(always)]
    pub(crate) const fn is_in_ms(self) -> bool {
        !matches!(self, Preset::Number(_, Unit::Seconds))
    }
}

/// Part of a conjunction: true when `image[word] & mask == state`.
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
    /// Pushes whether the timer in this row of [`Program::timers`](super::Program::timers) has run out.
    Elapsed(u16),
    /// Pops a Boolean and pushes whether it is True and the timer in this row of [`Program::timers`](super::Program::timers)
    /// has run out; only then is it asked for.
    AndElapsed(u16),
    /// Pops a preset and pushes `T/Xn/preset` for a step (or macro step) bit standing alone, when the preset is
    /// calculated.
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

/// `↑` and `↓` of all Booleans of one word, inputs, in a program that does not evolve `stable`. Words of the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Edges {
    /// What is watched.
    pub word: u16,
    /// What it was in the scan before.
    pub last: u16,
    /// The rising edges.
    pub rises: Option<Seen>,
    /// The falling edges.
    pub falls: Option<Seen>,
}

/// Where edges are seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Seen {
    /// Word of the image.
    pub word: u16,
    /// Those of its bits that somebody reads.
    pub bits: u32,
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
