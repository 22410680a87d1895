//! What numbers, durations and step identifiers are worth: `language.md`, lexical rules.

/// Why a literal cannot be read (rule `bad-literal`).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadLiteral {
    /// What is wrong, a lower-case phrase.
    pub message: String,
    /// The mend.
    pub help: String,
}

fn bad<T>(message: impl Into<String>, help: impl Into<String>) -> Result<T, BadLiteral> {
    Err(BadLiteral {
        message: message.into(),
        help: help.into(),
    })
}

/// The start of a long literal, for a message.
pub(crate) fn shortened(text: &str) -> String {
    const LONGEST: usize = 40;
    match text.char_indices().nth(LONGEST) {
        Some((at, _)) => format!("{}..", text.get(..at).unwrap_or("")),
        None => text.to_owned(),
    }
}

/// The value of an integer, without a sign: `42`, `16#FF`, `2#1010`, `8#17`, `1_000`. Saturates at the end of 64 bits.
pub(crate) fn integer(text: &str) -> Result<i64, BadLiteral> {
    const HELP: &str = "numbers are written `42`, `16#FF`, `2#1010` or `1_000`";
    if text.contains('.') {
        return bad(
            format!("`{}` is not a whole number", shortened(text)),
            "numbers are integers; only durations have decimals, with a unit: `0.5s`",
        );
    }
    let (base, digits) = match text.split_once('#') {
        None => (10, text),
        Some(("2", digits)) => (2, digits),
        Some(("8", digits)) => (8, digits),
        Some(("16", digits)) => (16, digits),
        Some((base, _)) => {
            return bad(
                format!("`{}` is not a base of numbers", shortened(base)),
                "the bases are 2, 8 and 16",
            );
        }
    };
    if digits.is_empty()
        || digits.starts_with('_')
        || digits.ends_with('_')
        || digits.contains("__")
    {
        return bad(format!("`{}` is not a number", shortened(text)), HELP);
    }
    let mut value = 0_i64;
    for c in digits.chars().filter(|&c| c != '_') {
        let Some(digit) = c.to_digit(base) else {
            let digit = match base {
                2 => "a binary digit",
                8 => "an octal digit",
                10 => "a digit",
                _ => "a hexadecimal digit",
            };
            return bad(
                format!("`{c}` in `{}` is not {digit}", shortened(text)),
                HELP,
            );
        };
        value = value
            .saturating_mul(i64::from(base))
            .saturating_add(i64::from(digit));
    }
    Ok(value)
}

/// The units of durations in ms, the largest first.
const UNITS: [(&str, i64); 5] = [
    ("d", 86_400_000),
    ("h", 3_600_000),
    ("min", 60_000),
    ("s", 1_000),
    ("ms", 1),
];

/// Units that are not of the language, and what stands for them; nothing where they are finer than 1 ms.
const FOREIGN_UNITS: [(&str, Option<&str>); 19] = [
    ("us", None),
    ("µs", None),
    ("μs", None),
    ("ns", None),
    ("m", Some("min")),
    ("mins", Some("min")),
    ("minute", Some("min")),
    ("minutes", Some("min")),
    ("sec", Some("s")),
    ("secs", Some("s")),
    ("second", Some("s")),
    ("seconds", Some("s")),
    ("msec", Some("ms")),
    ("hr", Some("h")),
    ("hrs", Some("h")),
    ("hour", Some("h")),
    ("hours", Some("h")),
    ("day", Some("d")),
    ("days", Some("d")),
];

/// The unit that begins a word whose rest is empty or the next part of a duration: true for `s` and `min30s`, and for
/// the units of other languages, which [`duration`] then refuses.
pub(crate) fn begins_with_unit(word: &str) -> bool {
    let end = word
        .find(|c: char| c.is_ascii_digit())
        .unwrap_or(word.len());
    let unit = word.get(..end).unwrap_or("").to_lowercase();
    UNITS.iter().any(|&(name, _)| name == unit)
        || FOREIGN_UNITS.iter().any(|&(name, _)| name == unit)
}

/// `T` and `TIME` begin a duration in IEC's notation, in any case.
pub(crate) fn is_duration_prefix(word: &str) -> bool {
    word.eq_ignore_ascii_case("T") || word.eq_ignore_ascii_case("TIME")
}

/// How a unit is read: IEC's `T#` knows `m` and any case.
fn unit_of(name: &str, iec: bool) -> Option<i64> {
    let name = match (iec, name.to_ascii_lowercase()) {
        (true, lower) if lower == "m" => "min".to_owned(),
        (true, lower) => lower,
        (false, _) => name.to_owned(),
    };
    UNITS
        .iter()
        .find(|(unit, _)| *unit == name)
        .map(|&(_, ms)| ms)
}

fn unknown_unit<T>(name: &str) -> Result<T, BadLiteral> {
    let lower = name.to_lowercase();
    match FOREIGN_UNITS.iter().find(|(unit, _)| *unit == lower) {
        Some((_, None)) => finer(),
        Some((_, Some(unit))) => bad(
            format!("`{name}` is not a unit of time"),
            format!("write `{unit}`"),
        ),
        None if unit_of(&lower, false).is_some() => bad(
            format!("`{name}` is not a unit of time"),
            format!("write `{lower}`"),
        ),
        None => bad(
            format!("`{}` is not a unit of time", shortened(name)),
            "the units are `h`, `min`, `s` and `ms`; several go together as in `1min30s`",
        ),
    }
}

