//! Graph text: always an answer, its places in the text, and a program that runs if there is one.

use std::io;

use grafcet::machine::Bench;
use grafcet::simulation::Simulation;
use grafcet_compiler::application::{Application, Place};
use grafcet_compiler::ast::{DeclarationKind, Type};
use grafcet_compiler::format::{Unformatted, format};
use grafcet_compiler::render::{Style, render, render_json};
use grafcet_compiler::source::FileId;
use grafcet_compiler::{Compilation, Target, compile};

use crate::corpus;

/// Words, signs and literals of the language and of its neighbours.
pub(crate) const WORDS: &str = "application import scan evolution input output retain var parameter const graph \
    always initial step macro entry exit transition template plant property test at in encloses when do on AND OR XOR \
    NOT MOD IF TRUE FALSE RE FE System X25 XM5 T F S I stable bool int time activation deactivation event never \
    reachable recoverable after within expect set clear release pulse for wait until scans power cycle with a b Drill \
    42 16#FF 2#12 1_000 30ms 2s 0.5s 1min30s T#1m30s \"text\" \" %IX0.0 %QW3 E5 ( ) { } , ; : := = <> ≠ < <= ≤ > >= ≥ \
    + - * / & · | ! ¬ ↑ ↓ -> => == && || .. . // (* *) /* # @ _ é e\u{301} → {I} {*} {1,3} S(G) F/G: T/X3/ \u{1F600} \
    \u{feff} \r\n \t \0 \n\n==lib.grafcet\n import\"lib.grafcet\"\n";

/// A line that begins like this names a library, whose text follows.
const LIBRARY: &str = "\n==";

/// So many scans are run of a program that compiles.
const SCANS: usize = 12;

pub(crate) fn run(input: &[u8]) {
    // Everything that reads a program refuses what is no UTF-8.
    let Ok(input) = str::from_utf8(input) else {
        return;
    };
    laid_out(input);
    let (main, libraries) = input.split_once(LIBRARY).unwrap_or((input, ""));
    for target in [Target::Host, Target::Firmware] {
        let load = |path: &str| library(libraries, path);
        let compilation = compile("fuzz.grafcet", main, &load, target);
        answered(&compilation);
        if let (Target::Host, Some(application)) = (target, &compilation.application) {
            sound(application);
            play(application, input);
        }
    }
}

pub(crate) fn seeds() -> Vec<Vec<u8>> {
    let programs = corpus::repository("graphs", ".grafcet");
    let rules = corpus::repository("grafcet-compiler/tests/rules", ".txt");
    let cases = rules.iter().flat_map(|rule| rule.split("== "));
    let wrong = corpus::repository("grafcet-compiler/tests/parser", ".grafcet");
    let texts = programs.into_iter().chain(cases.map(str::to_owned));
    texts.chain(wrong).map(String::into_bytes).collect()
}

/// The text behind the line with a library's name.
fn library(libraries: &str, path: &str) -> io::Result<String> {
    let mut parts = libraries.split(LIBRARY);
    let text = parts.find_map(|part| {
        let (name, text) = part.split_once('\n')?;
        (name.trim() == path).then(|| text.to_owned())
    });
    text.ok_or_else(|| io::ErrorKind::NotFound.into())
}

/// A text that fits the grammar has one layout, which is its own.
fn laid_out(text: &str) {
    match format(FileId(0), text) {
        Ok(laid_out) => match format(FileId(0), &laid_out) {
            Ok(again) => assert_eq!(again, laid_out, "another layout"),
            Err(error) => panic!("the layout of a program is refused: {error:?}\n{laid_out}"),
        },
        Err(Unformatted::Wrong(diagnostics)) => assert!(!diagnostics.is_empty()),
        Err(Unformatted::Otherwise) => panic!("the layout says something else"),
    }
}

/// What users see fits what there is to say.
fn answered(compilation: &Compilation) {
    let (said, sources) = (&compilation.diagnostics, &compilation.sources);
    assert_eq!(compilation.application.is_none(), compilation.has_errors());
    for diagnostic in said {
        let places = std::iter::once(diagnostic.span);
        for place in places.chain(diagnostic.labels.iter().map(|label| label.span)) {
            let text = sources.get(place.file).map_or("", |it| it.text.as_str());
            let stretch = text.get(place.start as usize..place.end as usize);
            assert!(stretch.is_some(), "{diagnostic:?} lies outside its file");
        }
    }
    let drawn = render(said, sources, Style::default());
    assert_eq!(drawn.is_empty(), said.is_empty());
    let lines = render_json(said, sources);
    assert_eq!(lines.lines().count(), said.len());
    for line in lines.lines() {
        let object = serde_json::from_str::<serde_json::Value>(line);
        assert!(object.is_ok(), "{line}");
    }
}

/// The engine may rely on every table.
fn sound(application: &Application) {
    let plants = application.plants.iter().map(|it| &it.unit.tables);
    let tests = application.tests.iter().map(|it| &it.observer.tables);
    let controller = std::iter::once(&application.controller.tables);
    for tables in controller.chain(plants).chain(tests) {
        assert_eq!(tables.program().unsoundness(), None);
    }
}

/// Runs the program with all its plants and restless inputs, and once through a loss of power.
fn play(application: &Application, input: &str) {
    let bench = Bench::new();
    let plants: Vec<usize> = (0..application.plants.len()).collect();
    let mut simulation = Simulation::new(&bench, application, &plants);
    let mut random = fastrand::Rng::with_seed(input.len() as u64);
    let inputs = application.controller.symbols.variables.iter();
    let given = |kind| matches!(kind, DeclarationKind::Input | DeclarationKind::Parameter);
    let inputs: Vec<_> = inputs.filter(|it| given(it.kind) && !it.bound).collect();
    for scan in 0..SCANS {
        for input in &inputs {
            let value = match input.ty {
                Type::Bool => i32::from(random.bool()),
                Type::Int | Type::Time => random.i32(..),
            };
            simulation.set(Place::Controller(input.slot), value);
        }
        simulation.scan();
        if scan == SCANS / 2 {
            simulation.power_cycle();
        }
    }
}
