//! Triggers and firing (`semantics.md`, phases 2 and 3; IEC 60848 rules 2 to 5).

use core::hint::cold_path;

use crate::bits::{bits_in_word, set_bits_of};
use crate::engine::Engine;
use crate::memory::Memory;
use crate::program::{Arm, Armed, Block, Compiled, Crossing, Graph, Run, Step, Transition};
use crate::sets::{GROUP, Set, mark, rows};
use crate::walk::{Groups, Visit, VisitSteps, each};

impl<P: Compiled, M: Memory> Engine<P, M> {
    /// Marks every armed transition whose trigger is True, and tells whether there are any. The situations stay as
    /// they are meanwhile, so that all transitions see the same one; the next ones are made beside them.
    #[inline(always)]
    pub(crate) fn mark_fired(&mut self) -> Marked {
        let tables = self.tables;
        let program = tables.program();
        let mut marking = Marking {
            engine: self,
            marked: Marked {
                any: false,
                across: false,
                shows: false,
            },
            now: 0,
            change: 0,
            exchanges: false,
            enters: 0,
            only_arm: u16::MAX,
            armed: None,
        };
        tables.each_step(&mut marking);
        for graph in program.sources {
            if let Some(graph) = program.graphs.get(usize::from(*graph)) {
                marking.sources(graph);
            }
        }
        let mut marked = marking.marked;
        if program.marks_all
            && let [marks] = self.memory.store.fired()
        {
            marked.any = *marks != 0;
            marked.shows = marked.any;
        }
        marked
    }

    /// Whether a term holds.
    #[inline(always)]
    pub(crate) fn term_holds(&self, row: usize) -> bool {
        let tables = self.tables;
        let term = tables.program().terms.get(row);
        term.is_some_and(|term| term.holds(self.memory.store.image()))
    }

    /// A word of the situations of now.
    #[inline(always)]
    pub(crate) fn situation_word(&self, place: usize) -> u32 {
        let tables = self.tables;
        let first = usize::from(tables.program().layout.situations.start);
        self.memory.word(first + place)
    }

    /// Takes back all marks.
    #[inline(always)]
    pub(crate) fn clear_marks(&mut self) {
        if let [marks] = self.memory.store.fired_mut() {
            // Cheaper than a look whether it has to be.
            *marks = 0;
        } else if self.memory.has_sets() {
            for row in 0..rows(self.memory.store.fired().len()) {
                for bit in set_bits_of(self.memory.take_marked(row)) {
                    let mut marks = self.memory.store.fired_mut().chunks_mut(GROUP);
                    if let Some(marks) = marks.nth(row * 32 + bit) {
                        marks.fill(0);
                    }
                }
            }
        } else {
            self.memory.store.fired_mut().fill(0);
        }
    }

    /// Fires all marked transitions together: first every entrance step is left, then every exit step is entered, so
    /// that activation has priority (IEC 60848 rule 5). The situations before are kept.
    #[inline(always)]
    pub(crate) fn fire(&mut self, marked: Marked) {
        let tables = self.tables;
        let program = tables.program();
        // Of graphs of few steps the next situations are complete.
        if !program.links.is_empty() && marked.across {
            self.cross(Side::Entrance);
            self.cross(Side::Exit);
        }
        if !program.crosses_at_once {
            tables.each_step(&mut Exchanging { engine: self });
        }
    }

    /// Changes the next situation by the steps on one side of every marked transition of a graph with many steps.
    #[inline(never)]
    fn cross(&mut self, side: Side) {
        self.for_each_fired(|engine, row, transition| {
            let tables = engine.tables;
            let program = tables.program();
            let steps = match (program.crossing(transition), side) {
                (Crossing::Within { .. }, _) => return,
                (Crossing::Across { entrance, .. }, Side::Entrance) => entrance,
                (Crossing::Across { exit, .. }, Side::Exit) => exit,
            };
            if let Some(graph) = program.graph_of(row) {
                for step in steps.of(program.links) {
                    engine.change(graph, *step, side);
                }
            }
        });
    }

    /// Leaves or enters a step of a graph with many steps, all triggers having been evaluated.
    #[inline(never)]
    fn change(&mut self, graph: &Graph, step: u16, side: Side) {
        let tables = self.tables;
        let program = tables.program();
        let word = usize::from(graph.first_word) + usize::from(step / 32);
        let place = word.saturating_sub(usize::from(program.layout.situations.start));
        let next = match program.crosses_at_once {
            true => self.memory.store.image_mut().get_mut(word),
            false => self.memory.store.before_mut().get_mut(place),
        };
        if let Some(next) = next {
            let bit = 1 << (step % 32);
            *next = match side {
                Side::Entrance => *next & !bit,
                Side::Exit => *next | bit,
            };
            self.memory.put_armed(place, Armed::UNKNOWN);
            self.memory.enliven(place);
        }
    }

