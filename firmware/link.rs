//! Between the scan and the store: changed values on their way to the flash, and when the flash may be erased.
//!
//! The scan waits for none of it. It leaves the newest values, a lease while the program declares a quiet moment, and takes
//! the alarm of the store as one of its inputs.

use core::sync::atomic::{AtomicBool, Ordering};

use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::signal::Signal;
use embassy_time::{Duration, Instant};
use grafcet_core::engine::Engine;
use grafcet_core::memory::Memory;
use grafcet_core::program::{Bit, Compiled};

/// What of the program the store is wired to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wires {
    /// While it is True, the flash may be erased.
    pub quiet: Option<Bit>,
    /// The input that is True while the store needs a quiet moment, or cannot store.
    pub alarm: Option<Bit>,
}

/// What scan and store tell each other of R retained values.
pub struct Link<const R: usize> {
    wires: Wires,
    changes: Signal<CriticalSectionRawMutex, [i32; R]>,
    quiet_until: Signal<CriticalSectionRawMutex, Instant>,
    alarm: AtomicBool,
    /// A lease has been made use of since the latest scan.
    erased: AtomicBool,
}

/// A lease lasts to the next scan. This is how much of it has to be left for an erase to begin within it: between the
/// decision and the flash lie some microseconds, and an interrupt at worst.
const MARGIN: Duration = Duration::from_micros(200);

impl<const R: usize> Link<R> {
    /// A link with nothing under way.
    #[must_use]
    pub const fn new(wires: Wires) -> Self {
        Link {
            wires,
            changes: Signal::new(),
            quiet_until: Signal::new(),
            alarm: AtomicBool::new(false),
            erased: AtomicBool::new(false),
        }
    }

    /// Before a scan: the alarm becomes an input.
    pub fn sample(&self, engine: &mut Engine<impl Compiled, impl Memory>) {
        if let Some(bit) = self.wires.alarm {
            engine.set_input(bit, self.alarm.load(Ordering::Relaxed));
        }
    }

    /// Before a scan: whether the flash was erased since the one before because the program was quiet.
    pub fn has_erased(&self) -> bool {
        // The store does not run while the scan does.
        let erased = self.erased.load(Ordering::Relaxed);
        self.erased.store(false, Ordering::Relaxed);
        erased
    }

    /// After a scan, before the next one at `release`: whether the program is quiet until then.
    // A function of its own: what calls wakers through pointers is listed by name (tests/image).
    #[inline(never)]
    pub fn lease(&self, engine: &Engine<impl Compiled, impl Memory>, release: Instant) {
        match self.wires.quiet {
            Some(bit) if engine.bit(bit) => self.quiet_until.signal(release),
            Some(_) => self.quiet_until.reset(),
            None => {}
        }
    }

    /// Hands changed values to the store. Newer ones take the place of those that have not been fetched, so that the
    /// scan never waits for the flash.
    pub fn hand(&self, values: [i32; R]) {
        self.changes.signal(values);
    }

    /// Whether the program declares quiet moments at all.
    #[must_use]
    pub fn declares_quiet(&self) -> bool {
        self.wires.quiet.is_some()
    }

    /// The newest values, if they have changed since they were last asked for.
    pub fn try_changed(&self) -> Option<[i32; R]> {
        self.changes.try_take()
    }

    /// The newest values, when they have changed.
    pub async fn changed(&self) -> [i32; R] {
        self.changes.wait().await
    }

    /// Waits for a scan that declares a quiet moment, and leaves enough of it, for an erase that follows at once. Each scan
    /// is good for one.
    pub async fn quiet(&self) {
        loop {
            let until = self.quiet_until.wait().await;
            if Instant::now().saturating_add(MARGIN) < until {
                self.erased.store(true, Ordering::Relaxed);
                return;
            }
        }
    }

    /// Raises the alarm, or ends it.
    pub fn set_alarm(&self, alarm: bool) {
        self.alarm.store(alarm, Ordering::Relaxed);
    }
}
