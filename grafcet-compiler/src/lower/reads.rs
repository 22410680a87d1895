//! Who reads what.

use grafcet_core::program::{Bit, Op};

use crate::application::Tables;

/// For each word of inputs those that anybody reads: a condition, a value, an edge.
pub(super) fn inputs(tables: &Tables) -> Vec<u32> {
    let edges = tables.edges.iter().flat_map(|row| {
        let seen = [row.rises, row.falls].into_iter().flatten();
        seen.map(|seen| (row.word, seen.bits))
    });
    let words = tables.layout.inputs;
    let mut read = vec![0; usize::from(words.len)];
    for (word, mask) in conditions(tables).chain(edges) {
        let place = word.checked_sub(words.start).map(usize::from);
        if let Some(inputs) = place.and_then(|place| read.get_mut(place)) {
            *inputs |= mask;
        }
    }
    read
}

/// Whether a condition or a value reads `System:first_scan`.
pub(super) fn first_scan(tables: &Tables) -> bool {
    let bit = Bit::FIRST_SCAN;
    conditions(tables).any(|(word, mask)| usize::from(word) == bit.word() && mask & bit.mask() != 0)
}

/// The words and bits that conditions and values read.
fn conditions(tables: &Tables) -> impl Iterator<Item = (u16, u32)> {
    let terms = tables.terms.iter().map(|term| (term.word, term.mask));
    terms.chain(bits(tables.ops.iter()).map(|bit| (bit.0 / 32, bit.mask())))
}

/// The Booleans that code reads.
fn bits<'t>(ops: impl Iterator<Item = &'t Op>) -> impl Iterator<Item = Bit> {
    ops.filter_map(|op| match op {
        Op::Bit(bit) => Some(*bit),
        _ => None,
    })
}
