//! What a program becomes: conditions, watches, runs and places in the tables.

mod conditions;
mod crossing;
mod identity;
mod limits;
mod logic;
mod places;
mod plants;
mod sequence;
mod sharing;
mod structure;
mod substitution;
mod timing;
mod walk;
mod watches;

use grafcet_compiler::application::{Application, Tables};
use grafcet_compiler::render::{Style, render};
use grafcet_compiler::{Target, compile};
use grafcet_core::program::{Condition, Op, Rest, Role, Term};

/// The application that a text becomes.
fn application(text: &str) -> Application {
    let load = |path: &str| panic!("{path} is not imported");
    let compilation = compile("test.grafcet", text, &load, Target::Host);
    let Some(application) = compilation.application else {
        let style = Style::default();
        panic!(
            "{}",
            render(&compilation.diagnostics, &compilation.sources, style)
        );
    };
    application
}

/// The controller's tables.
fn tables(text: &str) -> Tables {
    let tables = application(text).controller.tables;
    assert_eq!(tables.program().unsoundness(), None);
    tables
}

/// The tables of one graph with some inputs, outputs and variables around it.
fn graph(elements: &str) -> Tables {
    tables(&format!(
        "input a, b, c\noutput M, N, O\nvar n, m : int\nvar t : time\nparameter p : time = 1s\n\
         graph G {{\n{elements}\n}}"
    ))
}

/// What a graph is among others.
fn role(tables: &Tables, graph: usize) -> Role {
    *tables.program().role(&tables.graphs[graph])
}

/// A row of the conditions.
fn condition(tables: &Tables, row: u16) -> Condition {
    tables.conditions[usize::from(row)]
}

/// What the first step that a transition leaves asks for: its first term, and those behind it.
fn terms_of(tables: &Tables, transition: u16) -> Vec<Term> {
    let transition = tables.transitions[usize::from(transition)];
    let first = tables.terms[usize::from(transition.term)];
    let fires = condition(tables, transition.fires);
    let behind = fires.terms.of(&tables.terms).iter().copied();
    let first = (first.mask != 0).then_some(first);
    // What is behind a first term that always holds would be looked at without need.
    assert!(first.is_some() || fires.terms.len == 0);
    first.into_iter().chain(behind).collect()
}

/// The code of a rest that has some.
fn ops_of(tables: &Tables, rest: Rest) -> Vec<Op> {
    let (Rest::Logic(row) | Rest::Code(row)) = rest else {
        panic!("{rest:?} has no code");
    };
    let code = tables.codes[usize::from(row)];
    let start = code.start as usize;
    tables.ops[start..start + usize::from(code.len)].to_vec()
}
