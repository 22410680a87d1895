//! What IEC 60848, the book and the specification leave open, as the manual decides it: what no other file claims.

use grafcet::testing;
use grafcet_compiler::diagnostic::{Level, Rule};
use grafcet_compiler::{Target, compile};

use crate::run::{application, run, run_scans, run_with};

/// The rules that a text breaks, warnings aside.
fn errors(text: &str) -> Vec<Rule> {
    let none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
    let compilation = compile("test.grafcet", text, &none, Target::Host);
    let diagnostics = compilation.diagnostics.iter();
    let errors = diagnostics.filter(|it| it.level() == Level::Error);
    errors.map(|it| it.rule).collect()
}

/// Runs the one test of a program; it has to pass.
#[track_caller]
fn passes(text: &str) {
    let application = application(text);
    if let Err(failure) = testing::run(&application, &application.tests[0], |_| {}) {
        panic!("{}\n{}", failure.diagnostic().message, failure.details());
    }
}

#[test]
fn graphs_plants_and_templates_share_a_space_of_names_apart_from_variables() {
    let one = "input A\nvar n : int\ngraph A { always { n = n + 1 IF A } }\n";
    assert_eq!(errors(one), []);
    assert_eq!(
        errors(&format!("{one} plant A {{ }}")),
        [Rule::DuplicateName]
    );
    assert_eq!(
        errors(&format!("{one} template A {{ }}")),
        [Rule::DuplicateName]
    );
    assert_eq!(errors(&format!("{one} template n {{ }}")), []);
}

#[test]
fn a_plant_knows_only_what_the_wires_tell() {
    let program = |plant: &str| {
        format!(
            "input i
             output O
             parameter p : int = 1
             const c : int = 1
             var v : bool
             graph G {{ initial step 1 {{ O IF i AND v; v = i }} }}
             plant P {{ {plant} }}"
        )
    };
    assert_eq!(errors(&program("always { i IF O AND p > c }")), []);
    for refused in [
        "always { i IF v }",
        "always { i IF G:X1 }",
        "always { i IF S(G) = {1} }",
        "input j",
        "output Q",
        "always { O IF TRUE }",
    ] {
        assert_ne!(errors(&program(refused)), [], "{refused}");
    }
}

#[test]
fn a_name_without_a_graph_is_looked_for_in_the_plants_of_the_test_too() {
    let program = |test: &str| {
        format!(
            "input i
             output O
             graph G {{ initial step 1 {{ O IF i }} }}
             plant P {{ var v : int; initial step 1 {{ v = v + 1 }} }}
             test \"it\" {test}"
        )
    };
    passes(&program("{ expect X1 }"));
    passes(&program("with P { expect v = 1 AND G:X1 AND P:X1 }"));
    assert_ne!(errors(&program("{ expect v = 1 }")), []);
}

#[test]
fn a_template_without_an_instance_is_checked() {
    let program = "graph G { initial step 1 }\n template T { always { n = n + 1 } }";
    assert!(errors(program).contains(&Rule::UnknownName));
}

#[test]
fn constant_arithmetic_that_faults_is_counted_by_the_scan() {
    let program = "
        var n, faults : int
        graph G { always { n = 7 / 0 + 2147483647 + 1; faults = System:arithmetic_faults } }
    ";
    let trace = run_scans(program, 2);
    assert_eq!(trace.column("n"), "2147483647,2147483647");
    assert_eq!(trace.column("faults"), "2,4");
}

#[test]
fn a_negative_constant_is_a_preset() {
    let program = "
        input a
        output P, Q
        const back : time = -1s
        graph G { always { P IF T/a/back; Q IF T/a/(-3) } }
    ";
    let trace = run(program, &[("a", "0 1 0")]);
    assert_eq!(trace.column("P"), "0,1,1");
    assert_eq!(trace.column("Q"), "0,1,1");
}

#[test]
fn an_input_has_a_range_only_at_a_word() {
    let read = "var n : int\ngraph G { always { n = level } }";
    assert_eq!(
        errors(&format!("input level : int at %IW0 in 0 .. 9\n{read}")),
        []
    );
    assert_ne!(errors(&format!("input level : int in 0 .. 9\n{read}")), []);
    let template = "
        var n : int
        template T { input level : int in 0 .. 9; always { n = level } }
        graph G = T { level at %IW0 }
    ";
    assert_eq!(errors(template), []);
}

#[test]
fn what_a_plant_writes_is_clamped_without_a_count() {
    let program = "
        input level : int at %IW0 in 0 .. 5
        var n, faults : int
        graph G { always { n = level; faults = System:arithmetic_faults } }
        plant P { always { level = level + 3 } }
    ";
    let trace = run_with(program, &["P"], 4);
    assert_eq!(trace.column("n"), "3,5,5,5");
    assert_eq!(trace.column("faults"), "0,0,0,0");
}

#[test]
fn a_plant_sees_its_own_inputs_as_it_wrote_them() {
    let program = "
        input i : int
        var n : int
        graph G { always { n = i } }
        plant P { var k : int; always { i = i + 1; k = i; i = i + 10 IF k = 2 } }
    ";
    assert_eq!(run_with(program, &["P"], 4).column("n"), "1,12,13,14");
}

