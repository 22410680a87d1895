//! What a program becomes: conditions, watches, runs and places in the tables.

mod conditions;
mod identity;
mod limits;
mod places;
mod plants;
mod structure;
mod substitution;
mod watches;

use grafcet_compiler::application::{Application, Tables};
use grafcet_compiler::render::{Style, render};
use grafcet_compiler::{Target, compile};

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
