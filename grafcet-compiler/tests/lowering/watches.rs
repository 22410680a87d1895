//! Edges and timers: which have a memory, and when they are evaluated.

use grafcet_compiler::application::Tables;
use grafcet_core::program::{Bit, Edge, Edges, Op, Preset, Run, Term, Timer, Unit, Watch};

use crate::{condition, graph, ops_of, role, tables, terms_of};

fn of(tables: &Tables, run: Run) -> Vec<Watch> {
    run.of(&tables.watches).to_vec()
}

#[test]
fn a_step_is_timed_by_its_activation_and_others_are_not_timed() {
    let tables = graph(
        "initial step 1; step 2\ntransition 1: 1 -> 2 when T/X1/2s AND a\ntransition 2: 2 -> 1 when p/X1 OR T/X1/p",
    );
    assert!(tables.watches.is_empty());
    let duties = tables.duties[usize::from(tables.steps[0].duties)];
    // The first is asked for only while the step is active.
    assert!(matches!(tables.timers[0], Timer::Own { since, .. } if Some(since) == duties.since));
    assert!(matches!(
        tables.timers[1],
        Timer::Any { step: Bit(64), activated, .. } if Some(activated) == duties.activated
    ));
    assert_eq!((tables.timers.len(), tables.layout.since), (2, 1));
    let ops = ops_of(
        &tables,
        condition(&tables, tables.transitions[1].fires).rest,
    );
    let elapsed = ops.iter().filter(|op| **op == Op::Elapsed(1));
    assert_eq!(elapsed.count(), 2);
    assert_eq!(tables.layout.stamps, 1);
    assert_eq!(tables.steps[1].duties, 0);
}

#[test]
fn an_integer_preset_counts_seconds() {
    let tables = graph("initial step 1\ntransition 1: 1 -> 1 when T/X1/3 AND T/X1/n");
    let presets: Vec<Preset> = tables.timers.iter().map(|timer| timer.preset()).collect();
    assert!(matches!(
        presets[..],
        [Preset::Constant(3000), Preset::Number(_, Unit::Seconds)]
    ));
}

#[test]
fn any_other_enable_is_watched_where_it_stands() {
    let tables = graph(
        "initial step 1 { M IF T/a AND b/2s }\ntransition 1: 1 -> 1 when 1s/a/2s\nalways { F/G:{} IF T/NOT X1/2s }",
    );
    assert!(matches!(
        of(&tables, tables.action_watches)[..],
        [Watch::Timer { .. }]
    ));
    assert!(matches!(
        of(&tables, tables.trigger_watches)[..],
        [Watch::OnDelay { .. }, Watch::OffDelay { .. }]
    ));
    assert!(matches!(
        of(&tables, role(&tables, 0).self_watches)[..],
        [Watch::Timer { .. }]
    ));
}

#[test]
fn an_off_delay_of_a_step_watches_its_on_delay() {
    let tables = graph("initial step 1\ntransition 1: 1 -> 1 when 1s/X1/2s");
    assert!(matches!(
        of(&tables, tables.trigger_watches)[..],
        [Watch::OffDelay { .. }]
    ));
    assert_eq!(tables.timers.len(), 1);
}

#[test]
fn a_preset_that_an_action_may_change_is_read_before_the_actions() {
    let tables = graph("initial step 1 { t = t + 1s; M IF T/X1/t; N IF T/X1/p; O IF T/X1/2s }");
    assert!(matches!(
        of(&tables, tables.action_watches)[..],
        [Watch::Value { gate: None, .. }]
    ));
    let tables = graph("initial step 1 { t = t + 1s }\ntransition 1: 1 -> 1 when T/X1/t");
    assert!(tables.watches.is_empty());
}

