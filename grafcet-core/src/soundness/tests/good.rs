//! One good program that uses every table.

use crate::program::{
    Arm, Armed, Assignment, Bit, Block, Code, Condition, Course, Crossing, Dependent, Duties, Edge,
    Edges, Enclosing, Event, Evolution, Forced, Graph, Layout, Macro, Masks, Momentary, Number,
    NumberRow, Op, Order, Preset, Program, Rest, Retained, Role, Run, Seen, Since, Slot, Stamp,
    Step, Stored, Target, Term, Timer, Transition, Unit, Watch,
};

pub(super) const fn run(start: u16, len: u16) -> Run {
    Run { start, len }
}

/// A condition without terms.
pub(super) const fn only(rest: Rest) -> Condition {
    Condition {
        terms: Run::EMPTY,
        rest,
    }
}

/// A condition of terms alone.
pub(super) const fn all(start: u16, len: u16) -> Condition {
    Condition {
        terms: run(start, len),
        rest: Rest::None,
    }
}

const FREE: NumberRow = NumberRow {
    initial: 0,
    min: i32::MIN,
    max: i32::MAX,
};

const STEP: Step = Step {
    first_arm: 0,
    first_momentary: 0,
    duties: 0,
    arm_count: 0,
    momentary_count: 0,
};

const NOTHING: Duties = Duties {
    stored: Run::EMPTY,
    on_activation: Run::EMPTY,
    on_deactivation: Run::EMPTY,
    on_event: Run::EMPTY,
    orders: Run::EMPTY,
    activated: None,
    since: None,
};

const GRAPH: Graph = Graph {
    steps: Run::EMPTY,
    first_word: 0,
    transitions: Run::EMPTY,
    initial: 0,
    role: 0,
};

const fn block(first: u16) -> Block {
    Block {
        first,
        masks: 0,
        momentary: 0,
    }
}

const fn transition(fires: u16, term: u16, crossing: u16) -> Transition {
    Transition {
        fires,
        term,
        crossing,
    }
}

pub(super) const fn within(leaves: u32, enters: u32) -> Crossing {
    Crossing::Within {
        actions: 0,
        leaves,
        enters,
    }
}

pub(super) const fn across(entrance: Run, exit: Run) -> Crossing {
    Crossing::Across {
        actions: 0,
        entrance,
        exit,
    }
}

/// `x < 5`.
const COMPARED: Condition = only(Rest::Code(0));
pub(super) const FIVE: Code = Code { start: 1, len: 1 };

/// Three steps, one step, and 33 steps.
const STEPS: [Step; 37] = {
    let mut steps = [STEP; 37];
    steps[0] = Step {
        first_arm: 0,
        first_momentary: 0,
        duties: 1,
        arm_count: 1,
        momentary_count: 1,
    };
    steps[1] = Step {
        first_arm: 1,
        duties: 2,
        arm_count: 1,
        ..STEP
    };
    steps[2].duties = 3;
    steps[4].first_arm = 3;
    steps[4].arm_count = 1;
    steps[36].first_arm = 4;
    steps[36].arm_count = 1;
    steps
};

