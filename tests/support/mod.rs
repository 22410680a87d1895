//! What several tests of the image share. No test uses all of it.

#![allow(
    dead_code,
    reason = "each test is a crate of its own and uses its part"
)]
#![allow(clippy::expect_used, reason = "a failed expectation is a failed test")]

pub mod nor;
pub mod program;
pub mod records;
pub mod task;
