//! What must hold for any input, target by target.

pub(crate) mod flash;
pub(crate) mod graph;
pub(crate) mod stimulus;
pub(crate) mod wiring;

// The flash whose power can be cut is that of the firmware's own tests.
#[path = "../../tests/support/nor.rs"]
mod nor;
