//! A NOR flash in memory whose power can be cut in the middle of anything it does.

use std::ops::Range;

use embedded_storage_async::nor_flash::{
    ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash,
};

/// How an operation looks that was cut short.
#[derive(Clone, Copy, Debug)]
pub enum Tear {
    /// The bytes up to the cut are as they should be, the others as before.
    InOrder,
    /// Every bit that the operation should change has changed or not, as the seed has it.
    Scattered(u64),
}

/// A flash with sectors of `SECTOR` bytes. Programming clears bits, erasing sets those of whole sectors.
#[derive(Clone)]
pub struct Nor<const SECTOR: usize> {
    pub bytes: Vec<u8>,
    /// Sectors erased so far.
    pub erased: usize,
    /// How often each sector was erased.
    pub wear: Vec<usize>,
    /// Programming operations so far.
    pub programmed: usize,
    /// Everything that has been done since power came, finished or not.
    pub done: Vec<Operation>,
    cut: Option<(usize, Tear)>,
    off: bool,
}

/// Something that takes the flash some time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// So many bytes were programmed.
    Program(usize),
    /// A sector of so many bytes was erased.
    Erase(usize),
}

/// What is programmed at once.
const PAGE: usize = 256;

/// Why the model refuses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The power is off.
    Off,
    /// Outside the flash, not whole sectors, or more than a page.
    Range,
    /// A byte was to be programmed that is not erased.
    NotErased,
}

impl<const SECTOR: usize> Nor<SECTOR> {
    /// An erased flash.
    pub fn new(sectors: usize) -> Self {
        Self::holding(vec![0xff; sectors * SECTOR])
    }

    /// A flash with this content.
    pub fn holding(bytes: Vec<u8>) -> Self {
        Nor {
            wear: vec![0; bytes.len() / SECTOR],
            bytes,
            erased: 0,
            programmed: 0,
            done: Vec::new(),
            cut: None,
            off: false,
        }
    }

    /// Cuts the power once so many further bytes have been programmed or erased, before anybody learns of the last.
    pub fn cut_after(mut self, bytes: usize, tear: Tear) -> Self {
        self.cut = Some((bytes, tear));
        self
    }

    /// Power comes back.
    pub fn power_on(mut self) -> Self {
        self.off = false;
        self.cut = None;
        self.done.clear();
        self
    }

    /// Makes a range into what an operation wants it to be, or tears it.
    fn change(&mut self, range: Range<usize>, wanted: &[u8]) -> Result<(), Refusal> {
        let length = range.len();
        let tear = match &mut self.cut {
            Some((left, tear)) if *left <= length => Some((*left, *tear)),
            Some((left, _)) => {
                *left -= length;
                None
            }
            None => None,
        };
        let now = &mut self.bytes[range];
        match tear {
            None => now.copy_from_slice(wanted),
            Some((done, Tear::InOrder)) => now[..done].copy_from_slice(&wanted[..done]),
            Some((done, Tear::Scattered(seed))) => {
                let mut random = seed ^ (done as u64) << 32 ^ 0x9e37_79b9_7f4a_7c15;
                for (byte, wanted) in now.iter_mut().zip(wanted) {
                    let mask = next(&mut random);
                    *byte = (*byte & !mask) | (wanted & mask);
                }
            }
        }
        self.off = tear.is_some();
        if self.off { Err(Refusal::Off) } else { Ok(()) }
    }

    fn range(&self, offset: u32, length: usize) -> Result<Range<usize>, Refusal> {
        let range = offset as usize..offset as usize + length;
        if self.off {
            Err(Refusal::Off)
        } else if range.end > self.bytes.len() {
            Err(Refusal::Range)
        } else {
            Ok(range)
        }
    }
}

/// xorshift64*, one byte.
fn next(state: &mut u64) -> u8 {
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    (state.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 56) as u8
}

impl NorFlashError for Refusal {
    fn kind(&self) -> NorFlashErrorKind {
        NorFlashErrorKind::Other
    }
}

impl<const SECTOR: usize> ErrorType for Nor<SECTOR> {
    type Error = Refusal;
}

impl<const SECTOR: usize> ReadNorFlash for Nor<SECTOR> {
    const READ_SIZE: usize = 1;

    async fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Refusal> {
        let range = self.range(offset, bytes.len())?;
        bytes.copy_from_slice(&self.bytes[range]);
        Ok(())
    }

    fn capacity(&self) -> usize {
        self.bytes.len()
    }
}

impl<const SECTOR: usize> NorFlash for Nor<SECTOR> {
    const WRITE_SIZE: usize = 1;
    const ERASE_SIZE: usize = SECTOR;

    async fn erase(&mut self, from: u32, to: u32) -> Result<(), Refusal> {
        let range = self.range(from, (to - from) as usize)?;
        if !range.start.is_multiple_of(SECTOR) || !range.end.is_multiple_of(SECTOR) {
            return Err(Refusal::Range);
        }
        for start in range.step_by(SECTOR) {
            self.erased += 1;
            self.wear[start / SECTOR] += 1;
            self.done.push(Operation::Erase(SECTOR));
            self.change(start..start + SECTOR, &[0xff; SECTOR])?;
        }
        Ok(())
    }

    async fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Refusal> {
        let range = self.range(offset, bytes.len())?;
        if bytes.is_empty() || range.start / PAGE != (range.end - 1) / PAGE {
            return Err(Refusal::Range);
        }
        // Hardware would quietly keep the zeros. Nothing here may rely on that: a torn page may not be trusted.
        if self.bytes[range.clone()].iter().any(|byte| *byte != 0xff) {
            return Err(Refusal::NotErased);
        }
        self.programmed += 1;
        self.done.push(Operation::Program(bytes.len()));
        self.change(range, bytes)
    }
}
