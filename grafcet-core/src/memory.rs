//! What changes while a program runs.

use crate::program::{Bit, Forced, Layout, Number, Stamp};

/// A [`Stamp`] that never was.
pub(crate) const NEVER: u64 = u64::MAX;

/// How a graph stands in the hierarchy of forcing and enclosing (`semantics.md`, phase 4).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Standing {
    /// The best order on the graph found so far in this round.
    pub(crate) order: Option<Given>,
    /// A valid order held in the round before, so the graph is not free yet.
    pub(crate) held: bool,
    /// Its own evolution of the latest round was void.
    pub(crate) void: bool,
}

/// A valid order, with what decides between two of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Given {
    pub(crate) by: u16,
    pub(crate) rank: u16,
    pub(crate) situation: Forced,
}

impl Standing {
    /// Free, as before scan 0.
    pub const FREE: Standing = Standing {
        order: None,
        held: false,
        void: false,
    };
}

/// The memory of one program, sized at build time: on a microcontroller a static.
///
/// The image comes first and the numbers follow, so that a tool that looks into RAM finds them.
#[repr(C)]
#[derive(Debug)]
pub struct Storage<
    const WORDS: usize,
    const NUMBERS: usize,
    const SITUATION_WORDS: usize,
    const REMEMBERED: usize,
    const STAMPS: usize,
    const STACK: usize,
    const FIRED: usize,
    const PASSED: usize,
    const STANDINGS: usize,
> {
    image: [u32; WORDS],
    numbers: [i32; NUMBERS],
    before: [u32; SITUATION_WORDS],
    before_scan: [u32; REMEMBERED],
    fired: [u32; FIRED],
    passed: [u32; PASSED],
    stack: [i32; STACK],
    stamps: [u64; STAMPS],
    standings: [Standing; STANDINGS],
}

impl<
    const WORDS: usize,
    const NUMBERS: usize,
    const SITUATION_WORDS: usize,
    const REMEMBERED: usize,
    const STAMPS: usize,
    const STACK: usize,
    const FIRED: usize,
    const PASSED: usize,
    const STANDINGS: usize,
> Storage<WORDS, NUMBERS, SITUATION_WORDS, REMEMBERED, STAMPS, STACK, FIRED, PASSED, STANDINGS>
{
    /// Memory in which nothing has happened.
    #[must_use]
    pub const fn new() -> Self {
        Storage {
            image: [0; WORDS],
            numbers: [0; NUMBERS],
            before: [0; SITUATION_WORDS],
            before_scan: [0; REMEMBERED],
            fired: [0; FIRED],
            passed: [0; PASSED],
            stack: [0; STACK],
            stamps: [NEVER; STAMPS],
            standings: [Standing::FREE; STANDINGS],
        }
    }
}

impl<
    const WORDS: usize,
    const NUMBERS: usize,
    const SITUATION_WORDS: usize,
    const REMEMBERED: usize,
    const STAMPS: usize,
    const STACK: usize,
    const FIRED: usize,
    const PASSED: usize,
    const STANDINGS: usize,
> Default
    for Storage<
        WORDS,
        NUMBERS,
        SITUATION_WORDS,
        REMEMBERED,
        STAMPS,
        STACK,
        FIRED,
        PASSED,
        STANDINGS,
    >
{
    fn default() -> Self {
        Self::new()
    }
}

