//! Walking over the bits that are set, and a Boolean that is a word.

use core::ops::Range;

/// The places of the set bits of consecutive words, lowest first.
pub(crate) fn set_bits(words: &[u32]) -> impl Iterator<Item = usize> + '_ {
    words
        .iter()
        .enumerate()
        .flat_map(|(index, word)| set_bits_of(*word).map(move |bit| index * 32 + bit))
}

/// The places of the set bits of one word, lowest first.
pub(crate) fn set_bits_of(word: u32) -> impl Iterator<Item = usize> {
    let mut rest = word;
    core::iter::from_fn(move || {
        if rest == 0 {
            return None;
        }
        let bit = rest.trailing_zeros() as usize;
        rest &= rest - 1;
        Some(bit)
    })
}

/// Of consecutive bits, counted over many words, those that lie in one of these.
pub(crate) fn bits_in_word(bits: &Range<usize>, word: usize) -> u32 {
    let from = bits.start.saturating_sub(word * 32).min(32);
    let to = bits.end.saturating_sub(word * 32).min(32);
    // None is all shifted out.
    let below = |bit: usize| u32::MAX.checked_shr(32 - bit as u32).unwrap_or(0);
    below(to) & !below(from)
}

/// A Boolean of a word's size: an engine without gaps is moved without a call that copies memory.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Flag {
    Off,
    On,
}

#[cfg(test)]
mod tests {
    use super::bits_in_word;

    #[test]
    fn consecutive_bits_lie_in_the_words_they_reach() {
        assert_eq!(bits_in_word(&(0..0), 0), 0);
        assert_eq!(bits_in_word(&(7..7), 0), 0);
        assert_eq!(bits_in_word(&(0..32), 0), u32::MAX);
        assert_eq!(bits_in_word(&(4..9), 0), 0b1_1111_0000);
        assert_eq!(bits_in_word(&(30..97), 0), 0b11 << 30);
        assert_eq!(bits_in_word(&(30..97), 1), u32::MAX);
        assert_eq!(bits_in_word(&(30..97), 3), 1);
        assert_eq!(bits_in_word(&(30..97), 4), 0);
        assert_eq!(bits_in_word(&(40..41), 0), 0);
    }
}
