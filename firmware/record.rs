//! What is stored of the retained values: one record, a header and the values, encoded by `postcard`.
//!
//! | bytes | of the header, all little-endian |
//! | --- | --- |
//! | 0 to 3 | CRC-32 of everything behind it |
//! | 4 to 7 | sequence number |
//! | 8 to 11 | fingerprint of the program |
//! | 12, 13 | length of the record, header and all |
//! | 14, 15 | what may still be written: see [`crate::budget`] |

use crc::{CRC_32_ISO_HDLC, Crc, Digest, NoTable};
use grafcet_core::program::Retained;

/// The longest record that is stored or read, in bytes. About ten bytes are needed for each retained value.
pub const LONGEST_RECORD: usize = 4000;

/// The length of a record without values, in bytes.
pub const HEADER: usize = 16;

/// Detects every error of up to three bits in the longest record, and any burst of up to 32.
static CRC: Crc<u32, NoTable> = Crc::<u32, NoTable>::new(&CRC_32_ISO_HDLC);

/// All retained values of one moment.
#[derive(Clone, Copy, Debug)]
pub struct Record<'a> {
    /// One more than that of the record before.
    pub sequence: u32,
    /// The fingerprint of the program that stored it.
    pub fingerprint: u32,
    /// What the store may still write, in its units.
    pub credit: u16,
    /// The values.
    pub values: Values<'a>,
}

/// Retained values under their keys.
#[derive(Clone, Copy, Debug)]
pub enum Values<'a> {
    /// Of a running program: its rows, and a value for each.
    Running(&'a [Retained], &'a [i32]),
    /// As they are stored.
    Stored(&'a [u8]),
}

impl<'a> Values<'a> {
    /// Keys and values, in the order of the program that stored them.
    pub fn iter(&self) -> impl Iterator<Item = (u32, i32)> + use<'a> {
        let (rows, values, mut stored) = match *self {
            Values::Running(rows, values) => (rows, values, &[][..]),
            Values::Stored(bytes) => (&[][..], &[][..], bytes),
        };
        let running = rows
            .iter()
            .zip(values)
            .map(|(row, value)| (row.key, *value));
        running.chain(core::iter::from_fn(move || {
            let (pair, rest) = postcard::take_from_bytes(stored).ok()?;
            stored = rest;
            Some(pair)
        }))
    }
}

impl Record<'_> {
    /// Encodes the record. The answer is its length in bytes; none when it does not fit into the buffer.
    pub(crate) fn encode(&self, buffer: &mut [u8]) -> Option<usize> {
        let mut length = HEADER;
        for pair in self.values.iter() {
            let free = buffer.get_mut(length..)?;
            length += postcard::to_slice(&pair, free).ok()?.len();
        }
        let header = Header {
            check: 0,
            sequence: self.sequence,
            fingerprint: self.fingerprint,
            length: u16::try_from(length).ok()?,
            credit: self.credit,
        };
        buffer.get_mut(..HEADER)?.copy_from_slice(&header.bytes());
        let check = CRC.checksum(buffer.get(CHECK..length)?);
        buffer
            .get_mut(..CHECK)?
            .copy_from_slice(&check.to_le_bytes());
        Some(length)
    }
}

/// Bytes of the check sum, which it does not cover.
const CHECK: usize = 4;

/// The beginning of a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Header {
    check: u32,
    pub(crate) sequence: u32,
    pub(crate) fingerprint: u32,
    length: u16,
    pub(crate) credit: u16,
}

impl Header {
    /// Reads what may be a header.
    pub(crate) fn read(bytes: &[u8; HEADER]) -> Self {
        let [a, b, c, d, e, f, g, h, i, j, k, l, length @ .., m, n] = *bytes;
        Header {
            check: u32::from_le_bytes([a, b, c, d]),
            sequence: u32::from_le_bytes([e, f, g, h]),
            fingerprint: u32::from_le_bytes([i, j, k, l]),
            length: u16::from_le_bytes(length),
            credit: u16::from_le_bytes([m, n]),
        }
    }

    /// The length of the record in bytes, if it can be one.
    pub(crate) fn record_length(&self) -> Option<usize> {
        let length = usize::from(self.length);
        (HEADER..=LONGEST_RECORD)
            .contains(&length)
            .then_some(length)
    }

    /// The check of a record that begins so; what follows the header is still to be added.
    pub(crate) fn check(&self) -> Check {
        let mut digest = CRC.digest();
        digest.update(self.bytes().get(CHECK..).unwrap_or_default());
        Check {
            digest,
            expected: self.check,
        }
    }

    fn bytes(&self) -> [u8; HEADER] {
        let mut bytes = [0; HEADER];
        let parts = [
            &self.check.to_le_bytes()[..],
            &self.sequence.to_le_bytes(),
            &self.fingerprint.to_le_bytes(),
            &self.length.to_le_bytes(),
            &self.credit.to_le_bytes(),
        ];
        for (to, from) in bytes.iter_mut().zip(parts.into_iter().flatten()) {
            *to = *from;
        }
        bytes
    }
}

/// The check sum of a record that is read in parts.
pub(crate) struct Check {
    digest: Digest<'static, u32, NoTable>,
    expected: u32,
}

impl Check {
    /// Adds the next bytes.
    pub(crate) fn add(&mut self, bytes: &[u8]) {
        self.digest.update(bytes);
    }

    /// Whether the record is as it was written.
    pub(crate) fn holds(self) -> bool {
        self.digest.finalize() == self.expected
    }
}
