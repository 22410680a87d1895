//! A compiled program: the one lowered form that is verified, simulated and executed.
//!
//! Rows refer to each other by index and to runs of rows by [`Run`]. All Booleans of a program - inputs, steps,
//! variables, the results of edges and timers - are bits of one image, so that a conjunction of any of them is a
//! comparison of masked words. All numbers are slots of one array.

mod expression;
mod place;
mod rows;
mod sequence;

use crate::bits::set_bits_of;
use crate::sets::rows;
use crate::walk::loop_over_steps;

pub use crate::sets::GROUP;
pub use crate::walk::{Groups, VisitSteps};

pub use expression::{
    Code, Condition, Edge, Edges, Op, Preset, Rest, Seen, Term, Timer, Unit, Watch,
};
pub use place::{Bit, Number, Run, Since, Slot, Stamp};
pub use rows::{
    Actors, Arm, Assignment, Block, Crossing, Dependent, Duties, Enclosing, Event, Forced, Graph,
    Macro, Masks, Momentary, NumberRow, Order, Retained, Role, Step, Stored, Target, Transition,
};
pub(crate) use sequence::Taken;
pub use sequence::{Armed, Course};

/// How a program evolves within a scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Evolution {
    /// One firing a scan (`evolution scan`, the default).
    Scan,
    /// Rounds until nothing fires (`evolution stable`, IEC 60848).
    Stable,
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
    /// Steps of which is kept since when they are active.
    pub since: u16,
    /// Depth of the stack that the deepest code needs.
    pub stack: u16,
    /// Words with one bit for each transition; none when none is ever marked.
    pub fired: u16,
    /// Words with one bit for each transition that fired in an earlier round; none unless it evolves `stable`.
    pub passed: u16,
    /// Words with the situations and macro steps before the scan (round); none when nobody asks for them.
    pub before: u16,
    /// Words with the situations before the scan: none unless it evolves `stable` or a step encloses a graph.
    pub remembered: u16,
    /// Graphs whose standing in the hierarchy is kept; none when no graph forces or encloses another.
    pub standings: u16,
    /// Words of [`Layout::momentary`] that are kept to see whether they change; none when there is but one.
    pub shown: u16,
    /// Words of the sets of words that hold anything: a bit for eight words of transitions, behind them a bit for eight
    /// words of situations and macro steps. None in a small program.
    pub sets: u16,
    /// Words of situations of which it is kept what is armed in them: all, and so many behind them that they are whole
    /// groups of eight; none in a small program.
    pub armed: u16,
}

impl Layout {
    /// Words with the bits of steps and macro steps: what is remembered of the scan before.
    #[must_use]
    pub const fn situation_words(&self) -> usize {
        self.situations.len as usize + self.macros.len as usize
    }

    /// The same layout for a large program, in which it is kept what is armed.
    #[must_use]
    pub const fn with_armed(mut self) -> Self {
        self.armed = self.situations.len.next_multiple_of(GROUP as u16);
        let behind = self.situations.start.saturating_add(self.armed);
        let words = if behind > Armed::WORDS as u16 {
            behind
        } else {
            Armed::WORDS as u16
        };
        if words > self.words {
            self.words = words;
        }
        self
    }

