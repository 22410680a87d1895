//! The lines of the log on a host: printed with their time, or kept for whoever asked for them.

use std::cell::RefCell;
use std::fmt::Arguments;
use std::io::{self, Write};
use std::process;

use embassy_time::Instant;

thread_local! {
    static KEPT: RefCell<Option<Vec<Line>>> = const { RefCell::new(None) };
}

/// A line of the log.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// When it was logged, in ms.
    pub time_ms: u64,
    /// What it says.
    pub text: String,
}

/// Prints a line with its time, or keeps it.
pub fn print(text: Arguments<'_>) {
    let time_ms = Instant::now().as_millis();
    let kept = KEPT.with_borrow_mut(|kept| {
        let kept = kept.as_mut()?;
        kept.push(Line {
            time_ms,
            text: text.to_string(),
        });
        Some(())
    });
    if kept.is_none() {
        show(format_args!(
            "{:>4}.{:03}  {text}",
            time_ms / 1000,
            time_ms % 1000
        ));
    }
}

/// Shows a line to the user. When nobody reads any more (`plc | head`), the soft PLC has nothing left to do and ends.
pub fn show(line: Arguments<'_>) {
    if writeln!(io::stdout(), "{line}").is_err() {
        process::exit(0);
    }
}

/// Runs something and keeps the lines that it logs on this thread instead of printing them.
pub fn keep<T>(work: impl FnOnce() -> T) -> (T, Vec<Line>) {
    let before = KEPT.replace(Some(Vec::new()));
    let output = work();
    let lines = KEPT.replace(before).unwrap_or_default();
    (output, lines)
}
