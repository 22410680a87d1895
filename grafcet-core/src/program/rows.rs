//! The rows of the tables: graphs, steps, transitions, orders and statements.

use super::{Armed, Bit, Code, Condition, Course, Number, Run, Since, Slot, Stamp};

/// A graph: a run of steps, a run of transitions and the words of its situation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Graph {
    /// Rows of [`Program::steps`](super::Program::steps). Step `i` of the run is bit `i` of the graph's situation words.
    pub steps: Run,
    /// The first of [`Graph::words`].
    pub first_word: u16,
    /// Rows of [`Program::transitions`](super::Program::transitions).
    pub transitions: Run,
    /// First word in [`Program::situations`](super::Program::situations) of the initial situation.
    pub initial: u16,
    /// Row of [`Program::roles`](super::Program::roles): what few graphs have. Row 0 is that of a graph that has none of it.
    pub role: u16,
}

impl Graph {
    /// Words of the image with the situation, used by this graph alone: as many as its steps need.
    #[must_use]
    #[inline(always)]
    pub const fn words(&self) -> Run {
        Run {
            start: self.first_word,
            len: self.steps.len.div_ceil(32),
        }
    }
}

/// What a graph is among others: what encloses it, what its stand-alone actions force; and what it begins by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Role {
    /// Rows of [`Program::arms`](super::Program::arms): its transitions without entrance steps.
    pub sources: Run,
    /// Rows of [`Program::enclosings`](super::Program::enclosings): the steps that enclose this graph; empty for a graph of its own.
    pub enclosings: Run,
    /// Rows of [`Program::orders`](super::Program::orders): forcing by its stand-alone actions, other graphs only.
    pub orders: Run,
    /// Rows of [`Program::orders`](super::Program::orders): forcing of itself by its stand-alone actions.
    pub self_orders: Run,
    /// Rows of [`Program::watches`](super::Program::watches): edges and timers in the forcing conditions of this graph, self-forcing excepted.
    pub watches: Run,
    /// Rows of [`Program::watches`](super::Program::watches): edges and timers in the conditions of its self-forcing.
    pub self_watches: Run,
}

impl Role {
    /// A graph of its own that forces none and has no transition without entrance.
    pub const NONE: Role = Role {
        sources: Run::EMPTY,
        enclosings: Run::EMPTY,
        orders: Run::EMPTY,
        self_orders: Run::EMPTY,
        watches: Run::EMPTY,
        self_watches: Run::EMPTY,
    };
}

/// A step: what it arms and what it does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Step {
    /// First row of [`Step::arms`].
    pub first_arm: u16,
    /// First row of [`Step::momentary`].
    pub first_momentary: u16,
    /// Row of [`Program::duties`](super::Program::duties): what else it does. Row 0 is that of a step that does nothing else.
    pub duties: u16,
    /// How many [`Step::arms`] it has.
    pub arm_count: u8,
    /// How many [`Step::momentary`] statements it has.
    pub momentary_count: u8,
}

impl Step {
    /// Rows of [`Program::arms`](super::Program::arms): transitions that have this step as their first entrance step.
    #[must_use]
    #[inline(always)]
    pub const fn arms(&self) -> Run {
        Run {
            start: self.first_arm,
            len: self.arm_count as u16,
        }
    }

    /// Rows of [`Program::momentary`](super::Program::momentary): statements that depend on no momentary variable.
    #[must_use]
    #[inline(always)]
    pub const fn momentary(&self) -> Run {
        Run {
            start: self.first_momentary,
            len: self.momentary_count as u16,
        }
    }
}

/// What a step does beside momentary actions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Duties {
    /// Rows of [`Program::stored`](super::Program::stored): statements without `on`.
    pub stored: Run,
    /// Rows of [`Program::stored`](super::Program::stored): `on activation`.
    pub on_activation: Run,
    /// Rows of [`Program::stored`](super::Program::stored): `on deactivation`.
    pub on_deactivation: Run,
    /// Rows of [`Program::events`](super::Program::events): `on event`.
    pub on_event: Run,
    /// Rows of [`Program::orders`](super::Program::orders): forcing by this step.
    pub orders: Run,
    /// Where its time of activation is kept, when a timer reads it.
    pub activated: Option<Stamp>,
    /// The same for timers that are asked for only while it is active.
    pub since: Option<Since>,
}

/// A macro step: its bit is True while any step of its expansion is active.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Macro {
    /// The step bit `XM5`.
    pub bit: Bit,
    /// The graph it belongs to.
    pub graph: u16,
    /// Rows of [`Program::steps`](super::Program::steps): its expansion, nested expansions included.
    pub steps: Run,
    /// Where its time of activation is kept, when a timer reads it.
    pub activated: Option<Stamp>,
}

