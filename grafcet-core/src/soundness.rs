//! What every table of a program promises, checked once, at build time.
//!
//! The engine follows indices without looking twice. `build.rs` therefore writes
//! `const _: () = grafcet_core::soundness::demand(&PROGRAM)` beside the tables it generates: a table that points
//! outside another one, a bit outside the image or code that needs more stack than there is does not build.
//! Everything here is a `const fn` and linear in the size of the program.

mod actors;
mod asked;
mod code;
mod exchange;
mod rows;
mod sequence;
mod structure;

use crate::program::{Bit, Evolution, Number, Program, Run, Slot, Stamp};

/// The first table that breaks its promise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unsound {
    /// Scan period, number of stamps or places in the image.
    Layout,
    /// A number's first value lies outside its limits, or there are not as many rows as numbers.
    Numbers,
    /// A conjunction looks outside the image, or for a bit that it masks out.
    Terms,
    /// The graphs do not share out steps, transitions and situation words among themselves, each its own.
    Graphs,
    /// The hierarchy does not name every graph once.
    Hierarchy,
    /// A step points outside a table.
    Steps,
    /// What groups of steps do is said otherwise.
    Actors,
    /// A macro step points outside its graph.
    Macros,
    /// A transition joins what is no step of its graph, or points outside a table.
    Transitions,
    /// A `do` block points outside the stored statements, or the first one holds any.
    DoBlocks,
    /// A condition asks for what is not there, or the first one for anything.
    Conditions,
    /// A timer waits for what is not there.
    Timers,
    /// The code of a condition is cut off, takes what is not there or needs more stack than there is.
    Codes,
    /// An arm names a term that is not there, or a transition that does not leave the step that arms it.
    Arms,
    /// A situation is exchanged before a trigger reads it.
    Exchange,
    /// An arm says wrongly how it goes on behind its step.
    Sequences,
    /// What a step does beside momentary actions points outside a table, or row 0 does something.
    Duties,
    /// Row 0 of what few graphs have is not none of it.
    Roles,
    /// An enclosing step is none, or its set is no set of steps of the graph.
    Enclosings,
    /// An order is for a graph that is not there, or for a set that is no set of its steps.
    Orders,
    /// A stored statement writes what it must not.
    Stored,
    /// An event points outside the image or the stored statements.
    Events,
    /// A momentary statement writes what it must not.
    Momentary,
    /// An edge or a timer remembers outside the memory.
    Watches,
    /// A bit that is True at first, or a retained value, is none that can be written.
    FirstValues,
}

impl Unsound {
    /// What is said when the build stops.
    #[must_use]
    pub const fn message(self) -> &'static str {
        match self {
            Unsound::Layout => "the layout of the program is unsound",
            Unsound::Numbers => "the table of numbers is unsound",
            Unsound::Terms => "the table of conjunctions is unsound",
            Unsound::Graphs => "the table of graphs is unsound",
            Unsound::Hierarchy => "the hierarchy of the graphs is unsound",
            Unsound::Steps => "the table of steps is unsound",
            Unsound::Actors => "the table of what groups of steps do is unsound",
            Unsound::Macros => "the table of macro steps is unsound",
            Unsound::Transitions => "the table of transitions is unsound",
            Unsound::DoBlocks => "the table of `do` blocks is unsound",
            Unsound::Conditions => "the table of conditions is unsound",
            Unsound::Timers => "the table of timers on steps is unsound",
            Unsound::Codes => "the code of the conditions is unsound",
            Unsound::Arms => "the table of armed transitions is unsound",
            Unsound::Exchange => "a situation is exchanged before it is read",
            Unsound::Sequences => "the sequences in the table of armed transitions are unsound",
            Unsound::Duties => "the table of what steps do is unsound",
            Unsound::Roles => "the table of what few graphs have is unsound",
            Unsound::Enclosings => "the table of enclosings is unsound",
            Unsound::Orders => "the table of forcing orders is unsound",
            Unsound::Stored => "the table of stored statements is unsound",
            Unsound::Events => "the table of events is unsound",
            Unsound::Momentary => "the tables of momentary statements are unsound",
            Unsound::Watches => "the table of edges and timers is unsound",
            Unsound::FirstValues => "the tables of first and retained values are unsound",
        }
    }
}

