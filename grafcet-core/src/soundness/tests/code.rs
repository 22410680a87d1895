//! Conditions and what they point to.

use super::*;

#[test]
fn a_conjunction_looks_at_the_image_and_for_what_can_be() {
    refused! {
        terms[0].word = 13 => Terms;
        terms[0].state = 0b100 => Terms;
    }
}

#[test]
fn a_timer_on_a_step_knows_its_bit_its_stamp_and_its_preset() {
    let preset = Preset::Constant(500);
    let beyond = Preset::Number(Number(4), Unit::Milliseconds);
    let (step, activated, since) = (Bit(64), Stamp(0), Since(1));
    refused! {
        timers[0] = Timer::Any { step: Bit(416), activated, preset } => Timers;
        timers[0] = Timer::Any { step, activated: Stamp(4), preset } => Timers;
        timers[0] = Timer::Any { step, activated, preset: beyond } => Timers;
        timers[2] = Timer::Own { since: Since(2), preset } => Timers;
        timers[2] = Timer::Own { since, preset: beyond } => Timers;
    }
}

#[test]
fn a_condition_stays_within_the_tables() {
    refused! {
        conditions[2] = all(3, 1) => Conditions;
        conditions[2] = only(Rest::Elapsed(3)) => Conditions;
        conditions[2] = only(Rest::Running(3)) => Conditions;
        conditions[2] = only(Rest::Code(3)) => Conditions;
        conditions[2] = only(Rest::Logic(3)) => Conditions;
    }
}

#[test]
fn the_first_condition_always_holds() {
    refused! {
        conditions[0] = all(0, 1) => Conditions;
        conditions[0] = only(Rest::Elapsed(0)) => Conditions;
    }
}

#[test]
fn code_gets_by_with_its_stack() {
    refused! {
        // It leaves two values, takes one that is not there.
        ops[2] = Op::Not => Codes;
        ops[0] = Op::Not => Codes;
        ops[0] = Op::Number(Number(4)) => Codes;
        ops[0] = Op::Bit(Bit(416)) => Codes;
        ops[5] = Op::Elapsed(3) => Codes;
        ops[4] = Op::AndElapsed(3) => Codes;
        ops[3] = Op::AndElapsed(0) => Codes;
        ops[8] = Op::StepTimer { step: Bit(416), activated: Stamp(0), unit: Unit::Seconds } => Codes;
        ops[8] = Op::StepTimer { step: Bit(64), activated: Stamp(4), unit: Unit::Seconds } => Codes;
        codes[0] = Code { start: 0, len: 0 } => Codes;
        codes[0] = Code { start: 0, len: 1 << 15 } => Codes;
        codes[0] = Code { start: u32::MAX, len: 1 } => Codes;
    }
    layout_refused! { stack = 1 => Codes; }
}

#[test]
fn logic_is_code_on_nothing_but_booleans() {
    refused! {
        conditions[4] = only(Rest::Logic(0)) => Conditions;
        conditions[4] = only(Rest::Logic(2)) => Conditions;
        ops[3] = Op::Number(Number(3)) => Conditions;
        ops[3] = Op::Constant(2) => Conditions;
        ops[4] = Op::Negate => Conditions;
        ops[6] = Op::Equal => Conditions;
    }
    for constant in [0, 1] {
        let ops = changed(GOOD.ops, |ops| ops[3] = Op::Constant(constant));
        let program = Program { ops: &ops, ..GOOD };
        assert_eq!(program.unsoundness(), None);
    }
}

/// The good program with logic that works on so many Booleans at once.
fn deep_logic(depth: usize) -> Option<Unsound> {
    let mut ops = GOOD.ops.to_vec();
    ops.extend([Op::Bit(Bit(32))].repeat(depth));
    ops.extend([Op::Or].repeat(depth - 1));
    let codes = changed(GOOD.codes, |codes| {
        codes[1] = Code {
            start: 9,
            len: 2 * depth as u16 - 1,
        };
    });
    let layout = Layout {
        stack: 40,
        ..GOOD.layout
    };
    let program = Program {
        ops: &ops,
        codes: &codes,
        layout,
        ..GOOD
    };
    program.unsoundness()
}

#[test]
fn logic_works_on_32_booleans_at_once_and_no_more() {
    assert_eq!(deep_logic(32), None);
    assert_eq!(deep_logic(33), Some(Unsound::Conditions));
}