#[test]
fn addresses_of_different_widths_are_not_compared() {
    let program = |second: &str| {
        format!(
            "var a : int at %MW0
             var b : int at {second}
             graph G {{ always {{ a = a + b; b = b + 1 }} }}"
        )
    };
    assert_eq!(errors(&program("%MD0")), []);
    assert_eq!(errors(&program("%MW0")), [Rule::DuplicateAddress]);
}

#[test]
fn leading_zeros_are_refused_in_steps_and_transitions_alone() {
    let program = |step: &str, transition: &str, number: &str| {
        format!(
            "var n : int
             graph G {{
                 initial step {step} {{ n = n + {number} }}
                 transition {transition}: {step} -> {step} when n = 1
             }}"
        )
    };
    assert_eq!(errors(&program("7", "7", "007")), []);
    assert!(errors(&program("07", "7", "7")).contains(&Rule::BadLiteral));
    assert!(errors(&program("7", "07", "7")).contains(&Rule::BadLiteral));
}

#[test]
fn durations_of_tests_and_of_the_scan_are_written_out() {
    let program = |scan: &str, step: &str| {
        format!(
            "scan {scan}
             const d : time = 10 ms
             input i
             output O
             graph G {{ initial step 1 {{ O IF T/i/d }} }}
             test \"it\" {{ {step} }}"
        )
    };
    assert_eq!(errors(&program("10 ms", "wait 10 ms")), []);
    assert_eq!(errors(&program("d", "wait 10 ms")), [Rule::Syntax]);
    for step in ["wait d", "pulse i for d", "wait until O within d"] {
        assert_eq!(errors(&program("10 ms", step)), [Rule::Syntax], "{step}");
    }
}

#[test]
fn a_delay_binds_like_a_division() {
    let program = |condition: &str| {
        format!("input a, b\noutput P\ngraph G {{ always {{ P IF {condition} AND b }} }}")
    };
    let trace = run(&program("10ms/a"), &[("a", "0 1 1"), ("b", "1 1 1")]);
    assert_eq!(trace.column("P"), "0,0,1");
    for parenthesised in ["NOT a", "↑a", "TRUE", "S(G) = {}", "T/a/1s"] {
        assert_eq!(errors(&program(&format!("10ms/({parenthesised})"))), []);
        let bare = errors(&program(&format!("10ms/{parenthesised}")));
        assert_ne!(bare, [], "10ms/{parenthesised}");
    }
}

#[test]
fn the_time_of_plants_and_claims_goes_on_when_that_of_the_controller_begins_anew() {
    passes(
        "
        input i, j
        output ON, TIMED
        graph G { initial step 1 { ON; TIMED IF T/X1/50ms }; always { ON IF i AND j } }
        plant P { initial step 1; always { i IF T/X1/50ms } }
        test \"it\" with P {
            set j
            wait 40 ms
            power cycle
            expect i AND NOT TIMED
            expect T/j/40ms
            wait 40 ms
            expect NOT TIMED
            wait 10 ms
            expect TIMED
        }
    ",
    );
}

#[test]
fn under_stable_a_claim_does_not_see_a_step_left_and_entered_within_a_scan() {
    passes(
        "
        evolution stable
        input a
        output TIMED
        graph G {
            always { TIMED IF T/X1/20ms }
            initial step 1
            step 2
            transition 1: 1 -> 2 when ↑a
            transition 2: 2 -> 1
        }
        test \"it\" {
            expect NOT T/X1/20ms
            wait 1 scans
            set a
            wait 1 scans
            expect T/X1/20ms AND NOT TIMED
        }
    ",
    );
}

#[test]
fn a_start_pressed_as_an_order_ends_is_lost() {
    let program = "
        input stop, start
        graph H { always { F/L:{I} IF stop } }
        graph L { initial step 1; step 2; transition 1: 1 -> 2 when ↑start }
    ";
    let trace = run(
        program,
        &[("stop", "0 1 0 0 0 0"), ("start", "0 0 1 1 0 1")],
    );
    assert_eq!(trace.column("L"), "1,1,1,1,1,2");
}

#[test]
fn a_step_bit_bound_to_an_input_of_a_template_stands_alone() {
    let program = "
        input go
        output P, Q
        template T { input i; output o; always { o IF T/i/20ms AND NOT T/i/30ms } }
        graph A = T { i = G:X2; o = P }
        graph B = T { i = G:X2 AND TRUE; o = Q }
        graph G {
            initial step 1
            step 2
            transition 1: 1 -> 2 when go
        }
        graph K { initial step 1; step 2; transition 1: 1 -> 2 when 20ms/G:X2 }
    ";
    let trace = run(program, &[("go", "0 1 0 0 0")]);
    assert_eq!(trace.column("P"), "0,0,0,1,0");
    assert_eq!(
        trace.column("Q"),
        "0,0,0,1,0",
        "an action sees the step at once"
    );
    assert_eq!(trace.column("K"), "1,1,1,2,2");
}

#[test]
fn the_rise_of_a_bound_step_bit_is_one_in_scan_0() {
    let program = "
        output P, Q
        template T { input i; output o; always { o IF ↑i } }
        graph A = T { i = G:X1; o = P }
        graph B = T { i = G:X1 AND TRUE; o = Q }
        graph G { initial step 1 }
    ";
    let trace = run_scans(program, 2);
    assert_eq!(trace.column("P"), "1,0");
    assert_eq!(trace.column("Q"), "0,0");
}
