//! Compiles the program named by `BENCH_PROGRAM` to its tables and to the places of its first 32 outputs.

use std::path::{Path, PathBuf};
use std::{env, fs, io, process};

use grafcet_compiler::application::VariableSymbol;
use grafcet_compiler::model::DeclarationKind;
use grafcet_compiler::render::{Style, render};
use grafcet_compiler::{Target, compile, emit};
use grafcet_core::program::Slot;

fn main() {
    if let Err(fault) = build() {
        eprintln!("{fault}");
        process::exit(1);
    }
}

fn build() -> Result<(), String> {
    println!("cargo::rerun-if-env-changed=BENCH_PROGRAM");
    let manifest = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let path = match env::var("BENCH_PROGRAM") {
        Ok(path) => path,
        Err(_) => "../../graphs/line_switcher.grafcet".to_owned(),
    };
    let failed = |error: io::Error| format!("error: {path}: {error}");
    let read = |path: &Path| {
        println!("cargo::rerun-if-changed={}", path.display());
        fs::read_to_string(path)
    };
    let text = read(Path::new(&path)).map_err(failed)?;
    let folder = Path::new(&path).parent().unwrap_or(Path::new("."));
    let load = |name: &str| read(&folder.join(name));
    let mut compiled = compile(&path, &text, &load, Target::Host);
    let Some(application) = &mut compiled.application else {
        return Err(render(
            &compiled.diagnostics,
            &compiled.sources,
            Style::default(),
        ));
    };
    // In C nobody keeps either what only a log asks for.
    if env::var_os("CARGO_FEATURE_WATCHED").is_none() {
        let tables = &mut application.controller.tables;
        *tables = tables.clone().unwatched();
    }
    let tables = emit::source(emit::program(application)).map_err(|error| error.to_string())?;
    let lanes = lanes(&application.controller.symbols.variables);
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default()).join("program.rs");
    fs::write(out, tables + &lanes).map_err(failed)?;
    if env::var("CARGO_CFG_TARGET_OS").is_ok_and(|system| system == "none") {
        let script = manifest.join("link.ld");
        for argument in [
            "--gc-sections",
            "-ubench_init",
            "-uscan_once",
            "-ulook_once",
        ] {
            println!("cargo::rustc-link-arg-bins={argument}");
        }
        println!("cargo::rustc-link-arg-bins=-T{}", script.display());
        println!("cargo::rerun-if-changed={}", script.display());
    }
    Ok(())
}

/// The first 32 Boolean outputs in declaration order, as lanes: neighbours in a word of the image that are neighbours
/// in `bench_out` too.
fn lanes(variables: &[VariableSymbol]) -> String {
    let outputs = variables.iter().filter_map(|variable| match variable.slot {
        Slot::Bit(bit) if variable.kind == DeclarationKind::Output => Some(bit),
        _ => None,
    });
    // Word, first bit in the word, first bit in `bench_out`, how many.
    let mut lanes: Vec<[usize; 4]> = Vec::new();
    for (place, bit) in outputs.take(32).enumerate() {
        let shift = usize::from(bit.0) % 32;
        match lanes.last_mut() {
            Some([word, from, _, bits]) if *word == bit.word() && *from + *bits == shift => {
                *bits += 1;
            }
            _ => lanes.push([bit.word(), shift, place, 1]),
        }
    }
    let lanes: String = lanes
        .iter()
        .map(|[word, from, to, bits]| {
            let mask = u32::MAX >> (32 - bits);
            format!("Lane {{ word: {word}, from: {from}, mask: {mask:#x}, to: {to} }}, ")
        })
        .collect();
    format!("use super::Lane;\n/// The outputs.\npub static OUTPUTS: &[Lane] = &[{lanes}];\n")
}