fn finer<T>() -> Result<T, BadLiteral> {
    bad(
        "a duration finer than 1 ms",
        "durations are whole milliseconds; nothing is rounded away",
    )
}

/// The length of a duration in ms: `30ms`, `2 s`, `0.5 s`, `1min30s`, `T#1m30s`. Saturates at the end of 64 bits.
///
/// # Errors
/// When it is no duration, or one finer than 1 ms.
pub fn duration(text: &str) -> Result<i64, BadLiteral> {
    let (iec, mut rest) = match text.split_once('#') {
        Some((prefix, rest)) if is_duration_prefix(prefix) => (true, rest),
        _ => (false, text),
    };
    if rest.starts_with(['#', '-']) {
        return bad(
            format!("`{}` is not a duration", shortened(text)),
            "write a minus sign in front: `-T#1s`",
        );
    }
    let mut total = 0_i64;
    let mut larger = i64::MAX;
    loop {
        let (number, behind) = split(rest, |c| c.is_ascii_digit() || matches!(c, '.' | '_'));
        let (unit, behind) = split(behind.trim_start(), |c| {
            !c.is_ascii_digit() && c != '_' && !c.is_whitespace()
        });
        if number.is_empty() || unit.is_empty() {
            return bad(
                format!("`{}` is not a duration", shortened(text)),
                "durations are written `30ms`, `2s`, `0.5 s`, `1min30s` or `T#1m30s`",
            );
        }
        let Some(ms) = unit_of(unit, iec) else {
            return unknown_unit(unit);
        };
        if ms >= larger {
            return bad(
                "the parts of a duration stand in the wrong order",
                "the larger unit comes first: `1min30s`",
            );
        }
        larger = ms;
        total = total.saturating_add(part(number, ms)?);
        rest = behind.trim_start();
        rest = if iec {
            rest.strip_prefix('_').unwrap_or(rest)
        } else {
            rest
        };
        if rest.is_empty() {
            return Ok(total);
        }
        if number.contains('.') {
            return bad(
                "a decimal point before the last part of a duration",
                "write `1min30s` for `1.5min`",
            );
        }
    }
}

fn split(text: &str, fits: impl Fn(char) -> bool) -> (&str, &str) {
    text.split_at(text.find(|c| !fits(c)).unwrap_or(text.len()))
}

/// `number` times a unit of `ms` milliseconds, if that is whole.
fn part(number: &str, ms: i64) -> Result<i64, BadLiteral> {
    let (whole, fraction) = number.split_once('.').unwrap_or((number, ""));
    let fraction = fraction.trim_end_matches('0');
    if !fraction.chars().all(|c| c.is_ascii_digit()) {
        return bad(
            format!("`{}` is not a number", shortened(number)),
            "decimals are written `0.5`",
        );
    }
    let whole = integer(whole)?.saturating_mul(ms);
    if fraction.is_empty() {
        return Ok(whole);
    }
    // A fraction without trailing zeros is whole in ms only if it is short: the units have no more than ten factors
    // of 2 and five of 5. So nothing below overflows.
    const LONGEST: usize = 10;
    if fraction.len() > LONGEST {
        return finer();
    }
    let scale = fraction.chars().fold(1_i64, |scale, _| scale * 10);
    let fraction = integer(fraction)? * ms;
    if fraction % scale != 0 {
        return finer();
    }
    Ok(whole.saturating_add(fraction / scale))
}

/// The text of a step identifier: digits, or one capital letter and digits, without leading zeros (rule
/// `bad-literal`). With the error comes the identifier that was meant, where that is evident.
pub(crate) fn step_identifier(text: &str) -> Result<(), (BadLiteral, Option<String>)> {
    let mut characters = text.chars();
    let letter = characters.next().filter(|c| !c.is_ascii_digit());
    let digits = if letter.is_some() {
        characters.as_str()
    } else {
        text
    };
    let is_number = !digits.is_empty() && digits.chars().all(|c| c.is_ascii_digit());
    if !is_number || letter.is_some_and(|letter| !letter.is_alphabetic()) {
        return Err((
            BadLiteral {
                message: format!("`{}` is not a step identifier", shortened(text)),
                help: "steps are named by digits, or by one capital letter and digits: `5`, `E5`"
                    .to_owned(),
            },
            None,
        ));
    }
    let capital: String = letter
        .iter()
        .flat_map(|letter| letter.to_uppercase())
        .collect();
    let short = digits.trim_start_matches('0');
    let short = if short.is_empty() { "0" } else { short };
    let meant = format!("{capital}{short}");
    if meant == text {
        return Ok(());
    }
    let message = if short == digits {
        format!("`{}` does not begin with a capital letter", shortened(text))
    } else {
        format!("`{}` has leading zeros", shortened(text))
    };
    let help = format!("write `{}`", shortened(&meant));
    Err((BadLiteral { message, help }, Some(meant)))
}
