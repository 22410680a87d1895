//! Writes the seeds of a target as files, one each: where `script/fuzz` begins.

use std::path::Path;
use std::process::ExitCode;
use std::{env, fs};

use grafcet_fuzz::target::Target;

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let (target, directory) = match arguments.as_slice() {
        [target, directory] => (Target::named(target), directory),
        _ => (None, &String::new()),
    };
    let Some(target) = target else {
        let names = Target::ALL.map(Target::name).join("|");
        eprintln!("usage: seeds {names} DIRECTORY");
        return ExitCode::from(2);
    };
    for (index, seed) in target.seeds().iter().enumerate() {
        let path = Path::new(directory).join(format!("seed-{index:03}"));
        if let Err(error) = fs::write(&path, seed) {
            eprintln!("error: {}: {error}", path.display());
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}
