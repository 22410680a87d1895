//! The soft PLC: the same tasks on a host.

pub mod clock;
pub mod flash;
pub mod lines;
