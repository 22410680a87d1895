//! What several tests of the image share.

pub mod nor;
