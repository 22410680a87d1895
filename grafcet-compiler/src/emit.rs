//! Tables as Rust source: what `build.rs` puts into an image.
//!
//! The generated items name their types by `grafcet_core::program::*` and stand in a module of their own. Beside
//! the tables stand assertions about them, so that a table which breaks its promise does not build.

mod demonstration;
mod rows;
mod walks;

use grafcet_core::program::Program;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

pub use self::demonstration::demonstration;
use self::rows::Row;
use self::walks::walks;
pub use self::walks::{FEW, Walk, Word};
use crate::application::{Application, Plant, Symbols, Tables, Wire};

/// Programs with at most so much to unroll are walked over row by row: what the compiler of the image does in seconds.
const UNROLLED: usize = 900;
/// What counts as so much: a row that is more than a transition with one term.
const ROW: usize = 8;

/// `PROGRAM`, `NAMES` and `Storage` of the controller, with their assertions.
#[must_use]
pub fn program(application: &Application) -> TokenStream {
    let tables = &application.controller.tables;
    let program = tables.literal();
    let names = names_literal(&application.name, tables, &application.controller.symbols);
    let storage = storage(tables);
    let walks = is_unrolled(&tables.program()).then(|| walks(&tables.program()));
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

            #walks
        }

        /// What the program calls its things.
        pub static NAMES: Names<'static> = #names;

        #storage

        const _: () = assert!(Storage::is_sized_for(&PROGRAM));
    }
}

/// Whether walks over the steps of a program are written out row by row.
#[must_use]
pub fn is_unrolled(program: &Program<'_>) -> bool {
    let arms = program.arms.iter().map(|arm| {
        let transition = program.transitions.get(usize::from(arm.transition));
        match transition.map(|transition| transition.fires) {
            Some(0) => 1,
            _ => ROW,
        }
    });
    let duties = program.steps.iter().filter(|step| step.duties > 0).count();
    let momentary = program.steps.iter().map(|step| step.momentary().len);
    let momentary = momentary.chain([program.always_momentary.len]);
    let momentary = momentary.map(usize::from).sum::<usize>();
    arms.sum::<usize>() + (momentary + duties) * ROW <= UNROLLED
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

fn storage(tables: &Tables) -> TokenStream {
    let layout = &tables.layout;
    let sizes = [
        ("image", usize::from(layout.words)),
        ("numbers", usize::from(layout.numbers)),
        ("before", usize::from(layout.before)),
        ("before_scan", usize::from(layout.remembered)),
        ("fired", usize::from(layout.fired)),
        ("passed", usize::from(layout.passed)),
        ("stack", usize::from(layout.stack)),
        ("stamps", usize::from(layout.stamps)),
        ("since", usize::from(layout.since)),
        ("standings", usize::from(layout.standings)),
        ("shown", usize::from(layout.shown)),
        ("sets", usize::from(layout.sets)),
        ("armed", usize::from(layout.armed)),
    ];
    let sizes = sizes.map(|(name, length)| {
        let (name, length) = (format_ident!("{name}"), Literal::usize_unsuffixed(length));
        quote!(#name: #length)
    });
    quote!(grafcet_core::storage!(Storage { #(#sizes),* });)
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
