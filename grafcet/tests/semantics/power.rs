//! What survives power, and what does not.

use grafcet::machine::Bench;
use grafcet::simulation::Simulation;
use grafcet::testing;
use grafcet_compiler::application::{Application, Place};

use crate::run::application;

fn place(application: &Application, name: &str) -> Place {
    let variables = &application.controller.symbols.variables;
    let found = variables.iter().find(|variable| variable.name == name);
    Place::Controller(found.unwrap_or_else(|| panic!("no {name}")).slot)
}

#[test]
fn retained_variables_and_parameters_survive_and_nothing_else() {
    let application = application(
        "
        input go
        retain var kept, count : int
        retain var flag
        var lost : int = 1
        parameter p : int = 5 in 0 .. 9
        graph G {
            always { kept = p IF go; count = count + 1; lost = 2 IF go; flag = True IF go }
            initial step 1
            step 2
            transition 1: 1 -> 2 when go
        }
    ",
    );
    let bench = Bench::new();
    let mut simulation = Simulation::new(&bench, &application, &[]);
    let value = |simulation: &Simulation<'_>, name| simulation.value(place(&application, name));
    simulation.scan();
    simulation.set(place(&application, "go"), 1);
    simulation.set(place(&application, "p"), 7);
    simulation.scan();
    simulation.set(place(&application, "go"), 0);
    assert_eq!(value(&simulation, "lost"), 2);
    assert_eq!(simulation.time_ms(), 10);

    simulation.power_cycle();
    simulation.scan();
    assert_eq!(simulation.time_ms(), 0);
    assert_eq!(value(&simulation, "kept"), 7);
    assert_eq!(value(&simulation, "count"), 3);
    assert_eq!(value(&simulation, "flag"), 1);
    assert_eq!(value(&simulation, "p"), 7);
    assert_eq!(value(&simulation, "lost"), 1);
    let situation = grafcet::images::situation(&application.controller, 0, simulation.images());
    assert_eq!(situation, "1");
}

/// Runs the one test of a program; it has to pass.
fn passes(text: &str) {
    let application = application(text);
    assert!(!application.tests.is_empty(), "a test");
    for test in &application.tests {
        if let Err(failure) = testing::run(&application, test, |_| {}) {
            let message = failure.diagnostic().message;
            panic!("{}: {message}\n{}", test.name, failure.details());
        }
    }
}

#[test]
fn timers_and_edges_begin_anew_after_power_comes_back() {
    passes(
        "
        input a
        graph G {
            initial step 1
            step 2
            step 3
            transition 1: 1 -> 2 when T/X1/50ms
            transition 2: 1 -> 3 when ↑a
        }
        test \"timed from the new scan 0, and a held button is no edge\" {
            wait 40 ms
            expect X1
            set a
            power cycle
            wait 40 ms
            expect X1
            wait 10 ms
            expect X2
        }
    ",
    );
}

#[test]
fn plants_live_on_and_see_the_outputs_off_until_scan_0_is_over() {
    passes(
        "
        input i
        output ON
        graph G { initial step 1 { ON }; always { ON IF i } }
        plant P {
            var scans : int = 0
            var seen : int = 0
            var edges : int = 0
            always {
                scans = scans + 1
                seen = seen + 1 IF ON
                edges = edges + 1 IF ↑ON
                i IF False
            }
        }
        test \"one life\" with P {
            wait 3 scans
            expect P:scans = 4 AND P:seen = 3 AND P:edges = 1
            power cycle
            expect P:scans = 5 AND P:seen = 3
            wait 1 scans
            expect P:scans = 6 AND P:seen = 4 AND P:edges = 2
        }
    ",
    );
}

#[test]
fn what_a_test_has_set_stays_set() {
    passes(
        "
        input a, b
        output A, B
        graph G { always { A IF a; B IF b } }
        plant P { always { a IF NOT A AND A } }
        test \"overridden before and after\" with P {
            set a, b
            expect A AND B
            power cycle
            expect A AND B
            release a
            wait 1 scans
            expect NOT A AND B
        }
    ",
    );
}
