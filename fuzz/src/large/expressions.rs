//! Expressions and actions.

use super::{Shape, condition, each, repeated, so_many, steps};

/// Momentary actions of one stand-alone action.
fn momentary(count: usize, statements: &str) -> String {
    let outputs = so_many(count, |n| format!("output v{n}\n"));
    format!("input a\n{outputs}graph G {{ always {{ {statements} }} }}")
}

/// Comparisons with situations of a graph of many steps.
fn situations(bytes: usize, statement: impl Fn(usize) -> String) -> String {
    let compared = each(bytes / 2, statement);
    let graph = steps("H", bytes / 2);
    format!("output M\ngraph G {{ initial step 1 {{ {compared} }} }}\n{graph}")
}

pub(super) const SHAPES: &[Shape] = &[
    Shape {
        name: "a conjunction",
        make: |bytes| condition(&format!("{}b", repeated("a AND ", bytes))),
    },
    Shape {
        name: "a conjunction over lines",
        make: |bytes| condition(&format!("{}b", repeated("a\nAND ", bytes))),
    },
    Shape {
        name: "a conjunction of disjunctions",
        make: |bytes| condition(&format!("{}b", repeated("(a OR NOT b) AND ", bytes))),
    },
    Shape {
        name: "an exclusive disjunction",
        make: |bytes| condition(&format!("{}b", repeated("a XOR ", bytes))),
    },
    Shape {
        name: "a conjunction of edges",
        make: |bytes| condition(&format!("{}b", repeated("↑a AND ", bytes))),
    },
    Shape {
        name: "a conjunction of timers",
        make: |bytes| {
            condition(&format!(
                "{}b",
                each(bytes, |n| format!("T/a/{}ms AND ", n + 1))
            ))
        },
    },
    Shape {
        name: "a conjunction of delays",
        make: |bytes| {
            condition(&format!(
                "{}b",
                each(bytes, |n| format!("{}ms/a AND ", n + 1))
            ))
        },
    },
    Shape {
        name: "a sum",
        make: |bytes| condition(&format!("0 < {}1", repeated("1 + ", bytes))),
    },
    Shape {
        name: "constants around a long condition",
        make: |bytes| {
            let around = "TRUE AND (".repeat(150);
            let inner = repeated("a XOR ", bytes);
            condition(&format!("{around}{inner}b{}", ")".repeat(150)))
        },
    },
    Shape {
        name: "edges around a long condition",
        make: |bytes| {
            let around = "↑(".repeat(150);
            let inner = repeated("a XOR ", bytes);
            condition(&format!("{around}{inner}b{}", ")".repeat(150)))
        },
    },
    Shape {
        name: "every input read",
        make: |bytes| {
            let count = bytes / 20;
            let inputs = so_many(count, |n| format!("input v{n}\n"));
            let read = so_many(count, |n| format!("v{n} AND "));
            format!("{inputs}output M\ngraph G {{ initial step 1 {{ M IF {read} v0 }} }}")
        },
    },
    Shape {
        name: "momentary actions, each of the one before",
        make: |bytes| {
            let count = bytes / 32;
            momentary(
                count,
                &so_many(count - 1, |n| format!("v{} IF v{n}\n", n + 1)),
            )
        },
    },
    Shape {
        name: "momentary actions, each of the next",
        make: |bytes| {
            let count = bytes / 32;
            momentary(
                count,
                &so_many(count - 1, |n| format!("v{n} IF v{}\n", n + 1)),
            )
        },
    },
    Shape {
        name: "momentary actions in a ring",
        make: |bytes| {
            let count = bytes / 32;
            momentary(
                count,
                &so_many(count, |n| format!("v{n} IF v{}\n", (n + 1) % count)),
            )
        },
    },
    Shape {
        name: "momentary actions, each of all before",
        make: |bytes| {
            let count = (bytes / 4).isqrt();
            let all = |n| so_many(n, |other| format!("v{other} OR "));
            momentary(count, &so_many(count, |n| format!("v{n} IF {}a\n", all(n))))
        },
    },
    Shape {
        name: "momentary actions on many outputs",
        make: |bytes| {
            let names = so_many(999, |n| format!("v{n}, "));
            momentary(1000, &each(bytes, |_| format!("{names}v999 IF a\n")))
        },
    },
    Shape {
        name: "stored actions",
        make: |bytes| {
            let all = repeated("n = n + 1\n", bytes);
            format!("var n : int\ngraph G {{ initial step 1 {{ {all} }} }}")
        },
    },
    Shape {
        name: "actions on events",
        make: |bytes| {
            let all = repeated("on event ↑a: n = n + 1\n", bytes);
            format!("input a\nvar n : int\ngraph G {{ initial step 1 {{ {all} }} }}")
        },
    },
    Shape {
        name: "situations in actions",
        make: |bytes| situations(bytes, |n| format!("M IF S(H) = {{{n}}}\n")),
    },
    Shape {
        name: "situations in edges",
        make: |bytes| situations(bytes, |n| format!("M IF ↑(S(H) = {{{n}}})\n")),
    },
    Shape {
        name: "initial situations",
        make: |bytes| situations(bytes, |_| "M IF S(H) <> {I}\n".to_owned()),
    },
    Shape {
        name: "situations in one condition",
        make: |bytes| {
            let all = each(bytes / 2, |n| format!("S(H) = {{{n}}} XOR "));
            format!("{}{}", condition(&format!("{all}a")), steps("H", bytes / 2))
        },
    },
];
