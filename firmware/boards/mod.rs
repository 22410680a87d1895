//! Boards: what is special to each.

#[cfg(not(target_os = "none"))]
pub mod host;
#[cfg(target_os = "none")]
#[allow(
    unsafe_code,
    reason = "interrupts, exported names and what outlives a reset; each use says why it is sound"
)]
pub mod pico;
