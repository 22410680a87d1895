//! Steps that stand in a sequence, and what is kept of them.

use grafcet_compiler::application::Tables;
use grafcet_core::program::{Course, Sequel};

use crate::{graph, tables};

/// What the only arm of a step says.
fn sequel(tables: &Tables, step: usize) -> Sequel {
    tables.arms[usize::from(tables.steps[step].first_arm)].sequel
}

#[test]
fn a_step_with_one_way_on_stands_in_a_sequence() {
    let tables = graph(
        "initial step 1; step 2 { M := a }; step 3\ntransition 1: 1 -> 2 when a; transition 2: 2 -> 3 when NOT a\n\
         transition 3: 3 -> 1 when T/X3/1s",
    );
    let course = |step| sequel(&tables, step).course;
    assert_eq!(course(0), Course::to(1, false));
    assert_eq!(course(1), Course::to(2, false));
    assert_eq!(course(2), Course::to(0, true));
    let next = (0..3).map(|step| sequel(&tables, step).next);
    let first = |step: usize| tables.steps[step].first_arm;
    assert!(next.eq([first(1), first(2), first(0)]));
}

#[test]
fn branches_and_joints_and_ends_stand_in_none() {
    let tables = graph(
        "initial step 1; step 2; step 3; step 4; step 5\ntransition 1: 1 -> 2 when a; transition 2: 1 -> 3 when NOT a\n\
         transition 3: 2 -> 3, 4; transition 4: 3, 4 -> 5; transition 5: 5 ->",
    );
    assert!(tables.arms.iter().all(|arm| arm.sequel == Sequel::NONE));
}

#[test]
fn nothing_follows_in_a_sequence_behind_its_last_step() {
    let tables =
        graph("initial step 1; step 2\ntransition 1: 1 -> 2 when a; transition 2: 2 -> when a");
    assert_eq!(sequel(&tables, 0).course, Course::to(1, false));
    assert_eq!(sequel(&tables, 0).next, Sequel::NO_NEXT);
    assert_eq!(sequel(&tables, 1), Sequel::NONE);
}

#[test]
fn a_sequence_of_many_steps_goes_on_within_each_word() {
    let steps: String = (2..=40).map(|step| format!("step {step}; ")).collect();
    let ways: String = (1..40)
        .map(|step| format!("transition {step}: {step} -> {} when a\n", step + 1))
        .collect();
    let tables = graph(&format!("initial step 1; {steps}\n{ways}"));
    assert_eq!(sequel(&tables, 30).course, Course::to(31, false));
    assert_eq!(sequel(&tables, 30).next, Sequel::NO_NEXT);
    assert_eq!(sequel(&tables, 31), Sequel::NONE);
    assert_eq!(sequel(&tables, 32).course, Course::to(1, false));
    assert_eq!(sequel(&tables, 32).next, tables.steps[33].first_arm);
}

#[test]
fn a_step_of_a_sequence_names_the_one_output_that_it_shows() {
    let source = |action: &str| {
        format!(
            "input a; output O; output P\ngraph G {{ initial step 1 {{ {action} }}; step 2\n\
             transition 1: 1 -> 2 when a; transition 2: 2 -> 1 when a }}"
        )
    };
    let shows = |action| sequel(&tables(&source(action)), 0).shows;
    assert_eq!(shows(""), Sequel::SHOWS_NOTHING);
    assert_eq!(shows("O"), 1);
    // Of one word they are one target.
    assert_eq!(shows("O, P"), 1);
    assert_eq!(shows("O IF a"), Sequel::SHOWS_MORE);
    assert_eq!(shows("O; P IF a"), Sequel::SHOWS_MORE);
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
