//! Steps that stand in a sequence (IEC 60848: each has one way on). A large program keeps in mind what is armed in a word
//! in which such a step is the only active one, so that a scan looks at that transition and at nothing else.

use core::cell::Cell;

use crate::engine::Engine;
use crate::evolution::Marking;
use crate::memory::{Following, Memory};
use crate::program::{Arm, Armed, Block, Compiled, Condition, Program, Rest, Taken, Term};
use crate::sets::{GROUP, mark};
use crate::walk::Groups;

impl<P: Compiled, M: Memory> Engine<P, M> {
    /// Finds out what is armed, so that the next scan need not.
    pub(crate) fn find_armed(&mut self) {
        if P::UNROLLED {
            return;
        }
        let tables = self.tables;
        for place in 0..self.memory.store.armed().len() {
            let block = tables.program().blocks.get(place);
            let armed = block.map_or(Armed::NOTHING, |block| self.armed_in(place, block));
            self.memory.put_armed(place, armed);
        }
    }

    /// What is armed in a word, if it is known when one step of it is active or none.
    fn armed_in(&self, place: usize, block: &Block) -> Armed {
        let now = self.situation_word(place);
        if now == 0 {
            return Armed::NOTHING;
        }
        let tables = self.tables;
        let bit = now.trailing_zeros() as usize;
        match tables.program().steps.get(usize::from(block.first) + bit) {
            Some(step) if step.arm_count == 1 && now.is_power_of_two() => {
                self.armed_alone(step.first_arm)
            }
            _ => Armed::UNKNOWN,
        }
    }

    /// What is armed by a step with a row of the arms, if it stands in a sequence.
    pub(crate) fn armed_alone(&self, row: u16) -> Armed {
        let tables = self.tables;
        let program = tables.program();
        match program.arms.get(usize::from(row)) {
            Some(arm) if !arm.course.is_free() => program.armed_by(row),
            _ => Armed::UNKNOWN,
        }
    }

    /// Whether a transition fires that is armed. Kept apart, since it is long where few ask for it.
    #[inline(never)]
    fn fires_apart(&mut self, row: u16) -> bool {
        let tables = self.tables;
        let transition = tables.program().transitions.get(usize::from(row));
        transition
            .is_some_and(|it| self.term_holds(usize::from(it.term)) && self.holds_row(it.fires))
    }

    /// Looks at groups of words as long as first terms say whether the transitions fire that are armed there. Gives the
    /// first word of which that is not so, and what has fired.
    #[inline(never)]
    fn follow_plainly(&mut self, groups: &mut Groups) -> (Option<usize>, Taken) {
        let tables = self.tables;
        let program = tables.program();
        let first = usize::from(program.layout.situations.start);
        let parts = self.memory.store.following();
        let (image, armed) = (parts.image, parts.armed);
        let image = Cell::from_mut(image).as_slice_of_cells();
        let (Some(near), Some(situations)) =
            (image.first_chunk(), image.get(first..first + armed.len()))
        else {
            return (groups.next().map(|group| group * GROUP), Taken::NONE);
        };
        let mut looking = Looking {
            near,
            arms: if program.marks_all {
                &[]
            } else {
                arms(program)
            },
            before: parts.before,
            marks: None,
            taken: Taken::NONE,
        };
        let (armed, _) = armed.as_chunks_mut::<GROUP>();
        let (situations, _) = situations.as_chunks::<GROUP>();
        let Groups {
            mut left,
            next: mut group,
        } = *groups;
        while left != 0 {
            let is_member = left & 1 != 0;
            if is_member
                && let (Some(armed), Some(situations)) =
                    (armed.get_mut(group), situations.get(group))
            {
                let mut known = GROUP;
                for (offset, (armed, situation)) in armed.iter_mut().zip(situations).enumerate() {
                    if !looking.look(group * GROUP + offset, armed, situation) {
                        known = offset;
                        break;
                    }
                }
                if let (Some(armed), Some(situations)) =
                    (armed.get_mut(known..), situations.get(known..))
                    && !armed.is_empty()
                {
                    let first = group * GROUP + known;
                    let kept = (&mut *looking.before, &mut *parts.fired, &mut *parts.sets);
                    let (place, taken) = look_on(tables, image, kept, armed, situations, first);
                    looking.taken.join(taken);
                    if place.is_some() {
                        *groups = Groups {
                            left: left >> 1,
                            next: group + 1,
                        };
                        return (place, looking.taken);
                    }
                }
            }
            left >>= 1;
            group += 1;
        }
        (None, looking.taken)
    }
}

/// What it takes to look whether a sequence goes on.
struct Looking<'m> {
    near: &'m [Cell<u32>; Armed::WORDS],
    arms: &'m [Arm],
    before: &'m mut [u32],
    /// The marks, if all that fire are marked, and the set of groups in which there are any.
    marks: Option<(&'m mut [u32], &'m mut [u32])>,
    taken: Taken,
}

