//! `grafcet bound`.

use crate::desk::{Desk, Said, desk};

const STABLE: &str = "\
evolution stable
input a
output Q
graph Ring {
    initial step 1
    step 2 { Q }
    transition 1: 1 -> 2 when a
    transition 2: 2 -> 1 when TRIGGER
}
";

fn bound(said: &Said) -> serde_json::Value {
    assert_eq!(said.code, Some(0), "{said:?}");
    serde_json::from_str(&said.out).unwrap()
}

/// That there are lines that begin like this.
fn has_lines(said: &Said, lines: &[&str]) {
    for line in lines {
        let found = said.out.lines().any(|said| said.starts_with(line));
        assert!(found, "{line}: {said:?}");
    }
}

#[test]
fn a_bound_is_stated_for_each_processor_with_what_it_is_made_of() {
    let said = desk().grafcet(&["bound", "drill.grafcet"]);
    assert_eq!((said.code, said.err.as_str()), (Some(0), ""), "{said:?}");
    has_lines(
        &said,
        &[
            "Cortex-M0+  ",
            "Cortex-M4   ",
            "whatever is active",
            "Drill in step ",
        ],
    );
    assert!(!said.out.contains('\u{1b}'), "no colours: {said:?}");
}

#[test]
fn json_gives_instructions_and_time_at_the_clock() {
    let desk = desk();
    let slow = bound(&desk.grafcet(&[
        "bound",
        "--format",
        "json",
        "--m4-mhz",
        "1",
        "drill.grafcet",
    ]));
    for cpu in ["m0plus", "m4"] {
        let instructions = slow[cpu]["instructions"].as_u64().unwrap();
        let shares = slow[cpu]["shares"].as_array().unwrap().iter();
        let shares: u64 = shares
            .map(|share| share["instructions"].as_u64().unwrap())
            .sum();
        // Each share is rounded up.
        assert!(
            instructions <= shares && shares < instructions + 3,
            "{slow}"
        );
    }
    // Two cycles an instruction.
    let instructions = slow["m4"]["instructions"].as_u64().unwrap();
    assert_eq!(slow["m4"]["microseconds"], 2 * instructions);
    assert_eq!(slow["m0plus"]["mhz"], 125);
}

#[test]
fn more_work_has_a_higher_bound() {
    let program = |actions: &str| {
        format!(
            "input a\noutput P, Q\nvar n : int = 0\ngraph G {{\n initial step 1 {{ P }}\n step 2 {{ {actions} }}\n transition 1: 1 -> 2 when a\n transition 2: 2 -> 1 when NOT a\n}}\n"
        )
    };
    let desk = Desk::with(&[
        ("less.grafcet", &program("Q")),
        ("more.grafcet", &program("Q; n = (n + 1) MOD 7")),
    ]);
    let instructions = |file: &str| {
        let said = desk.grafcet(&["bound", "--format", "json", file]);
        bound(&said)["m4"]["instructions"].as_u64().unwrap()
    };
    assert!(instructions("more.grafcet") > instructions("less.grafcet"));
}

#[test]
fn the_rounds_of_a_program_that_evolves_stable_are_named() {
    let desk = Desk::with(&[
        ("settles.grafcet", &STABLE.replace("TRIGGER", "↑a")),
        ("races.grafcet", &STABLE.replace("TRIGGER", "a")),
    ]);
    let said = desk.grafcet(&["bound", "settles.grafcet"]);
    has_lines(
        &said,
        &[
            "The program evolves stable: 3 rounds at most",
            "a round behind the first ",
            "all firings in those ",
            "behind the last round ",
        ],
    );
    let settles = bound(&desk.grafcet(&["bound", "--format", "json", "settles.grafcet"]));
    let of = |name: &str| settles["m4"][name].as_u64().unwrap();
    assert!(of("a_later_round") <= of("a_round"), "{settles}");
    assert!(of("instructions") < 9 * of("a_round"), "{settles}");
    let said = desk.grafcet(&["bound", "races.grafcet"]);
    assert!(said.out.contains("before the 100 rounds"), "{said:?}");
    let races = bound(&desk.grafcet(&["bound", "--format", "json", "races.grafcet"]));
    let of = |name: &str| races["m4"][name].as_u64().unwrap();
    assert!(of("instructions") > 99 * of("a_round"), "{races}");
}

#[test]
fn help_says_what_a_bound_does_not_cover() {
    let said = desk().grafcet(&["bound", "--help"]);
    assert_eq!(said.code, Some(0));
    for word in ["interrupts", "pins", "log", "flash", "Exit codes"] {
        assert!(said.out.contains(word), "{word}: {said:?}");
    }
}
