//! Which words of a large program hold anything, so that a scan passes over all others.

use crate::memory::{Bank, Memory};
use crate::program::Armed;

/// Neighbouring words that a large program passes over together when they hold nothing: mostly several of them hold
/// something, or none.
pub const GROUP: usize = 8;

/// A set of groups of words, one bit for each.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Set {
    /// Words of situations in which a step is active, or was before this scan (round). In all others it is neither
    /// way.
    Lively,
    /// Words of transitions in which one has fired in this round.
    Marked,
}

impl<M: Memory> Bank<M> {
    /// Notes what is armed in a word of situations. Whoever writes such a word says so.
    #[inline(always)]
    pub(crate) fn put_armed(&mut self, place: usize, now: Armed) {
        if let Some(armed) = self.store.armed_mut().get_mut(place) {
            *armed = now;
        }
    }

    /// Whether the sets are kept: a small program is walked over faster without.
    #[inline(always)]
    pub(crate) fn has_sets(&self) -> bool {
        !self.store.sets().is_empty()
    }

    /// Of 32 neighbouring groups those that are in a set; without sets all.
    #[inline(always)]
    pub(crate) fn members(&self, set: Set, row: usize) -> u32 {
        if !self.has_sets() {
            return u32::MAX;
        }
        let row = self.first(set) + row;
        self.store.sets().get(row).copied().unwrap_or(0)
    }

    /// Notes that a step is active in a word of situations, or was before this scan (round).
    #[inline(always)]
    pub(crate) fn enliven(&mut self, place: usize) {
        let first = self.first(Set::Lively);
        insert(self.store.sets_mut(), first, place);
    }

    /// Takes a group of words of situations out of the set, if nothing is active in any of them, nor was.
    #[inline(never)]
    pub(crate) fn let_sleep(&mut self, group: usize) {
        if !self.has_sets() {
            return;
        }
        let armed = self.store.armed().chunks(GROUP).nth(group);
        if armed.is_none_or(|armed| armed.iter().any(|it| *it != Armed::NOTHING)) {
            return;
        }
        let row = self.first(Set::Lively) + group / 32;
        if let Some(row) = self.store.sets_mut().get_mut(row) {
            *row &= !(1 << (group % 32));
        }
    }

    /// Takes 32 neighbouring groups out of the set of marked ones, and gives those that were in it.
    pub(crate) fn take_marked(&mut self, row: usize) -> u32 {
        let row = self.first(Set::Marked) + row;
        match self.store.sets_mut().get_mut(row) {
            // Mostly nothing is, and nothing need be written.
            Some(groups) if *groups != 0 => core::mem::take(groups),
            _ => 0,
        }
    }

    /// Where the bits of a set begin.
    #[inline(always)]
    fn first(&self, set: Set) -> usize {
        match set {
            Set::Marked => 0,
            Set::Lively => rows(self.store.fired().len()),
        }
    }
}

/// Marks a transition.
#[inline(always)]
pub(crate) fn mark(fired: &mut [u32], sets: &mut [u32], transition: usize) {
    let place = transition / 32;
    let Some(marks) = fired.get_mut(place) else {
        return;
    };
    let is_first = *marks == 0;
    *marks |= 1 << (transition % 32);
    // The set of marked groups is the first one.
    if is_first {
        insert(sets, 0, place);
    }
}

/// Puts the group of a word into the set whose bits begin at a row, if sets are kept.
#[inline(always)]
fn insert(sets: &mut [u32], first: usize, place: usize) {
    let group = place / GROUP;
    if let Some(row) = sets.get_mut(first + group / 32) {
        *row |= 1 << (group % 32);
    }
}

/// How many words the bits of a set of so many words take.
pub(crate) const fn rows(words: usize) -> usize {
    words.div_ceil(GROUP * 32)
}
