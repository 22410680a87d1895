//! `plc.toml`: all that an automation engineer sets to bring a program onto a board, without a line of Rust.
//!
//! - [`file`](mod@file): the file as it is written, each value with its place;
//! - [`wire`]: one line of it, with what is particular to the kind of signal;
//! - [`board`] and [`boards`]: what there is to wire;
//! - [`retain`]: the flash of retained values, and what their store is wired to;
//! - [`check`](mod@check): the file against its board and its program, which leaves a [`Wiring`];
//! - [`load()`]: all of it, from a path;
//! - [`emit`]: the wiring as Rust source and linker script, for `build.rs`;
//! - [`rule`]: what can be wrong, by name.
//!
//! A file that is wrong in ten places is told so ten times in one go, each time with its line and the mend.

#![forbid(unsafe_code)]

pub mod board;
pub mod boards;
pub mod check;
mod duration;
pub mod emit;
pub mod file;
mod join;
mod load;
mod nearest;
mod pins;
pub mod retain;
pub mod rule;
mod side;
mod syntax;
pub mod table;
pub mod wire;

pub use check::Wiring;
pub use load::{Loaded, load, load_from};
