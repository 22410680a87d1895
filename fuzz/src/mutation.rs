//! How one input becomes another.

use fastrand::Rng;

/// So many changes at most are made at once.
const MOST_CHANGES: usize = 6;

/// Numbers at the ends of what something holds.
const EXTREMES: &[&str] = &[
    "0",
    "1",
    "07",
    "255",
    "256",
    "32767",
    "32768",
    "65535",
    "65536",
    "2147483647",
    "2147483648",
    "4294967295",
    "4294967296",
    "18446744073709551615",
    "18446744073709551616",
    "16#FFFFFFFF",
    "0.5",
    "1e9",
];

/// Changes some words of a text: takes them away, repeats, swaps and replaces them, puts a number to its extreme, or
/// puts in a word of the language or a stretch of another text. What is no UTF-8 is changed byte by byte.
#[must_use]
pub fn of_text(input: &[u8], other: &[u8], words: &str, random: &mut Rng) -> Vec<u8> {
    let (Ok(text), Ok(other)) = (str::from_utf8(input), str::from_utf8(other)) else {
        return of_bytes(input, other, random);
    };
    let mut pieces = pieces(text);
    let others = self::pieces(other);
    let words: Vec<&str> = words.split(' ').filter(|word| !word.is_empty()).collect();
    for _ in 0..random.usize(1..=MOST_CHANGES) {
        change(&mut pieces, &others, &words, random);
    }
    pieces.concat().into_bytes()
}

fn change<'t>(pieces: &mut Vec<&'t str>, others: &[&'t str], words: &[&'t str], random: &mut Rng) {
    let Some(at) = place(pieces, random) else {
        pieces.extend(random.choice(words));
        return;
    };
    match random.u8(0..10) {
        0 => {
            pieces.remove(at);
        }
        1 => {
            pieces.drain(at..at + stretch(pieces.len() - at, random));
        }
        2 => pieces.insert(at, pieces[at]),
        3 => {
            let repeated = pieces[at..at + stretch(pieces.len() - at, random)].to_vec();
            pieces.splice(at..at, repeated);
        }
        4 => {
            let with = random.usize(..pieces.len());
            pieces.swap(at, with);
        }
        5 => pieces[at] = pieces[random.usize(..pieces.len())],
        6 | 7 => {
            let numbers: Vec<usize> = (0..pieces.len())
                .filter(|index| pieces[*index].starts_with(|c: char| c.is_ascii_digit()))
                .collect();
            if let (Some(number), Some(extreme)) = (random.choice(numbers), random.choice(EXTREMES))
            {
                pieces[number] = extreme;
            }
        }
        8 => {
            if let Some(word) = random.choice(words) {
                pieces.splice(at..at, [word, " "]);
            }
        }
        _ => {
            if let Some(from) = place(others, random) {
                let taken = &others[from..from + stretch(others.len() - from, random)];
                pieces.splice(at..at, taken.iter().copied());
            }
        }
    }
}

/// Changes some bytes: flips a bit, sets a byte, erases or copies a stretch, or takes one of another input.
#[must_use]
pub fn of_bytes(input: &[u8], other: &[u8], random: &mut Rng) -> Vec<u8> {
    let mut bytes = input.to_vec();
    for _ in 0..random.usize(1..=MOST_CHANGES) {
        let Some(at) = place(&bytes, random) else {
            bytes.push(random.u8(..));
            continue;
        };
        let length = stretch(bytes.len() - at, random);
        match random.u8(0..6) {
            0 => bytes[at] ^= 1 << random.u8(0..8),
            1 => bytes[at] = random.u8(..),
            2 => bytes[at..at + length].fill(random.choice([0, 0xff]).unwrap_or(0)),
            3 => {
                let to = random.usize(..=bytes.len() - length);
                bytes.copy_within(at..at + length, to);
            }
            4 => {
                bytes.drain(at..at + length);
            }
            _ => {
                if let Some(from) = place(other, random) {
                    let taken = &other[from..from + stretch(other.len() - from, random)];
                    let replaced = taken.len().min(bytes.len() - at);
                    bytes.splice(at..at + replaced, taken.iter().copied());
                }
            }
        }
    }
    bytes
}

/// Some index; none when there is nothing.
fn place<T>(items: &[T], random: &mut Rng) -> Option<usize> {
    (!items.is_empty()).then(|| random.usize(..items.len()))
}

/// A length up to what there is: often a short one.
fn stretch(most: usize, random: &mut Rng) -> usize {
    let short = random.bool();
    random.usize(0..=if short { most.min(8) } else { most })
}

/// Words, signs and the white space between them.
fn pieces(text: &str) -> Vec<&str> {
    let mut pieces = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word = |c: char| c.is_alphanumeric() || c == '_';
        let end = if word(first) {
            rest.find(|c| !word(c)).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let (piece, behind) = rest.split_at(end);
        pieces.push(piece);
        rest = behind;
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_seed_gives_the_same_input() {
        let of = |seed| {
            of_text(
                b"step 1 { A }",
                b"graph G {}",
                "OR",
                &mut Rng::with_seed(seed),
            )
        };
        assert!((0..100).all(|seed| of(seed) == of(seed)));
        assert!((0..100).any(|seed| of(seed) != of(seed + 1)));
    }
}
