//! Rows that are asked for again are there once.

use grafcet_core::Engine;
use grafcet_core::program::{Condition, Crossing, Run, Target};
use grafcet_core::vectors::Vectors;

use crate::{graph, tables};

#[test]
fn equal_conditions_share_their_rows() {
    let tables = graph(
        "initial step 1 { M IF a AND b; N IF b AND a; O IF a OR b }\n\
         transition 1: 1 -> 1 when a AND b\ntransition 2: 1 -> 1 when a OR b",
    );
    // `a AND b`, and what always holds.
    assert_eq!(tables.terms.len(), 2);
    assert_eq!(tables.conditions.len(), 3);
    assert_eq!((tables.codes.len(), tables.ops.len()), (1, 3));
    assert_eq!(tables.momentary[0].condition, tables.momentary[1].condition);
    assert_eq!(tables.momentary[2].condition, tables.transitions[1].fires);
}

#[test]
fn the_first_term_of_a_transition_is_named_by_it_alone() {
    let tables = graph("initial step 1\ntransition 1: 1 -> 1 when a AND NOT b");
    assert_eq!(tables.terms.len(), 1);
    assert_eq!(tables.conditions, [Condition::ALWAYS]);
    let tables =
        graph("initial step 1\ntransition 1: 1 -> 1 when a AND NOT b AND NOT System:unstable");
    let behind = Run { start: 0, len: 1 };
    assert_eq!(tables.terms.len(), 2);
    assert_eq!(tables.conditions[1].terms, behind);
    assert_eq!(tables.transitions[0].term, 1);
}

#[test]
fn equal_timers_of_a_step_are_one_row() {
    let tables = graph(
        "initial step 1 { M IF T/X1/2s; N IF NOT T/X1/2s; O IF T/X1/2s OR a }\n\
         transition 1: 1 -> 1 when T/X1/2s\ntransition 2: 1 -> 1 when T/X1/2 AND a\n\
         transition 3: 1 -> 1 when T/X1/3s",
    );
    assert_eq!(tables.timers.len(), 2);
}

#[test]
fn variables_that_become_true_together_share_rows() {
    let tables = graph(
        "initial step 1 { M, N }; step 2 { N, M IF a }; step 3 { M }\n\
         transition 1: 1 -> 2 when a; transition 2: 2 -> 3 when a",
    );
    let [both, one] = [0b11, 0b01].map(|mask| Target {
        word: tables.layout.momentary.start,
        mask,
    });
    assert_eq!(tables.targets, [both, one]);
    assert_eq!(tables.momentary[0].targets, tables.momentary[1].targets);
}

#[test]
fn variables_in_two_words_are_two_targets_of_one_statement() {
    let names: Vec<String> = (0..40).map(|index| format!("M{index}")).collect();
    let names = names.join(", ");
    let tables = tables(&format!(
        "output {names}\ngraph G {{ initial step 1 {{ {names} }} }}"
    ));
    let first = tables.layout.momentary.start;
    let targets: Vec<_> = tables
        .targets
        .iter()
        .map(|target| (target.word, target.mask))
        .collect();
    assert_eq!(targets, [(first, u32::MAX), (first + 1, 0xff)]);
    assert_eq!(tables.momentary.len(), 1);
}

#[test]
fn steps_that_do_alike_share_momentary_statements() {
    let tables = graph(
        "initial step 1 { M IF a; N }; step 2 { M IF a; N }; step 3 { M IF a }\n\
         transition 1: 1 -> 2 when a; transition 2: 2 -> 3 when a",
    );
    let runs: Vec<Run> = tables.steps.iter().map(|step| step.momentary()).collect();
    assert_eq!(runs[0], runs[1]);
    assert_ne!(runs[0], runs[2]);
    assert_eq!(tables.momentary.len(), 3);
}

#[test]
fn stored_statements_that_are_alike_are_there_once_wherever_they_stand() {
    let tables = graph(
        "initial step 1 { n = 1; m = 2 }; step 2 { n = 1; m = 2 }; step 3 { n = 1 }\n\
         transition 1: 1 -> 2 when a do { n = 1 }; transition 2: 2 -> 3 when a do { n = 1 }",
    );
    assert_eq!(tables.stored.len(), 3);
    assert_eq!((tables.duties.len(), tables.do_blocks.len()), (3, 2));
}

