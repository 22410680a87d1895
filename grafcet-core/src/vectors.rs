//! Memory for any program, of any size, where there is an allocator.

use alloc::vec;
use alloc::vec::Vec;

use crate::memory::{Memory, NEVER, Standing};
use crate::program::{Armed, Program};

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
    since: Vec<u32>,
    standings: Vec<Standing>,
    shown: Vec<u32>,
    sets: Vec<u32>,
    armed: Vec<Armed>,
}

impl Vectors {
    /// Memory as large as the program needs, in which nothing has happened.
    #[must_use]
    pub fn new(program: &Program<'_>) -> Self {
        let layout = &program.layout;
        Vectors {
            image: vec![0; usize::from(layout.words)],
            numbers: vec![0; usize::from(layout.numbers)],
            before: vec![0; usize::from(layout.before)],
            before_scan: vec![0; usize::from(layout.remembered)],
            fired: vec![0; usize::from(layout.fired)],
            passed: vec![0; usize::from(layout.passed)],
            stack: vec![0; usize::from(layout.stack)],
            stamps: vec![NEVER; usize::from(layout.stamps)],
            since: vec![0; usize::from(layout.since)],
            standings: vec![Standing::FREE; usize::from(layout.standings)],
            shown: vec![0; usize::from(layout.shown)],
            sets: vec![0; usize::from(layout.sets)],
            armed: vec![Armed::NOTHING; usize::from(layout.armed)],
        }
    }
}

impl Memory for Vectors {
    memory_methods!(fields);
}
