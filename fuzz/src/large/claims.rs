//! Plants, tests and properties.

use super::{Shape, each, repeated, so_many, steps};

const PROGRAM: &str = "input a\noutput Q\ngraph G { initial step 1 { Q IF a } }\n";

fn plants(count: usize) -> String {
    so_many(count, |n| {
        format!("plant P{n} {{ var v; always {{ a IF Q }} }}\n")
    })
}

/// One test of many claims, beside many graphs.
fn beside_graphs(bytes: usize, graph: &str, claim: impl Fn(usize) -> String) -> String {
    let claims = each(bytes / 2, claim);
    let graphs = each(bytes / 2, |n| format!("graph G{n} {{ {graph} }}\n"));
    format!("test \"t\" {{ {claims} }}\n{graphs}")
}

pub(super) const SHAPES: &[Shape] = &[
    Shape {
        name: "plants",
        make: |bytes| PROGRAM.to_owned() + &plants(bytes / 40),
    },
    Shape {
        name: "plants beside a large controller",
        make: |bytes| {
            let graph = steps("H", bytes / 2);
            format!("{PROGRAM}{graph}{}", plants(bytes / 80))
        },
    },
    Shape {
        name: "tests",
        make: |bytes| {
            PROGRAM.to_owned() + &each(bytes, |n| format!("test \"t{n}\" {{ expect Q }}\n"))
        },
    },
    Shape {
        name: "tests beside a large controller",
        make: |bytes| {
            let graph = steps("H", bytes / 2);
            let tests = each(bytes / 2, |n| format!("test \"t{n}\" {{ expect Q }}\n"));
            format!("{PROGRAM}{graph}{tests}")
        },
    },
    Shape {
        name: "tests of situations",
        make: |bytes| {
            let graph = steps("H", bytes / 2);
            graph
                + &each(bytes / 2, |n| {
                    format!("test \"t{n}\" {{ expect S(H) = {{{n}}} }}\n")
                })
        },
    },
    Shape {
        name: "tests with a plant each",
        make: |bytes| {
            let count = bytes / 80;
            let tests = so_many(count, |n| {
                format!("test \"t{n}\" with P{n} {{ expect Q }}\n")
            });
            format!("{PROGRAM}{}{tests}", plants(count))
        },
    },
    Shape {
        name: "tests with all plants",
        make: |bytes| {
            let count = bytes / 80;
            let all = so_many(count, |n| format!("P{n}, "));
            let tests = so_many(8, |n| {
                format!("test \"t{n}\" with {all}P0 {{ expect Q }}\n")
            });
            format!("{PROGRAM}{}{tests}", plants(count))
        },
    },
    Shape {
        name: "a test of many steps",
        make: |bytes| {
            format!(
                "{PROGRAM}test \"t\" {{ {} }}",
                repeated("expect Q\n", bytes)
            )
        },
    },
    Shape {
        name: "unqualified step bits",
        make: |bytes| beside_graphs(bytes, "initial step 1", |_| "expect X7\n".to_owned()),
    },
    Shape {
        name: "unqualified lettered step bits",
        make: |bytes| beside_graphs(bytes, "initial step 1", |_| "expect XM7\n".to_owned()),
    },
    Shape {
        name: "ambiguous step bits",
        make: |bytes| beside_graphs(bytes, "initial step 1", |_| "expect X1\n".to_owned()),
    },
    Shape {
        name: "ambiguous names",
        make: |bytes| beside_graphs(bytes, "var v", |_| "expect v\n".to_owned()),
    },
    Shape {
        name: "names of plants that do not run",
        make: |bytes| {
            let claims = repeated("expect v\n", bytes / 2);
            format!("{PROGRAM}{}test \"t\" {{ {claims} }}", plants(bytes / 80))
        },
    },
    Shape {
        name: "unknown plants",
        make: |bytes| {
            let all = each(bytes / 2, |n| format!("Z{n}, "));
            format!(
                "{PROGRAM}{}test \"t\" with {all}Z {{ expect Q }}",
                plants(bytes / 80)
            )
        },
    },
    Shape {
        name: "properties",
        make: |bytes| {
            PROGRAM.to_owned() + &each(bytes, |n| format!("property \"p{n}\": never Q\n"))
        },
    },
];
