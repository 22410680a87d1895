//! A second interpreter of `semantics.md`, written to be obvious: sets of step names, maps from names to values, and
//! the phases one by one as they stand in the text. It shares the syntax tree with the product and nothing else: names
//! are looked up while the program runs, expressions are walked as they were written, and the memory of an edge or a
//! timer is found by the place where it is written.
//!
//! It takes programs that the compiler accepts; what the compiler refuses has no meaning here and may panic. It
//! simulates no plants and runs no tests.

#![forbid(unsafe_code)]

mod action;
mod expression;
mod graph;
mod hierarchy;
mod machine;
mod momentary;
mod name;
mod program;
mod trace;
mod value;
mod watch;

pub use machine::Machine;
pub use name::Qualified;
pub use program::Program;
pub use value::Value;
