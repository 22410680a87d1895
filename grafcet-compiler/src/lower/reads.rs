//! Who reads what.

use grafcet_core::program::{Bit, Condition, Op, Rest};

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

/// Whether the situation of a word can be exchanged as soon as its steps have been looked at, since no trigger that is
/// evaluated later reads it.
pub(super) fn crosses_at_once(tables: &Tables) -> bool {
    let program = tables.program();
    let first = tables.layout.situations.start;
    tables.sources.is_empty()
        && tables.links.is_empty()
        && tables.graphs.iter().all(|graph| {
            let earlier = first..graph.first_word;
            let steps = graph.steps.of(&tables.steps).iter();
            let arms = steps.flat_map(|step| step.arms().of(&tables.arms));
            let terms = arms.filter_map(|arm| tables.terms.get(usize::from(arm.term)));
            let transitions = graph.transitions.of(&tables.transitions).iter();
            let fires = transitions.map(|transition| program.condition(transition.fires));
            let triggers = fires.flat_map(|condition| words(tables, condition));
            let mut words = terms.map(|term| term.word).chain(triggers);
            !words.any(|word| earlier.contains(&word))
        })
}

/// The words that a condition reads.
fn words(tables: &Tables, condition: Condition) -> impl Iterator<Item = u16> + use<'_> {
    let terms = condition.terms.of(&tables.terms).iter();
    let terms = terms.map(|term| term.word);
    let code = match condition.rest {
        Rest::Code(code) | Rest::Logic(code) => tables.codes.get(usize::from(code)),
        Rest::None | Rest::Elapsed(_) | Rest::Running(_) => None,
    };
    let ops = code.into_iter().flat_map(|code| {
        let start = code.start as usize;
        tables.ops.iter().skip(start).take(usize::from(code.len))
    });
    terms.chain(bits(ops).map(|bit| bit.0 / 32))
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
