//! Programs from their text, for as long as the test runs.

use grafcet_compiler::application::{Symbols, Tables};
use grafcet_compiler::{Target, compile};
use grafcet_core::engine::Engine;
use grafcet_core::program::{Names, Program, Slot};
use grafcet_core::vectors::Vectors;

/// An engine for a program of a test.
pub type TestEngine = Engine<&'static Program<'static>, Vectors>;

/// A program and what it calls its things.
#[derive(Clone, Copy)]
pub struct Leaked {
    pub program: &'static Program<'static>,
    pub names: &'static Names<'static>,
    symbols: &'static Symbols,
}

/// Compiles the text of an application, which must be without errors.
pub fn program(text: &str) -> Leaked {
    let none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
    let compilation = compile("test.grafcet", text, &none, Target::Host);
    let application = compilation.application.unwrap_or_else(|| {
        let said: Vec<_> = compilation
            .diagnostics
            .iter()
            .map(|it| &it.message)
            .collect();
        panic!("the program is refused: {said:?}")
    });
    let tables: &'static Tables = Box::leak(Box::new(application.controller.tables));
    let symbols: &'static Symbols = Box::leak(Box::new(application.controller.symbols));
    let graphs = symbols.graphs.iter();
    let steps = graphs
        .clone()
        .flat_map(|graph| &graph.steps)
        .map(|step| step.id.as_str());
    let transitions = graphs
        .clone()
        .flat_map(|graph| &graph.transitions)
        .map(|it| it.number);
    let retained = tables.retained.iter().map(|row| {
        let variable = symbols.variables.iter().find(|it| it.slot == row.slot);
        variable.expect("what is retained has a name").name.as_str()
    });
    let names = Names {
        application: "test",
        graphs: leak(graphs.map(|graph| graph.name.as_str())),
        steps: leak(steps),
        transitions: leak(transitions),
        retained: leak(retained),
    };
    Leaked {
        program: Box::leak(Box::new(tables.program())),
        names: Box::leak(Box::new(names)),
        symbols,
    }
}

impl Leaked {
    /// An engine with memory of its own.
    pub fn engine(&self) -> TestEngine {
        Engine::new(self.program, Vectors::new(self.program))
    }

    /// Where a variable lives.
    pub fn slot(&self, name: &str) -> Slot {
        let variable = self.symbols.variables.iter().find(|it| it.name == name);
        variable
            .unwrap_or_else(|| panic!("no variable {name}"))
            .slot
    }
}

fn leak<T>(items: impl Iterator<Item = T>) -> &'static [T] {
    Vec::leak(items.collect())
}
