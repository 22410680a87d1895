//! Edges and timers that remember: evaluated in every scan where they stand (`semantics.md`, "Edges", "Timers").

use crate::engine::Engine;
use crate::memory::{Memory, NEVER};
use crate::program::{Bit, Code, Compiled, Edge, Edges, Run, Seen, Stamp, Unit, Watch};
use crate::walk::{Visit, each};

/// Which evaluation of the watches it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pass {
    /// Scan 0: memories are primed, and edges are False but for those of a step that was just activated.
    Start,
    /// The first (or only) round of a scan.
    First,
    /// A later round of a scan that evolves `stable`: edges are False and keep the memory of the first.
    Later,
}

impl<P: Compiled, M: Memory> Engine<P, M> {
    /// Evaluates watches in their order, so that an inner one is up to date for the one around it.
    #[inline(always)]
    pub(crate) fn watch(&mut self, watches: Run, pass: Pass) {
        let tables = self.tables;
        if let Some(watches) = watches.some(tables.program().watches) {
            each::<P, Watch>(watches, &mut Watching { engine: self, pass });
        }
    }

    /// Compares the words of inputs with those of the scan before.
    #[inline(always)]
    pub(crate) fn watch_inputs(&mut self, pass: Pass) {
        let tables = self.tables;
        each::<P, Edges>(tables.program().edges, &mut Watching { engine: self, pass });
    }

    /// Stores the edges of inputs. They are over in the next scan.
    #[inline(always)]
    fn put_edges(&mut self, seen: Option<Seen>, edges: u32) {
        if let Some(Seen { word, bits }) = seen {
            self.memory.put_word(usize::from(word), edges & bits);
            if edges & bits != 0 {
                self.note_change();
            }
        }
    }

    #[inline(always)]
    fn evaluate(&mut self, watch: &Watch, pass: Pass) -> (bool, Bit) {
        match watch {
            Watch::Edge {
                operand,
                edge,
                last,
                result,
                from_false,
            } => {
                let now = self.holds(operand);
                if pass == Pass::Later {
                    return (false, *result);
                }
                let was = self.exchange(*last, now);
                let seen = match edge {
                    Edge::Rising => now && !was,
                    Edge::Falling => was && !now,
                };
                (seen && (pass == Pass::First || *from_false), *result)
            }
            Watch::Timer {
                enable,
                preset,
                unit,
                last,
                risen,
                result,
            } => {
                let enable = self.holds(enable);
                let preset = self.value_of(*preset);
                let risen = self.follow(enable, *last, *risen);
                (self.elapsed(risen, preset, *unit), *result)
            }
            Watch::OnDelay {
                enable,
                delay,
                last,
                risen,
                result,
            } => {
                let enable = self.holds(enable);
                let delay = self.value_of(*delay);
                let risen = self.follow(enable, *last, *risen);
                let passed = self.elapsed(risen, delay, Unit::Milliseconds);
                (enable && passed, *result)
            }
            Watch::OffDelay {
                on,
                hold,
                last,
                fallen,
                result,
            } => {
                let on = self.holds(on);
                let held = self.hold(on, *hold, *last, *fallen);
                (on || held, *result)
            }
            Watch::Value {
                condition,
                gate,
                result,
            } => {
                // Nothing is armed in scan 0, an event no more than a transition.
                let open = gate.is_none_or(|gate| pass != Pass::Start && self.memory.bit(gate));
                (open && self.holds(condition), *result)
            }
        }
    }

    /// Notes the time when the enable rises, and gives the time of its latest rise.
    fn follow(&mut self, enable: bool, last: Bit, risen: Stamp) -> u64 {
        if enable && !self.exchange(last, enable) {
            self.memory.set_stamp(risen, self.now_ms);
        } else if !enable {
            self.set_bit(last, false);
        }
        self.memory.stamp(risen)
    }

    /// Notes the time when `on` falls, and tells whether less than `hold` has passed since.
    fn hold(&mut self, on: bool, hold: Code, last: Bit, fallen: Stamp) -> bool {
        let hold = self.value_of(hold);
        if self.exchange(last, on) && !on {
            self.memory.set_stamp(fallen, self.now_ms);
        }
        let fallen = self.memory.stamp(fallen);
        fallen != NEVER && !self.elapsed(fallen, hold, Unit::Milliseconds)
    }

    /// Stores a memory bit and gives what it was.
    fn exchange(&mut self, last: Bit, now: bool) -> bool {
        let was = self.memory.bit(last);
        self.set_bit(last, now);
        was
    }
}

/// Evaluates watches.
struct Watching<'e, P, M> {
    engine: &'e mut Engine<P, M>,
    pass: Pass,
}

impl<P: Compiled, M: Memory> Visit<Watch> for Watching<'_, P, M> {
    #[inline(always)]
    fn row(&mut self, watch: &Watch) {
        let (value, result) = self.engine.evaluate(watch, self.pass);
        self.engine.set_bit(result, value);
    }
}

impl<P: Compiled, M: Memory> Visit<Edges> for Watching<'_, P, M> {
    #[inline(always)]
    fn row(&mut self, row: &Edges) {
        let now = self.engine.memory.word(usize::from(row.word));
        let was = match self.pass {
            Pass::Start => now,
            Pass::First | Pass::Later => self.engine.memory.word(usize::from(row.last)),
        };
        self.engine.memory.put_word(usize::from(row.last), now);
        self.engine.put_edges(row.rises, now & !was);
        self.engine.put_edges(row.falls, was & !now);
    }
}
