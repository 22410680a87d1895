//! Claims of `semantics.md`, from text to trace: each program here is compiled and run like a user's.

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