/// The memory of one program: a [`Storage`], or vectors on a host.
///
/// The lengths that a program needs are in its [`Layout`]; with less room nothing panics, and what has none reads as
/// False and 0.
pub trait Memory {
    /// The bits: inputs, situations, variables, outputs, results. [`Layout::words`] words.
    fn image(&self) -> &[u32];
    /// The same, to be written.
    fn image_mut(&mut self) -> &mut [u32];
    /// The numbers. [`Layout::numbers`] of them.
    fn numbers(&self) -> &[i32];
    /// The same, to be written.
    fn numbers_mut(&mut self) -> &mut [i32];
    /// The situations before this scan (round), and while transitions are marked the next ones.
    /// [`Layout::situation_words`] words.
    fn before(&self) -> &[u32];
    /// The same, to be written.
    fn before_mut(&mut self) -> &mut [u32];
    /// The situations before this scan. [`Layout::remembered`] words.
    fn before_scan(&self) -> &[u32];
    /// The same, to be written.
    fn before_scan_mut(&mut self) -> &mut [u32];
    /// The transitions that fired in this round. [`Layout::fired`] words.
    fn fired(&self) -> &[u32];
    /// The same, to be written.
    fn fired_mut(&mut self) -> &mut [u32];
    /// The transitions that fired in this scan's rounds so far. [`Layout::passed`] words.
    fn passed(&self) -> &[u32];
    /// The same, to be written.
    fn passed_mut(&mut self) -> &mut [u32];
    /// Room for postfix code. [`Layout::stack`] values.
    fn stack(&self) -> &[i32];
    /// The same, to be written.
    fn stack_mut(&mut self) -> &mut [i32];
    /// Times of activation and of rise, in ms. [`Layout::stamps`] of them.
    fn stamps(&self) -> &[u64];
    /// The same, to be written.
    fn stamps_mut(&mut self) -> &mut [u64];
    /// One for each graph, if a graph forces or encloses another. [`Layout::standings`] of them.
    fn standings(&self) -> &[Standing];
    /// The same, to be written.
    fn standings_mut(&mut self) -> &mut [Standing];
}

/// Writes the methods of [`Memory`] in one of the two ways below.
macro_rules! memory_methods {
    ($way:ident) => {
        $way! {
            image image_mut u32, numbers numbers_mut i32, before before_mut u32, before_scan before_scan_mut u32,
            fired fired_mut u32, passed passed_mut u32, stack stack_mut i32, stamps stamps_mut u64,
            standings standings_mut Standing
        }
    };
}

/// For a type with fields of the same names.
macro_rules! in_fields {
    ($($field:ident $field_mut:ident $type:ty),*) => {$(
        #[inline(always)]
        fn $field(&self) -> &[$type] {
            &self.$field
        }
        #[inline(always)]
        fn $field_mut(&mut self) -> &mut [$type] {
            &mut self.$field
        }
    )*};
}

/// For a reference to another memory.
macro_rules! in_target {
    ($($field:ident $field_mut:ident $type:ty),*) => {$(
        #[inline(always)]
        fn $field(&self) -> &[$type] {
            (**self).$field()
        }
        #[inline(always)]
        fn $field_mut(&mut self) -> &mut [$type] {
            (**self).$field_mut()
        }
    )*};
}

impl<
    const WORDS: usize,
    const NUMBERS: usize,
    const SITUATION_WORDS: usize,
    const REMEMBERED: usize,
    const STAMPS: usize,
    const STACK: usize,
    const FIRED: usize,
    const PASSED: usize,
    const STANDINGS: usize,
> Memory
    for Storage<
        WORDS,
        NUMBERS,
        SITUATION_WORDS,
        REMEMBERED,
        STAMPS,
        STACK,
        FIRED,
        PASSED,
        STANDINGS,
    >
{
    memory_methods!(in_fields);
}

impl<M: Memory> Memory for &mut M {
    memory_methods!(in_target);
}

/// A store, as the engine works with it.
#[derive(Debug)]
pub(crate) struct Bank<M> {
    pub(crate) store: M,
}

impl<M: Memory> Bank<M> {
    /// Forgets everything, as power-on does.
    pub(crate) fn clear(&mut self) {
        self.store.image_mut().fill(0);
        self.store.numbers_mut().fill(0);
        self.store.before_mut().fill(0);
        self.store.before_scan_mut().fill(0);
        self.store.fired_mut().fill(0);
        self.store.passed_mut().fill(0);
        self.store.stamps_mut().fill(NEVER);
        self.store.standings_mut().fill(Standing::FREE);
    }

    pub(crate) fn word(&self, word: usize) -> u32 {
        self.store.image().get(word).copied().unwrap_or(0)
    }

    pub(crate) fn bit(&self, bit: Bit) -> bool {
        self.word(bit.word()) & bit.mask() != 0
    }

    /// Writes a bit and tells whether that changed it.
    pub(crate) fn put_bit(&mut self, bit: Bit, value: bool) -> bool {
        let Some(word) = self.store.image_mut().get_mut(bit.word()) else {
            return false;
        };
        let new = if value {
            *word | bit.mask()
        } else {
            *word & !bit.mask()
        };
        core::mem::replace(word, new) != new
    }

    pub(crate) fn clear_bit(&mut self, bit: Bit) {
        if let Some(word) = self.store.image_mut().get_mut(bit.word()) {
            *word &= !bit.mask();
        }
    }

