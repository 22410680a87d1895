//! Random programs made fit for a board, for the tests of the emulated image: `tests/emulated/random.test.js`.

use std::path::{Path, PathBuf};
use std::{fs, io};

use grafcet_compiler::application::{Application, VariableSymbol};
use grafcet_compiler::{Target, ast, compile};

use crate::generate::{self, Features};
use crate::program::{Program, Type};
use crate::random::Random;
use crate::render::{LIBRARY, Text};

/// How many programs of each kind of evolution there are.
const PROGRAMS: usize = 2;
/// Of smaller ones too little is learnt for the time that an image takes.
const TRANSITIONS: usize = 15;
/// A hundred rounds of these programs are over within it on a Pico.
const STABLE_PERIOD_MS: u32 = 50;
/// Free pins of a Pico.
const PINS: std::ops::Range<usize> = 2..23;

/// What the pins do not give: numbers for the inputs that carry them.
const DRIVER: &str = "
graph Driver {
    always {
        level = (level * 5 + 3) MOD 23 - 4 IF ↑(a XOR d)
        interval = interval + 10ms IF ↑c
        interval = 0ms IF interval > 80ms
    }
}
";

#[test]
fn random_programs_are_made_into_applications_for_a_board() {
    let directory = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("applications");
    match fs::remove_dir_all(&directory) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => panic!("{error}"),
        _ => {}
    }
    for stable in [false, true] {
        let fit = (0..).filter_map(|seed| Some((seed, fit(seed, stable)?)));
        for (seed, (text, application)) in fit.take(PROGRAMS) {
            write(
                &directory.join(format!("random_{seed}")),
                &text,
                &application,
            )
            .expect("a directory");
        }
    }
    assert_eq!(
        fs::read_dir(directory).expect("a directory").count(),
        2 * PROGRAMS
    );
}

/// The program of a seed, if it can be wired and is worth it.
fn fit(seed: u64, stable: bool) -> Option<(Text, Application)> {
    let mut program = generate::program(&mut Random::new(seed), Features::ALL);
    if program.stable != stable {
        return None;
    }
    prepare(&mut program);
    let mut text = program.text();
    text.main += DRIVER;
    let library = text.library.clone();
    let load = |_: &str| library.clone().ok_or(io::ErrorKind::NotFound.into());
    let application = compile("random.grafcet", &text.main, &load, Target::Firmware).application?;
    if application
        .controller
        .symbols
        .variables
        .iter()
        .any(is_number_at_a_pin)
    {
        return None;
    }
    let large = application.controller.tables.transitions.len() >= TRANSITIONS;
    large.then_some((text, application))
}

/// As a template's terminal can be.
fn is_number_at_a_pin(variable: &VariableSymbol) -> bool {
    let address = variable.address.as_deref().unwrap_or_default();
    variable.ty != ast::Type::Bool && (address.starts_with("%I") || address.starts_with("%Q"))
}

/// Gives the Booleans of the application addresses, and makes variables of what no pin carries. Nothing is retained:
/// what changes in every scan would keep the flash busy, and the scans waiting.
fn prepare(program: &mut Program) {
    if program.stable {
        program.period_ms = STABLE_PERIOD_MS;
    }
    let globals = program.declarations.iter_mut();
    for (place, declaration) in globals.enumerate() {
        let direction = match declaration.kind {
            "input" => 'I',
            "output" => 'Q',
            _ => continue,
        };
        if declaration.ty == Type::Bool {
            declaration.address = Some(format!("%{direction}X{}.{}", 50 + place / 8, place % 8));
        } else {
            declaration.kind = "var";
            declaration.address = None;
        }
    }
    let locals = program
        .graphs
        .iter_mut()
        .flat_map(|graph| &mut graph.declarations);
    let retained = program.declarations.iter_mut().chain(locals);
    for declaration in retained.filter(|it| it.kind == "retain var") {
        declaration.kind = "var";
    }
}

fn write(directory: &Path, text: &Text, application: &Application) -> io::Result<()> {
    fs::create_dir_all(directory)?;
    fs::write(directory.join("random.grafcet"), &text.main)?;
    if let Some(library) = &text.library {
        fs::write(directory.join(LIBRARY), library)?;
    }
    fs::write(directory.join("plc.toml"), wiring(application))
}

fn wiring(application: &Application) -> String {
    let variables = application.controller.symbols.variables.iter();
    let addresses = variables.filter_map(|variable| variable.address.as_deref());
    let mut pins = PINS;
    let mut line = |address: &str| {
        format!(
            "\"{address}\" = \"GP{}\"\n",
            pins.next().unwrap_or_else(|| panic!("no pin is free"))
        )
    };
    let (mut inputs, mut outputs) = (String::new(), String::new());
    for address in addresses {
        match &address[..2] {
            "%I" => inputs += &line(address),
            "%Q" => outputs += &line(address),
            _ => {}
        }
    }
    format!(
        "application = \"random.grafcet\"\nboard = \"pico\"\n[inputs]\n{inputs}[outputs]\n{outputs}"
    )
}
