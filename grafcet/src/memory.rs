//! The engine's memory over vectors: for any program, of any size.

use grafcet_core::memory::{Memory, Standing};
use grafcet_core::program::Program;

/// The memory of one program.
#[derive(Debug)]
pub struct Vectors {
    image: Vec<u32>,
    numbers: Vec<i32>,
    before: Vec<u32>,
    before_scan: Vec<u32>,
    fired: Vec<u32>,
    passed: Vec<u32>,
    stack: Vec<i32>,
    stamps: Vec<u64>,
    standings: Vec<Standing>,
}

impl Vectors {
    /// Memory as large as the program needs.
    #[must_use]
    pub fn new(program: &Program<'_>) -> Self {
        let layout = &program.layout;
        let fired = usize::from(layout.fired);
        Vectors {
            image: vec![0; usize::from(layout.words)],
            numbers: vec![0; usize::from(layout.numbers)],
            before: vec![0; layout.situation_words()],
            before_scan: vec![0; layout.situation_words()],
            fired: vec![0; fired],
            passed: vec![0; usize::from(layout.passed)],
            stack: vec![0; usize::from(layout.stack)],
            stamps: vec![0; usize::from(layout.stamps)],
            standings: vec![Standing::FREE; usize::from(layout.standings)],
        }
    }

    /// The memory, as an engine takes it.
    pub fn memory(&mut self) -> Memory<'_> {
        Memory {
            image: &mut self.image,
            numbers: &mut self.numbers,
            before: &mut self.before,
            before_scan: &mut self.before_scan,
            fired: &mut self.fired,
            passed: &mut self.passed,
            stack: &mut self.stack,
            stamps: &mut self.stamps,
            standings: &mut self.standings,
        }
    }
}