/// Stops the build (or, outside a constant, panics) when a table of the program is unsound.
///
/// A sound program builds:
///
/// ```
/// # use grafcet_core::program::{Evolution, Layout, Program, Run};
/// # use grafcet_core::soundness::demand;
/// # const LAYOUT: Layout = Layout {
/// #     words: 1, inputs: Run::EMPTY, situations: Run::EMPTY, macros: Run::EMPTY, momentary: Run::EMPTY,
/// #     number_inputs: Run::EMPTY, outside: Run::EMPTY, numbers: 0, stamps: 0, since: 0, stack: 0, fired: 0, passed: 0,
/// #     remembered: 0, standings: 0, shown: 0, sets: 0, armed: 0, before: 0,
/// # };
/// # const EMPTY: Program<'static> = Program {
/// #     period_ms: 10, evolution: Evolution::Scan, fingerprint: 0, layout: LAYOUT, read_inputs: &[], reads_first_scan: false, crosses_at_once: false, marks_all: true, graphs: &[], roles: &[], hierarchy: &[],
/// #     blocks: &[], masks: &[], actors: &[], steps: &[], duties: &[], macros: &[], transitions: &[], crossings: &[], do_blocks: &[], links: &[], arms: &[],
/// #     situations: &[], enclosings: &[], orders: &[], sources: &[], lasting_in_steps: false,
/// #     momentary_varies: false, stores_on_change: false, stored: &[], events: &[], always_stored: Run::EMPTY, targets: &[], momentary: &[], always_momentary: Run::EMPTY,
/// #     dependent: &[], edges: &[], watches: &[], trigger_watches: Run::EMPTY, round_watches: Run::EMPTY,
/// #     action_watches: Run::EMPTY, conditions: &[], terms: &[], timers: &[], codes: &[], ops: &[], numbers: &[],
/// #     initially_true: &[], retained: &[],
/// # };
/// static PROGRAM: Program<'static> = Program { hierarchy: &[], ..EMPTY };
/// const _: () = demand(&PROGRAM);
/// ```
///
/// One with a damaged table, here a hierarchy of a graph that is not there, does not:
///
/// ```compile_fail,E0080
/// # use grafcet_core::program::{Evolution, Layout, Program, Run};
/// # use grafcet_core::soundness::demand;
/// # const LAYOUT: Layout = Layout {
/// #     words: 1, inputs: Run::EMPTY, situations: Run::EMPTY, macros: Run::EMPTY, momentary: Run::EMPTY,
/// #     number_inputs: Run::EMPTY, outside: Run::EMPTY, numbers: 0, stamps: 0, since: 0, stack: 0, fired: 0, passed: 0,
/// #     remembered: 0, standings: 0, shown: 0, sets: 0, armed: 0, before: 0,
/// # };
/// # const EMPTY: Program<'static> = Program {
/// #     period_ms: 10, evolution: Evolution::Scan, fingerprint: 0, layout: LAYOUT, read_inputs: &[], reads_first_scan: false, crosses_at_once: false, marks_all: true, graphs: &[], roles: &[], hierarchy: &[],
/// #     blocks: &[], masks: &[], actors: &[], steps: &[], duties: &[], macros: &[], transitions: &[], crossings: &[], do_blocks: &[], links: &[], arms: &[],
/// #     situations: &[], enclosings: &[], orders: &[], sources: &[], lasting_in_steps: false,
/// #     momentary_varies: false, stores_on_change: false, stored: &[], events: &[], always_stored: Run::EMPTY, targets: &[], momentary: &[], always_momentary: Run::EMPTY,
/// #     dependent: &[], edges: &[], watches: &[], trigger_watches: Run::EMPTY, round_watches: Run::EMPTY,
/// #     action_watches: Run::EMPTY, conditions: &[], terms: &[], timers: &[], codes: &[], ops: &[], numbers: &[],
/// #     initially_true: &[], retained: &[],
/// # };
/// static PROGRAM: Program<'static> = Program { hierarchy: &[0], ..EMPTY };
/// const _: () = demand(&PROGRAM);
/// ```
///
/// # Panics
/// With [`Unsound::message`]; firmware calls it in constants only.
pub const fn demand(program: &Program<'_>) {
    if let Some(unsound) = program.unsoundness() {
        panic!("{}", unsound.message());
    }
}

