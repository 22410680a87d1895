//! The time of the scan, and timers that have run out (`semantics.md`, "Timers").

use crate::engine::{Engine, LONG};
use crate::memory::Memory;
use crate::program::{Bit, Compiled, Preset, Since, Stamp, Timer, Unit};

/// Where the code of timers stands, in an image of a small program.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Timers {
    /// Where they are asked for: there the compiler knows the row, and hardly anything is left of it.
    InPlace,
    /// Apart, where it mostly does not.
    Apart,
}

impl<P: Compiled, M: Memory> Engine<P, M> {
    /// A scan is at that time.
    #[inline(always)]
    pub(crate) fn pass_time(&mut self, time_ms: u64) {
        let before_ms = core::mem::replace(&mut self.now_ms, time_ms);
        if self.memory.store.since().is_empty() {
            return;
        }
        // An image scans periodically, and is idle for LONG at most. A host may leap over any time.
        let passed_ms = if P::UNROLLED {
            (time_ms as u32).wrapping_sub(before_ms as u32)
        } else {
            u32::try_from(time_ms.saturating_sub(before_ms)).unwrap_or(u32::MAX)
        };
        let leaps = !P::UNROLLED && passed_ms > LONG;
        let span = |time_ms: u64| time_ms as u32 / LONG;
        if leaps || span(before_ms) != span(time_ms) {
            self.age_activations(passed_ms);
        }
    }

    /// What became active longer ago than any preset is as good as just that old, and noted so before the low words go
    /// round.
    #[inline(never)]
    fn age_activations(&mut self, passed_ms: u32) {
        let now_ms = self.now_ms as u32;
        let before_ms = now_ms.wrapping_sub(passed_ms);
        for since in self.memory.store.since_mut() {
            let age_ms = before_ms.wrapping_sub(*since).saturating_add(passed_ms);
            if age_ms > Timer::LONGEST_OWN_MS {
                *since = now_ms.wrapping_sub(Timer::LONGEST_OWN_MS);
            }
        }
    }

    /// Whether the timer in that row has run out.
    #[inline(always)]
    pub(crate) fn has_elapsed(&mut self, timer: u16, timers: Timers) -> bool {
        let tables = self.tables;
        match tables.program().timers.get(usize::from(timer)) {
            Some(Timer::Own { since, preset })
                if P::UNROLLED && timers == Timers::InPlace && preset.is_in_ms() =>
            {
                self.own_elapsed(*since, self.preset_ms(*preset))
            }
            _ => self.has_elapsed_apart(timer),
        }
    }

    /// The same, kept apart.
    #[inline(never)]
    pub(crate) fn has_elapsed_apart(&mut self, timer: u16) -> bool {
        let tables = self.tables;
        let program = tables.program();
        match program.timers.get(usize::from(timer)) {
            Some(Timer::Own { since, preset }) => {
                let (preset, unit) = self.preset(*preset);
                let preset = not_below_zero(preset);
                let preset_ms = match unit {
                    Unit::Seconds => in_ms(preset) as u32,
                    Unit::Milliseconds => preset,
                };
                self.own_elapsed(*since, preset_ms)
            }
            Some(Timer::Any {
                step,
                activated,
                preset,
            }) => {
                let (preset, unit) = self.preset(*preset);
                let risen = self.activation(*step, *activated);
                self.elapsed(risen, preset, unit)
            }
            None => false,
        }
    }

    fn preset(&self, preset: Preset) -> (i32, Unit) {
        match preset {
            Preset::Constant(ms) => (ms, Unit::Milliseconds),
            Preset::Number(number, unit) => (self.memory.number(number), unit),
        }
    }

    /// The same of a preset in ms that the compiler knows: of a number it knows the range then.
    #[inline(always)]
    fn preset_ms(&self, preset: Preset) -> u32 {
        let numbers = self.program().numbers;
        let (value, _) = self.preset(preset);
        match preset {
            Preset::Number(number, _)
                if numbers
                    .get(usize::from(number.0))
                    .is_some_and(|row| row.min >= 0) =>
            {
                value as u32
            }
            _ => not_below_zero(value),
        }
    }

    /// When a step or macro step was last activated. Until phase 5 has written it down, one that is activated in
    /// this very round counts from now.
    pub(crate) fn activation(&self, step: Bit, activated: Stamp) -> u64 {
        let tables = self.tables;
        let program = tables.program();
        let layout = &program.layout;
        if self.is_settling() && self.memory.bit(step) && !self.memory.was_active(layout, step) {
            self.now_ms
        } else {
            self.memory.stamp(activated)
        }
    }

    /// Whether the preset has passed since a rise; if not, the next scan by then is no idle one. A rise that never
    /// was has no elapsed time.
    pub(crate) fn elapsed(&mut self, risen_ms: u64, preset: i32, unit: Unit) -> bool {
        let elapsed_ms = self.now_ms.wrapping_sub(risen_ms);
        let long_ms = (elapsed_ms >> 32) as i32;
        let preset = not_below_zero(preset);
        let left_ms = match unit {
            Unit::Seconds => {
                let left_ms = in_ms(preset).saturating_sub(elapsed_ms);
                u32::try_from(left_ms).unwrap_or(u32::MAX)
            }
            Unit::Milliseconds if long_ms == 0 => preset.saturating_sub(elapsed_ms as u32),
            Unit::Milliseconds => 0,
        };
        self.wait(left_ms);
        // A rise that never was lies behind all times.
        left_ms == 0 && long_ms >= 0
    }

    /// The same for a step that is active.
    #[inline(always)]
    fn own_elapsed(&mut self, since: Since, preset_ms: u32) -> bool {
        let active_ms = (self.now_ms as u32).wrapping_sub(self.memory.since(since));
        let runs = active_ms < preset_ms;
        if runs {
            self.wait(preset_ms - active_ms);
        }
        !runs
    }

    /// The scan in so many ms is no idle one; 0 is no time.
    #[inline(always)]
    fn wait(&mut self, left_ms: u32) {
        if left_ms > 0 && left_ms < self.quiet_ms {
            self.quiet_ms = left_ms;
        }
    }
}

/// A preset below zero has always passed, as 0 has.
fn not_below_zero(preset: i32) -> u32 {
    u32::try_from(preset).unwrap_or(0)
}

/// Kept apart: a product of 64 bits is a long call on a small processor, and few presets need it.
#[inline(never)]
fn in_ms(seconds: u32) -> u64 {
    u64::from(seconds) * 1000
}
