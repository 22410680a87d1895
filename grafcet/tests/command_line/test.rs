//! `grafcet test`.

use std::fs;

use crate::desk::desk;

#[test]
fn tests_are_reported_like_cargos() {
    let desk = desk();
    let said = desk.grafcet(&["test", "drill.grafcet"]);
    assert_eq!(said.code, Some(1), "{said:?}");
    assert!(said.out.starts_with("running 2 tests\n"), "{said:?}");
    assert!(
        said.out
            .contains("test drill.grafcet: it spins and stops ... ok\n"),
        "{said:?}"
    );
    assert!(
        said.out
            .contains("test drill.grafcet: it never spins ... FAILED\n"),
        "{said:?}"
    );
    assert!(
        said.out.contains("error[never]: this holds at 10 ms"),
        "{said:?}"
    );
    assert!(said.out.contains("drill.grafcet:24:"), "the line: {said:?}");
    assert!(
        said.out.contains("at 10 ms: SPIN = 1\n"),
        "the values: {said:?}"
    );
    assert!(
        said.out
            .contains("time_ms  Drill  SPIN\n0        1      0\n10       2      1\n"),
        "{said:?}"
    );
    assert!(said.out.ends_with("\n1 passed, 1 failed\n"), "{said:?}");
}

#[test]
fn of_many_graphs_a_failure_shows_those_that_moved_and_those_asked_for() {
    let desk = desk();
    let graph = |name: &str| {
        format!(
            "graph {name} {{\n initial step 1\n step 2\n transition 1: 1 -> 2 when go{name}\n}}\n"
        )
    };
    let names = ["A", "B", "C", "D"];
    let inputs: String = names.map(|name| format!("input go{name}\n")).concat();
    let graphs = names.map(graph).concat();
    let test = "test \"d\" {\n set goA\n wait 1 scans\n expect S(D) = {2}\n}\n";
    let program = format!("application many\n{inputs}{graphs}{test}");
    fs::write(desk.path("many.grafcet"), program).unwrap();
    let said = desk.grafcet(&["test", "many.grafcet"]);
    assert!(
        said.out
            .contains("time_ms  A  D\n0        1  1\n10       2  1\n"),
        "{said:?}"
    );
}

#[test]
fn a_filter_chooses_tests_by_their_names() {
    let desk = desk();
    let said = desk.grafcet(&["test", "drill.grafcet", "spins and"]);
    assert_eq!(said.code, Some(0), "{said:?}");
    assert!(
        said.out.ends_with("\n1 passed, 0 failed, 1 filtered out\n"),
        "{said:?}"
    );
}

#[test]
fn a_test_leaves_its_trace_where_it_is_told_to() {
    let desk = desk();
    let said = desk.grafcet(&["test", "drill.grafcet", "stops", "--trace", "traces"]);
    assert_eq!(said.code, Some(0), "{said:?}");
    let trace = fs::read_to_string(desk.path("traces/drill.01.it_spins_and_stops.csv")).unwrap();
    let expected = "\
time_ms,Drill,SPIN,RAISE,TALL,delay,high
0,1,0,1,0,20,0
10,2,1,0,0,20,0
20,2,1,0,0,20,0
30,1,0,1,0,20,0
";
    assert_eq!(trace, expected);
}