#[test]
fn graphs_that_are_alike_share_all_but_their_steps() {
    let graphs: Vec<String> = ["G", "H"]
        .map(|name| {
            format!(
                "graph {name} {{ initial step 1; step 2 {{ M }}\n\
                 transition 1: 1 -> 2 when a; transition 2: 2 -> 1 when T/X2/1s }}\n"
            )
        })
        .to_vec();
    let tables = tables(&format!("input a\noutput M\n{}", graphs.concat()));
    assert_eq!(tables.crossings.len(), 2);
    // Nothing, and the timers of two steps.
    assert_eq!(tables.conditions.len(), 3);
    assert_eq!((tables.momentary.len(), tables.do_blocks.len()), (1, 1));
}

#[test]
fn what_steps_do_alike_is_one_row_and_nothing_is_the_first() {
    let tables = graph(
        "initial step 1; step 2 { M }; step 3; step 4; step 5 { n = 1 }\n\
         transition 1: 1 -> 2 when a; transition 2: 2 -> 3 when a; transition 3: 3 -> 4 when T/X3/1s\n\
         transition 4: 4 -> 5 when a; transition 5: 5 -> 1 when a",
    );
    let duties: Vec<u16> = tables.steps.iter().map(|step| step.duties).collect();
    assert_eq!(duties, [0, 0, 1, 0, 2]);
    assert_eq!(tables.duties.len(), 3);
    let masks = tables.masks[usize::from(tables.blocks[0].masks)];
    assert_eq!((masks.timed, masks.stored), (0b00100, 0b10000));
    assert_eq!(tables.blocks[0].momentary, 0b00010);
}

#[test]
fn a_step_without_statements_has_the_first_row_behind_others_too() {
    let tables = graph(
        "initial step 1 { n = 1; on event ↑a { n = 2 } }; step 2\n\
         transition 1: 1 -> 2 when a do { n = 3 }; transition 2: 2 -> 1 when a",
    );
    assert_eq!(tables.steps[1].duties, 0);
    let crossing = tables.program().crossing(&tables.transitions[1]);
    assert_eq!(crossing.actions(), 0);
}

#[test]
fn large_graphs_that_are_alike_share_their_links_and_each_goes_its_own_way() {
    let large = |name: &str, input: &str| {
        let chain = (2..=40).map(|step| {
            let before = step - 1;
            format!("step {step}; transition {step}: {before} -> {step} when {input}\n")
        });
        let chain: String = chain.collect();
        format!("graph {name} {{ initial step 1\n{chain} }}\n")
    };
    let graphs = [("G", "a"), ("H", "b"), ("I", "a")].map(|(name, input)| large(name, input));
    let tables = tables(&format!("input a, b\n{}", graphs.concat()));
    assert_eq!((tables.crossings.len(), tables.links.len()), (39, 40));
    let program = tables.program();
    let mut engine = Engine::new(&program, Vectors::new(&program));
    engine.start();
    let inputs = [0b01, 0b01, 0b10, 0b11];
    let active = inputs.iter().zip(1..).map(|(inputs, scan)| {
        engine.set_inputs(0, *inputs);
        engine.scan(scan * 10);
        [0, 1, 2].map(|graph| engine.active_steps(graph).map(|step| step % 40).collect())
    });
    let active: Vec<[Vec<usize>; 3]> = active.collect();
    let expected = [[1, 0, 1], [2, 0, 2], [2, 1, 2], [3, 2, 3]];
    assert_eq!(active, expected.map(|steps| steps.map(|step| vec![step])));
}

#[test]
fn a_graph_of_one_word_needs_no_links() {
    let chain = |steps: u32| {
        let chain: String = (2..=steps)
            .map(|step| {
                format!(
                    "step {step}; transition {step}: {} -> {step} when a\n",
                    step - 1
                )
            })
            .collect();
        graph(&format!("initial step 1\n{chain}"))
    };
    let small = chain(32);
    assert!(small.links.is_empty());
    let last = Crossing::Within {
        actions: 0,
        leaves: 1 << 30,
        enters: 1 << 31,
    };
    assert_eq!(small.program().crossing(&small.transitions[30]), last);
    assert_eq!(small.blocks.len(), 1);
    let large = chain(33);
    assert!(matches!(
        large.program().crossing(&large.transitions[0]),
        Crossing::Across { .. }
    ));
    assert_eq!(large.links.len(), 33);
    let firsts: Vec<u16> = large.blocks.iter().map(|block| block.first).collect();
    assert_eq!(firsts, [0, 32]);
}
