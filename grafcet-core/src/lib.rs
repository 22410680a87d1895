//! The scan of a GRAFCET program: what `semantics.md` says, phase by phase, over const tables.
//!
//! A compiled program is a [`program::Program`]: slices of small rows that lie in flash on a microcontroller and in
//! memory on a host. What changes while it runs lies in a [`memory::Memory`], sized for its program at build time.
//! An [`engine::Engine`] takes both and runs one scan at a time. Time, inputs and restored values come in as
//! arguments: nothing here knows a clock, a board, a flash page or a text, and no path panics or allocates.
//!
//! The rooms, in the order in which a scan passes through them:
//!
//! - [`program`]: the tables;
//! - [`memory`]: the images, numbers and time stamps;
//! - `expression`: conditions and values (conjunctions as mask and state words, the rest as postfix code);
//! - `timing`: timers that have run out;
//! - `watch`: edges and timers, which remember;
//! - `evolution`: triggers and firing (phases 2 and 3);
//! - `sequence`: the same where it is known beforehand what is armed, in large programs;
//! - `hierarchy`: enclosing and forcing (phase 4);
//! - `action`: events, stored and momentary statements (phases 5 to 7);
//! - `view` and [`images`]: what all of it leaves, for whoever looks;
//! - [`engine`]: the order of it all, scan 0 included.

#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "alloc")]
extern crate alloc;

mod action;
mod bits;
pub mod engine;
mod evolution;
mod expression;
mod hierarchy;
pub mod images;
#[macro_use]
pub mod memory;
pub mod program;
mod sequence;
mod sets;
pub mod soundness;
mod timing;
#[cfg(feature = "alloc")]
pub mod vectors;
mod view;
mod walk;
mod watch;

pub use engine::Engine;