impl Looking<'_> {
    /// Looks at a word, if one Boolean will do.
    #[inline(always)]
    fn look(&mut self, place: usize, armed: &mut Armed, situation: &Cell<u32>) -> bool {
        if !armed.may_fire(self.near) {
            self.keep(place, situation);
            return true;
        }
        let Some(arm) = self.arms.get(armed.plain_row()) else {
            return false;
        };
        self.go_on(place, armed, situation, arm);
        true
    }

    /// A transition fires.
    #[inline(always)]
    fn go_on(&mut self, place: usize, armed: &mut Armed, situation: &Cell<u32>, arm: &Arm) {
        self.keep(place, situation);
        self.taken.take(arm.course);
        if let Some((fired, sets)) = &mut self.marks {
            mark(fired, sets, usize::from(arm.transition));
        }
        situation.set(arm.course.enters());
        *armed = arm.next;
    }

    /// Keeps the situation of now as the one before the next scan (round), if that is asked for.
    #[inline(always)]
    fn keep(&mut self, place: usize, situation: &Cell<u32>) {
        if let Some(before) = self.before.get_mut(place) {
            *before = situation.get();
        }
    }
}

/// The transitions that change the situation as soon as they fire.
#[inline(always)]
fn arms<'a>(program: &Program<'a>) -> &'a [Arm] {
    match program.crosses_at_once {
        true => program.arms.get(..Armed::ROWS).unwrap_or(program.arms),
        false => &[],
    }
}

/// Looks at the words of a group from one on, if their terms will do. Gives the first of which that is not so, and
/// what has fired.
///
/// Kept apart, since mostly one Boolean will do, which is looked at with all registers.
#[inline(never)]
fn look_on<P: Compiled>(
    tables: P,
    image: &[Cell<u32>],
    (before, fired, sets): (&mut [u32], &mut [u32], &mut [u32]),
    armed: &mut [Armed],
    situations: &[Cell<u32>],
    first: usize,
) -> (Option<usize>, Taken) {
    let program = tables.program();
    let Some(near) = image.first_chunk() else {
        return (Some(first), Taken::NONE);
    };
    let mut looking = Looking {
        near,
        arms: arms(program),
        before,
        marks: program.marks_all.then_some((fired, sets)),
        taken: Taken::NONE,
    };
    let words = armed.iter_mut().zip(situations);
    for (place, (armed, situation)) in (first..).zip(words) {
        if !looking.look(place, armed, situation) {
            match look_closer(program, image, *armed) {
                Closer::Stays => looking.keep(place, situation),
                Closer::Fires(arm) if !looking.arms.is_empty() => {
                    looking.go_on(place, armed, situation, arm);
                }
                Closer::Fires(_) | Closer::Unknown => return (Some(place), looking.taken),
            }
        }
    }
    (None, looking.taken)
}

/// What a look at the terms of a transition says, which is known to be armed.
enum Closer<'a> {
    /// It does not fire.
    Stays,
    /// It does.
    Fires(&'a Arm),
    /// The terms do not say it.
    Unknown,
}

/// Looks at the terms of the transition that is armed.
#[inline(always)]
fn look_closer<'a>(program: &Program<'a>, image: &[Cell<u32>], armed: Armed) -> Closer<'a> {
    let Some(arm) = armed.arm(program.arms) else {
        return Closer::Unknown;
    };
    let transition = program.transitions.get(usize::from(arm.transition));
    let term = transition.and_then(|it| program.terms.get(usize::from(it.term)));
    let (Some(transition), Some(term)) = (transition, term) else {
        return Closer::Unknown;
    };
    if !stands(term, image) {
        return Closer::Stays;
    }
    match transition.fires {
        0 => Closer::Fires(arm),
        row => look_further(program, image, row, arm),
    }
}

/// The same, behind the first term.
#[inline(never)]
fn look_further<'a>(
    program: &Program<'a>,
    image: &[Cell<u32>],
    row: u16,
    arm: &'a Arm,
) -> Closer<'a> {
    let Condition { terms, rest } = program.condition(row);
    let mut terms = terms.of(program.terms).iter();
    if !terms.all(|term| stands(term, image)) {
        return Closer::Stays;
    }
    match rest {
        Rest::None => Closer::Fires(arm),
        _ => Closer::Unknown,
    }
}

/// Whether a term holds.
#[inline(always)]
fn stands(term: &Term, image: &[Cell<u32>]) -> bool {
    let word = image.get(usize::from(term.word));
    word.is_some_and(|word| word.get() & term.mask == term.state)
}

impl<P: Compiled, M: Memory> Marking<'_, P, M> {
    /// Looks at groups of words as long as it is known what is armed in them, and gives the first word of which it is not.
    #[inline(always)]
    pub(crate) fn follow_sequences(&mut self, groups: &mut Groups) -> Option<usize> {
        let (place, taken) = self.engine.follow_plainly(groups);
        self.marked.any |= taken.any();
        self.marked.shows |= taken.shows();
        place
    }

    /// Looks whether the transition fires that is armed in a word, if that is known.
    pub(crate) fn follow_closer(&mut self, place: usize) -> bool {
        let tables = self.engine.tables;
        let Following { image, armed, .. } = self.engine.memory.store.following();
        let image = Cell::from_mut(image).as_slice_of_cells();
        let (Some(near), Some(armed)) = (image.first_chunk(), armed.get(place)) else {
            return false;
        };
        let (may_fire, armed) = (armed.may_fire(near), *armed);
        let now = self.engine.situation_word(place);
        if may_fire {
            let Some(arm) = armed.arm(tables.program().arms) else {
                return false;
            };
            if self.engine.fires_apart(arm.transition) {
                self.mark(usize::from(arm.transition), false);
                self.put_next(place, now, arm.course.enters());
                self.engine.memory.put_armed(place, arm.next);
                return true;
            }
        }
        if let Some(word) = self.engine.memory.store.before_mut().get_mut(place) {
            *word = now;
        }
        true
    }
}