/// 32 steps of one graph, or its last ones: those that share a word of the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Block {
    /// Row of [`Program::steps`](super::Program::steps): the step that is the lowest bit.
    pub first: u16,
    /// Row of [`Program::masks`](super::Program::masks): which of its steps do something beside momentary actions.
    pub masks: u16,
    /// The steps that have momentary actions.
    pub momentary: u32,
}

/// Which steps of a word do something beside momentary actions, and whose of those have conditions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Masks {
    /// The steps whose time of activation is kept.
    pub timed: u32,
    /// The steps that have stored statements without `on`.
    pub stored: u32,
    /// The steps that have statements `on activation`.
    pub on_activation: u32,
    /// The steps that have statements `on deactivation`.
    pub on_deactivation: u32,
    /// The steps that have statements `on event`.
    pub on_event: u32,
    /// The steps that force.
    pub forcing: u32,
    /// The steps that have momentary actions with conditions.
    pub varying: u32,
}

impl Masks {
    /// None does anything.
    pub const NONE: Masks = Masks {
        timed: 0,
        stored: 0,
        on_activation: 0,
        on_deactivation: 0,
        on_event: 0,
        forcing: 0,
        varying: 0,
    };
}

/// What groups of words of steps do: eight neighbouring words are a group, and have a bit in each of these masks when one
/// of their steps does it. For 32 neighbouring groups.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Actors {
    /// The groups in which a step has momentary actions.
    pub momentary: u32,
    /// Those in which a step does something else.
    pub masks: Masks,
}

/// A transition as its first entrance step sees it, or as its graph does when it has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Arm {
    /// Row of [`Program::transitions`](super::Program::transitions).
    pub transition: u16,
    /// Which step the transition enters, when the step that arms it stands in a sequence.
    pub course: Course,
    /// What that step shows, when it stands in a sequence: [`Arm::SHOWS_NOTHING`], [`Arm::SHOWS_MORE`], or the row of
    /// [`Program::targets`](super::Program::targets), counted from 1, that it shows whatever holds.
    pub shows: u8,
    /// What is armed behind the transition, when the step stands in a sequence.
    pub next: Armed,
}

/// A transition.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Transition {
    /// Row of [`Program::conditions`](super::Program::conditions): when it fires while its first entrance step is
    /// active - the other entrance steps, and the trigger. The terms go on behind the first one.
    pub fires: u16,
    /// Row of [`Program::terms`](super::Program::terms): the first term of all that it asks for beside that step.
    pub term: u16,
    /// Row of [`Program::crossings`](super::Program::crossings): what firing does.
    pub crossing: u16,
}

/// The steps that a transition leaves and enters, and what it does on the way. Most transitions of a program share these.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Crossing {
    /// In a graph whose steps share one word.
    Within {
        /// Row of [`Program::do_blocks`](super::Program::do_blocks). Row 0 is that of a transition without one.
        actions: u16,
        /// The entrance steps.
        leaves: u32,
        /// The exit steps.
        enters: u32,
    },
    /// In a graph with more steps.
    Across {
        /// The same.
        actions: u16,
        /// Rows of [`Program::links`](super::Program::links): the entrance steps.
        entrance: Run,
        /// Rows of [`Program::links`](super::Program::links): the exit steps.
        exit: Run,
    },
}

impl Crossing {
    /// Stays where it is: what a row means that is not there, which no row of a checked program is.
    pub(crate) const NONE: Crossing = Crossing::Within {
        actions: 0,
        leaves: 0,
        enters: 0,
    };

    /// Its `do` block.
    #[must_use]
    #[inline(always)]
    pub const fn actions(self) -> usize {
        match self {
            Crossing::Within { actions, .. } | Crossing::Across { actions, .. } => actions as usize,
        }
    }
}

/// A step that encloses a graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Enclosing {
    /// The enclosing step.
    pub step: Bit,
    /// First word in [`Program::situations`](super::Program::situations) of the set that its activation gives.
    pub situation: u16,
    /// For an initial step, first word in [`Program::situations`](super::Program::situations) of what the graph takes in scan 0: its own initial
    /// steps, or the set when it has none.
    pub at_start: Option<u16>,
}

/// A forcing statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Order {
    /// The graph that is forced.
    pub graph: u16,
    /// The graph that forces.
    pub by: u16,
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
    /// The set whose words start there in [`Program::situations`](super::Program::situations); `{I}` and `{}` too.
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
    /// Rows of [`Program::stored`](super::Program::stored).
    pub stored: Run,
}

/// A momentary statement: its variables are True while its owner is active and the condition holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Momentary {
    /// Rows of [`Program::targets`](super::Program::targets): the variables.
    pub targets: Run,
    /// Row of [`Program::conditions`](super::Program::conditions): the condition behind `IF`.
    pub condition: u16,
}

/// Variables of one word of the image that become True together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Target {
    /// Word of the image.
    pub word: u16,
    /// Its bits.
    pub mask: u32,
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
