//! Graphs, links, hierarchy and the order of statements.

use grafcet_compiler::application::Tables;
use grafcet_core::program::{Arm, Bit, Crossing, Duties, Forced, Graph, Run, Slot, Step, Target};

use crate::{application, graph, role, tables};

#[test]
fn a_transition_is_armed_by_its_first_entrance_step_or_by_its_graph() {
    let tables = graph(
        "initial step 1; step 2; step 3\ntransition 1: 2, 1 -> 3\ntransition 2: -> 1 when a\ntransition 3: 3 ->\n\
         transition 4: 1 -> 2, 3",
    );
    let transitions = |run: Run| -> Vec<u16> {
        let arms: &[Arm] = run.of(&tables.arms);
        arms.iter().map(|arm| arm.transition).collect()
    };
    let armed: Vec<Vec<u16>> = tables
        .steps
        .iter()
        .map(|step| transitions(step.arms()))
        .collect();
    assert_eq!(armed, [&[3][..], &[0], &[2]]);
    assert_eq!(transitions(role(&tables, 0).sources), [1]);
    assert_eq!(tables.sources, [0]);
    let crossings: Vec<Crossing> = crossings(&tables);
    let within = |(leaves, enters)| Crossing::Within {
        actions: 0,
        leaves,
        enters,
    };
    assert_eq!(
        crossings,
        [(0b011, 0b100), (0, 0b001), (0b100, 0), (0b001, 0b110)].map(within)
    );
}

#[test]
fn steps_of_a_large_graph_are_left_and_entered_by_links() {
    let rest: String = (3..=40).map(|step| format!("step {step}; ")).collect();
    let tables = graph(&format!(
        "initial step 1; step 2; {rest}\ntransition 1: 1, 40 -> 2, 39 when a\ntransition 2: -> 1 when a; transition 3: 2 ->"
    ));
    let program = tables.program();
    let steps = |row: usize| -> (Vec<usize>, Vec<usize>) {
        let (graph, transition): (&Graph, _) = (&tables.graphs[0], &tables.transitions[row]);
        let crossing = program.crossing(transition);
        assert!(matches!(crossing, Crossing::Across { .. }));
        (
            program.entrance_steps(graph, transition).collect(),
            program.exit_steps(graph, transition).collect(),
        )
    };
    assert_eq!(steps(0), (vec![0, 39], vec![1, 38]));
    assert_eq!(steps(1), (vec![], vec![0]));
    assert_eq!(steps(2), (vec![1], vec![]));
    assert_eq!(tables.links[0], 0);
    assert_eq!(tables.links[1], 39);
}

#[test]
fn a_macro_step_is_entered_at_its_entry_and_left_at_its_exit() {
    let tables = graph(
        "initial step 1; macro step M5 { exit step 3; entry step 2; transition 2: 2 -> 3 }\n\
         transition 1: 1 -> M5\ntransition 3: M5 -> 1",
    );
    let crossings: Vec<Crossing> = crossings(&tables);
    let within = |(leaves, enters)| Crossing::Within {
        actions: 0,
        leaves,
        enters,
    };
    assert_eq!(
        crossings,
        [(0b100, 0b010), (0b001, 0b100), (0b010, 0b001)].map(within)
    );
    let (graph, program) = (&tables.graphs[0], tables.program());
    let transition = &tables.transitions[2];
    let left: Vec<usize> = program.entrance_steps(graph, transition).collect();
    let entered: Vec<usize> = program.exit_steps(graph, transition).collect();
    assert_eq!((left, entered), (vec![1], vec![0]));
}

#[test]
fn superiors_are_settled_first_and_otherwise_the_source_decides() {
    let tables = tables(
        "input a\ngraph A { initial step 1 }\ngraph B { initial step 1 { F/A:{1} IF a } }\n\
         graph C { initial step 1 encloses B{1} }\ngraph D { initial step 1; always { F/D:{} IF a } }",
    );
    assert_eq!(tables.hierarchy, [2, 1, 0, 3]);
}

#[test]
fn orders_are_ranked_by_the_source_wherever_they_stand() {
    let tables = tables(
        "input a\ngraph B { initial step 1 }\n\
         graph A { always { F/B:{} IF a }; initial step 1 { F/B:{1} }; always { F/B:{*}; F/A:{I} IF a } }",
    );
    let a = role(&tables, 1);
    let ranks = |run: Run| {
        run.of(&tables.orders)
            .iter()
            .map(|order| order.rank)
            .collect::<Vec<_>>()
    };
    assert_eq!(ranks(a.orders), [0, 2]);
    assert_eq!(ranks(duties(&tables, tables.steps[1]).orders), [1]);
    assert_eq!(ranks(a.self_orders), [3]);
    assert_eq!(tables.orders[1].situation, Forced::Current);
}

#[test]
fn an_enclosing_step_gives_its_set_and_at_the_start_the_initial_steps() {
    let tables = tables(
        "graph A { initial step 1 encloses B{2}, C{1}; step 2 encloses B{1}; transition 1: 1 -> 2; transition 2: 2 -> 1 }\n\
         graph B { initial step 1; step 2; step 3; transition 1: 2 -> 3 }\ngraph C { step 1 }",
    );
    let of = |graph: usize| role(&tables, graph).enclosings.of(&tables.enclosings);
    let word = |situation: u16| tables.situations[usize::from(situation)];
    assert!(of(0).is_empty());
    let at_start: Vec<Option<u32>> = of(1).iter().map(|it| it.at_start.map(word)).collect();
    assert_eq!(at_start, [Some(0b001), None]);
    let sets: Vec<u32> = of(1).iter().map(|it| word(it.situation)).collect();
    assert_eq!(sets, [0b010, 0b001]);
    assert_eq!(of(2)[0].at_start.map(word), Some(0b001));
}

