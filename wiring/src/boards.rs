//! One file a board.

mod pico;

pub use pico::PICO;
