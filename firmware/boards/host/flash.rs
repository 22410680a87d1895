//! A NOR flash in a file: the soft PLC's retain area.

use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::Path;

use embedded_storage_async::nor_flash::{
    ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash,
};

/// Bytes that are erased at once, as in the Pico's flash.
const SECTOR: usize = 4096;

/// A part of a flash, kept in a file. As in the Pico's, a write only clears bits and an erase sets those of a sector.
pub struct FlashFile {
    file: File,
    area: Range<u32>,
}

/// What goes wrong with a flash in a file.
#[derive(Debug)]
pub enum Error {
    /// Outside the area.
    OutOfBounds,
    /// Not whole sectors.
    NotAligned,
    /// The file.
    File(io::Error),
}

impl FlashFile {
    /// Opens the file that holds an area, or makes one that is erased. A file of another length is made to fit.
    ///
    /// # Errors
    /// When the file can neither be read nor made.
    pub fn open(path: &Path, area: Range<u32>) -> io::Result<Self> {
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)?;
        let length = file.metadata()?.len().min(area.len() as u64);
        file.set_len(length)?;
        file.seek(SeekFrom::End(0))?;
        let missing = area.len() as u64 - length;
        io::copy(&mut io::repeat(0xff).take(missing), &mut file)?;
        Ok(FlashFile { file, area })
    }

    /// Goes to a place, if so many bytes of the area are there.
    fn seek(&mut self, offset: u32, length: usize) -> Result<(), Error> {
        let inside = offset >= self.area.start
            && (u64::from(offset) + length as u64) <= u64::from(self.area.end);
        if !inside {
            return Err(Error::OutOfBounds);
        }
        self.file
            .seek(SeekFrom::Start(u64::from(offset - self.area.start)))?;
        Ok(())
    }
}

impl ErrorType for FlashFile {
    type Error = Error;
}

impl ReadNorFlash for FlashFile {
    const READ_SIZE: usize = 1;

    async fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Error> {
        self.seek(offset, bytes.len())?;
        self.file.read_exact(bytes)?;
        Ok(())
    }

    fn capacity(&self) -> usize {
        self.area.end as usize
    }
}

impl NorFlash for FlashFile {
    const WRITE_SIZE: usize = 1;
    const ERASE_SIZE: usize = SECTOR;

    async fn erase(&mut self, from: u32, to: u32) -> Result<(), Error> {
        if !(from as usize).is_multiple_of(SECTOR) || !(to as usize).is_multiple_of(SECTOR) {
            return Err(Error::NotAligned);
        }
        let length = to.saturating_sub(from) as usize;
        self.seek(from, length)?;
        io::copy(&mut io::repeat(0xff).take(length as u64), &mut self.file)?;
        self.file.sync_data()?;
        Ok(())
    }

    async fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Error> {
        let mut stored = vec![0; bytes.len()];
        self.read(offset, &mut stored).await?;
        for (stored, byte) in stored.iter_mut().zip(bytes) {
            *stored &= byte;
        }
        self.seek(offset, bytes.len())?;
        self.file.write_all(&stored)?;
        self.file.sync_data()?;
        Ok(())
    }
}

impl From<io::Error> for Error {
    fn from(error: io::Error) -> Self {
        Error::File(error)
    }
}

impl NorFlashError for Error {
    fn kind(&self) -> NorFlashErrorKind {
        match self {
            Error::OutOfBounds => NorFlashErrorKind::OutOfBounds,
            Error::NotAligned => NorFlashErrorKind::NotAligned,
            Error::File(_) => NorFlashErrorKind::Other,
        }
    }
}
