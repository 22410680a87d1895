//! Large graphs and many sequences, which the random programs seldom have.

use std::fmt::Write;

use crate::compare::{Trees, compare};
use crate::outcome::Tally;
use crate::random::Random;
use crate::render::Text;
use crate::stimulus::stimulus;

/// Steps of each graph: those of more than two words.
const STEPS: usize = 70;

#[test]
fn steps_of_a_long_sequence_are_read_by_others_of_it_as_they_were_before_the_scan() {
    let fired = tally(20, 300, program).fired;
    assert!(fired > 500, "{fired} transitions fire");
}

#[test]
fn many_sequences_wait_and_go_on_and_show_what_they_do() {
    let fired = tally(60, 200, sequences).fired;
    assert!(fired > 5000, "{fired} transitions fire");
}

/// What is seen of so many programs, which the engines and the reference must run alike for so many scans.
pub fn tally(programs: u64, scans: usize, program: impl Fn(&mut Random) -> String) -> Tally {
    let mut tally = Tally::default();
    for seed in 0..programs {
        let mut random = Random::new(seed);
        let text = Text {
            main: program(&mut random),
            library: None,
        };
        let stimulus = stimulus(&mut random, &Trees::of(&text).program(), scans);
        match compare(&text, &stimulus) {
            Ok(seen) => tally.add(seen),
            Err(failure) => panic!("seed {seed}: {failure}\n{}", text.main),
        }
    }
    tally
}

/// Up to sixty graphs, most of them sequences, some asleep. Nothing asks which transitions have fired; some programs read
/// steps of later graphs, some of earlier ones, some have timers or conditional actions, some more outputs than a word.
fn sequences(random: &mut Random) -> String {
    let outputs = *random.pick(&[3, 40]);
    let graphs = *random.pick(&[3, 17, 60]);
    let kinds = *random.pick(&[1, 2, 4, 5, 6]);
    let mut text = "input a; input b; input c\n".to_owned();
    for output in 0..outputs {
        let _ = writeln!(text, "output O{output}");
    }
    for graph in 0..graphs {
        let _ = writeln!(text, "graph G{graph} {{");
        let steps = *random.pick(&[1, 2, 3, 9, 40]);
        let sleeps = random.chance(30);
        for step in 1..=steps {
            let initial = if step == 1 && !sleeps { "initial " } else { "" };
            let condition = if kinds == 6 && random.chance(20) {
                " IF c"
            } else {
                ""
            };
            let shows = match random.chance(40) {
                true => format!(" {{ O{}{condition} }}", random.pick(&[0, 1, outputs - 1])),
                false => String::new(),
            };
            let _ = writeln!(text, "{initial}step {step}{shows}");
        }
        for step in 1..=steps {
            let trigger = trigger(random, kinds, graph, graphs, step);
            let next = match random.chance(4) {
                true => String::new(),
                false => (step % steps + 1).to_string(),
            };
            let _ = writeln!(text, "transition {step}: {step} -> {next} when {trigger}");
        }
        // A branch of some steps, which then stand in no sequence.
        if steps > 2 && random.chance(20) {
            let _ = writeln!(text, "transition {}: 1 -> 2, 3 when NOT c", steps + 1);
        }
        text.push_str("}\n");
    }
    text
}

/// A trigger of one of so many kinds, those with more to ask for behind those with less.
fn trigger(random: &mut Random, kinds: usize, graph: usize, graphs: usize, step: usize) -> String {
    let input = random.word(&["a", "b", "c", "NOT a", "NOT b"]);
    let several = [
        "a AND b",
        "a AND NOT b AND c",
        "NOT a AND NOT b",
        "b AND NOT c",
    ];
    let kind = *random.pick(&[0, 1, 1, 2, 3, 4, 5]);
    match kind.min(kinds - 1) {
        0 => input.to_owned(),
        1 => random.word(&several).to_owned(),
        2 if graph + 1 < graphs => format!("{input} AND NOT G{}:X1", graph + 1),
        2 => input.to_owned(),
        3 => format!("{input} AND (b OR NOT c)"),
        4 if random.chance(50) => format!("T/X{step}/20ms"),
        4 => format!("a AND T/X{step}/30ms"),
        _ => format!("{input} AND NOT G{}:X1", graph / 2),
    }
}

/// Two graphs that go round, each with three active steps. Some of their triggers read steps of the same graph.
fn program(random: &mut Random) -> String {
    let mut text = "input a; input b; output O\n".to_owned();
    for graph in ["G", "H"] {
        let _ = writeln!(text, "graph {graph} {{");
        for step in 1..=STEPS {
            let initial = if step % 30 == 1 && step < 62 {
                "initial "
            } else {
                ""
            };
            let shows = if random.chance(20) { " { O }" } else { "" };
            let _ = writeln!(text, "{initial}step {step}{shows}");
        }
        for step in 1..=STEPS {
            let other = random.pick(&[1, 2, 31, 32, 33, 34, 64, 65]);
            let input = random.pick(&["a", "b", "NOT a"]);
            let reads = match random.chance(15) {
                true => format!(" AND NOT X{other}"),
                false => String::new(),
            };
            let next = step % STEPS + 1;
            let _ = writeln!(
                text,
                "transition {step}: {step} -> {next} when {input}{reads}"
            );
        }
        text.push_str("}\n");
    }
    text
}