/// Word 0: `System:`; 1: inputs; 2 and 3: the steps of two graphs; 4 and 5: those of a large one; 6: a macro step;
/// 7: a momentary output; 8: variables, results and memories; 9: which sample lies outside its range; 10 to 12: the
/// edges of the inputs.
pub(super) const GOOD: Program<'static> = Program {
    period_ms: 10,
    evolution: Evolution::Scan,
    fingerprint: 1,
    layout: Layout {
        words: 13,
        inputs: run(1, 1),
        situations: run(2, 4),
        macros: run(6, 1),
        momentary: run(7, 1),
        number_inputs: run(2, 1),
        outside: run(9, 1),
        numbers: 4,
        stamps: 4,
        since: 2,
        stack: 2,
        fired: 1,
        passed: 0,
        remembered: 5,
        standings: 3,
        shown: 0,
        sets: 0,
        armed: 0,
        before: 5,
    },
    read_inputs: &[0b111],
    reads_first_scan: false,
    crosses_at_once: false,
    marks_all: true,
    graphs: &[
        Graph {
            steps: run(0, 3),
            first_word: 2,
            transitions: run(0, 2),
            initial: 0,
            role: 1,
        },
        Graph {
            steps: run(3, 1),
            first_word: 3,
            transitions: run(2, 1),
            initial: 1,
            role: 2,
        },
        Graph {
            steps: run(4, 33),
            first_word: 4,
            transitions: run(3, 2),
            initial: 3,
            ..GRAPH
        },
    ],
    roles: &[
        Role::NONE,
        Role {
            self_orders: run(1, 1),
            ..Role::NONE
        },
        Role {
            sources: run(2, 1),
            enclosings: run(0, 1),
            ..Role::NONE
        },
    ],
    hierarchy: &[0, 1, 2],
    blocks: &[
        Block {
            first: 0,
            masks: 1,
            momentary: 0b001,
        },
        block(3),
        block(4),
        block(36),
    ],
    masks: &[
        Masks::NONE,
        Masks {
            timed: 0b001,
            stored: 0b010,
            on_activation: 0,
            on_deactivation: 0b010,
            on_event: 0b010,
            forcing: 0b100,
            varying: 0,
        },
    ],
    actors: &[],
    steps: &STEPS,
    duties: &[
        NOTHING,
        Duties {
            activated: Some(Stamp(0)),
            since: Some(Since(1)),
            ..NOTHING
        },
        Duties {
            stored: run(0, 1),
            on_event: run(0, 1),
            on_deactivation: run(1, 1),
            ..NOTHING
        },
        Duties {
            orders: run(0, 1),
            ..NOTHING
        },
    ],
    macros: &[Macro {
        bit: Bit(192),
        graph: 0,
        steps: run(1, 2),
        activated: None,
    }],
    transitions: &[
        transition(2, 2, 0),
        transition(1, 1, 1),
        transition(0, 1, 2),
        transition(3, 1, 3),
        transition(4, 1, 4),
    ],
    crossings: &[
        within(0b001, 0b010),
        Crossing::Within {
            actions: 1,
            leaves: 0b010,
            enters: 0b101,
        },
        within(0, 0b1),
        across(run(0, 1), run(1, 1)),
        across(run(1, 1), run(0, 1)),
    ],
    do_blocks: &[Run::EMPTY, run(1, 1)],
    links: &[0, 32],
    arms: &[
        Arm {
            transition: 0,
            course: Course::to(1, true),
            shows: 1,
            next: Armed::UNKNOWN,
        },
        Arm::alone(1),
        Arm::alone(2),
        Arm::alone(3),
        Arm::alone(4),
    ],
    situations: &[0b001, 0b1, 0b101, 0b1, 0b0],
    enclosings: &[Enclosing {
        step: Bit(65),
        situation: 1,
        at_start: Some(1),
    }],
    orders: &[
        Order {
            graph: 1,
            by: 0,
            rank: 0,
            situation: Forced::Current,
            condition: Condition::ALWAYS,
        },
        Order {
            graph: 0,
            by: 0,
            rank: 1,
            situation: Forced::Set(2),
            condition: only(Rest::Running(1)),
        },
    ],
    sources: &[1],
    lasting_in_steps: true,
    momentary_varies: true,
    stores_on_change: true,
    stored: &[
        Stored {
            assignment: Assignment::Bit(Bit(256), COMPARED),
            condition: Condition::ALWAYS,
        },
        Stored {
            assignment: Assignment::Number(Number(3), FIVE),
            condition: COMPARED,
        },
    ],
    events: &[Event {
        event: Bit(258),
        stored: run(1, 1),
    }],
    always_stored: Run::EMPTY,
    targets: &[Target {
        word: 7,
        mask: 0b11,
    }],
    momentary: &[Momentary {
        targets: run(0, 1),
        condition: 0,
    }],
    always_momentary: Run::EMPTY,
    dependent: &[Dependent {
        owner: Some(Bit(64)),
        statement: Momentary {
            targets: run(0, 1),
            condition: 1,
        },
    }],
    edges: &[Edges {
        word: 1,
        last: 10,
        rises: Some(Seen { word: 11, bits: 1 }),
        falls: Some(Seen { word: 12, bits: 1 }),
    }],
    watches: &[
        Watch::Edge {
            operand: all(0, 1),
            edge: Edge::Rising,
            last: Bit(257),
            result: Bit(258),
            from_false: false,
        },
        Watch::Timer {
            enable: COMPARED,
            preset: FIVE,
            unit: Unit::Seconds,
            last: Bit(259),
            risen: Stamp(1),
            result: Bit(260),
        },
        Watch::OnDelay {
            enable: Condition::ALWAYS,
            delay: FIVE,
            last: Bit(261),
            risen: Stamp(2),
            result: Bit(262),
        },
        Watch::OffDelay {
            on: Condition::ALWAYS,
            hold: FIVE,
            last: Bit(263),
            fallen: Stamp(3),
            result: Bit(264),
        },
        Watch::Value {
            condition: only(Rest::Code(2)),
            gate: Some(Bit(64)),
            result: Bit(265),
        },
    ],
    trigger_watches: run(0, 2),
    round_watches: Run::EMPTY,
    action_watches: run(2, 3),
    conditions: &[
        Condition::ALWAYS,
        COMPARED,
        all(0, 1),
        only(Rest::Elapsed(0)),
        only(Rest::Logic(1)),
    ],
    terms: &[
        Term {
            word: 1,
            mask: 0b11,
            state: 0b01,
        },
        Term {
            word: 0,
            mask: 0,
            state: 0,
        },
        Term {
            word: 1,
            mask: 0b100,
            state: 0b100,
        },
    ],
    timers: &[
        Timer::Any {
            step: Bit(64),
            activated: Stamp(0),
            preset: Preset::Constant(500),
        },
        Timer::Any {
            step: Bit(192),
            activated: Stamp(3),
            preset: Preset::Number(Number(3), Unit::Seconds),
        },
        Timer::Own {
            since: Since(1),
            preset: Preset::Number(Number(3), Unit::Seconds),
        },
    ],
    codes: &[
        Code { start: 0, len: 3 },
        Code { start: 3, len: 4 },
        Code { start: 7, len: 2 },
    ],
    ops: &[
        Op::Number(Number(3)),
        Op::Constant(5),
        Op::Less,
        Op::Bit(Bit(32)),
        Op::Not,
        Op::Elapsed(0),
        Op::Or,
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
    initially_true: &[Bit(256)],
    retained: &[
        Retained {
            slot: Slot::Bit(Bit(256)),
            key: 1,
        },
        Retained {
            slot: Slot::Number(Number(3)),
            key: 2,
        },
    ],
};
