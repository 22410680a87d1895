//! Durations as the language writes them.

pub(crate) use grafcet_compiler::literals::BadLiteral;

/// The length of a duration in ms: `5 ms`, `0.5s`.
pub(crate) fn milliseconds(text: &str) -> Result<i64, BadLiteral> {
    grafcet_compiler::literals::duration(text)
}

/// A length in ms as a person writes it.
pub(crate) fn shown(ms: u32) -> String {
    if ms >= 1000 && ms.is_multiple_of(100) {
        format!("{} s", f64::from(ms) / 1000.0)
    } else {
        format!("{ms} ms")
    }
}