#[test]
fn momentary_statements_follow_what_they_depend_on() {
    let text = "input a\noutput M, N\nvar v, w\ngraph G {\n\
                always { M IF w AND NOT ↑v }\ninitial step 1 { w IF v; v IF a; N, v IF a AND ↓M } }";
    let application = application(text);
    let tables = &application.controller.tables;
    assert_eq!(tables.momentary.len(), 2);
    assert_eq!(tables.steps[0].momentary(), Run { start: 0, len: 2 });
    let bit = |name: &str| {
        let found = application
            .controller
            .symbols
            .variables
            .iter()
            .find(|it| it.name == name);
        match found.unwrap().slot {
            Slot::Bit(bit) => bit,
            Slot::Number(_) => unreachable!(),
        }
    };
    let targets: Vec<Target> = tables
        .dependent
        .iter()
        .flat_map(|it| it.statement.targets.of(&tables.targets))
        .copied()
        .collect();
    let target = |bit: Bit| Target {
        word: bit.0 / 32,
        mask: bit.mask(),
    };
    assert_eq!(targets, [bit("w"), bit("M")].map(target));
    let owned: Vec<bool> = tables
        .dependent
        .iter()
        .map(|it| it.owner.is_some())
        .collect();
    assert_eq!(owned, [true, false]);
}

#[test]
fn one_statement_with_two_variables_is_one_row() {
    let tables = graph("initial step 1 { M, N IF a OR b }");
    assert_eq!(tables.momentary.len(), 1);
    let targets = tables.momentary[0].targets.of(&tables.targets);
    assert_eq!(targets.len(), 1);
    assert_eq!(targets[0].mask, 0b11);
}

fn duties(tables: &Tables, step: Step) -> Duties {
    tables.duties[usize::from(step.duties)]
}

fn stored(tables: &Tables, run: Run) -> usize {
    run.of(&tables.stored).len()
}

#[test]
fn stored_statements_stand_in_the_group_in_which_they_run() {
    let tables = graph(
        "always { n = 1 }\ninitial step 1 { n = 2; on activation { n = 3; n = 4 }; on deactivation: n = 5\n\
         on event ↑a { n = 6; n = 7; n = 8 }; n = 9 }\ntransition 1: 1 -> 1 do { n = 10 }\nalways { n = 11 }",
    );
    let step = duties(&tables, tables.steps[0]);
    assert_eq!(stored(&tables, tables.always_stored), 2);
    assert_eq!(stored(&tables, step.stored), 2);
    assert_eq!(stored(&tables, step.on_activation), 2);
    assert_eq!(stored(&tables, step.on_deactivation), 1);
    assert_eq!(
        stored(&tables, step.on_event.of(&tables.events)[0].stored),
        3
    );
    assert_eq!(
        stored(&tables, tables.program().do_block(&tables.transitions[0])),
        1
    );
}

#[test]
fn a_program_says_what_it_never_does() {
    let flags = |elements: &str| {
        let tables = graph(&format!("initial step 1 {{ {elements} }}"));
        [
            tables.lasting_in_steps,
            tables.stores_on_change,
            tables.momentary_varies,
        ]
    };
    assert_eq!(flags("M"), [false, false, false]);
    assert_eq!(flags("n = 1"), [true, false, false]);
    assert_eq!(flags("on activation: n = 1"), [false, true, false]);
    assert_eq!(flags("on deactivation: n = 1"), [false, true, false]);
    assert_eq!(flags("on event ↑a: n = 1"), [false, false, false]);
    assert_eq!(flags("M IF a"), [false, false, true]);
    assert_eq!(flags("M IF T/X1/1s"), [false, false, true]);
    assert_eq!(flags("M; N IF M"), [false, false, true]);
    let transition = graph("initial step 1\ntransition 1: 1 -> 1 when a do { n = 1 }");
    assert!(transition.stores_on_change);
    let alone = graph("initial step 1\nalways { n = 1; M IF a }");
    assert!(!alone.lasting_in_steps && alone.momentary_varies);
}

#[test]
fn memory_for_what_a_program_does_not_do_is_not_kept() {
    let kept = |text: &str| {
        let layout = tables(text).layout;
        (layout.passed, layout.remembered, layout.standings)
    };
    let plain = "graph A { initial step 1; transition 1: 1 -> 1 }";
    assert_eq!(kept(plain), (0, 0, 0));
    assert_eq!(kept(&format!("evolution stable\n{plain}")), (1, 1, 0));
    let forced = format!("{plain}\ngraph B {{ initial step 1 {{ F/A:{{*}} }} }}");
    assert_eq!(kept(&forced), (0, 0, 2));
    let enclosed = format!("{plain}\ngraph B {{ initial step 1 encloses A{{1}} }}");
    assert_eq!(kept(&enclosed), (0, 2, 2));
}

/// What each transition does to the situation.
fn crossings(tables: &Tables) -> Vec<Crossing> {
    let program = tables.program();
    let transitions = tables.transitions.iter();
    transitions.map(|it| program.crossing(it)).collect()
}
