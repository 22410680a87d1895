//! The flash as the store sees it: a sector or a page at a time, and nobody has to guess who stopped the processor.
//!
//! While the flash is erased or programmed no code runs from it. So a scan waits for one sector or one page at most, and
//! the scan between two of them feeds the watchdog. Before scan 0 that is done here, as often as an area can need it.

use embassy_rp::flash::{Blocking, ERASE_SIZE, Error, Flash, PAGE_SIZE, READ_SIZE, WRITE_SIZE};
use embassy_rp::peripherals::FLASH;
use embedded_storage_async::nor_flash::{ErrorType, NorFlash, ReadNorFlash};

use super::{FLASH_SIZE, reset};
use crate::application::RETAIN;
use crate::vitals::{Pulse, Task};

/// The flash, driven by the store task, which it shows to be alive.
pub struct StoreFlash {
    flash: Flash<'static, FLASH, Blocking, FLASH_SIZE>,
    pulse: &'static Pulse,
    /// How often the watchdog may still be fed before scan 0: every sector twice.
    feeds: usize,
}

impl StoreFlash {
    /// The flash of a task with this sign of life.
    #[must_use]
    pub fn new(flash: Flash<'static, FLASH, Blocking, FLASH_SIZE>, pulse: &'static Pulse) -> Self {
        StoreFlash {
            flash,
            pulse,
            feeds: 2 * RETAIN.len() / ERASE_SIZE,
        }
    }

    /// An operation in which nothing else runs.
    fn operate<T>(&mut self, operation: impl FnOnce(&mut Self) -> T) -> T {
        self.pulse.beat();
        let before = reset::suspect(Task::Store);
        if before == Task::Start && self.feeds > 0 {
            self.feeds -= 1;
            reset::feed_start();
        }
        #[cfg(feature = "hang")]
        super::hang::hold(Task::Store);
        let outcome = operation(self);
        reset::suspect(before);
        outcome
    }
}

impl ErrorType for StoreFlash {
    type Error = Error;
}

impl ReadNorFlash for StoreFlash {
    const READ_SIZE: usize = READ_SIZE;

    async fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Error> {
        self.pulse.beat();
        self.flash.blocking_read(offset, bytes)
    }

    fn capacity(&self) -> usize {
        FLASH_SIZE
    }
}

impl NorFlash for StoreFlash {
    const WRITE_SIZE: usize = WRITE_SIZE;
    const ERASE_SIZE: usize = ERASE_SIZE;

    async fn erase(&mut self, from: u32, to: u32) -> Result<(), Error> {
        for sector in (from..to).step_by(ERASE_SIZE) {
            let end = to.min(sector.saturating_add(ERASE_SIZE as u32));
            self.operate(|it| it.flash.blocking_erase(sector, end))?;
        }
        Ok(())
    }

    async fn write(&mut self, mut offset: u32, mut bytes: &[u8]) -> Result<(), Error> {
        while !bytes.is_empty() {
            let room = PAGE_SIZE - offset as usize % PAGE_SIZE;
            let (page, rest) = bytes.split_at(room.min(bytes.len()));
            self.operate(|it| it.flash.blocking_write(offset, page))?;
            offset = offset.saturating_add(page.len() as u32);
            bytes = rest;
        }
        Ok(())
    }
}
