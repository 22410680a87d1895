//! Words, signs, comments and texts.

use super::{Shape, repeated};

macro_rules! repetitions {
    ($($name:literal $part:literal)*) => {
        &[$(
            Shape { name: $name, make: |bytes| repeated($part, bytes) },
            Shape { name: concat!($name, ", in a condition"), make: |bytes| within(&repeated($part, bytes)) },
        )*]
    };
}

fn within(text: &str) -> String {
    format!("input a\noutput M\ngraph G {{ initial step 1 {{ M IF {text}")
}

pub(super) const SHAPES: &[Shape] = repetitions! {
    "parentheses" "("
    "closing parentheses" ")"
    "comments in comments" "(*"
    "comments" "(* *)"
    "line comments" "//\n"
    "braces" "{"
    "closing braces" "}"
    "NOT" "NOT "
    "edges" "↑"
    "signs" "- "
    "operands" "a AND "
    "equals" "= "
    "names" "a "
    "points" "a."
    "digits" "9"
    "durations" "1s "
    "a number and blanks" "1         "
    "timers" "T/"
    "forcing" "F/G:{1} "
    "situations" "S(G)={1} "
    "quotation marks" "\""
    "texts" "\"x\"\n"
    "addresses" "%a "
    "strange signs" "@ "
    "line ends" "\n"
    "carriage returns" "\r"
    "semicolons" ";"
    "zeros" "\0"
    "byte order marks" "\u{feff}"
};
