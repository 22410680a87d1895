//! Walking over rows: in a loop; or, in an image of a small program, row by row, so that the compiler knows each row and
//! nothing of it is looked up in a scan.

use crate::bits::set_bits_of;
use crate::program::{Block, Compiled, Step};
use crate::sets::{GROUP, rows};

/// What is done with rows of one table.
pub(crate) trait Visit<T> {
    /// Does it with one row.
    fn row(&mut self, row: &T);
}

/// What is done with some steps.
pub trait VisitSteps {
    /// Whether words that are not followed are visited apart from the loop around, which then has the registers: where
    /// most are followed. Only loops ask for it.
    fn is_apart(&self) -> bool {
        false
    }
    /// The groups of words to be looked at, of 32 neighbouring ones. Only loops ask for them.
    fn groups(&self, row: usize) -> u32;
    /// Visits groups of words as long as it is known what is armed in them, and gives the first word of which it is not,
    /// in a group that has been taken. Only loops ask for it.
    fn follow(&mut self, groups: &mut Groups) -> Option<usize> {
        groups.next().map(|group| group * GROUP)
    }
    /// The same for one word: whether it has been visited. Only loops ask for it.
    fn follow_one(&mut self, _place: usize) -> bool {
        false
    }
    /// The steps to be visited, of those that share a word: those of its bits that are set.
    fn choose(&mut self, place: usize, block: &Block) -> u32;
    /// Visits one of them.
    fn step(&mut self, step: &Step);
    /// All of a word have been visited.
    fn leave(&mut self, place: usize);
}

/// Groups of words that are still to be visited, of 32 neighbouring ones.
#[derive(Clone, Copy, Debug)]
pub struct Groups {
    pub(crate) left: u32,
    pub(crate) next: usize,
}

impl Groups {
    /// Those that are members, of so many words.
    #[inline(always)]
    pub(crate) fn of(row: usize, members: u32, words: usize) -> Groups {
        let next = row * 32;
        let beyond = (next + 32).saturating_sub(words.div_ceil(GROUP));
        Groups {
            left: members & u32::MAX.checked_shr(beyond as u32).unwrap_or(0),
            next,
        }
    }
}

impl Iterator for Groups {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        while self.left != 0 {
            let group = self.next;
            let is_member = self.left & 1 != 0;
            self.left >>= 1;
            self.next += 1;
            if is_member {
                return Some(group);
            }
        }
        None
    }
}

/// Visits rows one after the other.
#[inline(always)]
pub(crate) fn each<P: Compiled, T>(rows: &[T], visit: &mut impl Visit<T>) {
    if !P::UNROLLED {
        for row in rows {
            visit.row(row);
        }
        return;
    }
    let mut rest = rows;
    macro_rules! next {
        () => {
            if let [row, behind @ ..] = rest {
                visit.row(row);
                rest = behind;
            }
        };
    }
    // More than these are rare, and go round in a loop.
    next!();
    next!();
    next!();
    next!();
    for row in rest {
        visit.row(row);
    }
}

/// Visits steps in a loop.
#[inline(always)]
pub(crate) fn loop_over_steps(blocks: &[Block], steps: &[Step], visit: &mut impl VisitSteps) {
    for row in 0..rows(blocks.len()) {
        let members = visit.groups(row);
        if members == 0 {
            continue;
        }
        let mut groups = Groups::of(row, members, blocks.len());
        while let Some(first) = visit.follow(&mut groups) {
            for place in first..blocks.len().min(groups.next * GROUP) {
                if !visit.follow_one(place)
                    && let Some(block) = blocks.get(place)
                {
                    visit_word(place, block, steps, visit);
                }
            }
        }
    }
}

/// Visits the steps of one word.
#[inline(always)]
fn visit_word(place: usize, block: &Block, steps: &[Step], visit: &mut impl VisitSteps) {
    if visit.is_apart() {
        look_apart(place, block, steps, visit);
    } else {
        look(place, block, steps, visit);
    }
}

/// The same, kept apart.
#[inline(never)]
fn look_apart(place: usize, block: &Block, steps: &[Step], visit: &mut impl VisitSteps) {
    look(place, block, steps, visit);
}

/// The same, at the place.
#[inline(always)]
fn look(place: usize, block: &Block, steps: &[Step], visit: &mut impl VisitSteps) {
    for bit in set_bits_of(visit.choose(place, block)) {
        if let Some(step) = steps.get(usize::from(block.first) + bit) {
            visit.step(step);
        }
    }
    visit.leave(place);
}
