//! Names: many, long, equal, nearly equal, unknown.

use super::{Shape, each, repeated, so_many};

pub(super) const SHAPES: &[Shape] = &[
    Shape {
        name: "one name",
        make: |bytes| format!("input {}", repeated("a", bytes)),
    },
    Shape {
        name: "one number",
        make: |bytes| format!("scan {}", repeated("9", bytes)),
    },
    Shape {
        name: "one text",
        make: |bytes| format!("application x \"{}\"\ngraph G {{}}", repeated("a", bytes)),
    },
    Shape {
        name: "one step number",
        make: |bytes| format!("graph G {{ step {} }}", repeated("9", bytes)),
    },
    Shape {
        name: "a long name and another like it",
        make: |bytes| {
            let long = repeated("a", bytes / 2);
            format!("input {long}\ngraph G {{ initial step 1 {{ {long}b }} }}")
        },
    },
    Shape {
        name: "long names and others like them",
        make: |bytes| {
            let long = "a".repeat(2000);
            let inputs = each(bytes / 2, |number| format!("input {long}{number}\n"));
            let names = each(bytes / 2, |number| format!("b{long}{number}\n"));
            format!("{inputs}graph G {{ initial step 1 {{ {names} }} }}")
        },
    },
    Shape {
        name: "unknown steps of a graph with a long name",
        make: |bytes| {
            let name = repeated("G", bytes / 2);
            let all = each(bytes / 2, |n| format!("transition {n}: 1 -> {}\n", n + 2));
            format!("graph {name} {{ initial step 1\n{all} }}")
        },
    },
    Shape {
        name: "one name with many accents",
        make: |bytes| format!("input e{}", repeated("\u{301}\u{323}", bytes)),
    },
    Shape {
        name: "decomposed syllables",
        make: |bytes| format!("input {}", repeated("\u{1112}\u{1161}\u{11ab}", bytes)),
    },
    Shape {
        name: "decomposed names",
        make: |bytes| format!("input {}z", repeated("e\u{301}, ", bytes)),
    },
    Shape {
        name: "names that normalising makes longer",
        make: |bytes| format!("input {}z", repeated("\u{fb2c}, ", bytes)),
    },
    Shape {
        name: "declarations",
        make: |bytes| {
            format!(
                "{}graph G {{ initial step 1 }}",
                each(bytes, |n| format!("input v{n}\n"))
            )
        },
    },
    Shape {
        name: "equal declarations",
        make: |bytes| repeated("input a\n", bytes),
    },
    Shape {
        name: "equal graphs",
        make: |bytes| repeated("graph G {}\n", bytes),
    },
    Shape {
        name: "names that differ in case",
        make: |bytes| {
            let spelt = |number: usize| {
                let letters = ('a'..='p').enumerate();
                let upper = |(place, letter): (usize, char)| match number >> place & 1 {
                    0 => letter,
                    _ => letter.to_ascii_uppercase(),
                };
                letters.map(upper).collect::<String>()
            };
            each(bytes.min(17 << 16), |number| {
                format!("input {}\n", spelt(number))
            })
        },
    },
    Shape {
        name: "unknown names beside far ones",
        make: |bytes| {
            let inputs = each(bytes / 2, |n| format!("input v{n}\n"));
            let unknown = each(bytes / 2, |n| format!("w{n}\n"));
            format!("{inputs}graph G {{ initial step 1 {{ {unknown} }} }}")
        },
    },
    Shape {
        name: "unknown names beside near ones",
        make: |bytes| {
            let inputs = each(bytes / 2, |n| format!("input velocity_sensor_{n}\n"));
            let unknown = each(bytes / 2, |n| format!("velocity_sensr_{n}\n"));
            format!("{inputs}graph G {{ initial step 1 {{ {unknown} }} }}")
        },
    },
    Shape {
        name: "unknown names beside many graphs",
        make: |bytes| {
            let graphs = each(bytes / 2, |n| format!("graph G{n} {{}}\n"));
            let unknown = each(bytes / 2, |n| format!("unknown_{n}\n"));
            format!("{graphs}graph H {{ initial step 1 {{ {unknown} }} }}")
        },
    },
    Shape {
        name: "unknown graphs beside many",
        make: |bytes| {
            let graphs = each(bytes / 2, |n| format!("graph G{n} {{}}\n"));
            let unknown = each(bytes / 2, |n| format!("F/ZZZ{n}:{{}}\n"));
            format!("{graphs}graph H {{ initial step 1 {{ {unknown} }} }}")
        },
    },
    Shape {
        name: "unknown names in one line",
        make: |bytes| {
            let unknown = each(bytes, |n| format!("ü{n}; "));
            format!("graph G {{ initial step 1 {{ {unknown} }} }}")
        },
    },
    Shape {
        name: "errors in one line",
        make: |bytes| {
            format!(
                "graph G {{ step 1 {{ {} }} }}",
                repeated("a = = b ; ", bytes)
            )
        },
    },
    Shape {
        name: "step bits that are declared",
        make: |bytes| {
            let inputs = each(bytes / 2, |n| format!("input XM{n}\n"));
            let steps = each(bytes / 2, |n| format!("initial step M{n}\n"));
            format!("{inputs}graph G {{ {steps} }}")
        },
    },
    Shape {
        name: "addresses",
        make: |bytes| each(bytes, |n| format!("input v{n} at %IX{}.{}\n", n / 8, n % 8)),
    },
    Shape {
        name: "one address",
        make: |bytes| each(bytes, |n| format!("input v{n} at %IX0.0\n")),
    },
    Shape {
        name: "retained variables",
        make: |bytes| each(bytes, |n| format!("retain var v{n}\n")),
    },
    Shape {
        name: "constants, each of the one before",
        make: |bytes| {
            let rest = each(bytes, |n| format!("const c{}: int = c{n}\n", n + 1));
            format!("const c0: int = 1\n{rest}")
        },
    },
    Shape {
        name: "constants, each of the next",
        make: |bytes| {
            let count = bytes / 24;
            let all = so_many(count, |n| format!("const c{n}: int = c{}\n", n + 1));
            format!("{all}const c{count}: int = 1\n")
        },
    },
    Shape {
        name: "constants in a ring",
        make: |bytes| {
            let count = bytes / 24;
            so_many(count, |n| {
                format!("const c{n}: int = c{}\n", (n + 1) % count)
            })
        },
    },
    Shape {
        name: "imports of nothing",
        make: |bytes| each(bytes, |n| format!("import \"no{n}\"\n")),
    },
    Shape {
        name: "an import with a long path",
        make: |bytes| format!("import \"{}\"", repeated("a/", bytes)),
    },
];
