//! The engine five times: as it loops over programs; with what it keeps of large ones, the sets of words and what is
//! armed in each; the same without what it keeps for whoever looks on; and as it is written out in the image of a small
//! one, with and without that.

use grafcet_compiler::emit::{Walk, Word};
use grafcet_core::Engine;
use grafcet_core::program::{Actors, Bit, Compiled, Layout, Program, Slot, VisitSteps};
use grafcet_core::vectors::Vectors;

/// A host may leap over any time, an image scans periodically: so far at most, in ms.
const LEAP_MS: u64 = 1 << 29;

/// The same tables, as they are, with sets, with sets for an image in which nobody looks on, for such an image without
/// sets, and with the walk over them.
pub struct Tables<'t> {
    looped: [Program<'t>; 3],
    unwatched: Program<'t>,
    walk: Walk,
}

impl<'t> Tables<'t> {
    /// The tables with what their groups of words do.
    pub fn of(tables: Program<'t>, actors: &'t [Actors]) -> Self {
        let sets = u16::try_from(tables.layout.set_words()).unwrap_or(0);
        let layout = Layout {
            sets,
            ..tables.layout.with_armed()
        };
        let large = Program {
            layout,
            actors,
            ..tables
        };
        Tables {
            looped: [tables, large, large.unwatched()],
            unwatched: tables.unwatched(),
            walk: Walk::of(&tables),
        }
    }
}

/// A program that is walked over as the source of its image does it.
#[derive(Clone, Copy, Debug)]
struct WrittenOut<'t> {
    program: &'t Program<'t>,
    walk: &'t Walk,
}

impl Compiled for WrittenOut<'_> {
    const UNROLLED: bool = true;

    fn program(&self) -> &Program<'_> {
        self.program
    }

    fn exchanges(&self, place: usize) -> bool {
        self.walk.words[place].exchanges
    }

    fn each_step(&self, visit: &mut impl VisitSteps) {
        let blocks = self.program.blocks.iter().zip(&self.walk.words);
        for (place, (block, word)) in blocks.enumerate() {
            let steps = visit.choose(place, block);
            if !self.visit(visit, word, &word.alone, steps) {
                for chain in &word.chains {
                    self.visit(visit, word, chain, steps);
                }
            }
            visit.leave(place);
        }
    }
}

impl WrittenOut<'_> {
    /// Visits the first of these steps that is among those, if any is.
    fn visit(&self, visit: &mut impl VisitSteps, word: &Word, these: &[u32], steps: u32) -> bool {
        let bit = these.iter().find(|bit| steps >> **bit & 1 != 0);
        if let Some(bit) = bit {
            visit.step(&self.program.steps[usize::from(word.first) + *bit as usize]);
        }
        bit.is_some()
    }
}

/// Does the same with all engines.
macro_rules! each {
    ($twins:ident, $engine:ident => $what:expr) => {{
        for $engine in &mut $twins.looped {
            $what;
        }
        for $engine in $twins.written_out.iter_mut().flatten() {
            $what;
        }
    }};
}

/// Engines that are given the same.
pub struct Twins<'t> {
    looped: [Engine<&'t Program<'t>, Vectors>; 3],
    /// None behind a leap over a long time.
    written_out: Option<[Engine<WrittenOut<'t>, Vectors>; 2]>,
    time_ms: u64,
}

impl<'t> Twins<'t> {
    pub fn new(tables: &'t Tables<'t>) -> Self {
        let written_out = |program| {
            let walk = &tables.walk;
            let written_out = WrittenOut { program, walk };
            Engine::new(written_out, Vectors::new(program))
        };
        Twins {
            looped: tables
                .looped
                .each_ref()
                .map(|tables| Engine::new(tables, Vectors::new(tables))),
            written_out: Some([&tables.looped[0], &tables.unwatched].map(written_out)),
            time_ms: 0,
        }
    }

    /// The one whose traces are compared.
    pub fn first(&self) -> &Engine<&'t Program<'t>, Vectors> {
        &self.looped[0]
    }

    /// Whether the latest scan left the same in all.
    pub fn agree(&self) -> bool {
        let [one, other, unwatched] = &self.looped;
        are_alike(one, other)
            && one.numbers() == unwatched.numbers()
            && bits(one) == bits(unwatched)
            && self.written_out.as_ref().is_none_or(|[other, unwatched]| {
                are_alike(one, other)
                    && one.numbers() == unwatched.numbers()
                    && bits(one) == bits(unwatched)
            })
    }

    pub fn restore(&mut self, slot: Slot, value: i32) -> bool {
        let mut restored = false;
        each!(self, engine => restored |= engine.restore(slot, value));
        restored
    }

    pub fn set_recovered(&mut self, recovered: bool) {
        each!(self, engine => engine.set_recovered(recovered));
    }

    pub fn set_overruns(&mut self, overruns: u32) {
        each!(self, engine => engine.set_overruns(overruns));
    }

    pub fn set_parameter(&mut self, slot: Slot, value: i32) {
        each!(self, engine => engine.set_parameter(slot, value));
    }

    pub fn sample(&mut self, slot: Slot, value: i32) {
        each!(self, engine => engine.sample(slot, value));
    }

    pub fn start(&mut self) {
        each!(self, engine => engine.start());
    }

    /// False when it was an idle scan for all.
    pub fn scan(&mut self, time_ms: u64) -> bool {
        if time_ms - self.time_ms > LEAP_MS {
            self.written_out = None;
        }
        self.time_ms = time_ms;
        let mut scanned = false;
        each!(self, engine => scanned |= engine.scan(time_ms));
        scanned
    }
}

fn are_alike<P: Compiled, Q: Compiled>(
    one: &Engine<P, Vectors>,
    other: &Engine<Q, Vectors>,
) -> bool {
    let program = one.program();
    one.numbers() == other.numbers()
        && one.fired().eq(other.fired())
        && (0..program.graphs.len()).all(|graph| {
            one.graph_changed(graph) == other.graph_changed(graph)
                && one.steps_before(graph).eq(other.steps_before(graph))
                && one.graph_forced(graph) == other.graph_forced(graph)
        })
        && bits(one) == bits(other)
}

/// All Booleans, but for what nobody reads: `System:first_scan`, which an image does not keep then, and what inputs were
/// whose edges nobody asks for, which an idle scan does not look at.
fn bits<P: Compiled>(engine: &Engine<P, Vectors>) -> Vec<u32> {
    let mut words = engine.image().to_vec();
    if let Some(system) = words.first_mut()
        && !engine.program().reads_first_scan
    {
        *system &= !Bit::FIRST_SCAN.mask();
    }
    for edges in engine.program().edges {
        let read = [edges.rises, edges.falls].into_iter().flatten();
        let read = read.fold(0, |bits, seen| bits | seen.bits);
        if let Some(last) = words.get_mut(usize::from(edges.last)) {
            *last &= read;
        }
    }
    without_end(words)
}

/// Words without those at their end that hold nothing: the image of a large program has more of them.
fn without_end(mut words: Vec<u32>) -> Vec<u32> {
    let last = words.iter().rposition(|word| *word != 0);
    words.truncate(last.map_or(0, |last| last + 1));
    words
}
