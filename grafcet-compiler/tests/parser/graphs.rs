//! Files, graphs, steps, transitions, macro steps, templates.

use super::{graph, right, show, step, transition, wrong};
use grafcet_compiler::ast::{BindingTarget, Element, Item, ScanOption, StepRole, Trigger};

#[test]
fn a_file_has_imports_a_name_options_and_items() {
    let file = right(
        "import \"saws.grafcet\"\nimport \"../lib/doors.grafcet\"\napplication mill \"two saws\"\nscan 5 ms\n\
         evolution stable\ninput a",
    );
    assert_eq!(file.imports.len(), 2);
    assert_eq!(file.application.unwrap().0.text, "mill");
    assert!(matches!(
        file.options[1],
        ScanOption::Evolution { stable: true, .. }
    ));
    assert_eq!(file.items.len(), 1);
}

#[test]
fn options_stand_among_the_items_and_need_no_application() {
    let file = right("input a\nevolution scan\nscan 20ms");
    assert!(file.application.is_none());
    assert!(matches!(
        file.options[0],
        ScanOption::Evolution { stable: false, .. }
    ));
}

#[test]
fn imports_and_the_application_stand_first() {
    assert_eq!(
        wrong("input a\nimport \"x\""),
        ["syntax 2: an import stands behind other elements"]
    );
    assert_eq!(
        wrong("input a\napplication x"),
        ["syntax 2: `application` stands behind other elements"]
    );
    assert_eq!(
        wrong("application x\napplication y"),
        ["syntax 2: the application is named twice"]
    );
}

#[test]
fn steps_are_initial_enclose_graphs_and_have_texts_and_actions() {
    let read = step("initial step 3 \"home\" encloses Saw{1}, Door{E1, 2} { A }");
    assert!(read.initial);
    assert_eq!(read.text.unwrap().text, "home");
    let enclosed: Vec<_> = read
        .encloses
        .iter()
        .map(|(graph, set)| format!("{}{}", graph.text, show::set(set)))
        .collect();
    assert_eq!(enclosed, ["Saw{1}", "Door{E1 2}"]);
    assert_eq!(show::block(&read.block.unwrap()), "A");
    assert!(step("step 4").block.is_none());
}

#[test]
fn a_step_encloses_a_set_of_named_steps() {
    assert_eq!(
        wrong("graph G { step 1 encloses H{I}\n}"),
        ["syntax 1: a set of steps is expected here"]
    );
    assert_eq!(
        wrong("graph G { step 1 encloses H\n}"),
        ["syntax 1: expected a set of steps such as `{1, 3}`, found the end of the line"]
    );
}

#[test]
fn transitions_join_steps() {
    let read = transition("transition 7 \"go\": 3, E4 -> 5, 6 when a");
    assert_eq!(read.text.unwrap().text, "go");
    assert_eq!(
        (show::names(&read.entrance), show::names(&read.exit)),
        ("3 E4".to_owned(), "5 6".to_owned())
    );
}

#[test]
fn source_and_sink_transitions_lack_a_side() {
    assert_eq!(transition("transition 1: -> 3 when a").entrance.len(), 0);
    assert_eq!(transition("transition 1: 3 -> when a").exit.len(), 0);
    assert_eq!(transition("transition 1: 3 ->").exit.len(), 0);
}

#[test]
fn a_trigger_is_an_expression_always_true_or_a_text() {
    assert!(matches!(
        transition("transition 1: 1 -> 2").trigger,
        Trigger::AlwaysTrue
    ));
    assert!(matches!(
        transition("transition 1: 1 -> 2 when =1").trigger,
        Trigger::AlwaysTrue
    ));
    assert!(matches!(
        transition("transition 1: 1 -> 2 when = 1 do { a = 1 }").trigger,
        Trigger::AlwaysTrue
    ));
    assert!(matches!(
        transition("transition 1: 1 -> 2 do { a = 1 }").trigger,
        Trigger::AlwaysTrue
    ));
    assert!(matches!(
        transition("transition 1: 1 -> 2 when True").trigger,
        Trigger::Expression(_)
    ));
    assert!(matches!(
        transition("transition 1: 1 -> 2 when \"part there\"").trigger,
        Trigger::Text(_)
    ));
}

