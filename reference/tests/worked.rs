//! The worked traces of `semantics.md`, and the sentences around them that a trace shows best.

use grafcet_compiler::ast::File;
use grafcet_compiler::parser::parse;
use grafcet_compiler::source::FileId;
use grafcet_reference::{Machine, Program};

fn parsed(text: &str) -> File {
    let mut diagnostics = Vec::new();
    let file = parse(FileId(0), text, &mut diagnostics);
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    file
}

/// The cells of these columns, scan by scan, separated by points; `inputs` holds for each scan the inputs that are
/// True.
fn trace(text: &str, columns: &[&str], inputs: &[&str]) -> Vec<String> {
    let file = parsed(text);
    let program = Program::new(&file, &[]);
    let header = program.header();
    let place = |column: &&str| header.iter().position(|name| name == column);
    let places: Vec<usize> = columns.iter().filter_map(place).collect();
    assert_eq!(places.len(), columns.len(), "{header:?}");
    let mut machine = Machine::new(&program);
    let scans = inputs.iter().zip(0..);
    scans
        .map(|(inputs, scan)| {
            for name in program.inputs() {
                let value = inputs.split(' ').any(|input| input == name.1);
                machine.set(name, i32::from(value));
            }
            machine.scan(scan * program.period_ms);
            let row = machine.row();
            let cells: Vec<&str> = places.iter().map(|place| row[*place].as_str()).collect();
            cells.join(".")
        })
        .collect()
}

#[test]
fn an_edge_fires_in_the_scan_that_reads_it_and_a_timer_counts_from_the_activation() {
    let text = "
        input a
        output M
        graph G {
            initial step 1
            step 2 { M }
            transition 1: 1 -> 2 when ↑a
            transition 2: 2 -> 1 when T/X2/20ms
        }";
    let rows = trace(text, &["time_ms", "G", "M"], &["a", "a", "", "a", "a", ""]);
    assert_eq!(
        rows,
        ["0.1.0", "10.1.0", "20.1.0", "30.2.1", "40.2.1", "50.1.0"]
    );
}

#[test]
fn an_always_true_chain_moves_one_step_a_scan() {
    let text = "
        graph G {
            initial step 1
            step 2
            step 3
            transition 1: 1 -> 2 when True
            transition 2: 2 -> 3 when True
            transition 3: 3 -> 1 when True
        }";
    assert_eq!(trace(text, &["G"], &[""; 5]), ["1", "2", "3", "1", "2"]);
}

#[test]
fn a_token_kept_by_a_self_loop_is_no_activation() {
    let text = "
        input a
        output long
        var n : int
        graph G {
            initial step 1
            step 2 { on activation: n = n + 1; long IF T/X2/30ms }
            transition 1: 1 -> 2 when a
            transition 2: 2 -> 2 when a
        }";
    let rows = trace(text, &["G", "n", "long"], &["", "a", "a", "a", "a", "a"]);
    assert_eq!(rows, ["1.0.0", "2.1.0", "2.1.0", "2.1.0", "2.1.1", "2.1.1"]);
}

#[test]
fn the_drill_of_the_language_drills_a_hole_and_comes_home_when_stopped() {
    let text = "
        input start, stop, up, down
        output SPIN, RAISE, LOWER, ALARM
        graph Drill {
            always { F/Drill:{2} IF stop }
            initial step 2 { RAISE IF NOT up }
            step 3 { SPIN }
            step 4 { SPIN; LOWER }
            step 5 { SPIN; RAISE }
            step 6 { ALARM IF NOT T/X6/2s }
            transition 2: 2 -> 3 when ↑start AND up
            transition 3: 3 -> 4 when T/X3/20ms
            transition 4: 4 -> 5 when down
            transition 5: 5 -> 2 when up
            transition 6: 2 -> 6 when T/X2/15s AND NOT up
            transition 9: 6 -> 2 when ↑start
        }";
    let inputs = [
        "up", "up start", "up", "up", "", "down", "", "up", "up start", "stop", "stop", "",
    ];
    let rows = trace(text, &["Drill", "SPIN", "RAISE", "LOWER"], &inputs);
    let expected = [
        "2.0.0.0", "3.1.0.0", "3.1.0.0", "4.1.0.1", "4.1.0.1", "5.1.1.0", "5.1.1.0", "2.0.0.0",
        "3.1.0.0", "2.0.1.0", "2.0.1.0", "2.0.1.0",
    ];
    assert_eq!(rows, expected);
}

