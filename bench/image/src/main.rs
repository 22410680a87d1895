//! The engine and one program with nothing around them, for measuring: on bare metal two functions and three words,
//! whose instructions an emulator counts; on a host a program that tells how often a second it scans.

#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod contract;
#[cfg(not(target_os = "none"))]
mod host;

use grafcet_core::Engine;

mod program {
    #![allow(unused, missing_docs)]
    include!(concat!(env!("OUT_DIR"), "/program.rs"));
}
use program::{OUTPUTS, Storage, ThisProgram};

type Controller = Engine<ThisProgram, Storage>;

/// Outputs that are neighbours in a word of the image, and in the word of outputs.
struct Lane {
    word: usize,
    from: u32,
    mask: u32,
    to: u32,
}

/// The first 32 Boolean outputs, in declaration order from bit 0.
#[inline(always)]
fn outputs(engine: &Controller) -> u32 {
    let image = engine.image();
    OUTPUTS.iter().fold(0, |word, lane| {
        let lying = image.get(lane.word).copied().unwrap_or(0);
        word | ((lying >> lane.from) & lane.mask) << lane.to
    })
}

#[cfg(not(target_os = "none"))]
fn main() {
    host::measure();
}
