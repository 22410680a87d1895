//! Templates and their instances, where a short text makes a long program.

use super::{Shape, each, repeated, so_many};

/// Two halves: what a template holds, and its instances.
fn halves(bytes: usize, template: &str, bindings: &str) -> String {
    let instances = each(bytes / 2, |n| format!("graph A{n} = T {bindings}\n"));
    format!("input a\noutput Q\ntemplate T {{ {template} }}\n{instances}")
}

/// Instances whose input is bound to something of another one.
fn chain(count: usize, bound: impl Fn(usize) -> String) -> String {
    let instances = so_many(count, |n| {
        format!("graph A{n} = T {{ M = Q; i = {} }}\n", bound(n))
    });
    format!(
        "input a\noutput Q\ntemplate T {{ input i; output M; initial step 1 {{ M IF i }} }}\n{instances}"
    )
}

/// Bytes of one instance in a chain, about.
const LINK: usize = 40;

pub(super) const SHAPES: &[Shape] = &[
    Shape {
        name: "instances",
        make: |bytes| halves(2 * bytes, "initial step 1", ""),
    },
    Shape {
        name: "instances of many steps",
        make: |bytes| {
            halves(
                bytes,
                &each(bytes / 2, |n| format!("initial step {n}\n")),
                "",
            )
        },
    },
    Shape {
        name: "instances of many variables",
        make: |bytes| halves(bytes, &each(bytes / 2, |n| format!("var v{n}\n")), ""),
    },
    Shape {
        name: "instances of a long condition",
        make: |bytes| {
            let condition = repeated("a AND ", bytes / 2);
            halves(
                bytes,
                &format!("output M; initial step 1 {{ M IF {condition}a }}"),
                "{ M = Q }",
            )
        },
    },
    Shape {
        name: "instances of many errors",
        make: |bytes| {
            let unknown = each(bytes / 2, |n| format!("v{n}\n"));
            halves(bytes, &format!("initial step 1 {{ {unknown} }}"), "")
        },
    },
    Shape {
        name: "a long binding used often",
        make: |bytes| {
            let used = repeated("M IF i\n", bytes / 2);
            let bound = repeated("a AND ", bytes / 2);
            format!(
                "input a\noutput Q\ntemplate T {{ input i; output M; initial step 1 {{ {used} }} }}\n\
                 graph A = T {{ M = Q; i = {bound}a }}"
            )
        },
    },
    Shape {
        name: "bindings that double",
        make: |bytes| {
            let bound = |n: usize| match n.checked_sub(1) {
                Some(before) => format!("A{before}:i AND NOT A{before}:i"),
                None => "a".to_owned(),
            };
            chain(bytes / LINK, bound)
        },
    },
    Shape {
        name: "bindings, each of the one before",
        make: |bytes| {
            let bound = |n: usize| match n.checked_sub(1) {
                Some(before) => format!("A{before}:i"),
                None => "a".to_owned(),
            };
            chain(bytes / LINK, bound)
        },
    },
    Shape {
        name: "bindings, each of the next",
        make: |bytes| {
            let count = bytes / LINK;
            chain(count, |n| {
                if n + 1 < count {
                    format!("NOT A{}:i", n + 1)
                } else {
                    "a".to_owned()
                }
            })
        },
    },
    Shape {
        name: "bindings in a ring",
        make: |bytes| {
            let count = bytes / LINK;
            chain(count, |n| format!("A{}:i", (n + 1) % count))
        },
    },
    Shape {
        name: "outputs bound, each to the next",
        make: |bytes| {
            let count = bytes / LINK;
            let bound = |n| {
                if n + 1 < count {
                    format!("A{}:M", n + 1)
                } else {
                    "Q".to_owned()
                }
            };
            let instances = so_many(count, |n| {
                format!("graph A{n} = T {{ M = {} }}\n", bound(n))
            });
            format!(
                "input a\noutput Q\ntemplate T {{ output M; initial step 1 {{ M IF a }} }}\n{instances}"
            )
        },
    },
    Shape {
        name: "unknown bindings",
        make: |bytes| {
            let inputs = each(bytes / 2, |n| format!("input i{n}\n"));
            let bound = each(bytes / 2, |n| format!("z{n} = TRUE\n"));
            format!("template T {{ {inputs} initial step 1 }}\ngraph A = T {{ {bound} }}")
        },
    },
    Shape {
        name: "many bindings",
        make: |bytes| {
            let count = bytes / 24;
            let inputs = so_many(count, |n| format!("input i{n}\n"));
            let bound = so_many(count, |n| format!("i{n} = a\n"));
            format!("input a\ntemplate T {{ {inputs} initial step 1 }}\ngraph A = T {{ {bound} }}")
        },
    },
    Shape {
        name: "templates without instances",
        make: |bytes| each(bytes, |n| format!("template T{n} {{ initial step 1 }}\n")),
    },
    Shape {
        name: "instances of nothing",
        make: |bytes| each(bytes, |n| format!("graph A{n} = T{n}\n")),
    },
];
