//! Properties, tests and the steps of tests.

use super::{right, show, wrong};
use grafcet_compiler::ast::{Item, PropertyKind, Test, TestStepKind};

#[track_caller]
fn test(steps: &str) -> Test {
    match right(&format!("test \"t\" {{ {steps}\n}}"))
        .items
        .into_iter()
        .next()
    {
        Some(Item::Test(test)) => test,
        other => panic!("{other:?}"),
    }
}

fn kinds(steps: &str) -> Vec<String> {
    let names = |refs: &[grafcet_compiler::ast::Ref]| -> String {
        let names: Vec<_> = refs.iter().map(show::reference).collect();
        names.join(" ")
    };
    let show_one = |kind: &TestStepKind| match kind {
        TestStepKind::Set(all) => {
            let all: Vec<_> = all
                .iter()
                .map(|(name, value)| match value {
                    Some(value) => format!("{}={}", show::reference(name), show::constant(value)),
                    None => show::reference(name),
                })
                .collect();
            format!("set {}", all.join(" "))
        }
        TestStepKind::Clear(all) => format!("clear {}", names(all)),
        TestStepKind::Release(all) => format!("release {}", names(all)),
        TestStepKind::Pulse(name, time) => {
            format!("pulse {} {}", show::reference(name), show::constant(time))
        }
        TestStepKind::Wait(time) => format!("wait {}", show::constant(time)),
        TestStepKind::WaitScans(count) => format!("wait {count} scans"),
        TestStepKind::WaitUntil(until, time) => {
            format!("until {} {}", show::expression(until), show::constant(time))
        }
        TestStepKind::Expect(e) => format!("expect {}", show::expression(e)),
        TestStepKind::Never(e) => format!("never {}", show::expression(e)),
        TestStepKind::Always(e) => format!("always {}", show::expression(e)),
        TestStepKind::PowerCycle => "power cycle".to_owned(),
    };
    test(steps)
        .steps
        .iter()
        .map(|step| show_one(&step.kind))
        .collect()
}

#[test]
fn every_step_of_a_test() {
    let steps = "set a, n = -5, b = TRUE, Saw1:delay = 2s\nclear a, G:b\nrelease a\npulse a for 50 ms\nwait 100 ms\n\
                 wait 3 scans\nwait until X2 AND a within 10 s\nexpect S(G) = {3} AND NOT b\nnever a\nalways b\n\
                 power cycle";
    assert_eq!(
        kinds(steps),
        [
            "set a n=-5 b=true Saw1:delay=2000ms",
            "clear a G:b",
            "release a",
            "pulse a 50ms",
            "wait 100ms",
            "wait 3 scans",
            "until (AND X2 a) 10000ms",
            "expect (AND (S G = {3}) (NOT b))",
            "never a",
            "always b",
            "power cycle",
        ]
    );
}

#[test]
fn steps_of_a_test_may_share_a_line() {
    assert_eq!(kinds("set a; wait 1 scans; power cycle").len(), 3);
}

#[test]
fn a_test_runs_with_plants() {
    let file = right("test \"t\" with Press, Belt { expect a }");
    let Item::Test(test) = &file.items[0] else {
        panic!("a test")
    };
    assert_eq!(show::names(&test.plants), "Press Belt");
}

#[test]
fn every_kind_of_property() {
    let file = right(
        "property \"a\": never a AND b\nproperty \"b\": always a\nproperty \"c\": reachable X3\n\
         property \"d\": recoverable S(G) = {I}\nproperty \"e\": after ↑a within 2 s expect b",
    );
    let kinds: Vec<_> = file
        .items
        .iter()
        .map(|item| match item {
            Item::Property(property) => match &property.kind {
                PropertyKind::Never(e) => format!("never {}", show::expression(e)),
                PropertyKind::Always(e) => format!("always {}", show::expression(e)),
                PropertyKind::Reachable(e) => format!("reachable {}", show::expression(e)),
                PropertyKind::Recoverable(e) => format!("recoverable {}", show::expression(e)),
                PropertyKind::After {
                    trigger,
                    within,
                    expect,
                } => format!(
                    "after {} {} {}",
                    show::expression(trigger),
                    show::constant(within),
                    show::expression(expect)
                ),
            },
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(
        kinds,
        [
            "never (AND a b)",
            "always a",
            "reachable X3",
            "recoverable (S G = {I})",
            "after (↑ a) 2000ms b"
        ]
    );
}

#[test]
fn what_a_test_lacks() {
    for (text, said) in [
        (
            "wait 3",
            "expected `scans` or a unit of time, found the end of the line",
        ),
        (
            "wait until a",
            "expected `within`, found the end of the line",
        ),
        ("pulse a", "expected `for`, found the end of the line"),
        ("push a", "expected a step of the test, found `push`"),
        ("power off", "expected `cycle`, found `off`"),
        (
            "wait delay",
            "expected a duration, a number of scans or `until`, found `delay`",
        ),
    ] {
        assert_eq!(
            wrong(&format!("test \"t\" {{\n{text}\nwait 1 s }}")),
            [format!("syntax 2: {said}")]
        );
    }
}

#[test]
fn what_a_property_lacks() {
    assert_eq!(
        wrong("property never a"),
        ["syntax 1: expected what the property says, in quotation marks, found `never`"]
    );
    assert_eq!(
        wrong("property \"p\": eventually a"),
        [
            "syntax 1: expected `never`, `always`, `reachable`, `recoverable` or `after`, found `eventually`"
        ]
    );
    assert_eq!(
        wrong("property \"p\": after a within b expect c"),
        ["syntax 1: expected a duration behind `within`, found `b`"]
    );
}
