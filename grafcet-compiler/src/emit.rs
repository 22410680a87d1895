//! Tables as Rust source: what `build.rs` puts into an image.
//!
//! The generated items name their types by `grafcet_core::program::*` and stand in a module of their own. Beside
//! the tables stand assertions about them, so that a table which breaks its promise does not build.

mod demonstration;
mod rows;

use proc_macro2::{Literal, TokenStream};
use quote::quote;

pub use self::demonstration::demonstration;
use self::rows::Row;
use crate::application::{Application, Plant, Symbols, Tables, Wire};

/// `PROGRAM`, `NAMES` and `Storage` of the controller, with their assertions.
#[must_use]
pub fn program(application: &Application) -> TokenStream {
    let tables = &application.controller.tables;
    let program = tables.literal();
    let names = names_literal(&application.name, tables, &application.controller.symbols);
    let storage = storage_type(tables);
    quote! {
        use grafcet_core::program::*;

        /// The program.
        pub static PROGRAM: Program<'static> = #program;

        // A table that breaks its promise does not build. The check is linear in the size of the program.
        #[allow(long_running_const_eval)]
        const _: () = grafcet_core::soundness::demand(&PROGRAM);

        /// The program for an engine that is compiled for it alone.
        #[derive(Clone, Copy, Debug)]
        pub struct ThisProgram;

        impl Compiled for ThisProgram {
            #[inline(always)]
            fn program(&self) -> &Program<'_> {
                &PROGRAM
            }
        }

        /// What the program calls its things.
        pub static NAMES: Names<'static> = #names;

        /// The memory of the program.
        pub type Storage = #storage;

        const _: () = assert!(Storage::is_sized_for(&PROGRAM));
    }
}

/// `PLANTS`: what stands in for the machine when the image runs on a host. `PlantTables` is a type of the image.
#[must_use]
pub fn plants(application: &Application) -> TokenStream {
    let count = Literal::usize_unsuffixed(application.plants.len());
    let plants = application.plants.iter().map(plant_literal);
    quote! {
        /// The plants, with the wires between their images and the controller's.
        pub static PLANTS: [PlantTables; #count] = [#(#plants),*];
    }
}

/// The tokens as a formatted file.
///
/// # Errors
/// When the tokens are not Rust items, which those made here are.
pub fn source(tokens: TokenStream) -> syn::Result<String> {
    Ok(prettyplease::unparse(&syn::parse2(tokens)?))
}

fn plant_literal(plant: &Plant) -> TokenStream {
    let name = &plant.name;
    let program = plant.unit.tables.literal();
    let reads = wires(&plant.reads);
    let writes = wires(&plant.writes);
    quote!(PlantTables { name: #name, program: #program, reads: #reads, writes: #writes })
}

/// Pairs of slots: where a value is read, and where it is written.
fn wires(wires: &[Wire]) -> TokenStream {
    let pairs = wires.iter().map(|wire| {
        let (from, to) = (wire.from.literal(), wire.to.literal());
        quote!((#from, #to))
    });
    quote!(&[#(#pairs),*])
}

fn storage_type(tables: &Tables) -> TokenStream {
    let layout = &tables.layout;
    let sizes = [
        usize::from(layout.words),
        usize::from(layout.numbers),
        layout.situation_words(),
        usize::from(layout.remembered),
        usize::from(layout.stamps),
        usize::from(layout.stack),
        usize::from(layout.fired),
        usize::from(layout.passed),
        usize::from(layout.standings),
    ]
    .map(Literal::usize_unsuffixed);
    quote!(grafcet_core::memory::Storage<#(#sizes),*>)
}

fn names_literal(application: &str, tables: &Tables, symbols: &Symbols) -> TokenStream {
    let graphs = symbols.graphs.iter().map(|graph| &graph.name);
    let steps = symbols.graphs.iter().flat_map(|graph| &graph.steps);
    let steps = steps.map(|step| &step.id);
    let transitions = symbols.graphs.iter().flat_map(|graph| &graph.transitions);
    let transitions = transitions.map(|transition| Literal::u32_unsuffixed(transition.number));
    let retained = tables.retained.iter().map(|row| {
        let variable = symbols.variables.iter().find(|it| it.slot == row.slot);
        variable.map_or("", |variable| variable.name.as_str())
    });
    quote! {
        Names {
            application: #application,
            graphs: &[#(#graphs),*],
            steps: &[#(#steps),*],
            transitions: &[#(#transitions),*],
            retained: &[#(#retained),*],
        }
    }
}
