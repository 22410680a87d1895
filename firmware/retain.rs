//! The retain store: what survives power, in flash.
//!
//! All retained variables and parameters are one [record](crate::record), stored when one of them changes and only then.
//! The area is a ring of sectors. Records are written one behind the other, each where the flash is erased; the newest
//! one that is whole holds. Its check sum tells whether it is: whatever a power cut leaves of a record, the one before
//! is still there. After a cut there is the old record or the new one, all of it or none.
//!
//! On an RP2040 no code runs from flash while a page is programmed (0.4 ms typically, 3 ms at most) or a sector erased
//! (45 ms, 400 ms at most). So a record that fits into a page never crosses from one into the next: it is one program. A
//! longer one begins with a page, and is programmed page by page; between two of them a scan can run. Nothing is erased
//! to write a record: erased sectors are kept in stock, and erasing is left to the moments that the caller chooses.
//!
//! Seen from the sector that is written to, the ring is: the stock, erased; sectors that are spent, whose records nobody
//! needs; and the sector before, which is kept because it may hold the record before the newest. Should the newest
//! one be damaged, that one holds.
//!
//! `sequential-storage` was used here before. It erases when it writes, with no way to do so ahead (its issue 80), and
//! programs two or three times for an item.

use core::ops::Range;

use embedded_storage_async::nor_flash::NorFlash;

use crate::budget::GRAIN;
use crate::record::{HEADER, Header, LONGEST_RECORD, Record, Values};

/// What is programmed at once, in bytes. Sectors are whole pages.
pub const PAGE: usize = 256;

/// The fewest sectors: one to write to, the one before, and two in stock, so that one can be erased while there is
/// another.
pub const FEWEST_SECTORS: usize = 4;

/// How many places are tried for a record that cannot be read where it was written.
const ATTEMPTS: usize = 3;

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
    /// What was written reads otherwise, in several places.
    Unreadable,
    /// No sector in stock: one has to be erased before the record can be written.
    NoStock,
}

/// The retain area of a flash.
pub struct Store<F> {
    flash: F,
    area: Range<u32>,
    /// Where the newest record stands, and how it begins.
    newest: Option<(usize, Header)>,
    /// The sector that is written to.
    active: usize,
    /// Where in it the next record may stand.
    next: usize,
    /// How many sectors behind it are known to be erased.
    stock: usize,
    /// Grains of flash used since [`Store::load`].
    used: u32,
    buffer: [u8; LONGEST_RECORD],
}

impl<F: NorFlash> Store<F> {
    const SECTOR: usize = F::ERASE_SIZE;

    /// A store in an area of byte offsets: whole sectors, at least four of them. [`Store::load`] comes first.
    pub const fn new(flash: F, area: Range<u32>) -> Self {
        Store {
            flash,
            area,
            newest: None,
            active: 0,
            next: 0,
            stock: 0,
            used: 0,
            buffer: [0; LONGEST_RECORD],
        }
    }

