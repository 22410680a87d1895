//! The engine and one program with nothing around them: two functions and three words, for counting instructions.

#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod contract;

#[cfg(not(target_os = "none"))]
fn main() {
    eprintln!("a program for bare metal: script/bench-image builds it");
    std::process::exit(2);
}
