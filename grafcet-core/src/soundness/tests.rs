//! What happens when a row of a good program is damaged.

extern crate std;

use std::vec::Vec;

use self::good::{FIVE, GOOD, across, all, only, run, within};
use super::{Unsound, demand};
use crate::program::{
    Assignment, Bit, Code, Condition, Edge, Evolution, Forced, Layout, Number, Op, Preset, Program,
    Rest, Run, Seen, Since, Slot, Stamp, Step, Term, Timer, Unit, Watch,
};

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

/// Changes something that is no row of a table and expects the rule that is broken.
macro_rules! program_refused {
    ($($($field:ident = $value:expr),+ => $rule:ident;)*) => {$(
        let program = Program { $($field: $value,)+ ..GOOD };
        assert_eq!(program.unsoundness(), Some(Unsound::$rule), "{}", stringify!($($field = $value),+));
    )*};
}

mod asked;
mod code;
mod good;
mod structure;

#[test]
fn a_good_program_is_sound() {
    assert_eq!(GOOD.unsoundness(), None);
    assert!(GOOD.is_sound());
}

#[test]
fn places_in_the_image_neither_overlap_nor_leave_it() {
    layout_refused! {
        words = 9 => Layout;
        inputs = run(0, 1) => Layout;
        inputs = run(2, 1) => Layout;
        situations = run(3, 4) => Layout;
        momentary = run(13, 1) => Layout;
        macros = run(7, 1) => Layout;
        outside = Run::EMPTY => Layout;
        number_inputs = run(1, 1) => Layout;
        number_inputs = run(2, 3) => Layout;
        fired = 0 => Layout;
    }
}

#[test]
fn a_program_has_the_memory_that_its_way_of_working_needs_and_no_more() {
    layout_refused! {
        passed = 1 => Layout;
        remembered = 0 => Layout;
        remembered = 4 => Layout;
        standings = 0 => Layout;
        standings = 2 => Layout;
        shown = 1 => Layout;
        sets = 1 => Layout;
        armed = 4 => Layout;
        armed = 8 => Layout;
        before = 0 => Layout;
        before = 4 => Layout;
        // One block for each word with steps.
        situations = run(2, 3) => Layout;
    }
    let alone = Program {
        graphs: &[],
        enclosings: &[],
        orders: &[],
        ..GOOD
    };
    assert_eq!(alone.unsoundness(), Some(Unsound::Layout));
    let large = Program {
        layout: GOOD.layout.with_armed(),
        ..GOOD
    };
    assert_eq!(large.unsoundness(), None);
    assert_eq!((large.layout.words, large.layout.armed), (32, 8));
    let stable = |passed| Program {
        evolution: Evolution::Stable,
        edges: &[],
        layout: Layout {
            passed,
            ..GOOD.layout
        },
        ..GOOD
    };
    assert_eq!(stable(1).unsoundness(), None);
    assert_eq!(stable(0).unsoundness(), Some(Unsound::Layout));
}

