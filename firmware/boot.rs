//! From reset to scan 0: why the controller starts, and what it still knows.

use embedded_storage_async::nor_flash::NorFlash;
use grafcet_core::engine::Engine;
use grafcet_core::memory::Memory;
use grafcet_core::program::{Compiled, Names};

use crate::log::{fault, note};
use crate::record::Record;
use crate::retain::{Error, Store};
use crate::vitals::Task;

/// Why the controller starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// Power came.
    PowerOn,
    /// The supply sagged so far that the chip reset itself, but not so far that its memory was lost.
    BrownOut,
    /// The reset pin.
    RunPin,
    /// A debugger.
    Debugger,
    /// The boot ROM, after a new image was flashed by it.
    Reboot,
    /// A task hung, and with it the controller, or it was stopped for that.
    Watchdog(Task),
    /// Scans took too long too often, and the policy is to start again.
    Overload,
    /// The program's image ended in a panic or a fault of the processor.
    Panic,
}

impl Cause {
    /// What `System:recovered` says.
    #[must_use]
    pub const fn is_recovery(self) -> bool {
        matches!(
            self,
            Cause::BrownOut | Cause::Watchdog(_) | Cause::Overload | Cause::Panic
        )
    }

    /// The cause in words, for the boot line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Cause::PowerOn => "power-on",
            Cause::BrownOut => "brown-out",
            Cause::RunPin => "run pin",
            Cause::Debugger => "debugger",
            Cause::Reboot => "reboot",
            Cause::Watchdog(Task::Start) => "watchdog: start hung",
            Cause::Watchdog(Task::Scan) => "watchdog: scan hung",
            Cause::Watchdog(Task::Store) => "watchdog: retain store hung",
            Cause::Overload => "overload",
            Cause::Panic => "panic",
        }
    }
}

/// What a board finds after a reset. A mark is a register that outlives every reset but those that power and the reset
/// pin cause.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Evidence {
    /// The watchdog reset the chip: it ran out, or was told to.
    pub by_watchdog: bool,
    /// What the image that ran before left.
    pub mark: Mark,
    /// Of that image, the task that had the processor, as far as it is known.
    pub suspect: Task,
    /// The last reset of the whole chip came from the debug port.
    pub by_debug_port: bool,
    /// The last reset of the whole chip came from the reset pin.
    pub by_run_pin: bool,
    /// The memory still holds what the image that ran before left there.
    pub memory_kept: bool,
}

/// What an image leaves in a register for the next start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Nothing: power failed since.
    None,
    /// It was running.
    Running,
    /// It panicked.
    Panicked,
    /// It was stopped for overload.
    Overloaded,
}

impl Mark {
    /// The mark as the word that is left.
    #[must_use]
    pub const fn word(self) -> u32 {
        match self {
            Mark::None => 0,
            Mark::Running => 0x706c_6331,
            Mark::Panicked => 0x706c_6321,
            Mark::Overloaded => 0x706c_6341,
        }
    }

    /// The mark in a word that was left, if it is one.
    #[must_use]
    pub fn read(word: u32) -> Mark {
        let marks = [Mark::Running, Mark::Panicked, Mark::Overloaded];
        let found = marks.into_iter().find(|mark| mark.word() == word);
        found.unwrap_or(Mark::None)
    }
}

impl Evidence {
    /// Why the board starts.
    #[must_use]
    pub const fn cause(self) -> Cause {
        match (self.by_watchdog, self.mark) {
            (true, Mark::Panicked) => Cause::Panic,
            (true, Mark::Overloaded) => Cause::Overload,
            (true, Mark::Running) => Cause::Watchdog(self.suspect),
            // The boot ROM uses the watchdog to leave for a new image; it knows no mark of ours.
            (true, Mark::None) => Cause::Reboot,
            // Only the processor was reset.
            (false, Mark::Running | Mark::Panicked | Mark::Overloaded) => Cause::Debugger,
            (false, Mark::None) if self.by_debug_port => Cause::Debugger,
            (false, Mark::None) if self.by_run_pin => Cause::RunPin,
            (false, Mark::None) if self.memory_kept => Cause::BrownOut,
            (false, Mark::None) => Cause::PowerOn,
        }
    }
}

/// Gives a program that has not been started what the store kept, and logs the boot line.
///
/// Nothing in the store keeps a program from starting: what does not fit is dropped with a line of its own, and
/// without a readable record all values are the declared ones.
pub async fn boot<F: NorFlash>(
    engine: &mut Engine<impl Compiled, impl Memory>,
    names: &Names<'_>,
    store: &mut Store<F>,
    cause: Cause,
) {
    engine.set_recovered(cause.is_recovery());
    let restored = match store.load().await {
        Ok(Some(record)) => restore(engine, names, &record),
        Ok(None) => 0,
        Err(error) => {
            log_error(&error);
            0
        }
    };
    let program = engine.program();
    note!(
        "{} {:08x}, scan {} ms, reset: {}, restored: {} of {} retained values",
        names.application,
        program.fingerprint,
        program.period_ms,
        cause.name(),
        restored,
        program.retained.len(),
    );
}

/// Restores what fits. The answer is how many values that was.
fn restore(
    engine: &mut Engine<impl Compiled, impl Memory>,
    names: &Names<'_>,
    record: &Record<'_>,
) -> u32 {
    let tables = engine.tables();
    let program = tables.program();
    if record.fingerprint != program.fingerprint {
        note!(
            "retain store: last written by another program, {:08x}",
            record.fingerprint
        );
    }
    let mut restored = 0;
    for (key, value) in record.values.iter() {
        let row = program
            .retained
            .iter()
            .zip(names.retained)
            .find(|(row, _)| row.key == key);
        match row {
            Some((row, _)) if engine.restore(row.slot, value) => restored += 1,
            Some((_, name)) => fault!(
                "retain store: {} = {} does not fit and is dropped",
                *name,
                value
            ),
            None => fault!(
                "retain store: value {} of unknown {:08x} is dropped",
                value,
                key
            ),
        }
    }
    restored
}

/// Logs what is wrong with the store. The error of the flash itself says nothing more.
pub(crate) fn log_error<E>(error: &Error<E>) {
    let reason = match error {
        Error::Flash(_) => "the flash reports a fault",
        Error::Area => "its area is not four whole sectors",
        Error::TooLong => "the record is too long",
        Error::Unreadable => "what was written cannot be read",
        Error::NoStock => "no erased sector is left",
    };
    fault!("retain store: {}", reason);
}
