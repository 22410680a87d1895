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
    /// The groups of words to be looked at, of 32 neighbouring ones. Only loops ask for them.
    fn groups(&self, row: usize) -> u32;
    /// The steps to be visited, of those that share a word: those of its bits that are set.
    fn choose(&mut self, place: usize, block: &Block) -> u32;
    /// Visits one of them.
    fn step(&mut self, step: &Step);
    /// All of a word have been visited.
    fn leave(&mut self, place: usize);
    /// All of a group have been visited. Only loops say so.
    fn leave_group(&mut self, _group: usize) {}
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
        for bit in set_bits_of(visit.groups(row)) {
            let group = row * 32 + bit;
            let first = group * GROUP;
            let Some(blocks) = blocks.get(first..) else {
                break;
            };
            for (place, block) in (first..).zip(blocks.iter().take(GROUP)) {
                for bit in set_bits_of(visit.choose(place, block)) {
                    if let Some(step) = steps.get(usize::from(block.first) + bit) {
                        visit.step(step);
                    }
                }
                visit.leave(place);
            }
            visit.leave_group(group);
        }
    }
}
