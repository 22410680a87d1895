//! Graphs, their steps and transitions, and the hierarchy.

use super::*;
use crate::program::Crossing;

#[test]
fn graphs_share_out_their_steps_transitions_and_words() {
    refused! {
        graphs[0].steps = run(0, 2) => Graphs;
        graphs[1].steps = run(2, 2) => Graphs;
        graphs[1].steps = run(3, 2) => Graphs;
        graphs[2].steps = run(4, 34) => Graphs;
        graphs[2].steps = run(4, 65) => Graphs;
        graphs[0].transitions = run(0, 1) => Graphs;
        graphs[1].transitions = run(2, 2) => Graphs;
        graphs[0].first_word = 1 => Graphs;
        graphs[1].first_word = 2 => Graphs;
        graphs[1].first_word = 4 => Graphs;
        graphs[2].first_word = 3 => Graphs;
        graphs[2].first_word = 5 => Graphs;
        graphs[0].initial = 5 => Graphs;
        graphs[1].initial = 2 => Graphs;
        graphs[2].initial = 1 => Graphs;
        graphs[2].initial = 4 => Graphs;
        graphs[1].role = 3 => Graphs;
    }
}

#[test]
fn what_few_graphs_have_stays_within_the_tables() {
    refused! {
        roles[2].sources = run(4, 2) => Roles;
        roles[2].enclosings = run(1, 1) => Roles;
        roles[2].orders = run(2, 1) => Roles;
        roles[1].self_orders = run(2, 1) => Roles;
        roles[1].watches = run(5, 1) => Roles;
        roles[1].self_watches = run(4, 2) => Roles;
    }
}

#[test]
fn the_first_row_of_what_few_graphs_have_is_none_of_it() {
    refused! {
        roles[0].sources = run(0, 1) => Roles;
        roles[0].enclosings = run(0, 1) => Roles;
        roles[0].orders = run(0, 1) => Roles;
        roles[0].self_orders = run(0, 1) => Roles;
        roles[0].watches = run(0, 1) => Roles;
        roles[0].self_watches = run(0, 1) => Roles;
    }
}

#[test]
fn the_graphs_with_transitions_without_entrance_are_known() {
    refused! {
        roles[2].sources = Run::EMPTY => Graphs;
        roles[1].sources = run(0, 1) => Graphs;
        sources[0] = 0 => Graphs;
        sources[0] = 3 => Graphs;
    }
    program_refused! {
        sources = &[] => Graphs;
        sources = &[1, 1] => Graphs;
    }
}

#[test]
fn a_word_of_a_situation_leads_to_the_steps_in_it_and_to_all_that_act() {
    refused! {
        blocks[0].first = 1 => Graphs;
        blocks[3].first = 35 => Graphs;
        blocks[0].momentary = 0b000 => Steps;
        blocks[0].momentary = 0b011 => Steps;
        blocks[0].masks = 2 => Graphs;
        masks[1].timed = 0b011 => Steps;
        masks[1].stored = 0b000 => Steps;
        masks[1].on_activation = 0b001 => Steps;
        masks[1].on_deactivation = 0b000 => Steps;
        masks[1].on_event = 0b110 => Steps;
        masks[1].forcing = 0b000 => Steps;
        masks[1].varying = 0b001 => Steps;
        masks[0].timed = 0b1 => Steps;
        steps[36].duties = 1 => Steps;
        steps[36].momentary_count = 1 => Steps;
    }
}

#[test]
fn the_hierarchy_names_every_graph_once() {
    refused! {
        hierarchy[1] = 0 => Hierarchy;
        hierarchy[1] = 3 => Hierarchy;
    }
    program_refused! { hierarchy = &[0, 1] => Hierarchy; }
}

#[test]
fn an_arm_is_of_a_transition_that_leaves_its_step() {
    refused! {
        arms[0].transition = 5 => Arms;
        // Of another graph, of another step, of a step although it leaves none, of none although it leaves one.
        arms[0].transition = 2 => Arms;
        arms[0].transition = 1 => Arms;
        arms[2].transition = 3 => Arms;
        arms[3].transition = 4 => Arms;
        steps[0].arm_count = 2 => Arms;
        steps[3] = Step { first_arm: 2, arm_count: 1, ..GOOD.steps[3] } => Arms;
        crossings[2] = within(1, 1) => Arms;
        crossings[3] = across(Run::EMPTY, run(0, 1)) => Arms;
    }
}

#[test]
fn a_step_stays_within_the_tables() {
    refused! {
        steps[0].first_arm = 5 => Steps;
        steps[0].arm_count = 6 => Steps;
        steps[0].first_momentary = 1 => Steps;
        steps[0].momentary_count = 2 => Steps;
        steps[0].duties = 4 => Steps;
    }
}

#[test]
fn a_macro_step_stays_within_its_graph() {
    refused! {
        macros[0].bit = Bit(64) => Macros;
        macros[0].graph = 1 => Macros;
        macros[0].graph = 3 => Macros;
        macros[0].steps = run(2, 2) => Macros;
        macros[0].activated = Some(Stamp(4)) => Macros;
    }
}

#[test]
fn a_transition_joins_steps_of_its_own_graph() {
    refused! {
        crossings[0] = within(0b1001, 0) => Transitions;
        crossings[0] = within(0b0001, 0b1000) => Transitions;
        crossings[2] = within(0, 0b10) => Transitions;
        // A word or links, as the graph has one word or more.
        crossings[0] = across(run(0, 1), run(1, 1)) => Transitions;
        crossings[3] = within(1, 1) => Transitions;
        crossings[3] = across(run(0, 1), run(2, 1)) => Transitions;
        crossings[3] = across(run(0, 3), run(1, 1)) => Transitions;
        links[1] = 33 => Transitions;
        links[1] = 65_535 => Transitions;
    }
}

#[test]
fn a_transition_stays_within_the_tables() {
    refused! {
        transitions[0].fires = 5 => Transitions;
        transitions[0].crossing = 5 => Transitions;
        transitions[0].term = 3 => Transitions;
        crossings[0] = Crossing::Within { actions: 2, leaves: 1, enters: 2 } => Transitions;
    }
}

#[test]
fn an_enclosing_step_gives_a_set_of_steps() {
    refused! {
        enclosings[0].step = Bit(192) => Enclosings;
        enclosings[0].situation = 2 => Enclosings;
        enclosings[0].situation = 5 => Enclosings;
        enclosings[0].at_start = Some(2) => Enclosings;
    }
}

#[test]
fn an_order_is_for_a_graph_and_a_set_of_its_steps() {
    refused! {
        orders[0].graph = 3 => Orders;
        orders[0].situation = Forced::Set(2) => Orders;
        orders[0].situation = Forced::Set(5) => Orders;
        orders[0].condition = all(0, 4) => Orders;
        orders[1].graph = 1 => Orders;
    }
}
