//! Hashes that are the same on every machine.

use std::fmt::{self, Write};

use crate::application::Tables;

/// FNV-1a, 32 bits.
struct Fnv(u32);

impl Fnv {
    const START: Fnv = Fnv(0x811c_9dc5);
    const PRIME: u32 = 0x0100_0193;
}

impl Write for Fnv {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            self.0 = (self.0 ^ u32::from(byte)).wrapping_mul(Fnv::PRIME);
        }
        Ok(())
    }
}

/// The hash of a text.
pub(super) fn of_text(text: &str) -> u32 {
    let mut hash = Fnv::START;
    // Writing into a hash never fails.
    let _ = hash.write_str(text);
    hash.0
}

/// The hash of tables, their own fingerprint left out. They are hashed as they are shown, which depends on no machine
/// and on no word size.
pub(super) fn of(tables: &Tables) -> u32 {
    let mut hash = Fnv::START;
    let unmarked = grafcet_core::program::Program {
        fingerprint: 0,
        ..tables.program()
    };
    let _ = write!(hash, "{unmarked:?}");
    hash.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_the_published_one() {
        assert_eq!(of_text(""), 0x811c_9dc5);
        assert_eq!(of_text("a"), 0xe40c_292c);
        assert_eq!(of_text("foobar"), 0xbf9c_f968);
    }
}
