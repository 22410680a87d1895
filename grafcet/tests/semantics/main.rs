//! Claims of `semantics.md`, from text to trace: each program here is compiled and run like a user's.

#![allow(clippy::expect_used, reason = "a test whose scene cannot be set fails")]

mod actions;
mod edges;
mod firing;
mod hierarchy;
mod numbers;
mod plants;
mod power;
mod run;
mod stable;
mod tests;
mod timers;
mod worked;