impl Program<'_> {
    /// True when no index of any table leads outside another one, nothing writes where it must not, and all code
    /// gets by with the stack of the layout.
    #[must_use]
    pub const fn is_sound(&self) -> bool {
        self.unsoundness().is_none()
    }

    /// The first table that is not.
    #[must_use]
    pub const fn unsoundness(&self) -> Option<Unsound> {
        // What the later tables rely on comes first.
        if !self.layout_is_sound() {
            Some(Unsound::Layout)
        } else if !self.numbers_are_sound() {
            Some(Unsound::Numbers)
        } else if !self.terms_are_sound() {
            Some(Unsound::Terms)
        } else if !self.timers_are_sound() {
            Some(Unsound::Timers)
        } else if !self.codes_are_sound() {
            Some(Unsound::Codes)
        } else if !self.conditions_are_sound() {
            Some(Unsound::Conditions)
        } else if !self.do_blocks_are_sound() {
            Some(Unsound::DoBlocks)
        } else if !self.roles_are_sound() {
            Some(Unsound::Roles)
        } else if !self.graphs_are_sound() {
            Some(Unsound::Graphs)
        } else if !self.hierarchy_is_sound() {
            Some(Unsound::Hierarchy)
        } else if !self.arms_are_sound() {
            Some(Unsound::Arms)
        } else if !self.duties_are_sound() {
            Some(Unsound::Duties)
        } else if !self.steps_are_sound() {
            Some(Unsound::Steps)
        } else if !self.actors_are_sound() {
            Some(Unsound::Actors)
        } else if !self.macros_are_sound() {
            Some(Unsound::Macros)
        } else if !self.transitions_are_sound() {
            Some(Unsound::Transitions)
        } else if !self.arms_are_of_their_steps() {
            Some(Unsound::Arms)
        } else if !self.enclosings_are_sound() {
            Some(Unsound::Enclosings)
        } else if !self.orders_are_sound() {
            Some(Unsound::Orders)
        } else if !self.stored_are_sound() {
            Some(Unsound::Stored)
        } else if !self.events_are_sound() {
            Some(Unsound::Events)
        } else if !self.momentary_are_sound() {
            Some(Unsound::Momentary)
        } else if !self.edges_are_sound() || !self.watches_are_sound() {
            Some(Unsound::Watches)
        } else if self.crosses_at_once && !self.can_cross_at_once() {
            Some(Unsound::Exchange)
        } else if !self.sequences_are_sound() {
            Some(Unsound::Sequences)
        } else if !self.first_values_are_sound() {
            Some(Unsound::FirstValues)
        } else {
            None
        }
    }

    const fn layout_is_sound(&self) -> bool {
        let layout = &self.layout;
        // Word 0 belongs to `System:`; what is read in, what steps hold and what is cleared must not share words.
        let owned = [
            layout.inputs,
            layout.situations,
            layout.macros,
            layout.momentary,
            layout.outside,
        ];
        let mut i = 0;
        while i < owned.len() {
            let run = owned[i];
            if !run.is_within(layout.words as usize) || (run.len > 0 && run.start == 0) {
                return false;
            }
            let mut j = 0;
            while j < i {
                if run.meets(owned[j]) {
                    return false;
                }
                j += 1;
            }
            i += 1;
        }
        self.period_ms >= 1
            && self.read_inputs.len() == layout.inputs.len as usize
            && layout.words >= 1
            && layout.number_inputs.is_within(layout.numbers as usize)
            && (layout.number_inputs.len == 0
                || layout.number_inputs.start > Number::ARITHMETIC_FAULTS.0)
            && layout.outside.len as usize * 32 >= layout.number_inputs.len as usize
            && (self.marks_all || !self.asks_what_fired())
            && (layout.fired as usize * 32 >= self.transitions.len()
                || (layout.fired == 0 && !self.marks_all && self.links.is_empty()))
            && (layout.before as usize == layout.situation_words()
                || (layout.before == 0 && !self.asks_what_was_active()))
            && match self.evolution {
                Evolution::Scan => layout.passed == 0,
                Evolution::Stable => layout.passed == layout.fired,
            }
            && layout.standings as usize
                == if self.orders.is_empty() && self.enclosings.is_empty() {
                    0
                } else {
                    self.graphs.len()
                }
            && layout.shown
                == if layout.momentary.len > 1 {
                    layout.momentary.len
                } else {
                    0
                }
            && (layout.armed == 0
                || layout.with_armed().armed == layout.armed
                    && layout.with_armed().words == layout.words)
            && (layout.sets == 0 || layout.sets as usize == layout.set_words())
            && layout.remembered as usize
                == if self.enclosings.is_empty() && matches!(self.evolution, Evolution::Scan) {
                    0
                } else {
                    layout.situation_words()
                }
            && self.blocks.len() == layout.situations.len as usize
            && self.always_stored.is_within(self.stored.len())
            && self.always_momentary.is_within(self.momentary.len())
            && self.trigger_watches.is_within(self.watches.len())
            && self.round_watches.is_within(self.watches.len())
            && self.action_watches.is_within(self.watches.len())
    }

    const fn bit_is_sound(&self, bit: Bit) -> bool {
        bit.word() < self.layout.words as usize
    }

    /// Whether a statement, an edge or a timer may write the bit: no input, step, momentary variable or `System:` bit.
    const fn bit_is_stored(&self, bit: Bit) -> bool {
        let layout = &self.layout;
        self.bit_is_sound(bit)
            && bit.0 > Bit::RECOVERED.0
            && !layout.inputs.holds(bit.word())
            && !layout.situations.holds(bit.word())
            && !layout.macros.holds(bit.word())
            && !layout.momentary.holds(bit.word())
            && !layout.outside.holds(bit.word())
    }

    /// Whether a statement may write the number: no input and no `System:` number.
    const fn number_is_stored(&self, number: Number) -> bool {
        number.0 < self.layout.numbers
            && number.0 > Number::ARITHMETIC_FAULTS.0
            && !self.layout.number_inputs.holds(number.0 as usize)
    }

    /// Whether a statement of either kind may write the slot.
    const fn slot_is_written(&self, slot: Slot) -> bool {
        match slot {
            Slot::Bit(bit) => self.bit_is_stored(bit) || self.layout.momentary.holds(bit.word()),
            Slot::Number(number) => self.number_is_stored(number),
        }
    }

    /// Whether the bit is a step's.
    const fn bit_is_step(&self, bit: Bit) -> bool {
        self.layout.situations.holds(bit.word())
    }

    const fn stamp_is_sound(&self, stamp: Stamp) -> bool {
        stamp.0 < self.layout.stamps
    }

    const fn optional_stamp_is_sound(&self, stamp: Option<Stamp>) -> bool {
        match stamp {
            Some(stamp) => self.stamp_is_sound(stamp),
            None => true,
        }
    }
}

impl Run {
    const fn end(self) -> usize {
        self.start as usize + self.len as usize
    }

    const fn is_within(self, rows: usize) -> bool {
        self.end() <= rows
    }

    const fn holds(self, index: usize) -> bool {
        index >= self.start as usize && index < self.end()
    }

    const fn meets(self, other: Run) -> bool {
        self.len > 0
            && other.len > 0
            && (self.start as usize) < other.end()
            && (other.start as usize) < self.end()
    }
}

#[cfg(test)]
mod tests;
