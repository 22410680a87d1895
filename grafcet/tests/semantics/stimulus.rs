//! `semantics.md`, "The trace": the two tables, their columns and their rows.

use crate::run::run_csv;

const PROGRAM: &str = "
    input a, b
    input n : int
    output A
    var k : int = 0
    graph G {
        input start
        input level : int
        initial step 1
        step 2
        transition 1: 1 -> 2 when start
        always { A IF a AND b; k = n + level }
    }
";

#[track_caller]
fn outputs(stimulus: &str) -> String {
    run_csv(PROGRAM, stimulus, &[], None).column("A")
}

#[test]
fn rows_between_two_scans_are_merged_and_hold_from_the_next_scan_on() {
    let stimulus = "time_ms,a,b\n1,1,\n2,,1\n9,0,\n10,1,\n15,,0\n17,1,1\n19,,0\n30,,\n";
    assert_eq!(outputs(stimulus), "0,1,0,0");
    assert_eq!(
        outputs("time_ms,a,b\n10,1,0\n10,0,1\n10,1,\n"),
        "0,1",
        "at one time too"
    );
}

#[test]
fn a_trace_ends_with_the_last_scan_before_or_at_the_last_row() {
    assert_eq!(outputs("time_ms,a,b\n0,1,1\n15,0,0\n"), "1,1");
    assert_eq!(outputs("time_ms,a,b\n"), "0", "scan 0 alone");
    let trace = run_csv(
        "scan 25 ms\ngraph G { initial step 1 }",
        "time_ms\n99\n",
        &[],
        None,
    );
    assert_eq!(trace.column("time_ms"), "0,25,50,75");
}

#[test]
fn until_goes_before_the_last_row() {
    let stimulus = "time_ms,a,b\n0,1,1\n20,0,0\n";
    let until = |ms| run_csv(PROGRAM, stimulus, &[], Some(ms)).column("A");
    assert_eq!(until(19), "1,1");
    assert_eq!(until(40), "1,1,0,0,0");
}

#[test]
fn before_the_first_row_inputs_are_off_and_parameters_as_declared() {
    let program = "
        input a
        output A
        parameter p : int = 1
        parameter d : time = 1s
        parameter q
        graph G { always { A IF NOT a AND d > 0s AND (q OR p > 0) } }
    ";
    let trace = run_csv(program, "time_ms,a,p,d,q\n20,1,5,-20,1\n", &[], None);
    assert_eq!(trace.column("A"), "1,1,0");
    assert_eq!(trace.column("p"), "1,1,5");
    assert_eq!(trace.column("d"), "1000,1000,-20");
    assert_eq!(trace.column("q"), "0,0,1");
}

#[test]
fn a_stimulus_may_come_from_any_spreadsheet() {
    for stimulus in [
        "\u{feff}time_ms,a,b\r\n0,1,1\r\n10,0,\r\n",
        "\"time_ms\",\"a\",\"b\"\n\"0\",\"1\",\"1\"\n10,\"0\",\"\"\n",
        "time_ms,a,b\n\n0,1,1\n\n10,0,\n\n",
        "time_ms,a,b\n0,1,1\n10,0,",
        "time_ms, a , b\n0, 1, 1\n10 ,0 , \n",
        "time_ms,b,a\n0,1,1\n10,,0\n",
    ] {
        assert_eq!(outputs(stimulus), "1,0", "{stimulus:?}");
    }
}

#[test]
fn inputs_of_a_graph_are_called_by_both_names() {
    let stimulus = "time_ms,G:start,G:level,n\n0,,5,-7\n10,1,,+3\n";
    let trace = run_csv(PROGRAM, stimulus, &[], None);
    assert_eq!(trace.column("G"), "1,2");
    assert_eq!(trace.column("k"), "-2,8");
}

#[test]
fn a_name_may_be_written_in_either_unicode_form() {
    let program = "input température : int\noutput Ä\ngraph G { always { Ä IF température > 3 } }";
    let trace = run_csv(program, "time_ms,tempe\u{301}rature\n0,4\n", &[], None);
    assert_eq!(trace.column("Ä"), "1");
}

#[test]
fn columns_go_by_kind_then_globals_then_graphs_and_bound_names_have_none() {
    let program = "
        parameter first : int = 1
        output Z
        graph Late {
            output o
            var v : int
            parameter delay : time = 2s
            const c : int = 1
            initial step 1
            always { o IF X1; v = c; Z IF delay > 1s AND first > 0 AND bound AND last }
        }
        var bound : bool
        template T {
            input i
            output terminal, stored
            output direct at %QX7.7
            parameter p : int = 4
            var own
            initial step 1
            always { terminal IF i; stored IF i; own IF i; direct IF p > 3 AND own }
        }
        graph Instance = T { i at %IX0.0; terminal at %QX0.1; stored = bound }
        output Y at %QX1.0
        graph Last { initial step 1; parameter r; always { Y IF r } }
        parameter last = TRUE
        plant P { var v : int; initial step 1 }
    ";
    let trace = run_csv(program, "time_ms,Instance:i\n0,1\n", &[], None);
    assert_eq!(
        trace.header(),
        "time_ms,Late,Instance,Last,Z,Y,Late:o,Instance:direct,\
         first,bound,last,Late:v,Late:delay,Instance:p,Instance:own,Last:r"
    );
    assert_eq!(trace.column("bound"), "1");
}

#[test]
fn a_situation_names_its_steps_in_source_order_and_no_macro_step() {
    let program = "
        graph G {
            initial step 9
            step 1
            macro step M4 {
                entry step E4
                exit step S4
                transition 1: E4 -> S4
            }
            step 3
            transition 2: 9 -> 9, 3, M4, 1
        }
        graph Empty { step 1 }
    ";
    let trace = run_csv(program, "time_ms\n20\n", &[], None);
    assert_eq!(trace.column("G"), "9,9 1 E4 3,9 1 E4 S4 3");
    assert_eq!(trace.column("Empty"), ",,");
}