    /// Visits the transitions that fired in this round, in source order.
    pub(crate) fn for_each_fired(&mut self, mut visit: impl FnMut(&mut Self, usize, &Transition)) {
        let words = self.memory.store.fired().len();
        for row in 0..rows(words) {
            for group in Groups::of(row, self.memory.members(Set::Marked, row), words) {
                for word in group * GROUP..words.min((group + 1) * GROUP) {
                    if P::UNROLLED {
                        self.visit_marks(word, &mut visit);
                    } else {
                        self.visit_marks_apart(word, &mut visit);
                    }
                }
            }
        }
    }

    /// Visits the transitions of a word that fired in this round.
    #[inline(always)]
    fn visit_marks(&mut self, word: usize, visit: &mut impl FnMut(&mut Self, usize, &Transition)) {
        let tables = self.tables;
        let marks = self.memory.store.fired().get(word).copied().unwrap_or(0);
        for bit in set_bits_of(marks) {
            let row = word * 32 + bit;
            if let Some(transition) = tables.program().transitions.get(row) {
                visit(self, row, transition);
            }
        }
    }

    /// The same, kept apart, since a loop need not be written out in a loop.
    #[inline(never)]
    fn visit_marks_apart(
        &mut self,
        word: usize,
        visit: &mut impl FnMut(&mut Self, usize, &Transition),
    ) {
        self.visit_marks(word, visit);
    }

    /// Whether any transition of this round has fired.
    #[inline(always)]
    pub(crate) fn any_fired(&self) -> bool {
        self.memory.store.fired().iter().any(|word| *word != 0)
    }

    /// Takes back the firing of a graph whose own evolution is void.
    pub(crate) fn void_fired(&mut self, transitions: Run) {
        let indices = transitions.indices();
        for place in indices.start / 32..indices.end.div_ceil(32) {
            let run = bits_in_word(&indices, place);
            if let Some(word) = self.memory.store.fired_mut().get_mut(place) {
                *word &= !run;
            }
        }
    }
}

/// A side of a transition.
#[derive(Clone, Copy)]
enum Side {
    Entrance,
    Exit,
}

/// Which transitions are marked.
#[derive(Clone, Copy)]
pub(crate) struct Marked {
    /// Any.
    pub any: bool,
    /// One of a graph with more steps than a word has.
    pub across: bool,
    /// One behind which momentary actions may show something else.
    pub shows: bool,
}

/// What has become of the situation in a scan (round).
#[derive(Clone, Copy)]
pub(crate) struct Moved {
    /// A transition has fired, or a situation has changed.
    pub any: bool,
    /// Momentary actions may show something else.
    pub shows: bool,
}

/// Makes the next situations those of now, and those of now the ones before.
struct Exchanging<'e, P, M> {
    engine: &'e mut Engine<P, M>,
}

impl<P: Compiled, M: Memory> VisitSteps for Exchanging<'_, P, M> {
    #[inline(always)]
    fn groups(&self, row: usize) -> u32 {
        self.engine.memory.members(Set::Lively, row)
    }

    #[inline(always)]
    fn choose(&mut self, place: usize, _: &Block) -> u32 {
        let tables = self.engine.tables;
        let word = usize::from(tables.program().layout.situations.start) + place;
        let memory = &mut self.engine.memory;
        let now = memory.word(word);
        if let Some(next) = memory.store.before_mut().get_mut(place) {
            let next = core::mem::replace(next, now);
            memory.put_word(word, next);
        }
        0
    }

    #[inline(always)]
    fn step(&mut self, _: &Step) {}

    #[inline(always)]
    fn leave(&mut self, _: usize) {}
}

/// Looks at armed transitions.
pub(crate) struct Marking<'e, P, M> {
    pub(crate) engine: &'e mut Engine<P, M>,
    pub(crate) marked: Marked,
    /// The steps of the word that is being looked at.
    now: u32,
    /// Those of its steps that the marked transitions make active or inactive.
    change: u32,
    /// Whether they can do no more than exchange steps that are active for others.
    exchanges: bool,
    /// Those that they enter, which stay active whoever leaves them (IEC 60848 rule 5).
    enters: u32,
    /// The only arm of the latest step that has been looked at; no row when there is none.
    only_arm: u16,
    /// What is armed behind the transition that it fired, if it did.
    armed: Option<Armed>,
}

