//! Whether situations can be exchanged word by word, while triggers of later graphs are still to be evaluated.

use grafcet_core::soundness::Unsound;

use super::tables;

/// Two graphs with these triggers.
fn two(first: &str, second: &str) -> String {
    format!(
        "input a\ngraph A {{ initial step 1; step 2; transition 1: 1 -> 2 when {first} }}\n\
         graph B {{ initial step 3; step 4; transition 2: 3 -> 4 when {second} }}"
    )
}

#[test]
fn situations_are_exchanged_at_once_unless_a_later_trigger_reads_them() {
    assert!(tables(&two("a", "a")).crosses_at_once);
    assert!(tables(&two("a AND X2", "a AND X4")).crosses_at_once);
    assert!(tables(&two("B:X3", "a XOR X4")).crosses_at_once);
    assert!(!tables(&two("a", "A:X1")).crosses_at_once);
    assert!(!tables(&two("a", "a AND A:X1")).crosses_at_once);
    assert!(!tables(&two("a", "a XOR A:X1")).crosses_at_once);
    assert!(!tables(&two("a", "a OR ↑A:X1 OR A:X1")).crosses_at_once);
}

#[test]
fn an_edge_or_a_timer_of_an_earlier_step_is_none_of_its_situation() {
    assert!(tables(&two("a", "↑A:X1")).crosses_at_once);
    assert!(tables(&two("a", "T/A:X1/1s")).crosses_at_once);
}

#[test]
fn graphs_of_many_steps_are_exchanged_at_once_but_not_what_has_no_entrance() {
    let source = "input a\ngraph A { step 1; transition 1: -> 1 when a }";
    assert!(!tables(source).crosses_at_once);
    let steps: String = (1..=33).map(|step| format!("step {step}; ")).collect();
    let large = format!("input a\ngraph A {{ initial {steps}transition 1: 1 -> 2 when a }}");
    assert!(tables(&large).crosses_at_once);
}

#[test]
fn tables_that_exchange_a_situation_before_it_is_read_are_refused() {
    for trigger in ["A:X1", "a AND A:X1", "a XOR A:X1"] {
        let mut tables = tables(&two("a", trigger));
        tables.crosses_at_once = true;
        let unsound = tables.program().unsoundness();
        assert_eq!(unsound, Some(Unsound::Exchange), "{trigger}");
    }
}

#[test]
fn steps_of_another_word_of_a_large_graph_are_read_before_they_are_exchanged() {
    let steps: String = (1..=40).map(|step| format!("step {step}; ")).collect();
    let large = |way: &str| {
        format!("input a\ngraph A {{ initial {steps}transition 1: 1 -> 2 when a\n{way} }}")
    };
    assert!(tables(&large("transition 2: 34 -> 35 when X40")).crosses_at_once);
    assert!(tables(&large("transition 2: 2 -> 3 when X40")).crosses_at_once);
    assert!(tables(&large("transition 2: 2, 40 -> 3")).crosses_at_once);
    assert!(!tables(&large("transition 2: 34 -> 35 when X1")).crosses_at_once);
    assert!(!tables(&large("transition 2: 34, 1 -> 35")).crosses_at_once);
}
