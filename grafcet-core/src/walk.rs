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
    /// Visits neighbouring words from one on, as long as it is known what is armed in them, and gives the first of which
    /// it is not. Only loops ask for it.
    fn follow(&mut self, from: usize, _end: usize) -> usize {
        from
    }
    /// Passes over a word in which nothing is active and nothing was. Only loops ask for it.
    fn passes(&mut self, _place: usize) -> bool {
        false
    }
    /// The steps to be visited, of those that share a word: those of its bits that are set.
    fn choose(&mut self, place: usize, block: &Block) -> u32;
    /// Visits one of them.
    fn step(&mut self, step: &Step);
    /// All of a word have been visited.
    fn leave(&mut self, place: usize);
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
        let mut groups = visit.groups(row);
        while groups != 0 {
            // Neighbours are looked at in one go.
            let first = groups.trailing_zeros();
            let behind = first + (groups >> first).trailing_ones();
            groups &= u32::MAX.checked_shl(behind).unwrap_or(0);
            let word = |group: u32| blocks.len().min((row * 32 + group as usize) * GROUP);
            let (mut place, end) = (word(first), word(behind));
            loop {
                place = visit.follow(place, end);
                if place >= end {
                    break;
                }
                if let Some(block) = blocks.get(place) {
                    visit_word(place, block, steps, visit);
                }
                place += 1;
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
    if visit.passes(place) {
        return;
    }
    for bit in set_bits_of(visit.choose(place, block)) {
        if let Some(step) = steps.get(usize::from(block.first) + bit) {
            visit.step(step);
        }
    }
    visit.leave(place);
}
