//! The worked traces of `semantics.md`.

use crate::run::{run, run_scans};

#[test]
fn a_to_b_and_back_after_20_ms() {
    let program = "
        input a
        output M
        graph G {
            initial step 1
            step 2 { M }
            transition 1: 1 -> 2 when ↑a
            transition 2: 2 -> 1 when T/X2/20ms
        }
    ";
    let trace = run(program, &[("a", "1 1 0 1 1 0")]);
    assert_eq!(trace.column("time_ms"), "0,10,20,30,40,50");
    assert_eq!(trace.column("G"), "1,1,1,2,2,1");
    assert_eq!(trace.column("M"), "0,0,0,1,1,0");
}

#[test]
fn an_always_true_chain_moves_one_step_a_scan() {
    let program = "
        graph G {
            initial step 1
            step 2
            step 3
            transition 1: 1 -> 2 when True
            transition 2: 2 -> 3 when True
            transition 3: 3 -> 1 when True
        }
    ";
    assert_eq!(run_scans(program, 6).column("G"), "1,2,3,1,2,3");
}

#[test]
fn a_self_loop_keeps_the_token_and_its_time() {
    let program = "
        input go, a
        graph G {
            var n : int = 0
            initial step 1
            step 2 { on activation: n = n + 1 }
            transition 1: 1 -> 2 when go
            transition 2: 2 -> 2 when a
            transition 3: 2 -> 1 when T/X2/50ms
        }
    ";
    let trace = run(program, &[("go", "0 1 0 0 0 0 0"), ("a", "0 0 1 1 1 0 0")]);
    assert_eq!(trace.column("G"), "1,2,2,2,2,2,1");
    assert_eq!(trace.column("G:n"), "0,1,1,1,1,1,1");
}
