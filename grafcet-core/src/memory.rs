//! What changes while a program runs.

use crate::program::{Armed, Bit, Layout, Number, Run, Since, Stamp, Target};

/// A [`Stamp`] that never was: later than every time, with room for any preset behind it.
pub(crate) const NEVER: u64 = 1 << 63;

/// How a graph stands in the hierarchy of forcing and enclosing (`semantics.md`, phase 4). It is one word, since mostly
/// a graph is free, and that is one look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Standing(u32);

impl Standing {
    /// Free, as before scan 0.
    pub const FREE: Standing = Standing(0);
    const HELD: u32 = 1 << 16;
    const VOID: u32 = 1 << 17;

    /// How a graph stands behind a round: whether a valid order held, so that it is not free yet, and whether its own
    /// evolution was void.
    pub(crate) const fn behind_round(held: bool, void: bool) -> Standing {
        let held = if held { Self::HELD } else { 0 };
        let void = if void { Self::VOID } else { 0 };
        Standing(held | void)
    }

    /// The best order on the graph found so far in this round: its row, counted from 1, or 0 when there is none.
    pub(crate) const fn order(self) -> u16 {
        self.0 as u16
    }

    /// The same graph under an order.
    pub(crate) const fn under(self, order: u16) -> Standing {
        Standing(self.0 & !0xffff | order as u32)
    }

    /// Whether a valid order held in the round before.
    pub(crate) const fn is_held(self) -> bool {
        self.0 & Self::HELD != 0
    }

    /// Whether its own evolution of the latest round was void.
    pub(crate) const fn is_void(self) -> bool {
        self.0 & Self::VOID != 0
    }
}

/// Parts of a [`Memory`] that are written while sequences are followed.
#[derive(Debug)]
pub struct Following<'m> {
    /// [`Memory::image`].
    pub image: &'m mut [u32],
    /// [`Memory::before`].
    pub before: &'m mut [u32],
    /// [`Memory::fired`].
    pub fired: &'m mut [u32],
    /// [`Memory::sets`].
    pub sets: &'m mut [u32],
    /// [`Memory::armed`].
    pub armed: &'m mut [Armed],
}

/// The memory of one program: what [`storage!`](crate::storage) makes, or vectors on a host.
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
    /// [`Layout::before`] words.
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
    /// Times of activation of steps whose timers are asked for only while they are active: the low words of ms, at most
    /// [`Timer::LONGEST_OWN_MS`](crate::program::Timer::LONGEST_OWN_MS) and some days ago. [`Layout::since`] of them.
    fn since(&self) -> &[u32];
    /// The same, to be written.
    fn since_mut(&mut self) -> &mut [u32];
    /// One for each graph, if a graph forces or encloses another. [`Layout::standings`] of them.
    fn standings(&self) -> &[Standing];
    /// The same, to be written.
    fn standings_mut(&mut self) -> &mut [Standing];
    /// What momentary variables were before phase 7, when they have more than a word. [`Layout::shown`] words.
    fn shown(&self) -> &[u32];
    /// The same, to be written.
    fn shown_mut(&mut self) -> &mut [u32];
    /// Which words hold anything. [`Layout::sets`] words, or none: everything is looked at then.
    fn sets(&self) -> &[u32];
    /// The same, to be written.
    fn sets_mut(&mut self) -> &mut [u32];
    /// What sequences are followed by, all to be written.
    fn following(&mut self) -> Following<'_>;
    /// What is armed in each word of situations. [`Layout::armed`] words, or none: all steps are looked at then.
    fn armed(&self) -> &[Armed];
    /// The same, to be written.
    fn armed_mut(&mut self) -> &mut [Armed];
}

