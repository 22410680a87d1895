//! Steps that stand in a sequence, and what is kept of them.

use grafcet_compiler::application::Tables;
use grafcet_core::program::{Arm, Armed, Course, Masks};

use crate::{graph, tables};

/// The only arm of a step.
fn only_arm(tables: &Tables, step: usize) -> Arm {
    tables.arms[usize::from(tables.steps[step].first_arm)]
}

/// What is armed while a step is the only active one.
fn armed(tables: &Tables, step: usize) -> Armed {
    let row = tables.steps[step].first_arm;
    let transition = &tables.transitions[usize::from(only_arm(tables, step).transition)];
    let first = &tables.terms[usize::from(transition.term)];
    Armed::by(row, first, transition.fires > 0)
}

/// To a bit of the word, behind which the same is shown.
fn to(bit: u8) -> Course {
    Course::to(bit, false)
}

#[test]
fn a_step_with_one_way_on_stands_in_a_sequence() {
    let tables = graph(
        "initial step 1; step 2 { M := a }; step 3\ntransition 1: 1 -> 2 when a; transition 2: 2 -> 3 when NOT a\n\
         transition 3: 3 -> 1 when T/X3/1s",
    );
    let arm = |step| only_arm(&tables, step);
    assert_eq!([0, 1, 2].map(|step| arm(step).course), [1, 2, 0].map(to));
    let next = [1, 2, 0].map(|step| armed(&tables, step));
    assert_eq!([0, 1, 2].map(|step| arm(step).next), next);
}

#[test]
fn branches_and_joints_and_ends_stand_in_none() {
    let tables = graph(
        "initial step 1; step 2; step 3; step 4; step 5\ntransition 1: 1 -> 2 when a; transition 2: 1 -> 3 when NOT a\n\
         transition 3: 2 -> 3, 4; transition 4: 3, 4 -> 5; transition 5: 5 ->",
    );
    assert!(
        tables
            .arms
            .iter()
            .all(|arm| *arm == Arm::alone(arm.transition))
    );
}

#[test]
fn nothing_follows_in_a_sequence_behind_its_last_step() {
    let tables =
        graph("initial step 1; step 2\ntransition 1: 1 -> 2 when a; transition 2: 2 -> when a");
    assert_eq!(only_arm(&tables, 0).course, to(1));
    assert_eq!(only_arm(&tables, 0).next, Armed::UNKNOWN);
    assert_eq!(only_arm(&tables, 1), Arm::alone(1));
}

#[test]
fn a_sequence_of_many_steps_goes_on_within_each_word() {
    let steps: String = (2..=40).map(|step| format!("step {step}; ")).collect();
    let ways: String = (1..40)
        .map(|step| format!("transition {step}: {step} -> {} when a\n", step + 1))
        .collect();
    let tables = graph(&format!("initial step 1; {steps}\n{ways}"));
    assert_eq!(only_arm(&tables, 30).course, to(31));
    assert_eq!(only_arm(&tables, 30).next, Armed::UNKNOWN);
    assert_eq!(only_arm(&tables, 31), Arm::alone(31));
    assert_eq!(only_arm(&tables, 32).course, to(1));
    assert_eq!(only_arm(&tables, 32).next, armed(&tables, 33));
}

#[test]
fn a_step_of_a_sequence_names_the_one_output_that_it_shows() {
    let source = |action: &str| {
        format!(
            "input a; output O; output P\ngraph G {{ initial step 1 {{ {action} }}; step 2\n\
             transition 1: 1 -> 2 when a; transition 2: 2 -> 1 when a }}"
        )
    };
    let shows = |action| only_arm(&tables(&source(action)), 0).shows;
    assert_eq!(shows(""), Arm::SHOWS_NOTHING);
    assert_eq!(shows("O"), 1);
    // Of one word they are one target.
    assert_eq!(shows("O, P"), 1);
    assert_eq!(shows("O IF a"), Arm::SHOWS_MORE);
    assert_eq!(shows("O; P IF a"), Arm::SHOWS_MORE);
}

#[test]
fn a_step_of_a_sequence_says_whether_the_next_one_shows_something_else() {
    let source = |one: &str, other: &str| {
        format!(
            "input a; output O; output P\ngraph G {{ initial step 1 {{ {one} }}; step 2 {{ {other} }}\n\
             transition 1: 1 -> 2 when a; transition 2: 2 -> 1 when a }}"
        )
    };
    let course = |one, other| only_arm(&tables(&source(one, other)), 0).course;
    assert_eq!(course("", ""), Course::to(1, false));
    assert_eq!(course("O", "O"), Course::to(1, false));
    assert_eq!(course("O", "P"), Course::to(1, true));
    assert_eq!(course("", "P"), Course::to(1, true));
    assert_eq!(course("O IF a", "O IF a"), Course::to(1, true));
}

#[test]
fn a_large_program_knows_which_groups_of_its_words_do_anything() {
    let sequence = |number: usize| {
        let action = if number % 16 == 3 { "{ O }" } else { "" };
        format!("graph G{number} {{ initial step 1 {action}; transition 1: 1 -> 1 when a }}\n")
    };
    let graphs: String = (0..1000).map(sequence).collect();
    let tables = tables(&format!("input a; output O\n{graphs}"));
    // Every other group of eight words has a graph that acts, and 256 words share a row.
    let momentary: Vec<u32> = tables.actors.iter().map(|row| row.momentary).collect();
    assert_eq!(
        momentary,
        [0x5555_5555, 0x5555_5555, 0x5555_5555, 0x1555_5555]
    );
    assert!(tables.actors.iter().all(|row| row.masks == Masks::NONE));
}

#[test]
fn what_is_armed_is_kept_of_large_programs_only() {
    assert_eq!(tables(&graphs(2)).layout.armed, 0);
    assert_eq!(tables(&graphs(1000)).layout.armed, 1000);
}

/// So many graphs.
fn graphs(count: usize) -> String {
    let graph = |number| format!("graph G{number} {{ initial step 1; transition 1: 1 -> 1 }}\n");
    (0..count).map(graph).collect()
}