#[test]
fn a_trigger_begins_with_when() {
    assert_eq!(
        wrong("graph G { transition 1: 1 -> 2 a\n}"),
        ["syntax 1: expected `when`, found `a`"]
    );
    assert_eq!(
        wrong("graph G { transition 1: 1 -> 2 IF a\n}"),
        ["syntax 1: a trigger does not begin with `IF`"]
    );
}

#[test]
fn a_transition_has_a_number_a_colon_and_an_arrow() {
    assert_eq!(
        wrong("graph G { transition : 1 -> 2\n}"),
        ["syntax 1: expected the number of the transition, found `:`"]
    );
    assert_eq!(
        wrong("graph G { transition 1 -> 2\n}"),
        ["syntax 1: expected `:` behind the transition's number, found `->`"]
    );
    assert_eq!(
        wrong("graph G { transition 1: 1, 2\n}"),
        ["syntax 1: expected `->` between the steps of the transition, found the end of the line"]
    );
    assert_eq!(
        wrong("graph G { transition 1: 1 => 2\n}"),
        ["syntax 1: `=>` is not the arrow of a transition"]
    );
    assert_eq!(
        wrong("graph G { transition 1: 1 -> (2)\n}"),
        ["syntax 1: expected a step identifier behind the arrow, found `(`"]
    );
}

#[test]
fn macro_steps_hold_steps_transitions_and_macro_steps() {
    let graph = graph(
        "graph G {\nmacro step M5 \"weld\" {\nentry step E1 { A }\nmacro step M6 { entry step E3; exit step S3 }\n\
         exit step S1\ntransition 1: E1 -> M6 when a\n}\n}",
    );
    let Element::Macro(expansion) = &graph.elements[0] else {
        panic!("a macro step")
    };
    assert_eq!(expansion.id.text, "M5");
    assert_eq!(expansion.elements.len(), 4);
    let Element::Step(entry) = &expansion.elements[0] else {
        panic!("a step")
    };
    assert_eq!(entry.role, StepRole::Entry);
}

#[test]
fn an_entry_step_may_be_initial() {
    let graph = graph("graph G { macro step M1 { entry initial step E1\nexit step S1\n} }");
    let Element::Macro(expansion) = &graph.elements[0] else {
        panic!("a macro step")
    };
    assert!(
        matches!(&expansion.elements[0], Element::Step(step) if step.initial && step.role == StepRole::Entry)
    );
}

#[test]
fn entry_and_exit_steps_belong_to_a_macro_step() {
    assert_eq!(
        wrong("graph G { entry step E1\n}"),
        ["syntax 1: `entry` stands outside a macro step"]
    );
}

#[test]
fn declarations_stand_outside_expansions() {
    assert_eq!(
        wrong("graph G { macro step M1 {\nvar a\nentry step E1\nexit step S1\n} }"),
        ["syntax 2: expected a step or a transition, found `var`"]
    );
}

#[test]
fn templates_and_plants_are_read_like_graphs() {
    let file =
        right("template Saw \"one saw\" { input up\nstep 1 }\nplant Press { always { up IF a } }");
    assert!(matches!(
        &file.items[..],
        [Item::Template(_), Item::Plant(_)]
    ));
}

#[test]
fn an_instance_binds_the_interface_of_a_template() {
    let file = right(
        "graph Saw1 = Saw {\nup at %IX0.0\ndown = a AND NOT b; delay = 2s\n}\ngraph Saw2 = Saw",
    );
    let [Item::Instance(first), Item::Instance(second)] = &file.items[..] else {
        panic!("two instances")
    };
    assert_eq!(
        (first.name.text.as_str(), first.template.text.as_str()),
        ("Saw1", "Saw")
    );
    assert!(
        matches!(&first.bindings[0].to, BindingTarget::Address(address) if address.text == "%IX0.0")
    );
    assert!(
        matches!(&first.bindings[1].to, BindingTarget::Expression(bound) if show::expression(bound) == "(AND a (NOT b))")
    );
    assert_eq!(first.bindings.len(), 3);
    assert_eq!(second.bindings.len(), 0);
}

#[test]
fn a_binding_has_an_address_or_a_value() {
    assert_eq!(
        wrong("graph A = T { up down }"),
        ["syntax 1: expected `at` or `=` behind the interface name, found `down`"]
    );
}
