//! What happens when a row of a good program is damaged.

extern crate std;

use std::vec::Vec;

use self::good::{FIVE, GOOD, run};
use super::{Unsound, demand};
use crate::memory::Storage;
use crate::program::{
    Assignment, Bit, Code, Condition, Edge, Forced, Layout, Number, Op, Program, Run, Slot, Stamp,
    Watch,
};

mod good;

const _: () = demand(&GOOD);

fn changed<T: Copy>(rows: &[T], change: impl FnOnce(&mut [T])) -> Vec<T> {
    let mut rows = rows.to_vec();
    change(&mut rows);
    rows
}

/// Damages one row of a table and expects the rule that is broken.
macro_rules! refused {
    ($($table:ident[$row:literal]$(.$field:ident)* = $value:expr => $rule:ident;)*) => {$(
        let rows = changed(GOOD.$table, |rows| rows[$row]$(.$field)* = $value);
        let program = Program { $table: &rows, ..GOOD };
        assert_eq!(
            program.unsoundness(),
            Some(Unsound::$rule),
            "{}",
            concat!(stringify!($table), "[", $row, "]" $(, ".", stringify!($field))*, " = ", stringify!($value)),
        );
    )*};
}

/// Damages the layout and expects the rule that is broken.
macro_rules! layout_refused {
    ($($field:ident = $value:expr => $rule:ident;)*) => {$(
        let layout = Layout { $field: $value, ..GOOD.layout };
        let program = Program { layout, ..GOOD };
        assert_eq!(program.unsoundness(), Some(Unsound::$rule), "{}", stringify!($field = $value));
    )*};
}

#[test]
fn a_good_program_is_sound() {
    assert_eq!(GOOD.unsoundness(), None);
    assert!(GOOD.is_sound());
}

#[test]
fn places_in_the_image_neither_overlap_nor_leave_it() {
    layout_refused! {
        words = 7 => Layout;
        inputs = run(0, 1) => Layout;
        inputs = run(2, 1) => Layout;
        situations = run(3, 2) => Layout;
        momentary = run(8, 1) => Layout;
        macros = run(5, 1) => Layout;
        outside = Run::EMPTY => Layout;
        number_inputs = run(1, 1) => Layout;
        number_inputs = run(2, 3) => Layout;
        fired = 0 => Layout;
    }
}

#[test]
fn runs_of_the_program_stay_within_their_tables() {
    for program in [
        Program {
            period_ms: 0,
            ..GOOD
        },
        Program {
            always_stored: run(2, 1),
            ..GOOD
        },
        Program {
            always_momentary: run(0, 2),
            ..GOOD
        },
        Program {
            trigger_watches: run(5, 1),
            ..GOOD
        },
        Program {
            round_watches: run(0, 6),
            ..GOOD
        },
        Program {
            action_watches: run(6, 0),
            ..GOOD
        },
    ] {
        assert_eq!(program.unsoundness(), Some(Unsound::Layout));
    }
}

#[test]
fn a_first_value_lies_within_its_limits() {
    refused! {
        numbers[3].initial = 10 => Numbers;
        numbers[3].initial = -1 => Numbers;
    }
    layout_refused! { numbers = 5 => Numbers; }
}

#[test]
fn a_conjunction_looks_at_the_image_and_for_what_can_be() {
    refused! {
        terms[0].word = 8 => Terms;
        terms[0].state = 0b100 => Terms;
    }
}

#[test]
fn graphs_share_out_their_steps_transitions_and_words() {
    refused! {
        graphs[0].steps = run(0, 2) => Graphs;
        graphs[1].steps = run(2, 2) => Graphs;
        graphs[1].steps = run(3, 2) => Graphs;
        graphs[0].transitions = run(0, 1) => Graphs;
        graphs[1].transitions = run(2, 2) => Graphs;
        graphs[1].words = run(2, 1) => Graphs;
        graphs[1].words = run(3, 2) => Graphs;
        graphs[0].words = run(2, 0) => Graphs;
        graphs[0].initial = 3 => Graphs;
        graphs[1].initial = 2 => Graphs;
        graphs[1].sources = run(2, 2) => Graphs;
        graphs[1].enclosings = run(1, 1) => Graphs;
        graphs[1].orders = run(2, 1) => Graphs;
        graphs[0].self_orders = run(2, 1) => Graphs;
        graphs[0].watches = run(5, 1) => Graphs;
        graphs[0].self_watches = run(4, 2) => Graphs;
    }
}

#[test]
fn the_hierarchy_names_every_graph_once() {
    refused! {
        hierarchy[1] = 0 => Hierarchy;
        hierarchy[1] = 2 => Hierarchy;
    }
    let short = Program {
        hierarchy: &[0],
        ..GOOD
    };
    assert_eq!(short.unsoundness(), Some(Unsound::Hierarchy));
}

#[test]
fn a_step_stays_within_the_tables() {
    refused! {
        steps[0].transitions = run(3, 1) => Steps;
        steps[0].momentary = run(1, 1) => Steps;
        steps[0].stored = run(2, 1) => Steps;
        steps[0].on_activation = run(2, 1) => Steps;
        steps[0].on_deactivation = run(2, 1) => Steps;
        steps[0].on_event = run(1, 1) => Steps;
        steps[0].orders = run(2, 1) => Steps;
        steps[0].activated = Some(Stamp(4)) => Steps;
    }
}

#[test]
fn a_macro_step_stays_within_its_graph() {
    refused! {
        macros[0].bit = Bit(64) => Macros;
        macros[0].graph = 1 => Macros;
        macros[0].graph = 2 => Macros;
        macros[0].steps = run(2, 2) => Macros;
        macros[0].activated = Some(Stamp(4)) => Macros;
    }
}

