//! Texts of every shape and many sizes are answered, and with work in proportion to their size: what is counted is the
//! memory that was asked for, so that no clock is needed. A shape that takes more time than its size without asking
//! for memory makes this very slow; `script/bench-compiler` shows which.

use std::alloc::System;
use std::process::ExitCode;

use grafcet_compiler::format::{Unformatted, format};
use grafcet_compiler::render::{Style, render, render_json};
use grafcet_compiler::source::FileId;
use grafcet_compiler::{Compilation, MOST_REPORTED, Target, compile};
use grafcet_fuzz::large::{Shape, shapes};
use libtest_mimic::{Arguments, Failed, Trial};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// The sizes that are compared.
const SIZES: [usize; 2] = [8 << 10, 32 << 10];

/// The larger text may ask for so many times the memory of the smaller. Four is linear; lists that double as they grow
/// and sorting add to it.
const MOST_TIMES: usize = 6;

/// Limits that have nothing to do with the size of the text let short texts ask for so much.
const FREE: usize = 48 << 20;

fn main() -> ExitCode {
    let mut arguments = Arguments::from_args();
    // What is counted belongs to one text only if nothing else runs.
    arguments.test_threads = Some(1);
    let trials = shapes().into_iter().map(|shape| {
        let name = shape.name.replace(' ', "_").replace(',', "");
        Trial::test(name, || grows_with_its_size(shape))
    });
    libtest_mimic::run(&arguments, trials.collect()).exit_code()
}

fn grows_with_its_size(shape: &'static Shape) -> Result<(), Failed> {
    let [small, large] = SIZES.map(|size| shape.text(size));
    let (_, small) = compiled(&small);
    let (compilation, large) = compiled(&large);
    shown(&compilation, SIZES[1]);
    if large > FREE + MOST_TIMES * small {
        let [few, many] = SIZES;
        let message = format!("{small} bytes of memory for {few} of text, {large} for {many}");
        return Err(message.into());
    }
    Ok(())
}

/// Compiles a text and lays it out, and tells how much memory that asked for in bytes.
fn compiled(text: &str) -> (Compilation, usize) {
    let region = Region::new(ALLOCATOR);
    let none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
    let compilation = compile("large.grafcet", text, &none, Target::Host);
    let layout = format(FileId(0), text);
    let asked_for = region.change().bytes_allocated;
    assert!(!matches!(layout, Err(Unformatted::Otherwise)));
    assert!(compilation.diagnostics.len() <= 2 * (MOST_REPORTED + 1));
    assert_eq!(compilation.application.is_none(), compilation.has_errors());
    (compilation, asked_for)
}

/// Shows what there is to say: an excerpt is short however long the line is.
fn shown(compilation: &Compilation, size: usize) {
    const LONGEST: usize = 16 << 10;
    let (said, sources) = (&compilation.diagnostics, &compilation.sources);
    let drawn = render(said, sources, Style::default());
    assert_eq!(drawn.is_empty(), said.is_empty());
    assert!(drawn.len() <= 2 * size + said.len() * LONGEST);
    assert_eq!(render_json(said, sources).lines().count(), said.len());
}
