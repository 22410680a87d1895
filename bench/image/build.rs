//! Compiles the program named by `BENCH_PROGRAM` to its tables and to the table of its first inputs and outputs.

use std::path::{Path, PathBuf};
use std::{env, fs, io, process};

use grafcet_compiler::application::VariableSymbol;
use grafcet_compiler::model::DeclarationKind;
use grafcet_compiler::render::{Style, render};
use grafcet_compiler::{Target, compile, emit};
use grafcet_core::program::{Bit, Slot};

fn main() {
    if let Err(fault) = build() {
        eprintln!("{fault}");
        process::exit(1);
    }
}

fn build() -> Result<(), String> {
    println!("cargo::rerun-if-env-changed=BENCH_PROGRAM");
    let path = env::var("BENCH_PROGRAM")
        .unwrap_or_else(|_| "../../graphs/line_switcher.grafcet".to_owned());
    println!("cargo::rerun-if-changed={path}");
    let failed = |error: io::Error| format!("error: {path}: {error}");
    let text = fs::read_to_string(&path).map_err(failed)?;
    let folder = Path::new(&path).parent().unwrap_or(Path::new("."));
    let load = |name: &str| fs::read_to_string(folder.join(name));
    let compiled = compile(&path, &text, &load, Target::Host);
    let Some(application) = &compiled.application else {
        return Err(render(
            &compiled.diagnostics,
            &compiled.sources,
            Style::default(),
        ));
    };
    let tables = emit::source(emit::program(application)).map_err(|error| error.to_string())?;
    let variables = &application.controller.symbols.variables;
    let bits = |kind| table(variables, kind);
    let wires = format!(
        "pub static INPUTS: &[Bit] = &{};\npub static OUTPUTS: &[Bit] = &{};\n",
        bits(DeclarationKind::Input),
        bits(DeclarationKind::Output)
    );
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default()).join("program.rs");
    fs::write(out, tables + &wires).map_err(failed)
}

/// The first 32 Booleans of a kind, in declaration order.
fn table(variables: &[VariableSymbol], kind: DeclarationKind) -> String {
    let of_kind = variables
        .iter()
        .filter(|variable| variable.kind == kind && !variable.bound);
    let bits = of_kind.filter_map(|variable| match variable.slot {
        Slot::Bit(Bit(bit)) => Some(format!("Bit({bit})")),
        Slot::Number(_) => None,
    });
    format!("[{}]", bits.take(32).collect::<Vec<_>>().join(", "))
}