#[test]
fn a_preset_that_can_fault_is_read_in_every_scan() {
    let tables = graph("initial step 1\ntransition 1: 1 -> 1 when T/X1/(t * n)");
    assert!(matches!(
        of(&tables, tables.trigger_watches)[..],
        [Watch::Value { gate: None, .. }]
    ));
    // It is calculated, so that it is no row.
    assert!(tables.timers.is_empty());
    assert!(matches!(tables.ops[..], [.., Op::StepTimer { .. }]));
}

#[test]
fn one_edge_is_watched_once_in_each_phase() {
    let tables = graph(
        "initial step 1 { M IF ↑(a OR b); N IF ↑(a OR b) AND b; O IF ↓(a OR b) }\n\
         transition 1: 1 -> 1 when ↑(a OR b)\ntransition 2: 1 -> 1 when ↑(a OR b) AND b OR RE (a OR b)\n\
         always { F/G:{} IF ↑(a OR b) }",
    );
    assert_eq!(tables.trigger_watches.len, 1);
    assert_eq!(tables.action_watches.len, 2);
    assert_eq!(role(&tables, 0).self_watches.len, 1);
}

#[test]
fn edges_of_inputs_are_watched_by_their_words_for_all_phases() {
    let tables = graph(
        "initial step 1 { M IF ↑a; N IF ↑a AND b; O IF ↓c; on event ↑b: n = n + 1 }\n\
         transition 1: 1 -> 1 when ↑b AND ↓a AND c\nalways { F/G:{} IF ↑a }",
    );
    assert!(tables.watches.is_empty());
    let edges = tables.edges[0];
    assert_eq!((tables.edges.len(), edges.word), (1, 1));
    let (rises, falls) = (edges.rises.unwrap(), edges.falls.unwrap());
    assert_eq!(
        (rises.bits, falls.bits),
        (0b011, 0b101),
        "of those alone that somebody reads"
    );
    let words = [edges.last, rises.word, falls.word];
    assert!(
        words
            .iter()
            .all(|word| *word > tables.layout.momentary.start)
    );
    let term = |word: u16, bits: u32| Term {
        word,
        mask: bits,
        state: bits,
    };
    assert_eq!(
        terms_of(&tables, 0),
        [
            term(1, 0b100),
            term(rises.word, 0b010),
            term(falls.word, 0b001)
        ]
    );
    assert_eq!(tables.events[0].event, Bit(rises.word * 32 + 1));
    let of_m = condition(&tables, tables.momentary[0].condition)
        .terms
        .of(&tables.terms);
    assert_eq!(of_m, [term(rises.word, 0b001)]);
}

#[test]
fn inputs_in_two_words_have_edges_in_words_of_their_own() {
    let inputs: Vec<String> = (0..40).map(|index| format!("i{index}")).collect();
    let triggers = ["↑i0 AND ↓i39", "↑i39"].map(|edges| format!("1 -> 1 when {edges}"));
    let tables = tables(&format!(
        "input {}\ngraph G {{ initial step 1; transition 1: {}; transition 2: {} }}",
        inputs.join(", "),
        triggers[0],
        triggers[1]
    ));
    let [first, second] = tables.edges[..] else {
        panic!("{:?}", tables.edges);
    };
    assert_eq!((first.word, second.word), (1, 2));
    let of = |edges: Edges| {
        let seen = [edges.rises, edges.falls].into_iter().flatten();
        let words: Vec<u16> = seen.map(|seen| seen.word).chain([edges.last]).collect();
        words
    };
    assert_eq!(
        (of(first).len(), of(second).len()),
        (2, 3),
        "no word for edges that nobody reads"
    );
    assert!(of(first).iter().all(|word| !of(second).contains(word)));
    let term = terms_of(&tables, 1);
    assert_eq!(
        (term[0].word, term[0].mask),
        (second.rises.unwrap().word, 1 << 7)
    );
}

