//! Walking over the bits that are set, and a Boolean that is a word.

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

/// A Boolean of a word's size: an engine without gaps is moved without a call that copies memory.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Flag {
    Off,
    On,
}
