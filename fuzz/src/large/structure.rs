//! Graphs, steps, transitions, hierarchy and macro steps.

use super::{Shape, each, repeated, so_many, steps};

/// Graphs that force others, by number.
fn forcing(count: usize, forced: impl Fn(usize) -> usize) -> String {
    so_many(count, |n| {
        format!(
            "graph G{n} {{ initial step 1 {{ F/G{}:{{1}} }} }}\n",
            forced(n)
        )
    })
}

fn list(count: usize) -> String {
    let others = so_many(count - 1, |n| format!("{n}, "));
    format!("{others}{}", count - 1)
}

pub(super) const SHAPES: &[Shape] = &[
    Shape {
        name: "a chain of steps",
        make: |bytes| {
            let all = each(bytes, |n| {
                let next = n + 1;
                format!("step {next} {{ M }}\ntransition {next}: {n} -> {next} when T/X{n}/1s\n")
            });
            format!("output M\ngraph G {{ initial step 0\n{all} }}")
        },
    },
    Shape {
        name: "graphs",
        make: |bytes| {
            each(bytes, |n| {
                format!("graph G{n} {{ initial step 1; transition 1: 1 -> 1 }}\n")
            })
        },
    },
    Shape {
        name: "empty graphs",
        make: |bytes| each(bytes, |n| format!("graph G{n} {{}}\n")),
    },
    Shape {
        name: "equal steps",
        make: |bytes| format!("graph G {{ {} }}", repeated("step 1\n", bytes)),
    },
    Shape {
        name: "equal transitions",
        make: |bytes| {
            let all = repeated("transition 1: 1 -> 1\n", bytes);
            format!("graph G {{ initial step 1\n{all} }}")
        },
    },
    Shape {
        name: "equal transitions in long lines",
        make: |bytes| {
            let line = format!("transition 1: 1 -> 1 (* {} *)\n", "x".repeat(3000));
            format!("graph G {{ initial step 1\n{} }}", repeated(&line, bytes))
        },
    },
    Shape {
        name: "transitions between one pair",
        make: |bytes| {
            let all = each(bytes, |n| format!("transition {n}: 1 -> 2 when a\n"));
            format!("input a\ngraph G {{ initial step 1\nstep 2\n{all} }}")
        },
    },
    Shape {
        name: "transitions from nothing",
        make: |bytes| {
            let all = each(bytes, |n| format!("transition {n}: -> 1 when ↑X1\n"));
            format!("graph G {{ initial step 1\n{all} }}")
        },
    },
    Shape {
        name: "a transition between all steps",
        make: |bytes| {
            let count = bytes / 32;
            let steps = so_many(count, |n| format!("initial step {n}\n"));
            let all = list(count);
            format!("graph G {{ {steps} transition 1: {all} -> {all} when ↑X1 }}")
        },
    },
    Shape {
        name: "a transition from one step again and again",
        make: |bytes| {
            let all = repeated("1, ", bytes / 2);
            format!("graph G {{ initial step 1\ntransition 1: {all}1 -> {all}1 when ↑X1 }}")
        },
    },
    Shape {
        name: "a set of one step again and again",
        make: |bytes| {
            let all = repeated("1, ", bytes);
            format!(
                "graph G {{ initial step 1 {{ F/H:{{{all}1}} }} }}\ngraph H {{ initial step 1 }}"
            )
        },
    },
    Shape {
        name: "unknown steps",
        make: |bytes| {
            let known = each(bytes / 2, |n| format!("initial step {n}\n"));
            let all = each(bytes / 2, |n| format!("transition {n}: {n} -> E{n}\n"));
            format!("graph G {{ {known}{all} }}")
        },
    },
    Shape {
        name: "forcing, each the next",
        make: |bytes| {
            let count = bytes / 42;
            forcing(count, |n| n + 1) + &format!("graph G{count} {{ initial step 1 }}")
        },
    },
    Shape {
        name: "forcing, each the one before",
        make: |bytes| "graph G {}\n".to_owned() + &forcing(bytes / 42, |n| n.saturating_sub(1)),
    },
    Shape {
        name: "forcing in a ring",
        make: |bytes| {
            let count = bytes / 42;
            forcing(count, |n| (n + 1) % count)
        },
    },
    Shape {
        name: "forcing in many rings",
        make: |bytes| forcing(bytes / 42, |n| n ^ 1),
    },
    Shape {
        name: "forcing all from one",
        make: |bytes| {
            let count = bytes / 42;
            let orders = so_many(count, |n| format!("F/H{n}:{{1}}\n"));
            let graphs = so_many(count, |n| format!("graph H{n} {{ initial step 1 }}\n"));
            format!("graph G {{ initial step 1 {{ {orders} }} }}\n{graphs}")
        },
    },
    Shape {
        name: "forcing the initial situation",
        make: |bytes| {
            let orders = repeated("F/H:{I}\n", bytes / 2);
            format!(
                "graph G {{ initial step 1 {{ {orders} }} }}\n{}",
                steps("H", bytes / 2)
            )
        },
    },
    Shape {
        name: "forcing every situation",
        make: |bytes| {
            let orders = each(bytes / 2, |n| format!("F/H:{{{n}}}\n"));
            format!(
                "graph G {{ initial step 1 {{ {orders} }} }}\n{}",
                steps("H", bytes / 2)
            )
        },
    },
    Shape {
        name: "enclosing, each the next",
        make: |bytes| {
            let count = bytes / 44;
            let part = |n| {
                format!(
                    "graph G{n} {{ initial step 1 encloses G{} {{1}} }}\n",
                    n + 1
                )
            };
            so_many(count, part) + &format!("graph G{count} {{ initial step 1 }}")
        },
    },
    Shape {
        name: "macro steps",
        make: |bytes| {
            let all = each(bytes, |n| {
                format!(
                    "macro step M{n} {{ entry step E{n}; exit step S{n}; transition {n}: E{n} -> S{n} }}\n"
                )
            });
            format!("graph G {{ initial step 1\n{all} }}")
        },
    },
    Shape {
        name: "nested macro steps",
        make: |bytes| {
            let outer = so_many(150, |n| {
                format!(
                    "macro step M{n} {{ entry step E{n}; exit step S{n}; transition {n}: E{n} -> S{n}\n"
                )
            });
            let inner = each(bytes, |n| format!("step {}\n", n + 2));
            format!(
                "graph G {{ initial step 1\n{outer}{inner}{} }}",
                "}".repeat(150)
            )
        },
    },
    Shape {
        name: "entry steps",
        make: |bytes| {
            let all = each(bytes, |n| format!("entry step {}\n", n + 2));
            format!("graph G {{ initial step 1\nmacro step M1 {{ {all} }} }}")
        },
    },
    Shape {
        name: "bits of one macro step",
        make: |bytes| {
            let read = repeated("M IF XM1\n", bytes / 2);
            let inner = each(bytes / 2, |n| format!("step {}\n", n + 2));
            format!(
                "output M\ngraph G {{ initial step 1 {{ {read} }}\nmacro step M1 {{ entry step E1; exit step S1\n{inner} }} }}"
            )
        },
    },
    Shape {
        name: "texts in steps",
        make: |bytes| {
            format!(
                "graph G {{ initial step 1 {{ {} }} }}",
                repeated("\"x\"\n", bytes)
            )
        },
    },
];
