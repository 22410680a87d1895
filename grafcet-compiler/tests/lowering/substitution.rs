//! How much may stand for interface names and constants: chains and products have limits, and the limits are told.

use grafcet_compiler::diagnostic::Rule;
use grafcet_compiler::model::{MAX_BOUND_DEPTH, MAX_BOUND_SIZE, MAX_COMPARED, MAX_REPEATED};
use grafcet_compiler::{Target, compile};

use crate::tables;

/// What refuses a program; nothing when it is accepted.
fn refused(text: &str) -> Vec<(Rule, String)> {
    let none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
    let compilation = compile("large.grafcet", text, &none, Target::Host);
    assert_eq!(compilation.application.is_none(), compilation.has_errors());
    let all = compilation.diagnostics.into_iter();
    let errors = all.filter(|it| it.level() == grafcet_compiler::diagnostic::Level::Error);
    errors.map(|it| (it.rule, it.message)).collect()
}

/// Instances of which each binds its input to what `bound` says.
fn instances(count: usize, bound: impl Fn(usize) -> String) -> String {
    let instance = |n| format!("graph A{n} = T {{ M = Q; i = {} }}\n", bound(n));
    let instances: String = (0..count).map(instance).collect();
    format!(
        "input a, b\noutput Q\n\
         template T {{ input i; output M; initial step 1 {{ M IF i }} }}\n{instances}"
    )
}

/// Each instance after the first takes the input of the one before.
fn forward(count: usize) -> String {
    instances(count, |n| match n.checked_sub(1) {
        Some(before) => format!("A{before}:i"),
        None => "a".to_owned(),
    })
}

/// Each instance but the last takes the input of the next.
fn backward(count: usize) -> String {
    instances(count, |n| {
        if n + 1 < count {
            format!("A{}:i", n + 1)
        } else {
            "a".to_owned()
        }
    })
}

#[test]
fn bindings_of_bindings_have_so_many_levels_in_either_direction() {
    let most = MAX_BOUND_DEPTH as usize - 1;
    for chain in [forward, backward] {
        assert_eq!(refused(&chain(most)), []);
        let said = refused(&chain(most + 1));
        assert_eq!(said.len(), 1, "{said:?}");
        assert_eq!(said[0].0, Rule::OutOfRange);
        assert!(said[0].1.contains("has more than 384 levels"), "{said:?}");
    }
}

#[test]
fn the_deepest_of_all_expressions_fits_the_stack() {
    // A conjunction of conjunctions as deep as the parser takes it, around bindings as deep as they may be.
    let deep = format!("{}a{}", "(b OR (NOT (".repeat(50), ")))".repeat(50));
    let text = instances(400, |n| match n.checked_sub(1) {
        Some(before) => format!("{} OR A{before}:i", deep.replacen("a", "b", 1)),
        None => deep.clone(),
    });
    assert!(
        refused(&text)
            .iter()
            .all(|(rule, _)| *rule == Rule::OutOfRange)
    );
}

#[test]
fn bindings_that_double_are_refused_when_they_have_grown_too_large() {
    let doubling = |count| {
        instances(count, |n| match n.checked_sub(1) {
            Some(before) => format!("A{before}:i AND NOT A{before}:i"),
            None => "a".to_owned(),
        })
    };
    // So many times double that all of it together is within the limit, and once more.
    assert_eq!(refused(&doubling(10)), []);
    let said = refused(&doubling(40));
    assert_eq!(said.len(), 1, "{said:?}");
    let message = format!(
        "what interface names stand for comes to more than {MAX_BOUND_SIZE} names and operators"
    );
    assert_eq!(said[0], (Rule::OutOfRange, message));
}

#[test]
fn instances_repeat_so_much_text_and_no_more() {
    let filler = "x".repeat(MAX_REPEATED / 4 - 100);
    let template = format!("template T {{ initial step 1 // {filler}\n}}");
    let length = template.len();
    let program = |instances: usize| {
        let all: String = (0..instances)
            .map(|n| format!("graph A{n} = T\n"))
            .collect();
        format!("{template}\n{all}")
    };
    assert!(4 * length <= MAX_REPEATED && MAX_REPEATED < 5 * length);
    assert_eq!(refused(&program(4)), []);
    let message = "the instances of templates come to more than 4 MB of text".to_owned();
    assert_eq!(refused(&program(5)), [(Rule::OutOfRange, message.clone())]);
    assert_eq!(refused(&program(50)), [(Rule::OutOfRange, message)]);
}

#[test]
fn situations_are_compared_for_so_many_steps_and_no_more() {
    let steps: String = (0..1000).map(|n| format!("initial step {n}\n")).collect();
    let program = |comparisons: usize| {
        let compared: String = (0..comparisons)
            .map(|n| format!("M IF S(H) = {{{}}}\n", n % 1000))
            .collect();
        format!("output M\ngraph G {{ initial step 1 {{ {compared} }} }}\ngraph H {{ {steps} }}")
    };
    let most = MAX_COMPARED / 1000;
    assert_eq!(refused(&program(most)), []);
    let message =
        format!("the situations that the program compares come to more than {MAX_COMPARED} steps");
    assert_eq!(refused(&program(most + 1)), [(Rule::OutOfRange, message)]);
}

#[test]
fn constants_stand_for_each_other_however_many_there_are() {
    let count = 20_000;
    let chain: String = (0..count)
        .map(|n| format!("const c{n} : int = c{}\n", n + 1))
        .collect();
    let tables = tables(&format!(
        "{chain}const c{count} : int = 42\nvar n : int = c0\ngraph G {{ initial step 1 {{ n = c7 }} }}"
    ));
    assert_eq!(tables.numbers.last().map(|row| row.initial), Some(42));
}

#[test]
fn constants_in_a_ring_are_refused_once() {
    let count = 20_000;
    let ring: String = (0..count)
        .map(|n| format!("const c{n} : int = c{}\n", (n + 1) % count))
        .collect();
    let message = "the constant `c0` needs its own value".to_owned();
    assert_eq!(refused(&ring), [(Rule::TypeMismatch, message)]);
}
