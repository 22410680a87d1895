//! Differences that have been found, as claims: the engine and the reference agree on them, and on what the law says.

use crate::compare::{Trees, traced};
use crate::render::Text;
use crate::stimulus::{Scan, full_name};

/// The cells of these columns, scan by scan, separated by points, from both alike; `inputs` holds for each scan the
/// Boolean inputs that are True.
fn agreed(text: &str, columns: &[&str], inputs: &[&str]) -> Vec<String> {
    let trees = Trees::of(&alone(text));
    let names: Vec<String> = trees
        .program()
        .inputs()
        .into_iter()
        .map(full_name)
        .collect();
    let value = |on: &str, name: &String| i32::from(on.split(' ').any(|on| on == name));
    let scan = |on: &&str| Scan {
        given: names
            .iter()
            .map(|name| (name.clone(), value(on, name)))
            .collect(),
        periods: 1,
        ..Scan::default()
    };
    let stimulus: Vec<Scan> = inputs.iter().map(scan).collect();
    agreed_on(text, columns, &stimulus)
}

/// The same for any stimulus.
fn agreed_on(text: &str, columns: &[&str], stimulus: &[Scan]) -> Vec<String> {
    let rows = match traced(&alone(text), stimulus) {
        Ok((_, rows)) => rows,
        Err(failure) => panic!("{failure}"),
    };
    let mut rows = rows.into_iter();
    let header = rows.next().unwrap_or_default();
    let places: Vec<usize> = (0..header.len())
        .filter(|place| columns.contains(&header[*place].as_str()))
        .collect();
    let cells = |row: Vec<String>| places.iter().map(|place| row[*place].clone()).collect();
    rows.map(|row| -> Vec<String> { cells(row) })
        .map(|cells| cells.join("."))
        .collect()
}

fn alone(text: &str) -> Text {
    Text {
        main: text.to_owned(),
        library: None,
    }
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
fn an_int_preset_counts_seconds_exactly_whatever_its_size() {
    let text = "
        input a
        output M
        var seconds : int = 3000000
        graph Main {
            always { M IF T/a/seconds }
            initial step 1
        }";
    let on = |periods| Scan {
        given: vec![("a".to_owned(), 1)],
        periods,
        ..Scan::default()
    };
    // 2 999 999.99 s and 3 000 000 s behind the rise.
    let rows = agreed_on(text, &["M"], &[on(1), on(299_999_999), on(1)]);
    assert_eq!(rows, ["0", "0", "1"]);
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

#[test]
fn an_enclosed_graph_keeps_nothing_in_scan_0_from_a_step_that_was_not_active_as_it_began() {
    let text = "
        graph Top {
            always { F/Top:{3} }
            step 3 encloses Middle{1}
        }
        graph Middle {
            initial step 1 encloses Low{2}
        }
        graph Low {
            step 2
            initial step 3
        }";
    let rows = agreed(text, &["Middle", "Low"], &["", ""]);
    assert_eq!(rows, ["1.2", "1.2"]);
}

#[test]
fn an_enclosed_graph_keeps_its_start_in_scan_0_only_from_the_step_that_gave_it() {
    let text = "
        graph Top {
            always { F/Other:{2, 3} }
        }
        graph Other {
            initial step 1 encloses Low{5}
            step 2
            initial step 3 encloses Low{6}
            initial step 4 encloses Low{7}
        }
        graph Low { step 5; step 6; step 7 }";
    assert_eq!(agreed(text, &["Other", "Low"], &[""]), ["2 3.6"]);
}
