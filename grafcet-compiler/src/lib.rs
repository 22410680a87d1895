//! From text to `Program`: one parser, one model, one lowered form.
//!
//! Data flows one way: [`source`] -> lexer -> parser -> [`ast`] -> model -> checks -> lowering -> tables. Everything
//! that is wrong on the way is a [`diagnostic::Diagnostic`]. How a program runs is not known here.

#![forbid(unsafe_code)]

pub mod activity;
pub mod application;
pub mod ast;
mod checks;
mod compile;
pub mod diagnostic;
pub mod emit;
pub mod format;
mod lexer;
pub mod literals;
mod lower;
pub mod model;
pub mod parser;
pub mod position;
pub mod render;
mod report;
pub mod source;

pub use compile::{Compilation, MOST_REPORTED, Target, compile};
pub use parser::parse;
