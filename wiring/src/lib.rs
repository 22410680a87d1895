//! `plc.toml`: all that an automation engineer sets to bring a program onto a board, without a line of Rust.