#[test]
fn a_transition_joins_steps_of_its_own_graph() {
    refused! {
        transitions[0].entrance = run(2, 1) => Transitions;
        transitions[0].exit = run(3, 1) => Transitions;
        transitions[0].exit = run(4, 1) => Transitions;
        transitions[0].trigger = Condition::All(run(1, 1)) => Transitions;
        transitions[0].actions = run(2, 1) => Transitions;
        links[1] = Bit(67) => Transitions;
        links[0] = Bit(256) => Links;
        armed_by[0] = 3 => ArmedBy;
    }
}

#[test]
fn code_gets_by_with_its_stack() {
    refused! {
        // It leaves two values, takes one that is not there, needs three.
        ops[2] = Op::Not => Transitions;
        ops[1] = Op::Not => Transitions;
        ops[0] = Op::Number(Number(4)) => Transitions;
        ops[0] = Op::Bit(Bit(256)) => Transitions;
        transitions[0].trigger = Condition::Code(Code { start: 0, len: 0 }) => Transitions;
        transitions[0].trigger = Condition::Code(Code { start: 0, len: 1 << 15 }) => Transitions;
        transitions[0].trigger = Condition::Code(Code { start: u32::MAX, len: 1 }) => Transitions;
    }
    layout_refused! { stack = 1 => Transitions; }
}

#[test]
fn an_enclosing_step_gives_a_set_of_steps() {
    refused! {
        enclosings[0].step = Bit(128) => Enclosings;
        enclosings[0].situation = 2 => Enclosings;
        enclosings[0].situation = 3 => Enclosings;
        enclosings[0].at_start = Some(2) => Enclosings;
    }
}

#[test]
fn an_order_is_for_a_graph_and_a_set_of_its_steps() {
    refused! {
        orders[0].graph = 2 => Orders;
        orders[0].situation = Forced::Set(2) => Orders;
        orders[0].situation = Forced::Set(3) => Orders;
        orders[0].condition = Condition::All(run(0, 2)) => Orders;
        orders[1].graph = 1 => Orders;
    }
}

#[test]
fn stored_statements_write_only_what_is_stored() {
    let bit = |bit| Assignment::Bit(Bit(bit), Condition::Always);
    refused! {
        stored[0].assignment = bit(1) => Stored;
        stored[0].assignment = bit(32) => Stored;
        stored[0].assignment = bit(64) => Stored;
        stored[0].assignment = bit(128) => Stored;
        stored[0].assignment = bit(160) => Stored;
        stored[0].assignment = bit(224) => Stored;
        stored[0].assignment = bit(256) => Stored;
        stored[1].assignment = Assignment::Number(Number(0), FIVE) => Stored;
        stored[1].assignment = Assignment::Number(Number(2), FIVE) => Stored;
        stored[1].assignment = Assignment::Number(Number(4), FIVE) => Stored;
        stored[1].condition = Condition::All(run(2, 0)) => Stored;
    }
}

#[test]
fn an_event_is_a_bit_with_statements() {
    refused! {
        events[0].event = Bit(256) => Events;
        events[0].stored = run(2, 1) => Events;
    }
}

#[test]
fn momentary_statements_write_only_what_is_momentary() {
    refused! {
        momentary[0].targets = run(0, 1) => Momentary;
        momentary[0].targets = run(4, 1) => Momentary;
        momentary[0].condition = Condition::All(run(2, 0)) => Momentary;
        dependent[0].owner = Some(Bit(32)) => Momentary;
        dependent[0].statement.targets = run(0, 1) => Momentary;
    }
}

#[test]
fn edges_and_timers_remember_within_the_memory() {
    let edge = |last, result| Watch::Edge {
        operand: Condition::Always,
        edge: Edge::Falling,
        last: Bit(last),
        result: Bit(result),
        from_false: true,
    };
    refused! {
        watches[0] = edge(32, 194) => Watches;
        watches[0] = edge(193, 64) => Watches;
        watches[0] = edge(193, 193) => Watches;
        watches[0] = edge(193, 256) => Watches;
        watches[2] = Watch::OnDelay {
            enable: Condition::Always, delay: FIVE, last: Bit(197), risen: Stamp(4), result: Bit(198),
        } => Watches;
        watches[3] = Watch::OffDelay {
            on: Condition::Always, hold: Code { start: 0, len: 2 }, last: Bit(197), fallen: Stamp(3), result: Bit(198),
        } => Watches;
        watches[4] = Watch::Value {
            condition: Condition::Always, gate: Some(Bit(256)), result: Bit(201),
        } => Watches;
        watches[4] = Watch::Value {
            condition: Condition::Always, gate: None, result: Bit(32),
        } => Watches;
    }
}

#[test]
fn first_and_retained_values_are_of_what_can_be_written() {
    refused! {
        initially_true[0] = Bit(64) => FirstValues;
        retained[0].slot = Slot::Bit(Bit(32)) => FirstValues;
        retained[1].slot = Slot::Number(Number(1)) => FirstValues;
    }
}

#[test]
#[should_panic(expected = "the hierarchy of the graphs is unsound")]
fn a_demand_names_the_table() {
    demand(&Program {
        hierarchy: &[1, 1],
        ..GOOD
    });
}

#[test]
fn a_storage_fits_exactly_its_program() {
    assert!(Storage::<8, 4, 3, 4, 2, 1, 2>::is_sized_for(&GOOD));
    assert!(!Storage::<7, 4, 3, 4, 2, 1, 2>::is_sized_for(&GOOD));
    assert!(!Storage::<8, 4, 3, 4, 2, 1, 1>::is_sized_for(&GOOD));
}
