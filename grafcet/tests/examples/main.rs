//! The examples of `graphs/examples/` against what they promise: files, tests, the table of the manual, transitions
//! that fire, graphs that are the same. Their own tests run in `graphs.rs`, their wiring is read in `wiring`.

#![allow(clippy::expect_used, reason = "a test whose scene cannot be set fails")]

mod coverage;
mod directory;
mod identical;
mod table;
