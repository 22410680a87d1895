//! Conditions, values, and the edges and timers that remember.

use super::{Bit, Number, Run, Stamp};

/// A run of [`Op`]s in [`Program::ops`](super::Program::ops) that leaves one value.
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
