//! From `plc.toml` and its graphs to the tables of the image.
//!
//! `PLC=other.toml` in the environment builds another application; its path begins at the top of the repository.

use std::path::{Path, PathBuf};
use std::{env, fs, io, process};

use wiring::Loaded;

fn main() {
    if let Err(fault) = build() {
        // Nothing has been printed for cargo, so that a person reads this and nothing else.
        eprintln!("{fault}");
        process::exit(1);
    }
}

fn build() -> Result<(), String> {
    let plc = env::var("PLC").unwrap_or_else(|_| "plc.toml".to_owned());
    let loaded =
        wiring::load(&plc).map_err(|error| format!("error: cannot read {plc}: {error}"))?;
    let bare_metal = env::var("CARGO_CFG_TARGET_OS").is_ok_and(|os| os == "none");
    let source = application(&loaded, bare_metal)?;
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    let failed = |error: io::Error| format!("error: cannot write the generated files: {error}");
    fs::write(out.join("application.rs"), source).map_err(failed)?;
    if bare_metal {
        link(&loaded, &out).map_err(failed)?;
    }
    for line in loaded.warnings().lines() {
        println!("cargo::warning={line}");
    }
    println!("cargo::rerun-if-env-changed=PLC");
    for file in &loaded.files {
        println!("cargo::rerun-if-changed={file}");
    }
    Ok(())
}

/// The source of the module `application`, or everything that is wrong.
fn application(loaded: &Loaded, bare_metal: bool) -> Result<String, String> {
    let Some((application, wires)) = &loaded.image else {
        return Err(loaded.errors());
    };
    let mut items = grafcet_compiler::emit::program(application);
    items.extend(wiring::emit::tables(wires));
    if bare_metal {
        items.extend(wiring::emit::board_pins(wires));
    } else {
        items.extend(wiring::emit::labels(wires, application));
        items.extend(grafcet_compiler::emit::plants(application));
        items.extend(grafcet_compiler::emit::demonstration(
            application,
            &loaded.sources,
        ));
    }
    grafcet_compiler::emit::source(items)
        .map_err(|error| format!("error: the generated source: {error}"))
}

/// Hands the memories to the linker: `memory.x` as it stands, and what it includes.
fn link(loaded: &Loaded, out: &Path) -> io::Result<()> {
    if let Some((_, wires)) = &loaded.image {
        fs::write(out.join("retain.x"), wiring::emit::retain_script(wires))?;
    }
    fs::copy("memory.x", out.join("memory.x"))?;
    println!("cargo::rerun-if-changed=memory.x");
    println!("cargo::rustc-link-search={}", out.display());
    // `--nmagic`: sections are not aligned to pages, which flash does not have.
    for argument in ["--nmagic", "-Tlink.x", "-Tlink-rp.x", "-Tdefmt.x"] {
        println!("cargo::rustc-link-arg-bins={argument}");
    }
    Ok(())
}
