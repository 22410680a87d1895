//! Long runs of two programs whose machines stand in the same file: operators and mishaps at random, days and years of
//! simulated time, the engine beside the second interpreter, and bounds that neither of them knows.
//!
//! - [`subject`]: the programs, what happens to their machines, and how long their steps may last;
//! - [`operator`]: who makes it happen, at random;
//! - [`lockstep`]: scan by scan in both interpreters;
//! - [`watch`]: what has been reached, and for how long;
//! - [`stretch`]: days with every scan in both, or years whose pauses are leapt over.

#![forbid(unsafe_code)]

pub mod lockstep;
pub mod operator;
pub mod stretch;
pub mod subject;
pub mod watch;
