//! Running GRAFCET programs on a host: the same engine and the same tables as on a microcontroller, over vectors.
//!
//! - [`machine`]: one program on its engine, across power cycles;
//! - [`simulation`]: a controller and its plants in lock step;
//! - [`images`]: what the images hold, as people read it;
//! - [`stimulus`], [`player`] and [`trace`]: CSV in, scan by scan, CSV out;
//! - [`testing`], [`report`] and [`table`]: the tests of the language, and what is shown when one fails;
//! - [`symbols`]: where everything lies, for tools that look into a memory;
//! - [`bound`]: what a scan takes at most;
//! - [`source`]: files in.

#![forbid(unsafe_code)]

pub mod bound;
pub mod images;
pub mod machine;
pub mod player;
pub mod report;
pub mod simulation;
pub mod source;
pub mod stimulus;
pub mod symbols;
pub mod table;
pub mod testing;
pub mod trace;
