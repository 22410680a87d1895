//! Large graphs of sequences, which the random programs seldom have.

use std::fmt::Write;

use crate::compare::{Trees, compare};

use crate::random::Random;
use crate::render::Text;
use crate::stimulus::stimulus;

/// Steps of each graph: those of more than two words.
const STEPS: usize = 70;

#[test]
fn steps_of_a_long_sequence_are_read_by_others_of_it_as_they_were_before_the_scan() {
    let mut fired = 0;
    for seed in 0..20 {
        let mut random = Random::new(seed);
        let text = Text {
            main: program(&mut random),
            library: None,
        };
        let stimulus = stimulus(&mut random, &Trees::of(&text).program(), 300);
        match compare(&text, &stimulus) {
            Ok(tally) => fired += tally.fired,
            Err(failure) => panic!("seed {seed}: {failure}\n{}", text.main),
        }
    }
    assert!(fired > 500, "{fired} transitions fire");
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