    pub(crate) fn raise_bit(&mut self, bit: Bit) {
        if let Some(word) = self.store.image_mut().get_mut(bit.word()) {
            *word |= bit.mask();
        }
    }

    /// Writes a word and tells whether that changed it.
    pub(crate) fn put_word(&mut self, word: usize, value: u32) -> bool {
        let word = self.store.image_mut().get_mut(word);
        word.is_some_and(|word| core::mem::replace(word, value) != value)
    }

    pub(crate) fn number(&self, number: Number) -> i32 {
        self.store
            .numbers()
            .get(usize::from(number.0))
            .copied()
            .unwrap_or(0)
    }

    /// Writes a number and tells whether that changed it.
    pub(crate) fn put_number(&mut self, number: Number, value: i32) -> bool {
        let slot = self.store.numbers_mut().get_mut(usize::from(number.0));
        slot.is_some_and(|slot| core::mem::replace(slot, value) != value)
    }

    pub(crate) fn stamp(&self, stamp: Stamp) -> u64 {
        self.store
            .stamps()
            .get(usize::from(stamp.0))
            .copied()
            .unwrap_or(NEVER)
    }

    pub(crate) fn set_stamp(&mut self, stamp: Stamp, time_ms: u64) {
        if let Some(slot) = self.store.stamps_mut().get_mut(usize::from(stamp.0)) {
            *slot = time_ms;
        }
    }

    /// A step or macro step bit as it stood before this scan (round).
    pub(crate) fn was_active(&self, layout: &Layout, step: Bit) -> bool {
        stood(self.store.before(), layout, step)
    }

    /// A step bit as scan 0 began, while scan 0 runs.
    pub(crate) fn was_initially_active(&self, layout: &Layout, step: Bit) -> bool {
        stood(self.store.before_scan(), layout, step)
    }

    /// Remembers the situations as those in which scan 0 begins; the situation before it is the empty one.
    pub(crate) fn mark_start(&mut self, layout: &Layout) {
        self.mark_scan(layout);
        self.store.before_mut().fill(0);
    }

    /// Scan 0 is over: from now on the situation before it is the empty one for all.
    pub(crate) fn forget_start(&mut self) {
        self.store.before_scan_mut().fill(0);
    }

    /// Remembers that a scan begins here.
    pub(crate) fn mark_scan(&mut self, layout: &Layout) {
        for place in 0..self.store.before_scan().len() {
            let word = match place.checked_sub(usize::from(layout.situations.len)) {
                None => usize::from(layout.situations.start) + place,
                Some(place) => usize::from(layout.macros.start) + place,
            };
            let now = self.word(word);
            if let Some(before) = self.store.before_scan_mut().get_mut(place) {
                *before = now;
            }
        }
        self.store.passed_mut().fill(0);
    }

    /// Notes that what has fired in this round has fired in this scan.
    pub(crate) fn note_passed(&mut self) {
        for place in 0..self.store.passed().len() {
            let fired = self.store.fired().get(place).copied().unwrap_or(0);
            if let Some(passed) = self.store.passed_mut().get_mut(place) {
                *passed |= fired;
            }
        }
    }

    /// Remembers the macro steps as those before the next round; the situations are remembered when they change.
    pub(crate) fn remember_macros(&mut self, layout: &Layout) {
        for place in 0..usize::from(layout.macros.len) {
            let now = self.word(usize::from(layout.macros.start) + place);
            let before = usize::from(layout.situations.len) + place;
            if let Some(before) = self.store.before_mut().get_mut(before) {
                *before = now;
            }
        }
    }
}

/// A step or macro step bit among remembered situations.
fn stood(situations: &[u32], layout: &Layout, step: Bit) -> bool {
    remembered(layout, step.word())
        .and_then(|word| situations.get(word))
        .is_some_and(|word| word & step.mask() != 0)
}

/// The word of [`Memory::before`] that remembers a word of the image.
pub(crate) fn remembered(layout: &Layout, word: usize) -> Option<usize> {
    let (steps, macros) = (layout.situations.indices(), layout.macros.indices());
    if steps.contains(&word) {
        Some(word - steps.start)
    } else if macros.contains(&word) {
        Some(steps.len() + word - macros.start)
    } else {
        None
    }
}