#[test]
fn an_order_holds_through_the_scan_in_which_it_ends() {
    let text = "
        input halt
        graph Top { always { F/Low:{*} IF halt } }
        graph Low {
            initial step 1
            step 2
            transition 1: 1 -> 2
            transition 2: 2 -> 1
        }";
    let rows = trace(text, &["Low"], &["", "", "halt", "halt", "", "", ""]);
    assert_eq!(rows, ["1", "2", "2", "2", "2", "1", "2"]);
}

#[test]
fn an_enclosed_graph_is_empty_until_its_enclosing_step_activates_it() {
    let text = "
        input a
        graph Top {
            initial step 1
            step 2 encloses Low{5}
            transition 1: 1 -> 2 when a
            transition 2: 2 -> 1 when NOT a
        }
        graph Low {
            initial step 4
            step 5
            transition 1: 5 -> 4
            transition 2: -> 5 when a
        }";
    let rows = trace(text, &["Top", "Low"], &["", "", "a", "a", "a", ""]);
    assert_eq!(rows, ["1.", "1.", "2.5", "2.4 5", "2.4 5", "1."]);
}

#[test]
fn a_stable_evolution_passes_through_and_executes_only_what_is_left() {
    let text = "
        evolution stable
        input a
        output M
        var n : int
        graph G {
            initial step 1
            step 2 { M; on activation: n = n + 1 }
            step 3
            transition 1: 1 -> 2 when ↑a
            transition 2: 2 -> 3 when X2
            transition 3: 3 -> 1 when ↑a
        }";
    let rows = trace(text, &["G", "M", "n"], &["", "a", "a", "", "a"]);
    assert_eq!(rows, ["1.0.0", "3.0.1", "3.0.1", "3.0.1", "1.0.1"]);
}

#[test]
fn a_ring_that_never_settles_is_unstable_until_it_does() {
    let text = "
        evolution stable
        input a
        output ALARM
        graph G {
            always { ALARM IF System:unstable }
            initial step 1
            step 2
            transition 1: 1 -> 2 when a
            transition 2: 2 -> 1 when a
        }";
    let rows = trace(text, &["G", "ALARM"], &["", "a", "a", ""]);
    assert_eq!(rows, ["1.0", "1.1", "1.1", "1.0"]);
}

#[test]
fn a_macro_step_is_entered_at_its_entry_and_left_from_its_exit() {
    let text = "
        input a
        output M
        graph G {
            always { M IF T/XM2/20ms AND XM2 }
            initial step 1
            macro step M2 {
                entry step E2
                step 7
                exit step S2
                transition 10: E2 -> 7
                transition 11: 7 -> S2
            }
            transition 1: 1 -> M2 when a
            transition 2: M2 -> 1 when NOT a
        }";
    let rows = trace(text, &["G", "M"], &["", "a", "a", "a", "a", "", ""]);
    assert_eq!(rows, ["1.0", "E2.0", "7.0", "S2.1", "S2.1", "1.0", "1.0"]);
}

#[test]
fn faults_saturate_and_are_counted_where_they_are_evaluated() {
    let text = "
        input a
        var n : int = 2147483647
        var q : int
        var faults : int
        var small : int in 0..3
        graph G {
            initial step 1 { n = n + 1 IF a; q = 7 / 0 IF a; small = small + 2 IF a }
            always { faults = System:arithmetic_faults }
        }";
    let rows = trace(text, &["n", "q", "small", "faults"], &["", "a", "a", ""]);
    assert_eq!(
        rows,
        [
            "2147483647.0.0.0",
            "2147483647.0.2.0",
            "2147483647.0.3.2",
            "2147483647.0.3.5"
        ]
    );
}

#[test]
fn an_instance_is_its_template_with_the_bindings_in_place() {
    let text = "
        input go
        output A
        graph Left = Cell { run = go AND NOT Right:X2; busy = A; delay = 10ms }
        graph Right = Cell { run = Left:X2; busy at %QX0.0 }
        template Cell {
            input run
            output busy
            parameter delay : time = 20ms
            initial step 1
            step 2 { busy }
            transition 1: 1 -> 2 when run
            transition 2: 2 -> 1 when T/X2/delay AND S(Cell) = {2}
        }";
    let columns = ["Left", "Right", "A", "Left:delay", "Right:delay"];
    let rows = trace(text, &columns, &["", "go", "go", "go", "go"]);
    let expected = [
        "1.1.0.10.20",
        "2.1.1.10.20",
        "1.2.0.10.20",
        "1.2.0.10.20",
        "1.1.0.10.20",
    ];
    assert_eq!(rows, expected);
}