#[test]
fn runs_of_the_program_stay_within_their_tables() {
    program_refused! {
        period_ms = 0 => Layout;
        always_stored = run(2, 1) => Layout;
        always_momentary = run(0, 2) => Layout;
        trigger_watches = run(5, 1) => Layout;
        round_watches = run(0, 6) => Layout;
        action_watches = run(6, 0) => Layout;
        blocks = &GOOD.blocks[..3] => Layout;
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
fn situations_are_not_exchanged_at_once_where_others_reach_into_them() {
    program_refused! {
        crosses_at_once = true => Exchange;
    }
}

#[test]
fn what_steps_do_stays_within_the_tables() {
    refused! {
        duties[2].stored = run(2, 1) => Duties;
        duties[2].on_activation = run(2, 1) => Duties;
        duties[2].on_deactivation = run(2, 1) => Duties;
        duties[2].on_event = run(1, 1) => Duties;
        duties[3].orders = run(2, 1) => Duties;
        duties[1].activated = Some(Stamp(4)) => Duties;
        duties[1].since = Some(Since(2)) => Duties;
    }
}

#[test]
fn the_first_row_of_what_steps_do_does_nothing() {
    refused! {
        duties[0].stored = run(0, 1) => Duties;
        duties[0].on_activation = run(0, 1) => Duties;
        duties[0].on_deactivation = run(0, 1) => Duties;
        duties[0].on_event = run(0, 1) => Duties;
        duties[0].orders = run(0, 1) => Duties;
        duties[0].activated = Some(Stamp(0)) => Duties;
        duties[0].since = Some(Since(0)) => Duties;
    }
}

#[test]
fn what_a_program_says_it_never_does_no_row_of_it_does() {
    program_refused! {
        lasting_in_steps = false => Duties;
        stores_on_change = false, do_blocks = &[Run::EMPTY; 2] => Duties;
        momentary_varies = false => Momentary;
    }
    // The `do` block of a transition alone, and the condition of an independent statement alone.
    let duties = changed(GOOD.duties, |rows| rows[2].on_deactivation = Run::EMPTY);
    let masks = changed(GOOD.masks, |rows| rows[1].on_deactivation = 0);
    program_refused! { stores_on_change = false, duties = &duties, masks = &masks => DoBlocks; }
    let momentary = changed(GOOD.momentary, |rows| rows[0].condition = 2);
    let masks = changed(GOOD.masks, |rows| rows[1].varying = 0b001);
    program_refused! {
        momentary_varies = false, dependent = &[], masks = &masks, momentary = &momentary => Momentary;
        momentary = &momentary => Steps;
    }
}

#[test]
fn stored_statements_write_only_what_is_stored() {
    let bit = |bit| Assignment::Bit(Bit(bit), Condition::ALWAYS);
    refused! {
        stored[0].assignment = bit(1) => Stored;
        stored[0].assignment = bit(32) => Stored;
        stored[0].assignment = bit(64) => Stored;
        stored[0].assignment = bit(192) => Stored;
        stored[0].assignment = bit(224) => Stored;
        stored[0].assignment = bit(288) => Stored;
        stored[0].assignment = bit(416) => Stored;
        stored[0].assignment = Assignment::Bit(Bit(256), only(Rest::Code(3))) => Stored;
        stored[1].assignment = Assignment::Number(Number(0), FIVE) => Stored;
        stored[1].assignment = Assignment::Number(Number(2), FIVE) => Stored;
        stored[1].assignment = Assignment::Number(Number(4), FIVE) => Stored;
        stored[1].assignment = Assignment::Number(Number(3), Code { start: 0, len: 2 }) => Stored;
        stored[1].condition = all(4, 0) => Stored;
    }
}

#[test]
fn do_blocks_are_of_stored_statements_and_the_first_is_empty() {
    refused! {
        do_blocks[0] = run(1, 1) => DoBlocks;
        do_blocks[1] = run(1, 2) => DoBlocks;
        do_blocks[1] = run(3, 0) => DoBlocks;
    }
}

#[test]
fn an_event_is_a_bit_with_statements() {
    refused! {
        events[0].event = Bit(416) => Events;
        events[0].stored = run(2, 1) => Events;
    }
}

#[test]
fn momentary_statements_write_only_what_is_momentary() {
    refused! {
        targets[0].word = 0 => Momentary;
        targets[0].word = 6 => Momentary;
        targets[0].word = 8 => Momentary;
        momentary[0].targets = run(1, 1) => Momentary;
        dependent[0].owner = Some(Bit(32)) => Momentary;
        dependent[0].statement.targets = run(0, 2) => Momentary;
        dependent[0].statement.condition = 5 => Momentary;
    }
    let momentary = changed(GOOD.momentary, |rows| rows[0].condition = 5);
    let masks = changed(GOOD.masks, |rows| rows[1].varying = 0b001);
    program_refused! { masks = &masks, momentary = &momentary => Momentary; }
}

fn seen(word: u16, bits: u32) -> Option<Seen> {
    Some(Seen { word, bits })
}

#[test]
fn what_is_read_of_the_inputs_counts_as_read() {
    program_refused! {
        read_inputs = &[] => Layout;
        read_inputs = &[0b110] => Terms;
        read_inputs = &[0b101] => Terms;
        read_inputs = &[0b011] => Terms;
    }
    let first_scan = Term {
        word: 0,
        mask: 1,
        state: 1,
    };
    let terms = changed(GOOD.terms, |rows| rows[0] = first_scan);
    program_refused! { terms = &terms => Terms; }
    refused! {
        ops[3] = Op::Bit(Bit(35)) => Codes;
    }
}

#[test]
fn edges_of_inputs_fill_words_of_their_own() {
    refused! {
        edges[0].word = 8 => Watches;
        edges[0].word = 0 => Watches;
        edges[0].last = 0 => Watches;
        edges[0].last = 1 => Watches;
        edges[0].last = 11 => Watches;
        edges[0].last = 13 => Watches;
        edges[0].rises = seen(2, 1) => Watches;
        edges[0].rises = seen(12, 1) => Watches;
        edges[0].rises = seen(1 << 11, 1) => Watches;
        edges[0].rises = seen(11, 0) => Watches;
        edges[0].rises = seen(11, 0b1000) => Watches;
        edges[0].falls = seen(7, 1) => Watches;
        edges[0].falls = seen(9, 1) => Watches;
        edges[0].falls = seen(10, 1) => Watches;
    }
    // Words of the image that are gone.
    layout_refused! { words = 12 => Watches; }
}

#[test]
fn a_stable_evolution_has_no_edges_of_whole_words() {
    let layout = Layout {
        passed: 1,
        ..GOOD.layout
    };
    program_refused! { evolution = Evolution::Stable, layout = layout => Watches; }
}

#[test]
fn edges_and_timers_remember_within_the_memory() {
    let edge = |last, result| Watch::Edge {
        operand: Condition::ALWAYS,
        edge: Edge::Falling,
        last: Bit(last),
        result: Bit(result),
        from_false: true,
    };
    refused! {
        watches[0] = edge(32, 258) => Watches;
        watches[0] = edge(257, 64) => Watches;
        watches[0] = edge(257, 257) => Watches;
        watches[0] = edge(257, 416) => Watches;
        watches[2] = Watch::OnDelay {
            enable: Condition::ALWAYS, delay: FIVE, last: Bit(261), risen: Stamp(4), result: Bit(262),
        } => Watches;
        watches[3] = Watch::OffDelay {
            on: Condition::ALWAYS, hold: Code { start: 0, len: 2 }, last: Bit(261), fallen: Stamp(3), result: Bit(262),
        } => Watches;
        watches[4] = Watch::Value {
            condition: Condition::ALWAYS, gate: Some(Bit(416)), result: Bit(265),
        } => Watches;
        watches[4] = Watch::Value {
            condition: Condition::ALWAYS, gate: None, result: Bit(32),
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
        hierarchy: &[1, 1, 2],
        ..GOOD
    });
}

#[test]
fn a_storage_fits_exactly_its_program() {
    /// Whether storage of these lengths fits.
    macro_rules! fits {
        ($image:literal $numbers:literal $before:literal $before_scan:literal $fired:literal $passed:literal
         $stack:literal $stamps:literal $since:literal $standings:literal $shown:literal $sets:literal
         $armed:literal) => {{
            crate::storage!(Storage {
                image: $image,
                numbers: $numbers,
                before: $before,
                before_scan: $before_scan,
                fired: $fired,
                passed: $passed,
                stack: $stack,
                stamps: $stamps,
                since: $since,
                standings: $standings,
                shown: $shown,
                sets: $sets,
                armed: $armed
            });
            Storage::is_sized_for(&GOOD)
        }};
    }
    assert!(fits!(13 4 5 5 1 0 2 4 2 3 0 0 0));
    assert!(!fits!(12 4 5 5 1 0 2 4 2 3 0 0 0));
    assert!(!fits!(13 3 5 5 1 0 2 4 2 3 0 0 0));
    assert!(!fits!(13 4 4 5 1 0 2 4 2 3 0 0 0));
    assert!(!fits!(13 4 5 4 1 0 2 4 2 3 0 0 0));
    assert!(!fits!(13 4 5 5 2 0 2 4 2 3 0 0 0));
    assert!(!fits!(13 4 5 5 1 1 2 4 2 3 0 0 0));
    assert!(!fits!(13 4 5 5 1 0 1 4 2 3 0 0 0));
    assert!(!fits!(13 4 5 5 1 0 2 5 2 3 0 0 0));
    assert!(!fits!(13 4 5 5 1 0 2 4 1 3 0 0 0));
    assert!(!fits!(13 4 5 5 1 0 2 4 2 2 0 0 0));
    assert!(!fits!(13 4 5 5 1 0 2 4 2 3 1 0 0));
    assert!(!fits!(13 4 5 5 1 0 2 4 2 3 0 1 0));
    assert!(!fits!(13 4 5 5 1 0 2 4 2 3 0 0 8));
}
