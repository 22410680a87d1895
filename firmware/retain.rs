//! The retain store: what survives power, in flash.
//!
//! All retained variables and parameters are one record, stored when one of them changes and only then. The area is
//! two halves, each a `sequential-storage` map with one key. A record goes to the half that does not hold the newest
//! one, and is read back. So whatever a power cut leaves of it - half a program cycle, half an erase - the other half
//! still holds the last good record: after a cut there is the old record or the new one, all of it or none.
//!
//! On an RP2040 no code runs from flash while it is programmed (0.4 ms for a record, two or three times) or erased
//! (45 ms for a sector, once in as many records as a sector holds). A scan that is due meanwhile is late; an erase
//! makes it overrun, which is counted.

use core::ops::Range;

use embedded_storage_async::nor_flash::NorFlash;
use sequential_storage::cache::{Cache, CacheImpl};
use sequential_storage::map::{MapConfig, MapStorage};

use crate::log::fault;
use crate::record::{Record, Values};

/// The longest record that is stored or read, in bytes. About ten bytes are needed for each retained value.
pub const LONGEST_RECORD: usize = 4000;

/// The only key in either map.
const KEY: u8 = 1;

/// Why the store could not do what it was asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(target_os = "none", derive(defmt::Format))]
pub enum Error<E> {
    /// The flash itself reports a fault.
    Flash(E),
    /// The area is not whole sectors, or fewer than four.
    Area,
    /// More values than a record can hold.
    TooLong,
    /// What was written reads otherwise, even after the half was formatted.
    Unreadable,
}

/// One of the two halves of the area.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Half {
    Lower,
    Upper,
}

impl Half {
    const BOTH: [Half; 2] = [Half::Lower, Half::Upper];

    fn other(self) -> Half {
        match self {
            Half::Lower => Half::Upper,
            Half::Upper => Half::Lower,
        }
    }
}

/// The retain area of a flash.
pub struct Store<F> {
    flash: F,
    area: Range<u32>,
    /// Which half holds the newest record, and its sequence number.
    newest: Option<(Half, u32)>,
    /// Halves that were formatted because they could not be read, since start.
    formatted: u32,
    buffer: [u8; LONGEST_RECORD],
}

impl<F: NorFlash> Store<F> {
    /// A store in an area of byte offsets: whole sectors, at least four of them. [`Store::load`] comes first.
    pub const fn new(flash: F, area: Range<u32>) -> Self {
        Store {
            flash,
            area,
            newest: None,
            formatted: 0,
            buffer: [0; LONGEST_RECORD],
        }
    }

