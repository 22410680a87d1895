//! How many rounds programs take that evolve `stable`: `grafcet bound` states how many at most, and the comparison fails
//! when a scan takes more.

use std::fmt::Write;

use crate::large::tally;
use crate::random::Random;

const PROGRAMS: u64 = 500;
const SCANS: usize = 150;

#[test]
fn no_scan_takes_more_rounds_than_are_stated_as_the_most() {
    let tally = tally(PROGRAMS, SCANS, program);
    assert!(tally.settles * 5 > tally.programs * 2, "{tally:?}");
    assert!(tally.longest * 4 > tally.settles, "{tally:?}");
    assert!(tally.forced > tally.programs, "{tally:?}");
}

/// A sequence with a way past some of its steps or a parallel branch, often with one beside it that forces or encloses it.
fn program(random: &mut Random) -> String {
    let mut text = "evolution stable\ninput a; input b; input c; input d\noutput Q\n".to_owned();
    let mut initial = "initial ";
    if random.chance(60) {
        let main = random.word(&["is forced", "is forced", "is enclosed", "stands beside it"]);
        if main == "is enclosed" {
            initial = "";
        }
        superior(random, &mut text, main);
    }
    let steps = random.between(3, 6);
    let _ = writeln!(text, "graph Main {{\n{initial}step 1 {{ Q }}");
    for step in 2..=steps {
        let _ = writeln!(text, "step {step}");
    }
    for step in 1..=steps {
        let trigger = trigger(random, step);
        let next = step % steps + 1;
        let _ = writeln!(text, "transition {step}: {step} -> {next} when {trigger}");
    }
    let more = steps + 1;
    match random.below(4) {
        0 => {
            let (from, to) = (random.between(1, steps), random.between(1, steps));
            let trigger = trigger(random, from);
            let _ = writeln!(text, "transition {more}: {from} -> {to} when {trigger}");
        }
        1 => {
            let trigger = trigger(random, 3);
            let _ = writeln!(text, "transition {more}: 2, 3 -> 1 when {trigger}");
        }
        _ => {}
    }
    text.push_str("}\n");
    text
}

/// Three steps in a ring.
fn superior(random: &mut Random, text: &mut String, main: &str) {
    let set = random.word(&["{}", "{I}", "{2}", "{*}", "{1, 3}"]);
    let condition = random.word(&["", "", " IF d", " IF NOT d", " IF ↑c"]);
    let order = match main {
        "is forced" => format!("F/Main:{set}{condition}"),
        _ => String::new(),
    };
    let encloses = match main {
        "is enclosed" => " encloses Main{1}",
        _ => "",
    };
    text.push_str("graph Superior {\n");
    let _ = match random.chance(30) {
        true => writeln!(text, "always {{ {order} }}\nstep 2"),
        false => writeln!(text, "step 2 {{ {order} }}"),
    };
    let _ = writeln!(text, "initial step 1\nstep 3{encloses}");
    for (from, to) in [(1, 2), (2, 3), (3, 1)] {
        let trigger = trigger(random, from);
        let _ = writeln!(text, "transition {from}: {from} -> {to} when {trigger}");
    }
    text.push_str("}\n");
}

fn trigger(random: &mut Random, step: usize) -> String {
    let inputs = ["a", "a", "b", "b", "c", "NOT a", "NOT b", "NOT d"];
    let (one, other) = (random.word(&inputs), random.word(&inputs));
    match random.below(16) {
        0 => format!("↑{}", one.replace("NOT ", "")),
        1 => format!("T/X{step}/30ms"),
        2 => format!("{one} AND T/X{step}/20ms"),
        3 => format!("({one} OR ↑d) AND NOT (c AND d)"),
        4 => format!("{one} XOR b"),
        5 | 6 => format!("{one} AND {other}"),
        7 => format!("{one} AND X1"),
        _ => one.to_owned(),
    }
}