    /// How many [`Layout::sets`] a large program needs.
    #[must_use]
    pub const fn set_words(&self) -> usize {
        rows(self.situation_words()) + rows(self.fired as usize)
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
    /// For each word of [`Layout::inputs`] the inputs that anybody reads. What happens to the others makes no scan
    /// differ from the one before.
    pub read_inputs: &'a [u32],
    /// Whether anybody reads `System:first_scan`.
    pub reads_first_scan: bool,
    /// Whether a word of situations can be exchanged as soon as its steps have been looked at: no trigger that is
    /// evaluated later reads it, and every transition belongs to it alone.
    pub crosses_at_once: bool,
    /// Whether it is noted of every transition that it fires: somebody asks for it. Otherwise it is of those of graphs with
    /// more than 32 steps.
    pub marks_all: bool,
    /// The graphs.
    pub graphs: &'a [Graph],
    /// What few graphs have; row 0 is none of it.
    pub roles: &'a [Role],
    /// Indices of the graphs in the order of phase 4: superiors first.
    pub hierarchy: &'a [u16],
    /// For each word of [`Layout::situations`], whose steps they are.
    pub blocks: &'a [Block],
    /// Which steps of a word do something beside momentary actions.
    pub masks: &'a [Masks],
    /// What groups of [`Program::blocks`] do, in a large program; in a small one there are no rows, and all may do anything.
    pub actors: &'a [Actors],
    /// The steps of all graphs.
    pub steps: &'a [Step],
    /// What steps do beside momentary actions; row 0 does nothing.
    pub duties: &'a [Duties],
    /// Macro steps, inner ones before outer ones.
    pub macros: &'a [Macro],
    /// The transitions of all graphs.
    pub transitions: &'a [Transition],
    /// What transitions do to situations.
    pub crossings: &'a [Crossing],
    /// Rows of `stored`: the `do` blocks of transitions; row 0 is empty.
    pub do_blocks: &'a [Run],
    /// Steps, counted from the first one of their graph: entrances and exits of the transitions of graphs with more than
    /// 32 steps.
    pub links: &'a [u16],
    /// Transitions: those that each step arms first, those of each graph without entrance.
    pub arms: &'a [Arm],
    /// Words of situations; a situation has as many as its graph.
    pub situations: &'a [u32],
    /// Steps that enclose graphs, for each enclosed graph in source order.
    pub enclosings: &'a [Enclosing],
    /// Forcing statements.
    pub orders: &'a [Order],
    /// Graphs that have transitions without entrance steps.
    pub sources: &'a [u16],
    /// Whether a step has stored statements without `on`.
    pub lasting_in_steps: bool,
    /// Whether a momentary action has a condition, so that momentary variables change while the situation stays.
    pub momentary_varies: bool,
    /// Whether a transition has a `do` block, or a step statements on its activation or deactivation.
    pub stores_on_change: bool,
    /// Stored statements.
    pub stored: &'a [Stored],
    /// `on event` statements.
    pub events: &'a [Event],
    /// Rows of `stored`: those of stand-alone actions.
    pub always_stored: Run,
    /// Variables of momentary statements.
    pub targets: &'a [Target],
    /// Momentary statements that depend on no momentary variable.
    pub momentary: &'a [Momentary],
    /// Rows of `momentary`: those of stand-alone actions.
    pub always_momentary: Run,
    /// Momentary statements that read momentary variables, each behind those it depends on.
    pub dependent: &'a [Dependent],
    /// Edges of inputs.
    pub edges: &'a [Edges],
    /// Edges and timers.
    pub watches: &'a [Watch],
    /// Rows of `watches`: those in triggers and events (phase 2).
    pub trigger_watches: Run,
    /// Rows of `watches`: those in `do` and `on` statements of a program that evolves `stable`.
    pub round_watches: Run,
    /// Rows of `watches`: those in all other actions (before phase 6).
    pub action_watches: Run,
    /// Conditions of transitions and momentary statements; row 0 always holds.
    pub conditions: &'a [Condition],
    /// Conjunctions.
    pub terms: &'a [Term],
    /// Timers on steps.
    pub timers: &'a [Timer],
    /// Where the code of conditions lies.
    pub codes: &'a [Code],
    /// Postfix code.
    pub ops: &'a [Op],
    /// Numbers with first values and limits.
    pub numbers: &'a [NumberRow],
    /// Booleans that are True before scan 0.
    pub initially_true: &'a [Bit],
    /// What survives power.
    pub retained: &'a [Retained],
}

impl Program<'_> {
    /// The entrance steps of a transition of a graph, as rows of [`Program::steps`], in source order.
    pub fn entrance_steps(
        &self,
        graph: &Graph,
        transition: &Transition,
    ) -> impl Iterator<Item = usize> + '_ {
        match self.crossing(transition) {
            Crossing::Within { leaves, .. } => self.steps_of(graph, leaves, Run::EMPTY),
            Crossing::Across { entrance, .. } => self.steps_of(graph, 0, entrance),
        }
    }

    /// The exit steps of a transition of a graph, likewise.
    pub fn exit_steps(
        &self,
        graph: &Graph,
        transition: &Transition,
    ) -> impl Iterator<Item = usize> + '_ {
        match self.crossing(transition) {
            Crossing::Within { enters, .. } => self.steps_of(graph, enters, Run::EMPTY),
            Crossing::Across { exit, .. } => self.steps_of(graph, 0, exit),
        }
    }

    /// What firing a transition does to the situation.
    #[must_use]
    #[inline(always)]
    pub fn crossing(&self, transition: &Transition) -> Crossing {
        let row = self.crossings.get(usize::from(transition.crossing));
        row.copied().unwrap_or(Crossing::NONE)
    }

    /// The statements of the `do` block of a transition.
    #[must_use]
    #[inline(always)]
    pub fn do_block(&self, transition: &Transition) -> Run {
        let run = self.do_blocks.get(self.crossing(transition).actions());
        run.copied().unwrap_or(Run::EMPTY)
    }

    /// A row of the conditions.
    #[must_use]
    #[inline(always)]
    pub fn condition(&self, row: u16) -> Condition {
        let condition = self.conditions.get(usize::from(row));
        condition.copied().unwrap_or(Condition::ALWAYS)
    }

    /// What a graph is among others.
    #[must_use]
    #[inline(always)]
    pub fn role(&self, graph: &Graph) -> &Role {
        self.roles
            .get(usize::from(graph.role))
            .unwrap_or(&Role::NONE)
    }

    /// Which steps of a word do something beside momentary actions.
    #[must_use]
    #[inline(always)]
    pub fn masks(&self, block: &Block) -> &Masks {
        self.masks
            .get(usize::from(block.masks))
            .unwrap_or(&Masks::NONE)
    }

    /// Of 32 neighbouring groups of words of steps those that do something.
    #[inline(always)]
    pub(crate) fn actors(&self, row: usize, which: impl Fn(&Actors) -> u32) -> u32 {
        self.actors.get(row).map_or(u32::MAX, which)
    }

    /// The graph to which a row of the transitions belongs.
    pub(crate) fn graph_of(&self, transition: usize) -> Option<&Graph> {
        let starts = |graph: &Graph| usize::from(graph.transitions.start) <= transition;
        let behind = self.graphs.partition_point(starts);
        self.graphs.get(behind.checked_sub(1)?)
    }

    fn steps_of(&self, graph: &Graph, mask: u32, links: Run) -> impl Iterator<Item = usize> + '_ {
        let first_step = usize::from(graph.steps.start);
        let linked = links.of(self.links).iter();
        let linked = linked.map(|place| usize::from(*place));
        let places = set_bits_of(mask).chain(linked);
        places.map(move |place| first_step + place)
    }

    /// What a step does beside momentary actions, if it does.
    pub(crate) fn duties_of(&self, step: &Step) -> Option<&Duties> {
        match step.duties {
            0 => None,
            row => self.duties.get(usize::from(row)),
        }
    }
}

/// Where an engine finds its program.
///
/// A reference to a [`Program`] will do anywhere. In an image it is a type without a value for which the compiler
/// knows the program: where its tables lie, how long they are, which are empty, is then known in the scan and not
/// looked up.
pub trait Compiled: Copy {
    /// Whether walks over rows are unrolled: fast, and long code, so for small programs only.
    const UNROLLED: bool = false;

    /// The program.
    fn program(&self) -> &Program<'_>;

    /// Whether firing exchanges steps of that word: none that a transition enters is active while it is armed, but one
    /// that it alone leaves. Then it does not matter in which order steps are left and entered (IEC 60848 rule 5).
    #[inline(always)]
    fn exchanges(&self, _place: usize) -> bool {
        false
    }

    /// Visits steps, word by word in source order.
    #[inline(always)]
    fn each_step(&self, visit: &mut impl VisitSteps) {
        let program = self.program();
        loop_over_steps(program.blocks, program.steps, visit);
    }
}

impl Compiled for &Program<'_> {
    #[inline(always)]
    fn program(&self) -> &Program<'_> {
        self
    }
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
