//! How things are written: what the syntax tree does not show.

/// Every spelling of `language.md`, with what keeps it apart from others.
pub const ALL: &[&str] = &[
    // Operators.
    " AND ",
    " & ",
    " · ",
    " OR ",
    " | ",
    " XOR ",
    "NOT ",
    "!",
    "¬",
    "↑",
    "RE ",
    "↓",
    "FE ",
    " = ",
    " := ",
    " <> ",
    " ≠ ",
    " < ",
    " <= ",
    " ≤ ",
    " > ",
    " >= ",
    " ≥ ",
    " + ",
    " - ",
    " * ",
    " / ",
    " MOD ",
    "=1",
    "TRUE",
    "FALSE",
    // Numbers.
    "2#",
    "8#",
    "16#",
    "_000",
    " -",
    // Durations.
    "50ms",
    " ms",
    " s ",
    "0.5 s",
    "1s/",
    " min",
    "1h",
    "23d",
    "T#",
    // Addresses.
    "%IX",
    "%I0",
    "%QX",
    "%Q0",
    "%MX",
    "%MW",
    "%MD",
    // Sets, timers and names.
    "{I}",
    "{}",
    "{*}",
    "T/",
    "S(",
    "System:first_scan",
    "System:unstable",
    "System:recovered",
    "System:overruns",
    "System:arithmetic_faults",
    "бункер.полон",
    "Störung",
    "Ä6",
    "E5",
    "XM5",
];

/// A text without its comments; a text in quotation marks is no place of one in the programs here.
pub fn without_comments(text: &str) -> String {
    let mut rest = text;
    let mut kept = String::new();
    let mut depth = 0_usize;
    while let Some(letter) = rest.chars().next() {
        let (skipped, deeper) = match depth {
            _ if rest.starts_with("(*") => (2, depth + 1),
            1.. if rest.starts_with("*)") => (2, depth - 1),
            0 if rest.starts_with("//") => (rest.find('\n').unwrap_or(rest.len()), 0),
            0 => {
                kept.push(letter);
                (letter.len_utf8(), 0)
            }
            _ => (letter.len_utf8(), depth),
        };
        rest = &rest[skipped..];
        depth = deeper;
    }
    kept
}
