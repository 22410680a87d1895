//! Claims of `semantics.md`, from text to trace: each program here is compiled and run like a user's.

#![allow(clippy::expect_used, reason = "a test whose scene cannot be set fails")]

mod actions;
mod beginning;
mod counting;
mod delays;
mod edges;
mod enclosing;
mod firing;
mod hierarchy;
mod numbers;
mod open;
mod orders;
mod plants;
mod power;
mod rounds;
mod run;
mod sequence;
mod stable;
mod stimulus;
mod tests;
mod timers;
mod worked;
