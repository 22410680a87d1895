//! What a person at a terminal gets from `grafcet`: output, errors and exit codes.

#![allow(clippy::unwrap_used, reason = "a test whose scene cannot be set fails")]

mod bound;
mod check;
mod desk;
mod every;
mod fmt;
mod test;
mod trace;