#[test]
fn edges_of_inputs_in_rounds_and_of_what_is_no_input_have_memories_of_their_own() {
    let text =
        "input a\noutput M\nvar v\ngraph G { initial step 1 { M IF ↑a AND ↓v; v = a AND NOT v } }";
    let scan = tables(text);
    assert_eq!((scan.edges.len(), scan.watches.len()), (1, 1));
    let stable = tables(&format!("evolution stable\n{text}"));
    assert_eq!((stable.edges.len(), stable.watches.len()), (0, 2));
}

#[test]
fn the_forcing_of_a_graph_has_watches_of_its_own() {
    let tables = tables(
        "input a, b\ngraph A { initial step 1 { F/B:{1} IF ↑(a OR b) }; always { F/B:{} IF ↓(a OR b); F/A:{} IF ↑(a OR b) } }\n\
         graph B { initial step 1 { F/C:{*} IF ↑(a OR b) } }\ngraph C { initial step 1 }",
    );
    let lengths = (0..3)
        .map(|graph| role(&tables, graph))
        .map(|role| (role.watches.len, role.self_watches.len));
    assert_eq!(lengths.collect::<Vec<_>>(), [(2, 1), (1, 0), (0, 0)]);
}

#[test]
fn only_a_rising_step_bit_in_an_action_counts_from_false() {
    let from_false = |tables: &Tables, run: Run| -> Vec<bool> {
        let edges = of(tables, run).into_iter();
        edges
            .filter_map(|watch| match watch {
                Watch::Edge { from_false, .. } => Some(from_false),
                _ => None,
            })
            .collect()
    };
    let tables = graph(
        "initial step 1 { M IF ↑X1; N IF ↓X1 OR ↑(X1 AND a) OR ↑(a OR b) }\ntransition 1: 1 -> 1 when ↑X1\n\
         always { F/G:{} IF ↑X1 }",
    );
    assert_eq!(
        from_false(&tables, tables.action_watches),
        [true, false, false, false]
    );
    assert_eq!(from_false(&tables, tables.trigger_watches), [false]);
    assert_eq!(from_false(&tables, role(&tables, 0).self_watches), [true]);
}

#[test]
fn an_operator_inside_another_stands_before_it() {
    let tables = graph("initial step 1\ntransition 1: 1 -> 1 when ↑(T/(↓(a OR b))/2s)");
    assert!(matches!(
        of(&tables, tables.trigger_watches)[..],
        [
            Watch::Edge {
                edge: Edge::Falling,
                ..
            },
            Watch::Timer { .. },
            Watch::Edge {
                edge: Edge::Rising,
                ..
            }
        ]
    ));
}

#[test]
fn an_event_is_its_edge_or_a_value_while_its_step_is_active() {
    let tables = graph(
        "initial step 1 { on event ↑a: n = n + 1; on event ↑a AND b: n = n + 1; on event ↑(a AND b): n = 0 }",
    );
    let watches = of(&tables, tables.trigger_watches);
    let [
        Watch::Value {
            gate: Some(_),
            result: second,
            ..
        },
        Watch::Edge { result: third, .. },
    ] = watches[..]
    else {
        panic!("{watches:?}");
    };
    let first = Bit(tables.edges[0].rises.unwrap().word * 32);
    let events: Vec<_> = tables.events.iter().map(|event| event.event).collect();
    assert_eq!(events, [first, second, third]);
}

#[test]
fn statements_of_a_change_are_watched_in_the_rounds_of_a_stable_evolution() {
    let text = "input a, b\nvar n : int\ngraph G { initial step 1 { on activation: n = n + 1 IF ↑(a OR b); n = n + 1 IF ↓(a OR b) }\n\
                transition 1: 1 -> 1 when a do { n = 0 IF T/X1/2s } }";
    let scan = tables(text);
    assert_eq!((scan.round_watches.len, scan.action_watches.len), (0, 2));
    let stable = tables(&format!("evolution stable\n{text}"));
    // The timer too: it is evaluated once, at the end of the first round.
    assert_eq!(
        (stable.round_watches.len, stable.action_watches.len),
        (2, 1)
    );
}
