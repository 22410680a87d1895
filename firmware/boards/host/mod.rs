//! The soft PLC: the same tasks on a host, against the plants of the program.
//!
//! - [`command`]: the command line;
//! - [`soft_plc`]: the controller, powered and run; [`panel`] and [`pins`]: its terminals; [`flash`]: its retain area;
//! - [`machine`]: what stands around it: [`site`], the plants, [`script`], the demonstration, and
//!   [`meter`], what is shown of numbers;
//! - [`server`]: the same machine for a controller elsewhere;
//! - [`clock`]: real or simulated time; [`lines`]: the log.

pub mod clock;
pub mod command;
pub mod flash;
pub mod lines;
pub mod machine;
pub mod meter;
pub mod panel;
pub mod pins;
pub mod script;
pub mod server;
pub mod site;
pub mod soft_plc;
