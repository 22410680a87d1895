//! Every test of every `.grafcet` file under `graphs/`, each under its own name; and each file is laid out as
//! `grafcet fmt` does it.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::{fs, io};

use grafcet::testing;
use grafcet_compiler::format::{Unformatted, format};
use grafcet_compiler::render::{Style, render};
use grafcet_compiler::source::FileId;
use grafcet_compiler::{Compilation, Target};
use libtest_mimic::{Arguments, Failed, Trial};

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../graphs");
    let trials = programs(&root)
        .and_then(|paths| {
            let trials: io::Result<Vec<Vec<Trial>>> =
                paths.iter().map(|path| trials(&root, path)).collect();
            trials
        })
        .map(|trials| trials.into_iter().flatten().collect());
    match trials {
        Ok(trials) => libtest_mimic::run(&arguments, trials).exit_code(),
        Err(error) => {
            eprintln!("{}: {error}", root.display());
            ExitCode::FAILURE
        }
    }
}

/// All programs below a directory, in a fixed order.
fn programs(directory: &Path) -> io::Result<Vec<PathBuf>> {
    let mut programs = Vec::new();
    let mut entries: Vec<PathBuf> = fs::read_dir(directory)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<io::Result<_>>()?;
    entries.sort();
    for path in entries {
        if path.is_dir() {
            programs.extend(self::programs(&path)?);
        } else if path.extension().is_some_and(|end| end == "grafcet") {
            programs.push(path);
        }
    }
    Ok(programs)
}

/// One trial that the program is accepted without a warning, one of its layout, and one for each of its tests.
fn trials(root: &Path, path: &Path) -> io::Result<Vec<Trial>> {
    let name = path
        .strip_prefix(root)
        .unwrap_or(path)
        .display()
        .to_string();
    // What is specified by texts only, for people, is drawn and does not run.
    let target = match name.ends_with(".level1.grafcet") {
        true => Target::Drawing,
        false => Target::Host,
    };
    let compilation = Arc::new(grafcet::source::compile(path, target)?);
    let checked = Arc::clone(&compilation);
    let mut trials = vec![Trial::test(format!("{name}: accepted"), move || {
        accepted(&checked, target)
    })];
    let text = fs::read_to_string(path)?;
    trials.push(Trial::test(format!("{name}: laid out"), move || {
        laid_out(&text)
    }));
    let tests = compilation.application.iter().flat_map(|a| &a.tests);
    for (index, test) in tests.enumerate() {
        let compilation = Arc::clone(&compilation);
        trials.push(Trial::test(format!("{name}: {}", test.name), move || {
            run(&compilation, index)
        }));
    }
    Ok(trials)
}

fn accepted(compilation: &Compilation, target: Target) -> Result<(), Failed> {
    let runs = compilation.application.is_some();
    if compilation.diagnostics.is_empty() && runs == (target != Target::Drawing) {
        return Ok(());
    }
    Err(render(
        &compilation.diagnostics,
        &compilation.sources,
        Style::default(),
    )
    .into())
}

fn laid_out(text: &str) -> Result<(), Failed> {
    match format(FileId(0), text) {
        Ok(layout) if layout == text => Ok(()),
        Ok(_) => Err("lay it out with `grafcet fmt`".into()),
        Err(Unformatted::Wrong(_)) => Err("it does not fit the grammar".into()),
        Err(Unformatted::Otherwise) => Err("laid out it would be read otherwise".into()),
    }
}

fn run(compilation: &Compilation, index: usize) -> Result<(), Failed> {
    let application = compilation.application.as_ref().ok_or("refused")?;
    let test = application.tests.get(index).ok_or("no such test")?;
    testing::run(application, test, |_| {}).map_err(|failure| {
        let place = render(
            &[failure.diagnostic()],
            &compilation.sources,
            Style::default(),
        );
        format!("{place}{}", failure.details()).into()
    })
}
