//! `semantics.md`, "Numbers": saturation, clamping, and the count of arithmetic faults.

use crate::run::{run, run_scans};

/// What a number is after it has been stored once, and how many faults that gave.
fn store(declaration: &str, value: &str) -> (String, String) {
    let program = format!(
        "var faults : int = 0
         {declaration}
         graph G {{ always {{ n = {value} IF System:first_scan; faults = System:arithmetic_faults }} }}"
    );
    let trace = run_scans(&program, 1);
    (trace.column("n"), trace.column("faults"))
}

fn of(value: &str) -> (String, String) {
    store(
        "var n : int = 0
         var big : int = 2147483647
         var small : int = -2147483648
         var seven : int = 7
         var two : int = 2
         var zero : int = 0",
        value,
    )
}

fn pair(value: &str, faults: &str) -> (String, String) {
    (value.to_owned(), faults.to_owned())
}

#[test]
fn arithmetic_saturates_and_counts() {
    assert_eq!(of("big + seven"), pair("2147483647", "1"));
    assert_eq!(of("small - seven"), pair("-2147483648", "1"));
    assert_eq!(of("big * two"), pair("2147483647", "1"));
    assert_eq!(of("small * two"), pair("-2147483648", "1"));
    assert_eq!(of("-small"), pair("2147483647", "1"));
    assert_eq!(of("small / -1"), pair("2147483647", "1"));
}

#[test]
fn division_by_zero_is_zero_and_counts() {
    assert_eq!(of("seven / zero"), pair("0", "1"));
    assert_eq!(of("seven MOD zero"), pair("0", "1"));
}

#[test]
fn division_truncates_and_the_remainder_has_the_sign_of_the_dividend() {
    assert_eq!(of("-seven / two"), pair("-3", "0"));
    assert_eq!(of("seven / -two"), pair("-3", "0"));
    assert_eq!(of("-seven MOD two"), pair("-1", "0"));
    assert_eq!(of("seven MOD -two"), pair("1", "0"));
    assert_eq!(of("small MOD -1"), pair("0", "0"));
}

#[test]
fn operators_bind_as_in_the_book() {
    assert_eq!(of("2 + 3 * 4 - 10 / 3 MOD 2"), pair("13", "0"));
    assert_eq!(of("(2 + 3) * 4"), pair("20", "0"));
    assert_eq!(of("16#FF + 2#1010 + 1_000"), pair("1265", "0"));
}

#[test]
fn a_stored_value_is_clamped_to_its_range_and_counted() {
    assert_eq!(
        store("var n : int = 5 in 0 .. 9\nvar ten : int = 10", "ten"),
        pair("9", "1")
    );
    assert_eq!(
        store("var n : int = 5 in 0 .. 9\nvar one : int = 1", "-one"),
        pair("0", "1")
    );
}

#[test]
fn times_are_milliseconds_and_scale() {
    assert_eq!(
        store("var n : time = 0s\nvar t : time = 1.5 s", "t * 2 + 10ms"),
        pair("3010", "0")
    );
    assert_eq!(
        store("var n : time = 0s\nvar t : time = 1.5 s", "t / 4 - 1s"),
        pair("-625", "0")
    );
}

#[test]
fn both_sides_of_an_operator_are_evaluated() {
    let program = "
        input a
        output P
        var faults : int = 0
        var zero : int = 0
        graph G {
            always { faults = System:arithmetic_faults; P IF a AND 1 / zero > 0 }
            always { zero = 0 }
        }
    ";
    assert_eq!(run(program, &[("a", "0 0 0")]).column("faults"), "0,1,2");
}

#[test]
fn a_trigger_counts_only_while_its_transition_is_armed() {
    let program = "
        input go
        var faults : int = 0
        var zero : int = 0
        graph G {
            always { faults = System:arithmetic_faults; zero = 0 }
            initial step 1
            step 2
            step 3
            transition 1: 1 -> 2 when go
            transition 2: 2 -> 3 when 1 / zero > 0
        }
    ";
    let trace = run(program, &[("go", "0 0 1 0 0")]);
    assert_eq!(trace.column("G"), "1,1,2,2,2");
    assert_eq!(trace.column("faults"), "0,0,0,1,2");
}

#[test]
fn the_operand_of_an_edge_counts_in_every_scan() {
    let program = "
        var faults : int = 0
        var zero : int = 0
        graph G {
            always { faults = System:arithmetic_faults; zero = 0 }
            initial step 1
            step 2
            step 3
            transition 1: 1 -> 2 when False AND X3
            transition 2: 2 -> 3 when ↑(1 / zero > 0)
        }
    ";
    assert_eq!(run_scans(program, 4).column("faults"), "1,2,3,4");
}

#[test]
fn a_value_counts_only_when_it_is_stored_and_a_condition_once_for_all_its_variables() {
    let program = "
        input a
        output P, Q
        var faults : int = 0
        var zero : int = 0
        var n : int = 0
        graph G {
            always {
                faults = System:arithmetic_faults
                zero = 0
                n = 1 / zero IF a
                P, Q IF 1 / zero = 0
            }
        }
    ";
    let trace = run(program, &[("a", "0 0 1 1")]);
    assert_eq!(trace.column("faults"), "0,1,2,4");
    assert_eq!(trace.column("P"), "1,1,1,1");
    assert_eq!(trace.column("Q"), "1,1,1,1");
}

#[test]
fn an_input_outside_its_range_is_clamped_and_counted_when_it_goes_out() {
    let program = "
        input level : int at %IW0 in 0 .. 100
        var n : int = 0
        var faults : int = 0
        graph G { always { n = level; faults = System:arithmetic_faults } }
    ";
    let trace = run(program, &[("level", "50 101 500 -1 50 -7")]);
    assert_eq!(trace.column("n"), "50,100,100,0,50,0");
    assert_eq!(trace.column("faults"), "0,1,1,1,1,2");
}

#[test]
fn a_parameter_outside_its_range_is_clamped_and_counted_once() {
    let program = "
        parameter p : int = 5 in 0 .. 9
        var faults : int = 0
        graph G { always { faults = System:arithmetic_faults + p - p } }
    ";
    let trace = run(program, &[("p", "5 12 12 12 3 -1")]);
    assert_eq!(trace.column("p"), "5,9,9,9,3,0");
    assert_eq!(trace.column("faults"), "0,1,1,1,1,2");
}

#[test]
fn a_fault_does_not_stop_the_scan() {
    let program = "
        output P
        var n : int = 0
        var zero : int = 0
        graph G {
            initial step 1
            step 2 { P }
            always { n = n / zero; zero = 0 }
            transition 1: 1 -> 2 when 1 MOD zero = 0
        }
    ";
    assert_eq!(run_scans(program, 2).column("P"), "0,1");
}