    /// The newest good record, if there is one. A half that cannot be read is formatted.
    ///
    /// # Errors
    /// When the flash fails, or the area is none.
    pub async fn load(&mut self) -> Result<Option<Record<'_>>, Error<F::Error>> {
        self.newest = None;
        for half in Half::BOTH {
            let sequence = self.sequence(half).await?;
            self.newest = match (self.newest, sequence) {
                (newest, None) => newest,
                (Some((_, newest)), Some(sequence)) if !is_newer(sequence, newest) => self.newest,
                (_, Some(sequence)) => Some((half, sequence)),
            };
        }
        let Some((half, _)) = self.newest else {
            return Ok(None);
        };
        let range = self.range(half);
        let mut map = map(&mut self.flash, range)?;
        match map.fetch_item(&mut self.buffer, &KEY).await {
            Ok(record) => Ok(record),
            Err(sequential_storage::Error::Storage { value, .. }) => Err(Error::Flash(value)),
            Err(_) => Err(Error::Unreadable),
        }
    }

    /// Stores a record of these values as the newest one. It is in flash when this returns.
    ///
    /// The future must be polled to its end: a write that is dropped half-way is a power cut.
    ///
    /// # Errors
    /// When the record is too long or the flash fails. The record before is then still the newest.
    pub async fn save(
        &mut self,
        fingerprint: u32,
        values: Values<'_>,
    ) -> Result<(), Error<F::Error>> {
        let (half, sequence) = match self.newest {
            Some((half, sequence)) => (half.other(), sequence.wrapping_add(1)),
            None => (Half::Lower, 0),
        };
        let record = Record {
            sequence,
            fingerprint,
            values,
        };
        // A flash may refuse to program what is not erased where it should be.
        let written = match self.write(half, &record).await {
            Err(Error::Flash(_)) => false,
            written => written?,
        };
        if !written {
            self.format(half).await?;
            if !self.write(half, &record).await? {
                return Err(Error::Unreadable);
            }
        }
        self.newest = Some((half, sequence));
        Ok(())
    }

    /// Gives the flash back.
    pub fn into_flash(self) -> F {
        self.flash
    }

    /// The sequence number of the record in a half. A half that is no map any more is formatted and has none.
    async fn sequence(&mut self, half: Half) -> Result<Option<u32>, Error<F::Error>> {
        let range = self.range(half);
        let mut map = map(&mut self.flash, range)?;
        let record = map.fetch_item::<Record<'_>>(&mut self.buffer, &KEY).await;
        match record.map(|record| record.map(|record| record.sequence)) {
            Ok(sequence) => Ok(sequence),
            Err(sequential_storage::Error::Storage { value, .. }) => Err(Error::Flash(value)),
            Err(_) => {
                self.format(half).await?;
                Ok(None)
            }
        }
    }

    /// Writes a record and reads it back. False when the half has to be formatted first.
    async fn write(&mut self, half: Half, record: &Record<'_>) -> Result<bool, Error<F::Error>> {
        use sequential_storage::Error as MapError;

        let range = self.range(half);
        let mut map = map(&mut self.flash, range)?;
        match map.store_item(&mut self.buffer, &KEY, record).await {
            Ok(()) => {}
            Err(MapError::Storage { value, .. }) => return Err(Error::Flash(value)),
            Err(MapError::ItemTooBig | MapError::SerializationError(_)) => {
                return Err(Error::TooLong);
            }
            Err(_) => return Ok(false),
        }
        match map.fetch_item::<Record<'_>>(&mut self.buffer, &KEY).await {
            Ok(read) => Ok(read.is_some_and(|read| read == *record)),
            Err(MapError::Storage { value, .. }) => Err(Error::Flash(value)),
            Err(_) => Ok(false),
        }
    }

    /// Erases a half, a sector at a time: between two sectors a scan can run.
    async fn format(&mut self, half: Half) -> Result<(), Error<F::Error>> {
        self.formatted = self.formatted.saturating_add(1);
        fault!(
            "retain store: unreadable half of the area formatted ({} since start)",
            self.formatted
        );
        for start in self.range(half).step_by(F::ERASE_SIZE) {
            let end = start.saturating_add(F::ERASE_SIZE as u32);
            self.flash.erase(start, end).await.map_err(Error::Flash)?;
        }
        Ok(())
    }

    fn range(&self, half: Half) -> Range<u32> {
        let sectors = self.area.len() / F::ERASE_SIZE / 2;
        let middle = self.area.start + (sectors * F::ERASE_SIZE) as u32;
        match half {
            Half::Lower => self.area.start..middle,
            Half::Upper => middle..self.area.end,
        }
    }
}

/// A map over a part of the flash, which has to be two whole sectors at least.
fn map<F: NorFlash>(
    flash: &mut F,
    range: Range<u32>,
) -> Result<MapStorage<u8, &mut F, impl CacheImpl<u8> + use<F>>, Error<F::Error>> {
    let config = MapConfig::try_new(range).map_err(|_| Error::Area)?;
    Ok(MapStorage::new(flash, config, Cache::new_uncached()))
}

/// Whether a sequence number was given after another one, across a wrap-around.
fn is_newer(sequence: u32, than: u32) -> bool {
    sequence.wrapping_sub(than) as i32 > 0
}
