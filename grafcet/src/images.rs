//! What a program's images hold after a scan, and how people read it.

use grafcet_compiler::application::Unit;
use grafcet_core::program::{Run, Slot};

/// The images of a program between two scans.
#[derive(Clone, Copy, Debug)]
pub struct Images<'a> {
    /// The Booleans.
    pub image: &'a [u32],
    /// The numbers.
    pub numbers: &'a [i32],
}

impl Images<'_> {
    /// The value at a slot, False as 0 and True as 1; 0 where the images hold nothing.
    #[must_use]
    pub fn value(&self, slot: Slot) -> i32 {
        match slot {
            Slot::Bit(bit) => {
                let word = self.image.get(bit.word()).copied().unwrap_or(0);
                i32::from(word & bit.mask() != 0)
            }
            Slot::Number(number) => self
                .numbers
                .get(usize::from(number.0))
                .copied()
                .unwrap_or(0),
        }
    }

    /// The places of the active steps among the steps of a graph whose situation lies in these words, ascending.
    pub fn active(&self, words: Run) -> impl Iterator<Item = usize> {
        let words = words.of(self.image).iter().copied().enumerate();
        words.flat_map(|(index, word)| {
            (0..32)
                .filter(move |bit| word & (1 << bit) != 0)
                .map(move |bit| index * 32 + bit)
        })
    }
}

/// The situation of a graph: the identifiers of its active steps in source order, separated by one space; empty
/// when no step is active (`semantics.md`, "The trace").
#[must_use]
pub fn situation(unit: &Unit, graph: usize, images: Images<'_>) -> String {
    let (Some(symbol), Some(row)) = (
        unit.symbols.graphs.get(graph),
        unit.tables.graphs.get(graph),
    ) else {
        return String::new();
    };
    let mut text = String::new();
    for step in images.active(row.words) {
        if let Some(step) = symbol.steps.get(step) {
            if !text.is_empty() {
                text.push(' ');
            }
            text.push_str(&step.id);
        }
    }
    text
}
