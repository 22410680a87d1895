//! The application image: a GRAFCET program as a PLC.
//!
//! `build.rs` turns the program named in `plc.toml` into const tables. Here are the tasks around its scan, generic over
//! pins, flash and time, so that a Raspberry Pi Pico and a host run the same ones:
//!
//! - [`boot`]: from reset to scan 0: the cause of the reset, the retained values, the boot line;
//! - [`scan`]: sample, scan, write, at every release of the [`schedule`];
//! - [`input`] and [`filter`], [`output`]: pins to images and back, with filters, active levels and safe states;
//! - [`analogue`] and [`scale`]: voltages to numbers;
//! - [`retain`] and [`record`]: retained values in flash, and [`store`]: the task that puts them there, within the
//!   [`budget`]; [`link`]: what it and the scan tell each other;
//! - [`vitals`]: who is alive, and who hung;
//! - [`log`]: what it says about itself;
//! - [`wiring`]: what hangs on which pin;
//! - [`boards`]: the Pico and the host.
//!
//! The scan runs above everything else and waits for nothing: what it hands to the store is taken when the store has
//! time. What must not go wrong is decided in the parts that know no board, and tested on a host.

#![cfg_attr(target_os = "none", no_std)]
#![deny(unsafe_code)]
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::indexing_slicing,
        clippy::panic,
        clippy::unreachable,
        clippy::todo
    )
)]

/// The program and its wiring, as the build read them.
pub mod application {
    #[cfg(not(target_os = "none"))]
    use crate::boards::host::script;
    #[cfg(not(target_os = "none"))]
    use crate::boards::host::site::PlantTables;
    #[cfg(not(target_os = "none"))]
    use crate::wiring::Label;
    use crate::wiring::{AnalogueWire, InputWire, OutputWire, Overload, Policy};

    include!(concat!(env!("OUT_DIR"), "/application.rs"));
}

pub mod analogue;
pub mod boards;
pub mod boot;
pub mod budget;
pub mod filter;
pub mod input;
pub mod link;
pub mod log;
pub mod output;
pub mod record;
pub mod retain;
pub mod scale;
pub mod scan;
pub mod schedule;
pub mod store;
pub mod vitals;
pub mod wiring;
