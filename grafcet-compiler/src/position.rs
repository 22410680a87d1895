//! Lines and columns.

use serde::Serialize;

/// A place in a text as people count: line and column from 1, columns in characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Position {
    /// The line, from 1.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
}

/// The position of a byte offset. Behind the end of the text it is the end.
#[must_use]
pub fn line_column(text: &str, offset: usize) -> Position {
    Lines::of(text).position(offset)
}

/// Where the lines of a text begin, and how many characters stand before each of its blocks.
#[derive(Clone, Debug)]
pub(crate) struct Lines<'a> {
    text: &'a str,
    starts: Vec<usize>,
    characters: Vec<usize>,
}

/// Bytes from one count of characters to the next.
const BLOCK: usize = 512;

impl<'a> Lines<'a> {
    /// Reads the text once, so that each position costs no more than a block, in a text of one line too.
    pub(crate) fn of(text: &'a str) -> Self {
        let behind_breaks = text.match_indices('\n').map(|(at, _)| at + 1);
        let mut characters = vec![0];
        let mut count = 0;
        for block in text.as_bytes().chunks(BLOCK) {
            count += begun(block);
            characters.push(count);
        }
        Lines {
            text,
            starts: std::iter::once(0).chain(behind_breaks).collect(),
            characters,
        }
    }

    /// The line that an offset lies in, from 1.
    pub(crate) fn line(&self, offset: usize) -> usize {
        self.starts.partition_point(|&start| start <= offset).max(1)
    }

    /// From the first character of a line to just behind its last, the line break excluded.
    pub(crate) fn bounds(&self, line: usize) -> (usize, usize) {
        let start = self
            .starts
            .get(line.saturating_sub(1))
            .copied()
            .unwrap_or(self.text.len());
        let end = self
            .starts
            .get(line)
            .map_or(self.text.len(), |next| next - 1);
        let content = self.text.get(start..end).unwrap_or("");
        (
            start,
            start + content.strip_suffix('\r').unwrap_or(content).len(),
        )
    }

    /// The position of a byte offset.
    pub(crate) fn position(&self, offset: usize) -> Position {
        let offset = self.text.floor_char_boundary(offset);
        let line = self.line(offset);
        let (start, _) = self.bounds(line);
        let before = self.characters_before(offset) - self.characters_before(start);
        Position {
            line,
            column: before + 1,
        }
    }

    fn characters_before(&self, offset: usize) -> usize {
        let block = offset / BLOCK;
        let rest = self.text.as_bytes().get(block * BLOCK..offset);
        self.characters.get(block).copied().unwrap_or_default() + begun(rest.unwrap_or_default())
    }
}

/// How many characters begin in some bytes of UTF-8.
fn begun(bytes: &[u8]) -> usize {
    bytes
        .iter()
        .filter(|byte| **byte & 0b1100_0000 != 0b1000_0000)
        .count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_characters_however_long_the_line_is() {
        let text = format!("é\n{}x", "aé€😀".repeat(500));
        let lines = Lines::of(&text);
        for (at, _) in text.char_indices() {
            let (start, _) = lines.bounds(lines.line(at));
            let column = text[start..at].chars().count() + 1;
            assert_eq!(lines.position(at).column, column, "at byte {at}");
        }
    }
}
