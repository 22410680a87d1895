//! `grafcet test`: the tests that stand beside the graphs.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use clap::Args;
use grafcet::testing::{self, Failure};
use grafcet::trace::Writer;
use grafcet_compiler::application::{Application, Test};
use grafcet_compiler::render::render;
use grafcet_compiler::source::Sources;

use super::{CommandError, GREEN, RED, STYLE, Verdict, accepted};

/// Run the tests of programs
#[derive(Args)]
#[command(override_usage = "grafcet test [OPTIONS] <FILE>... [FILTER]")]
#[command(after_help = "\
The last argument is a filter when it is neither the name of a file nor ends in .grafcet:
tests run whose names contain it.

Examples:
  grafcet test graphs/line_switcher.grafcet
  grafcet test graphs/line_switcher.grafcet \"bus fault\"
  grafcet test graphs/*.grafcet --trace traces

Exit codes: 0 all passed, 1 one failed or a program is refused, 2 a file cannot be used.")]
pub struct Arguments {
    /// Programs, and behind them a part of the names of the tests to run
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Keep the trace of every test in this directory
    #[arg(long, value_name = "DIR")]
    trace: Option<PathBuf>,
}

/// A program with the tests to run.
struct Suite<'a> {
    path: &'a Path,
    /// What the names of its traces begin with.
    name: String,
    sources: Sources,
    application: Application,
}

/// A test that failed.
struct Failed {
    name: String,
    report: String,
}

/// Runs the tests of all files, once all of them are accepted.
pub fn run(arguments: &Arguments) -> Result<Verdict, CommandError> {
    let (files, filter) = split(&arguments.files);
    let mut suites = Vec::new();
    for path in files {
        if let Some((sources, application)) = accepted(path)? {
            suites.push(Suite {
                path,
                name: name(&application, &suites),
                sources,
                application,
            });
        }
    }
    if suites.len() < files.len() {
        return Ok(Verdict::Bad);
    }
    if let Some(directory) = &arguments.trace {
        fs::create_dir_all(directory).map_err(CommandError::file(directory))?;
    }
    run_all(&suites, &filter, arguments.trace.as_deref())
}

/// The application's name; with a number behind it where another program before it has the same.
fn name(application: &Application, before: &[Suite<'_>]) -> String {
    let same = before
        .iter()
        .filter(|suite| suite.application.name == application.name);
    match same.count() {
        0 => application.name.clone(),
        others => format!("{}-{}", application.name, others + 1),
    }
}

/// The files, and the filter behind them; an empty one when there is none.
fn split(arguments: &[PathBuf]) -> (&[PathBuf], String) {
    match arguments {
        [files @ .., last] if !files.is_empty() && !names_a_file(last) => {
            (files, last.to_string_lossy().into_owned())
        }
        files => (files, String::new()),
    }
}

fn names_a_file(path: &Path) -> bool {
    path.exists() || path.extension().is_some_and(|end| end == "grafcet")
}

fn run_all(
    suites: &[Suite<'_>],
    filter: &str,
    directory: Option<&Path>,
) -> Result<Verdict, CommandError> {
    let mut out = anstream::stdout().lock();
    let total: usize = suites.iter().map(|s| s.application.tests.len()).sum();
    let chosen = |test: &Test| test.name.contains(filter);
    let running = suites
        .iter()
        .map(|suite| suite.application.tests.iter().filter(|t| chosen(t)).count())
        .sum::<usize>();
    let tests = if running == 1 { "test" } else { "tests" };
    writeln!(out, "running {running} {tests}")?;
    let mut failed = Vec::new();
    for suite in suites {
        for (index, test) in suite.application.tests.iter().enumerate() {
            if !chosen(test) {
                continue;
            }
            let name = format!("{}: {}", suite.path.display(), test.name);
            write!(out, "test {name} ... ")?;
            out.flush()?;
            match suite.run(index, test, directory)? {
                Ok(()) => writeln!(out, "{GREEN}ok{GREEN:#}")?,
                Err(failure) => {
                    writeln!(out, "{RED}FAILED{RED:#}")?;
                    let place = render(&[failure.diagnostic()], &suite.sources, STYLE);
                    let report = format!("{place}{}", failure.details());
                    failed.push(Failed { name, report });
                }
            }
        }
    }
    conclude(&mut out, &failed, running, total - running)?;
    Ok(if failed.is_empty() {
        Verdict::Good
    } else {
        Verdict::Bad
    })
}

fn conclude(
    out: &mut dyn Write,
    failed: &[Failed],
    running: usize,
    filtered_out: usize,
) -> io::Result<()> {
    if !failed.is_empty() {
        writeln!(out, "\nfailures:")?;
    }
    for Failed { name, report } in failed {
        writeln!(out, "\n---- {name} ----\n{}", report.trim_end())?;
    }
    write!(
        out,
        "\n{} passed, {} failed",
        running - failed.len(),
        failed.len()
    )?;
    match filtered_out {
        0 => writeln!(out),
        number => writeln!(out, ", {number} filtered out"),
    }
}

impl Suite<'_> {
    /// Runs a test; its trace goes into the directory, if there is one.
    fn run(
        &self,
        index: usize,
        test: &Test,
        directory: Option<&Path>,
    ) -> Result<Result<(), Box<Failure>>, CommandError> {
        let Some(directory) = directory else {
            return Ok(testing::run(&self.application, test, |_| {}));
        };
        let path = directory.join(self.trace_name(index, test));
        let mut written = Ok(());
        let traced = File::create(&path).and_then(|file| {
            let unit = &self.application.controller;
            let mut writer = Writer::new(unit, BufWriter::new(file))?;
            let verdict = testing::run(&self.application, test, |simulation| {
                if written.is_ok() {
                    written = writer.scan(simulation.time_ms(), simulation.images());
                }
            });
            written?;
            writer.finish()?;
            Ok(verdict)
        });
        traced.map_err(CommandError::file(&path))
    }

    /// A file name that tells which test it was on every file system: application, number and name.
    fn trace_name(&self, index: usize, test: &Test) -> String {
        let words = test.name.split(|c: char| !c.is_alphanumeric());
        let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
        let slug: String = words.join("_").chars().take(60).collect();
        format!("{}.{:02}.{slug}.csv", self.name, index + 1)
    }
}