    /// The newest whole record, if there is one. Nothing is changed in the flash.
    ///
    /// # Errors
    /// When the flash fails, or the area is none.
    pub async fn load(&mut self) -> Result<Option<Record<'_>>, Error<F::Error>> {
        self.check_area()?;
        self.newest = None;
        (self.active, self.next) = (0, 0);
        let mut blank = 0_u64;
        for sector in 0..self.sectors() {
            let end = self.look_through(sector).await?;
            if end == 0 {
                blank |= bit(sector);
            }
            let active = self.newest.map_or(0, |(at, _)| at / Self::SECTOR);
            if active == sector {
                (self.active, self.next) = (active, end);
            }
        }
        self.stock = 0;
        while self.stock < self.most_stock() && blank & bit(self.ahead(self.stock + 1)) != 0 {
            self.stock += 1;
        }
        let Some((at, header)) = self.newest else {
            return Ok(None);
        };
        let length = header.record_length().unwrap_or(HEADER);
        let record = self.buffer.get_mut(..length).ok_or(Error::TooLong)?;
        let place = offset(&self.area, at);
        self.flash.read(place, record).await.map_err(Error::Flash)?;
        Ok(Some(Record {
            sequence: header.sequence,
            fingerprint: header.fingerprint,
            credit: header.credit,
            values: Values::Stored(record.get(HEADER..).unwrap_or_default()),
        }))
    }

    /// Stores a record of these values as the newest one. It is in flash when this returns. `credit` is what may still
    /// be written before it.
    ///
    /// The future must be polled to its end: a write that is dropped half-way is a power cut.
    ///
    /// # Errors
    /// When the record is too long, there is no place for it, or the flash fails. The record before is then still the
    /// newest.
    pub async fn save(
        &mut self,
        fingerprint: u32,
        values: Values<'_>,
        credit: u16,
    ) -> Result<(), Error<F::Error>> {
        self.check_area()?;
        let sequence = match &self.newest {
            Some((_, newest)) => newest.sequence.wrapping_add(1),
            None => 0,
        };
        let used = self.used;
        for _ in 0..ATTEMPTS {
            let paid = u16::try_from(self.used.wrapping_sub(used)).unwrap_or(u16::MAX);
            let record = Record {
                sequence,
                fingerprint,
                credit: credit.saturating_sub(paid),
                values,
            };
            let length = record.encode(&mut self.buffer).ok_or(Error::TooLong)?;
            let at = self.take_place(length)?;
            self.program(at, length).await?;
            if let Some(header) = self.read_back(at, length).await? {
                self.newest = Some((at, header));
                return Ok(());
            }
        }
        Err(Error::Unreadable)
    }

    /// Takes the next sector that is spent into the stock: erases it, unless it is erased. False when there is none.
    ///
    /// Whether the flash did erase it shows when a record is written there and read back.
    ///
    /// # Errors
    /// When the flash fails, or the area is none.
    pub async fn erase_spent(&mut self) -> Result<bool, Error<F::Error>> {
        self.check_area()?;
        if self.spent() == 0 {
            return Ok(false);
        }
        let sector = self.ahead(self.stock + 1);
        if !self.is_blank(sector).await? {
            let start = offset(&self.area, sector * Self::SECTOR);
            let end = start.saturating_add(Self::SECTOR as u32);
            self.flash.erase(start, end).await.map_err(Error::Flash)?;
        }
        self.stock += 1;
        Ok(true)
    }

    /// How many sectors are erased and not written to yet.
    #[must_use]
    pub fn stock(&self) -> usize {
        self.stock
    }

    /// The largest stock that there can be.
    #[must_use]
    pub fn most_stock(&self) -> usize {
        self.sectors().saturating_sub(2)
    }

    /// How many sectors can be taken into the stock.
    #[must_use]
    pub fn spent(&self) -> usize {
        self.most_stock().saturating_sub(self.stock)
    }

    /// Grains of flash used since [`Store::load`], left out ones too. Wraps around.
    #[must_use]
    pub fn used(&self) -> u32 {
        self.used
    }

    /// The size of the area in bytes.
    #[must_use]
    pub fn area(&self) -> usize {
        self.area.len()
    }

    /// What the newest record says may still be written.
    #[must_use]
    pub fn credit(&self) -> Option<u16> {
        self.newest.map(|(_, header)| header.credit)
    }

    /// Gives the flash back.
    pub fn into_flash(self) -> F {
        self.flash
    }

    fn check_area(&self) -> Result<(), Error<F::Error>> {
        let whole = |bytes: usize| bytes.is_multiple_of(Self::SECTOR);
        let fits = whole(self.area.start as usize)
            && whole(self.area.len())
            && Self::SECTOR.is_multiple_of(PAGE)
            && self.sectors() >= FEWEST_SECTORS;
        if fits { Ok(()) } else { Err(Error::Area) }
    }

    fn sectors(&self) -> usize {
        self.area.len() / Self::SECTOR
    }

    /// The sector so many places behind the active one, in the ring.
    fn ahead(&self, places: usize) -> usize {
        let sector = self.active + places;
        sector.checked_rem(self.sectors()).unwrap_or(0)
    }

    /// Looks for whole records in a sector that are newer than the newest one. The answer is where the next one may stand;
    /// 0 when the sector is erased.
    async fn look_through(&mut self, sector: usize) -> Result<usize, Error<F::Error>> {
        let mut page = [0; PAGE];
        let (mut at, mut end) = (0, 0);
        while at < Self::SECTOR {
            let inside = at % PAGE;
            let start = sector * Self::SECTOR + at;
            self.read_page(start - inside, &mut page).await?;
            let rest = page.get(inside..).unwrap_or_default();
            let Some(bytes) = rest.first_chunk::<GRAIN>() else {
                break;
            };
            if is_erased(rest) {
                at += PAGE - inside;
            } else if is_erased(bytes) {
                at += GRAIN;
            } else {
                let (whole, length) = self.look_at(start, Header::read(bytes)).await?;
                // Nothing is written to where a torn record would have gone on: it might complete it.
                end = end.max(at + length);
                at += if whole { length } else { GRAIN };
            }
        }
        Ok(end)
    }

    /// Looks at what may be a record: whether it is one, and how many bytes it takes, or would.
    async fn look_at(
        &mut self,
        at: usize,
        header: Header,
    ) -> Result<(bool, usize), Error<F::Error>> {
        let Some(length) = header.record_length().filter(|it| Self::can_stand(at, *it)) else {
            return Ok((false, GRAIN));
        };
        let whole = self.is_whole(at, header, length).await?;
        let newest = self.newest.as_ref();
        if whole && newest.is_none_or(|(_, newest)| is_newer(header.sequence, newest.sequence)) {
            self.newest = Some((at, header));
        }
        Ok((whole, length.next_multiple_of(GRAIN)))
    }

    /// Whether a record of that length is ever written there: on one page, or from the beginning of one.
    fn can_stand(at: usize, length: usize) -> bool {
        let within = if length <= PAGE {
            PAGE
        } else if at.is_multiple_of(PAGE) {
            Self::SECTOR
        } else {
            return false;
        };
        at % within + length <= within
    }

    /// Whether a record that seems to begin here is as it was written.
    async fn is_whole(
        &mut self,
        at: usize,
        header: Header,
        length: usize,
    ) -> Result<bool, Error<F::Error>> {
        let mut check = header.check();
        let mut part = [0; 4 * GRAIN];
        let mut done = HEADER;
        while done < length {
            let wanted = (length - done).min(part.len());
            let bytes = part.get_mut(..wanted).unwrap_or_default();
            let place = offset(&self.area, at + done);
            self.flash.read(place, bytes).await.map_err(Error::Flash)?;
            check.add(bytes);
            done += wanted;
        }
        Ok(check.holds())
    }

    async fn is_blank(&mut self, sector: usize) -> Result<bool, Error<F::Error>> {
        let mut page = [0; PAGE];
        for at in (0..Self::SECTOR).step_by(PAGE) {
            self.read_page(sector * Self::SECTOR + at, &mut page)
                .await?;
            if !is_erased(&page) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    async fn read_page(&mut self, at: usize, page: &mut [u8; PAGE]) -> Result<(), Error<F::Error>> {
        let place = offset(&self.area, at);
        self.flash.read(place, page).await.map_err(Error::Flash)
    }

    /// Takes the next place for a record of that length. Whatever becomes of it, nothing else will be written there.
    fn take_place(&mut self, length: usize) -> Result<usize, Error<F::Error>> {
        if length > Self::SECTOR {
            return Err(Error::TooLong);
        }
        let mut start = self.next;
        if !start.is_multiple_of(PAGE) && start % PAGE + length > PAGE {
            start = start.next_multiple_of(PAGE);
        }
        let mut left_out = start - self.next;
        if start + length > Self::SECTOR {
            self.stock = self.stock.checked_sub(1).ok_or(Error::NoStock)?;
            left_out = Self::SECTOR - self.next;
            self.active = self.ahead(1);
            start = 0;
        }
        let taken = length.next_multiple_of(GRAIN);
        self.next = start + taken;
        self.used = self.used.wrapping_add(((left_out + taken) / GRAIN) as u32);
        Ok(self.active * Self::SECTOR + start)
    }

    /// Programs the first bytes of the buffer, a page at a time: between two of them a scan can run.
    async fn program(&mut self, at: usize, length: usize) -> Result<(), Error<F::Error>> {
        let record = self.buffer.get(..length).unwrap_or_default();
        for (number, page) in record.chunks(PAGE).enumerate() {
            let place = offset(&self.area, at + number * PAGE);
            self.flash.write(place, page).await.map_err(Error::Flash)?;
        }
        Ok(())
    }

    /// How the record in the buffer begins, if it stands there.
    async fn read_back(
        &mut self,
        at: usize,
        length: usize,
    ) -> Result<Option<Header>, Error<F::Error>> {
        let record = self.buffer.get(..length).unwrap_or_default();
        let mut part = [0; 4 * GRAIN];
        for (number, wanted) in record.chunks(part.len()).enumerate() {
            let place = offset(&self.area, at + number * part.len());
            let bytes = part.get_mut(..wanted.len()).unwrap_or_default();
            self.flash.read(place, bytes).await.map_err(Error::Flash)?;
            if bytes != wanted {
                return Ok(None);
            }
        }
        Ok(record.first_chunk().map(Header::read))
    }
}

/// A sector in a set of sectors. Those beyond 64 are in none: they are looked at when they are needed.
fn bit(sector: usize) -> u64 {
    u32::try_from(sector).map_or(0, |sector| 1_u64.checked_shl(sector).unwrap_or(0))
}

/// How an erased byte reads.
const ERASED: u8 = 0xff;

fn is_erased(bytes: &[u8]) -> bool {
    bytes.iter().all(|byte| *byte == ERASED)
}

/// The place in the flash of a place in the area.
fn offset(area: &Range<u32>, at: usize) -> u32 {
    area.start.saturating_add(at as u32)
}

/// Whether a sequence number was given after another one, across a wrap-around.
fn is_newer(sequence: u32, than: u32) -> bool {
    sequence.wrapping_sub(than) as i32 > 0
}
