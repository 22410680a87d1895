//! One good program that uses every table.

use crate::program::{
    Assignment, Bit, Code, Condition, Dependent, Edge, Enclosing, Event, Evolution, Forced, Graph,
    Layout, Macro, Momentary, Number, NumberRow, Op, Order, Program, Retained, Run, Slot, Stamp,
    Step, Stored, Term, Transition, Unit, Watch,
};

pub(super) const fn run(start: u16, len: u16) -> Run {
    Run { start, len }
}

const FREE: NumberRow = NumberRow {
    initial: 0,
    min: i32::MIN,
    max: i32::MAX,
};

const STEP: Step = Step {
    transitions: Run::EMPTY,
    momentary: Run::EMPTY,
    stored: Run::EMPTY,
    on_activation: Run::EMPTY,
    on_deactivation: Run::EMPTY,
    on_event: Run::EMPTY,
    orders: Run::EMPTY,
    activated: None,
};

const GRAPH: Graph = Graph {
    steps: Run::EMPTY,
    words: Run::EMPTY,
    transitions: Run::EMPTY,
    sources: Run::EMPTY,
    initial: 0,
    enclosings: Run::EMPTY,
    orders: Run::EMPTY,
    self_orders: Run::EMPTY,
    watches: Run::EMPTY,
    self_watches: Run::EMPTY,
};

/// `x < 5`.
const COMPARED: Condition = Condition::Code(Code { start: 0, len: 3 });
pub(super) const FIVE: Code = Code { start: 1, len: 1 };

/// Word 0: `System:`; 1: an input; 2 and 3: the steps of two graphs; 4: a macro step; 5: a momentary output;
/// 6: variables, results and memories; 7: which sample lies outside its range.
pub(super) const GOOD: Program<'static> = Program {
    period_ms: 10,
    evolution: Evolution::Scan,
    fingerprint: 1,
    layout: Layout {
        words: 8,
        inputs: run(1, 1),
        situations: run(2, 2),
        macros: run(4, 1),
        momentary: run(5, 1),
        number_inputs: run(2, 1),
        outside: run(7, 1),
        numbers: 4,
        stamps: 4,
        stack: 2,
        fired: 1,
    },
    graphs: &[
        Graph {
            steps: run(0, 3),
            words: run(2, 1),
            transitions: run(0, 2),
            initial: 0,
            self_orders: run(1, 1),
            ..GRAPH
        },
        Graph {
            steps: run(3, 1),
            words: run(3, 1),
            transitions: run(2, 1),
            sources: run(2, 1),
            initial: 1,
            enclosings: run(0, 1),
            ..GRAPH
        },
    ],
    hierarchy: &[0, 1],
    steps: &[
        Step {
            transitions: run(0, 1),
            momentary: run(0, 1),
            activated: Some(Stamp(0)),
            ..STEP
        },
        Step {
            transitions: run(1, 1),
            stored: run(0, 1),
            on_event: run(0, 1),
            ..STEP
        },
        Step {
            orders: run(0, 1),
            ..STEP
        },
        STEP,
    ],
    macros: &[Macro {
        bit: Bit(128),
        graph: 0,
        steps: run(1, 2),
        activated: None,
    }],
    transitions: &[
        Transition {
            entrance: run(0, 1),
            exit: run(1, 1),
            trigger: Condition::All(run(0, 1)),
            actions: Run::EMPTY,
        },
        Transition {
            entrance: run(1, 1),
            exit: run(0, 1),
            trigger: COMPARED,
            actions: run(1, 1),
        },
        Transition {
            entrance: Run::EMPTY,
            exit: run(2, 1),
            trigger: Condition::Always,
            actions: Run::EMPTY,
        },
    ],
    links: &[Bit(64), Bit(65), Bit(96), Bit(160)],
    armed_by: &[0, 1, 2],
    situations: &[0b001, 0b1, 0b101],
    enclosings: &[Enclosing {
        step: Bit(65),
        situation: 1,
        at_start: Some(1),
    }],
    orders: &[
        Order {
            graph: 1,
            rank: 0,
            situation: Forced::Current,
            condition: Condition::Always,
        },
        Order {
            graph: 0,
            rank: 1,
            situation: Forced::Set(2),
            condition: Condition::Always,
        },
    ],
    stored: &[
        Stored {
            assignment: Assignment::Bit(Bit(192), COMPARED),
            condition: Condition::Always,
        },
        Stored {
            assignment: Assignment::Number(Number(3), FIVE),
            condition: COMPARED,
        },
    ],
    events: &[Event {
        event: Bit(194),
        stored: run(1, 1),
    }],
    always_stored: Run::EMPTY,
    momentary: &[Momentary {
        targets: run(3, 1),
        condition: Condition::Always,
    }],
    always_momentary: Run::EMPTY,
    dependent: &[Dependent {
        owner: Some(Bit(64)),
        statement: Momentary {
            targets: run(3, 1),
            condition: COMPARED,
        },
    }],
    watches: &[
        Watch::Edge {
            operand: Condition::All(run(0, 1)),
            edge: Edge::Rising,
            last: Bit(193),
            result: Bit(194),
            from_false: false,
        },
        Watch::Timer {
            enable: COMPARED,
            preset: FIVE,
            unit: Unit::Seconds,
            last: Bit(195),
            risen: Stamp(1),
            result: Bit(196),
        },
        Watch::OnDelay {
            enable: Condition::Always,
            delay: FIVE,
            last: Bit(197),
            risen: Stamp(2),
            result: Bit(198),
        },
        Watch::OffDelay {
            on: Condition::Always,
            hold: FIVE,
            last: Bit(199),
            fallen: Stamp(3),
            result: Bit(200),
        },
        Watch::Value {
            condition: Condition::Code(Code { start: 3, len: 2 }),
            gate: Some(Bit(64)),
            result: Bit(201),
        },
    ],
    trigger_watches: run(0, 2),
    round_watches: Run::EMPTY,
    action_watches: run(2, 3),
    terms: &[Term {
        word: 1,
        mask: 0b11,
        state: 0b01,
    }],
    ops: &[
        Op::Number(Number(3)),
        Op::Constant(5),
        Op::Less,
        Op::Constant(2),
        Op::StepTimer {
            step: Bit(64),
            activated: Stamp(0),
            unit: Unit::Seconds,
        },
    ],
    numbers: &[
        FREE,
        FREE,
        FREE,
        NumberRow {
            initial: 1,
            min: 0,
            max: 9,
        },
    ],
    initially_true: &[Bit(192)],
    retained: &[
        Retained {
            slot: Slot::Bit(Bit(192)),
            key: 1,
        },
        Retained {
            slot: Slot::Number(Number(3)),
            key: 2,
        },
    ],
};
