//! Differences that have been found, as claims: the engine and the reference agree on them, and on what the law says.

use grafcet_reference::Machine;

use crate::compare::{Trees, compare};
use crate::render::Text;
use crate::stimulus::{Scan, full_name};

/// The cells of these columns, scan by scan, separated by points, from both alike; `inputs` holds for each scan the
/// Boolean inputs that are True.
fn agreed(text: &str, columns: &[&str], inputs: &[&str]) -> Vec<String> {
    let text = Text {
        main: text.to_owned(),
        library: None,
    };
    let trees = Trees::of(&text);
    let program = trees.program();
    let scan = |on: &&str| Scan {
        given: program
            .inputs()
            .into_iter()
            .map(|name| {
                (
                    full_name(name),
                    i32::from(on.split(' ').any(|on| on == name.1)),
                )
            })
            .collect(),
        periods: 1,
        ..Scan::default()
    };
    let stimulus: Vec<Scan> = inputs.iter().map(scan).collect();
    if let Err(failure) = compare(&text, &stimulus) {
        panic!("{failure}");
    }
    let header = program.header();
    let mut machine = Machine::new(&program);
    let mut rows = Vec::new();
    for (number, scan) in (0..).zip(&stimulus) {
        for (name, (_, value)) in program.inputs().into_iter().zip(&scan.given) {
            machine.set(name, *value);
        }
        machine.scan(number * program.period_ms);
        let row = machine.row();
        let cells: Vec<&str> = header
            .iter()
            .zip(&row)
            .filter(|(name, _)| columns.contains(&name.as_str()))
            .map(|(_, cell)| cell.as_str())
            .collect();
        rows.push(cells.join("."));
    }
    rows
}

#[test]
fn each_edge_that_is_written_counts_the_faults_of_its_own_operand() {
    let text = "
        output faults : int
        var m : int
        graph Main {
            always { faults = System:arithmetic_faults }
            initial step 1
            step 2
            transition 1: 1 -> 2 when ↑(1/m > 1)
            transition 2: 2 -> 1 when ↑(1/m > 1)
        }
        template Saw {
            input run
            step 1
            step 2
            transition 1: 1 -> 2 when T/(1/m > 1)/2s AND run
        }
        graph Saw1 = Saw { run = TRUE }
        graph Saw2 = Saw { run = TRUE }";
    assert_eq!(agreed(text, &["faults"], &["", ""]), ["4", "8"]);
}

#[test]
fn freezing_in_scan_0_keeps_what_the_graph_has_then_and_activates_nothing() {
    let text = "
        graph Top {
            always { F/Low:{*}; F/Late:{*}; F/Middle:{6} }
            initial step 1 encloses Low{5}
            initial step 2 encloses Middle{}
        }
        graph Middle {
            step 6 encloses Late{7}
        }
        graph Low {
            step 5
        }
        graph Late {
            initial step 7
        }";
    let rows = agreed(text, &["Middle", "Low", "Late"], &["", ""]);
    assert_eq!(rows, ["6.5.", "6.5."]);
}
