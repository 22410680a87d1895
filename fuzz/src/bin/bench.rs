//! What `grafcet check` takes for a large text of every shape: `script/bench-compiler` builds and runs this.

use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::time::{Duration, Instant};

use clap::Parser;
use grafcet_fuzz::large::shapes;

/// Measure `grafcet check` on large texts, one of every shape
#[derive(Parser)]
struct Arguments {
    /// The tool
    grafcet: PathBuf,
    /// Only shapes whose name contains this
    filter: Option<String>,
    /// The size of each text in KiB
    #[arg(long, default_value_t = 1024)]
    kib: usize,
    /// Where to keep the texts
    #[arg(long)]
    keep: Option<PathBuf>,
}

/// An answer is due within this.
const DUE: Duration = Duration::from_secs(1);

fn main() -> ExitCode {
    match measure(&Arguments::parse()) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(late) => {
            println!("{late} took longer than {} s", DUE.as_secs());
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// The answer is how many took too long.
fn measure(arguments: &Arguments) -> io::Result<usize> {
    let temporary = tempfile::tempdir()?;
    let directory = arguments.keep.as_deref().unwrap_or(temporary.path());
    let filter = arguments.filter.as_deref().unwrap_or("");
    let chosen = shapes().into_iter().filter(|it| it.name.contains(filter));
    let mut late = 0;
    for (index, shape) in chosen.enumerate() {
        let path = directory.join(format!("{index:03}.grafcet"));
        std::fs::write(&path, shape.text(arguments.kib << 10))?;
        let (took, status) = check(&arguments.grafcet, &path)?;
        late += usize::from(took > DUE);
        let flag = if took > DUE { "  <- late" } else { "" };
        println!(
            "{:>6} ms  {status:<10} {}{flag}",
            took.as_millis(),
            shape.name
        );
    }
    Ok(late)
}

fn check(grafcet: &Path, path: &Path) -> io::Result<(Duration, String)> {
    let begin = Instant::now();
    let status = Command::new(grafcet)
        .arg("check")
        .arg(path)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()?;
    let took = begin.elapsed();
    let status = match status.code() {
        Some(0) => "accepted".to_owned(),
        Some(1) => "refused".to_owned(),
        _ => status.to_string(),
    };
    Ok((took, status))
}
