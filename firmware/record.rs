//! What is stored of the retained values: one record, encoded by `postcard`.

use grafcet_core::program::Retained;
use sequential_storage::map::{SerializationError, Value};

/// All retained values of one moment.
#[derive(Clone, Copy, Debug)]
pub struct Record<'a> {
    /// One more than that of the record before.
    pub sequence: u32,
    /// The fingerprint of the program that stored it.
    pub fingerprint: u32,
    /// The values.
    pub values: Values<'a>,
}

impl PartialEq for Record<'_> {
    fn eq(&self, other: &Self) -> bool {
        (self.sequence, self.fingerprint) == (other.sequence, other.fingerprint)
            && self.values.iter().eq(other.values.iter())
    }
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

impl<'a> Value<'a> for Record<'a> {
    fn serialize_into(&self, buffer: &mut [u8]) -> Result<usize, SerializationError> {
        let mut length = encode(&(self.sequence, self.fingerprint), buffer, 0)?;
        for pair in self.values.iter() {
            length = encode(&pair, buffer, length)?;
        }
        Ok(length)
    }

    fn deserialize_from(buffer: &'a [u8]) -> Result<(Self, usize), SerializationError> {
        let ((sequence, fingerprint), values) =
            postcard::take_from_bytes(buffer).map_err(|_| SerializationError::InvalidFormat)?;
        let record = Record {
            sequence,
            fingerprint,
            values: Values::Stored(values),
        };
        Ok((record, buffer.len()))
    }
}

/// Encodes a value behind the first `length` bytes. The answer is the new length.
fn encode<T: serde::Serialize>(
    value: &T,
    buffer: &mut [u8],
    length: usize,
) -> Result<usize, SerializationError> {
    let free = buffer
        .get_mut(length..)
        .ok_or(SerializationError::BufferTooSmall)?;
    match postcard::to_slice(value, free) {
        Ok(encoded) => Ok(length + encoded.len()),
        Err(_) => Err(SerializationError::BufferTooSmall),
    }
}
