//! An instance of a template is the graph that one would have written by hand: the tables are the same.

use std::io;

use grafcet_compiler::application::{Application, Tables};
use grafcet_compiler::render::{Style, render};
use grafcet_compiler::{Target, compile};

const SAW: &str = "template Saw \"a saw\" {
    input go, stop
    output MOTOR, LAMP
    parameter delay : time = 2s in 1s..9s
    var cuts : int
    initial step 1
    step 2 { MOTOR IF T/X2/delay AND NOT stop; LAMP = ↑go; on activation: cuts = cuts + 1 }
    always { F/Saw:{I} IF stop AND S(Saw) = {2} }
    transition 1: 1 -> 2 when ↑go AND cuts < 100
    transition 2: 2 -> 1 when T/go/3s OR Saw:stop
}";

/// A library that imports another one, and itself.
fn load(path: &str) -> io::Result<String> {
    match path {
        "lib/saws.grafcet" => Ok("import \"saw.grafcet\"\nimport \"saws.grafcet\"".to_owned()),
        "lib/saw.grafcet" => Ok(SAW.to_owned()),
        _ => Err(io::ErrorKind::NotFound.into()),
    }
}

fn application(text: &str) -> Application {
    let compilation = compile("plant/main.grafcet", text, &load, Target::Host);
    let Some(application) = compilation.application else {
        let style = Style::default();
        panic!(
            "{}",
            render(&compilation.diagnostics, &compilation.sources, style)
        );
    };
    application
}

fn tables(text: &str) -> Tables {
    application(text).controller.tables
}

const TERMINALS: &str = "input a, b, c\noutput M, N\n";

#[test]
fn an_instance_is_the_graph_with_its_bindings_put_in() {
    let instance = format!(
        "{SAW}\n{TERMINALS}var lamp
         graph Left = Saw {{ go = a AND NOT b; stop = c; MOTOR = M; LAMP = lamp; delay = 1500ms }}
         graph Watch {{ initial step 1 {{ N IF lamp OR Left:X2 OR Left:go }} }}"
    );
    let by_hand = format!(
        "{TERMINALS}var lamp
         graph Left {{
             parameter delay : time = 1500ms in 1s..9s
             var cuts : int
             initial step 1
             step 2 {{ M IF T/X2/delay AND NOT c; lamp = ↑(a AND NOT b); on activation: cuts = cuts + 1 }}
             always {{ F/Left:{{I}} IF c AND S(Left) = {{2}} }}
             transition 1: 1 -> 2 when ↑(a AND NOT b) AND cuts < 100
             transition 2: 2 -> 1 when T/(a AND NOT b)/3s OR c
         }}
         graph Watch {{ initial step 1 {{ N IF lamp OR Left:X2 OR (a AND NOT b) }} }}"
    );
    assert_eq!(tables(&instance), tables(&by_hand));
}

#[test]
fn a_name_bound_to_an_address_is_a_terminal_of_its_own() {
    let instance = format!(
        "{SAW}\ngraph Left = Saw {{ go at %IX0.0; stop at %IX0.1; MOTOR at %QX0.0; LAMP at %QX0.1 }}"
    );
    let by_hand = SAW
        .replace("template Saw", "graph Left")
        .replace("F/Saw", "F/Left")
        .replace("S(Saw)", "S(Left)")
        .replace("Saw:stop", "Left:stop")
        .replace("input go, stop", "input go at %IX0.0\ninput stop at %IX0.1")
        .replace(
            "output MOTOR, LAMP",
            "output MOTOR at %QX0.0\noutput LAMP at %QX0.1",
        );
    assert_eq!(tables(&instance), tables(&by_hand));
}

#[test]
fn every_instance_has_steps_and_variables_of_its_own() {
    let text = format!(
        "{SAW}\n{TERMINALS}
         graph Left = Saw {{ go = a; stop = c; MOTOR = M; LAMP at %QX0.1 }}
         graph Right = Saw {{ go = Left:X2; stop = Left:stop; MOTOR = N; LAMP at %QX0.2; delay = 9s }}
         graph Other {{ initial step 1; transition 1: 1 -> 1 when b }}"
    );
    let symbols = application(&text).controller.symbols;
    let graphs: Vec<&str> = symbols
        .graphs
        .iter()
        .map(|graph| graph.name.as_str())
        .collect();
    assert_eq!(graphs, ["Left", "Right", "Other"]);
    let delays = symbols
        .variables
        .iter()
        .filter(|variable| variable.name.ends_with(":delay"));
    let delays: Vec<(&str, i32)> = delays.map(|it| (it.name.as_str(), it.initial)).collect();
    assert_eq!(delays, [("Left:delay", 2000), ("Right:delay", 9000)]);
}

#[test]
fn a_library_is_found_beside_the_file_that_imports_it() {
    let bindings = "go = a; stop = c; MOTOR = M; LAMP = N";
    let imported =
        format!("import \"lib/saws.grafcet\"\n{TERMINALS}graph Left = Saw {{ {bindings} }}");
    let local = format!("{TERMINALS}{SAW}\ngraph Left = Saw {{ {bindings} }}");
    assert_eq!(tables(&imported), tables(&local));
}

#[test]
fn an_unused_template_leaves_nothing_behind() {
    let graph = "graph G { initial step 1 { M IF a AND b; N IF c } }";
    assert_eq!(
        tables(&format!("{TERMINALS}{graph}\n{SAW}")),
        tables(&format!("{TERMINALS}{graph}"))
    );
}