/// Defines the memory of one program, sized at build time: on a microcontroller the type of a static.
///
/// The image comes first and the numbers follow, so that a tool that looks into RAM finds them. What the lengths mean
/// is said at the methods of [`Memory`](crate::memory::Memory). `is_sized_for` tells whether they are those that a
/// program asks for.
///
/// ```
/// grafcet_core::storage!(Storage {
///     image: 7, numbers: 2, before: 1, before_scan: 0, fired: 1, passed: 0, stack: 0, stamps: 1, since: 0,
///     standings: 0, shown: 0, sets: 0, armed: 0
/// });
/// static STORAGE: Storage = Storage::new();
/// ```
#[macro_export]
macro_rules! storage {
    ($name:ident {
        image: $image:literal, numbers: $numbers:literal, before: $before:literal, before_scan: $before_scan:literal,
        fired: $fired:literal, passed: $passed:literal, stack: $stack:literal, stamps: $stamps:literal,
        since: $since:literal, standings: $standings:literal, shown: $shown:literal, sets: $sets:literal,
        armed: $armed:literal
    }) => {
        /// The memory of the program.
        #[repr(C)]
        #[derive(Debug)]
        pub struct $name {
            image: [u32; $image],
            numbers: [i32; $numbers],
            before: [u32; $before],
            before_scan: [u32; $before_scan],
            fired: [u32; $fired],
            passed: [u32; $passed],
            stack: [i32; $stack],
            stamps: [u64; $stamps],
            since: [u32; $since],
            standings: [$crate::memory::Standing; $standings],
            shown: [u32; $shown],
            sets: [u32; $sets],
            armed: [$crate::program::Armed; $armed],
        }

        impl $name {
            /// Memory with nothing in it; an engine makes of it what it is before scan 0.
            #[must_use]
            pub const fn new() -> Self {
                $name {
                    image: [0; $image],
                    numbers: [0; $numbers],
                    before: [0; $before],
                    before_scan: [0; $before_scan],
                    fired: [0; $fired],
                    passed: [0; $passed],
                    stack: [0; $stack],
                    stamps: [0; $stamps],
                    since: [0; $since],
                    standings: [$crate::memory::Standing::FREE; $standings],
                    shown: [0; $shown],
                    sets: [0; $sets],
                    armed: [$crate::program::Armed(0); $armed],
                }
            }

            /// True when the memory has exactly the places that the program's layout asks for.
            #[must_use]
            pub const fn is_sized_for(program: &$crate::program::Program<'_>) -> bool {
                let layout = &program.layout;
                $image == layout.words as usize
                    && $numbers == layout.numbers as usize
                    && $before == layout.before as usize
                    && $before_scan == layout.remembered as usize
                    && $fired == layout.fired as usize
                    && $passed == layout.passed as usize
                    && $stack == layout.stack as usize
                    && $stamps == layout.stamps as usize
                    && $since == layout.since as usize
                    && $standings == layout.standings as usize
                    && $shown == layout.shown as usize
                    && $sets == layout.sets as usize
                    && $armed == layout.armed as usize
            }
        }

        impl Default for $name {
            fn default() -> Self {
                Self::new()
            }
        }

        impl $crate::memory::Memory for $name {
            $crate::memory_methods!(fields);
        }
    };
}

/// Writes the methods of [`Memory`], for a type with fields of their names or for a reference to another memory.
#[doc(hidden)]
#[macro_export]
macro_rules! memory_methods {
    ($way:ident) => {
        $crate::memory_methods! {
            @$way image image_mut u32, numbers numbers_mut i32, before before_mut u32,
            before_scan before_scan_mut u32, fired fired_mut u32, passed passed_mut u32, stack stack_mut i32,
            stamps stamps_mut u64, since since_mut u32, standings standings_mut $crate::memory::Standing, shown shown_mut u32,
            sets sets_mut u32, armed armed_mut $crate::program::Armed
        }
    };
    (@fields $($field:ident $field_mut:ident $type:ty),*) => {$(
        #[inline(always)]
        fn $field(&self) -> &[$type] {
            &self.$field
        }
        #[inline(always)]
        fn $field_mut(&mut self) -> &mut [$type] {
            &mut self.$field
        }
    )*
        #[inline(always)]
        fn following(&mut self) -> $crate::memory::Following<'_> {
            $crate::memory::Following {
                image: &mut self.image,
                before: &mut self.before,
                fired: &mut self.fired,
                sets: &mut self.sets,
                armed: &mut self.armed,
            }
        }
    };
    (@target $($field:ident $field_mut:ident $type:ty),*) => {$(
        #[inline(always)]
        fn $field(&self) -> &[$type] {
            (**self).$field()
        }
        #[inline(always)]
        fn $field_mut(&mut self) -> &mut [$type] {
            (**self).$field_mut()
        }
    )*
        #[inline(always)]
        fn following(&mut self) -> $crate::memory::Following<'_> {
            (**self).following()
        }
    };
}

impl<M: Memory> Memory for &mut M {
    memory_methods!(target);
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
        self.store.sets_mut().fill(0);
        self.store.passed_mut().fill(0);
        self.store.stamps_mut().fill(NEVER);
        self.store.since_mut().fill(0);
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
        let changes = *word != new;
        if changes {
            *word = new;
        }
        changes
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

    /// Takes back all momentary variables, and keeps what they were.
    pub(crate) fn begin_showing(&mut self, words: Run) {
        for (place, word) in words.indices().enumerate() {
            let before = self.word(word);
            if let Some(shown) = self.store.shown_mut().get_mut(place) {
                *shown = before;
            }
            self.put_word(word, 0);
        }
    }

    /// Whether they are something else now.
    pub(crate) fn shows_something_else(&self, words: Run) -> bool {
        let shown = self.store.shown().iter();
        shown
            .zip(words.of(self.store.image()))
            .any(|(before, now)| before != now)
    }

    /// Raises bits of one word.
    pub(crate) fn raise(&mut self, target: Target) {
        if let Some(word) = self.store.image_mut().get_mut(usize::from(target.word)) {
            *word |= target.mask;
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

    pub(crate) fn since(&self, since: Since) -> u32 {
        let slot = self.store.since().get(usize::from(since.0));
        slot.copied().unwrap_or(0)
    }

    pub(crate) fn set_since(&mut self, since: Since, time_ms: u64) {
        if let Some(slot) = self.store.since_mut().get_mut(usize::from(since.0)) {
            *slot = time_ms as u32;
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
