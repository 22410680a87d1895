//! Bad and big input: what everything that reads bytes from outside does with bytes that nobody would have written.
//!
//! - [`target`]: the parsers, each with what must hold for any input;
//! - [`mutation`]: how one input becomes the next;
//! - [`corpus`]: where inputs are kept;
//! - [`large`]: texts as large as asked for, of every shape that might cost more than its size.
//!
//! `cargo test` replays the corpus and tries a few hundred mutations, the same ones every time; `script/fuzz` searches
//! for as long as it is told to.

#![forbid(unsafe_code)]

pub mod corpus;
pub mod large;
pub mod mutation;
pub mod target;
mod targets;