impl<P: Compiled, M: Memory> Marking<'_, P, M> {
    #[inline(always)]
    fn arms(&mut self, arms: Run) {
        let tables = self.engine.tables;
        if let Some(arms) = arms.some(tables.program().arms) {
            each::<P, Arm>(arms, self);
        }
    }

    /// Marks an armed transition whose trigger is True, and goes on with the next situation of its word.
    #[inline(always)]
    fn fires(&mut self, arm: &Arm, row: usize, transition: &Transition) {
        let tables = self.engine.tables;
        if !P::UNROLLED {
            self.armed = Some(arm.next);
        }
        let crossing = tables.program().crossing(transition);
        self.mark(row, matches!(crossing, Crossing::Across { .. }));
        let Crossing::Within { leaves, enters, .. } = crossing else {
            return;
        };
        if self.exchanges {
            // Every step that is left is active, and none that is entered; whatever else fires.
            self.change |= leaves ^ enters;
        } else {
            let next = self.now ^ self.change;
            let next = next & !(leaves & !self.enters) | enters;
            self.change = next ^ self.now;
            self.enters |= enters;
        }
    }

    #[inline(always)]
    pub(crate) fn mark(&mut self, transition: usize, across: bool) {
        let tables = self.engine.tables;
        let program = tables.program();
        // Otherwise it is known by the change: what changes nothing is as good as if it had not fired.
        if !P::UNROLLED || across || program.marks_all || !program.crosses_at_once {
            self.marked.any = true;
            self.marked.shows = true;
        }
        self.marked.across |= across;
        if !across && !program.marks_all {
            return;
        }
        let parts = self.engine.memory.store.following();
        mark(parts.fired, parts.sets, transition);
    }

    /// Gives a word its next situation, or puts it beside the word when others still read it.
    #[inline(always)]
    pub(crate) fn put_next(&mut self, place: usize, now: u32, next: u32) {
        let tables = self.engine.tables;
        let program = tables.program();
        let at_once = program.crosses_at_once;
        let memory = &mut self.engine.memory;
        if let Some(word) = memory.store.before_mut().get_mut(place) {
            *word = if at_once { now } else { next };
        }
        // In a walk that is written out mostly nothing changes.
        if at_once && (!P::UNROLLED || next != now) {
            memory.put_word(usize::from(program.layout.situations.start) + place, next);
        }
    }

    /// A transition without entrance steps is always armed while its graph is alive.
    fn sources(&mut self, graph: &Graph) {
        if !self.engine.is_alive(graph) {
            return;
        }
        let tables = self.engine.tables;
        self.enters = 0;
        self.exchanges = false;
        let program = tables.program();
        self.arms(program.role(graph).sources);
        let first = program.layout.situations.start;
        let place = usize::from(graph.first_word.saturating_sub(first));
        let memory = &mut self.engine.memory;
        if let Some(word) = memory.store.before_mut().get_mut(place) {
            *word |= self.enters;
            memory.put_armed(place, Armed::UNKNOWN);
            memory.enliven(place);
        }
    }
}

impl<P: Compiled, M: Memory> VisitSteps for Marking<'_, P, M> {
    #[inline(always)]
    fn is_apart(&self) -> bool {
        true
    }

    #[inline(always)]
    fn groups(&self, row: usize) -> u32 {
        self.engine.memory.members(Set::Lively, row)
    }

    #[inline(always)]
    fn follow(&mut self, groups: &mut Groups) -> Option<usize> {
        if P::UNROLLED || self.engine.memory.store.armed().is_empty() {
            return groups.next().map(|group| group * GROUP);
        }
        self.follow_sequences(groups)
    }

    #[inline(always)]
    fn follow_one(&mut self, place: usize) -> bool {
        self.follow_closer(place)
    }

    #[inline(always)]
    fn choose(&mut self, place: usize, _: &Block) -> u32 {
        self.now = self.engine.situation_word(place);
        self.exchanges = self.engine.tables.exchanges(place);
        self.change = 0;
        self.enters = 0;
        self.only_arm = u16::MAX;
        self.armed = None;
        self.now
    }

    #[inline(always)]
    fn step(&mut self, step: &Step) {
        if !P::UNROLLED && step.arm_count == 1 {
            self.only_arm = step.first_arm;
        }
        self.arms(step.arms());
    }

    #[inline(always)]
    fn leave(&mut self, place: usize) {
        let next = self.now ^ self.change;
        self.put_next(place, self.now, next);
        if P::UNROLLED {
            if next != self.now {
                cold_path();
                self.marked.any = true;
            }
        } else {
            let is_one = self.now & self.now.wrapping_sub(1) == 0;
            let armed = match (self.now | next, is_one) {
                (0, _) => Armed::NOTHING,
                (_, true) => self
                    .armed
                    .unwrap_or_else(|| self.engine.armed_alone(self.only_arm)),
                (_, false) => Armed::UNKNOWN,
            };
            self.engine.memory.put_armed(place, armed);
            if armed == Armed::NOTHING {
                self.engine.memory.let_sleep(place / GROUP);
            }
        }
    }
}

impl<P: Compiled, M: Memory> Visit<Arm> for Marking<'_, P, M> {
    #[inline(always)]
    fn row(&mut self, arm: &Arm) {
        let tables = self.engine.tables;
        let program = tables.program();
        let row = usize::from(arm.transition);
        let Some(transition) = program.transitions.get(row) else {
            return;
        };
        let first_holds = self.engine.term_holds(usize::from(transition.term));
        // Mostly nothing fires, and what is done then lies beside the way. That is said at the one comparison that
        // decides.
        if transition.fires == 0 {
            if first_holds {
                cold_path();
                self.fires(arm, row, transition);
            }
        } else if first_holds && self.engine.holds_row(transition.fires) {
            cold_path();
            self.fires(arm, row, transition);
        }
    }
}
