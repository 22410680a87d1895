use grafcet_core::program::*;
/// The program.
pub static PROGRAM: Program<'static> = Program {
    period_ms: 10,
    evolution: Evolution::Scan,
    fingerprint: 4276993775,
    layout: Layout {
        words: 13,
        inputs: Run { start: 1, len: 1 },
        situations: Run { start: 2, len: 4 },
        macros: Run { start: 6, len: 1 },
        momentary: Run { start: 7, len: 1 },
        number_inputs: Run { start: 2, len: 1 },
        outside: Run { start: 9, len: 1 },
        numbers: 4,
        stamps: 4,
        since: 1,
        stack: 2,
        fired: 1,
        passed: 0,
        before: 5,
        remembered: 5,
        standings: 3,
        shown: 0,
        sets: 0,
        armed: 0,
    },
    read_inputs: &[3221225473],
    reads_first_scan: true,
    crosses_at_once: false,
    marks_all: true,
    graphs: &[
        Graph {
            steps: Run { start: 0, len: 3 },
            first_word: 2,
            transitions: Run { start: 0, len: 2 },
            initial: 0,
            role: 1,
        },
        Graph {
            steps: Run { start: 3, len: 1 },
            first_word: 3,
            transitions: Run { start: 2, len: 1 },
            initial: 1,
            role: 2,
        },
        Graph {
            steps: Run { start: 4, len: 33 },
            first_word: 4,
            transitions: Run { start: 3, len: 2 },
            initial: 3,
            role: 0,
        },
    ],
    roles: &[
        Role {
            sources: Run::EMPTY,
            enclosings: Run::EMPTY,
            orders: Run::EMPTY,
            self_orders: Run::EMPTY,
            watches: Run::EMPTY,
            self_watches: Run::EMPTY,
        },
        Role {
            sources: Run::EMPTY,
            enclosings: Run::EMPTY,
            orders: Run::EMPTY,
            self_orders: Run { start: 1, len: 1 },
            watches: Run::EMPTY,
            self_watches: Run::EMPTY,
        },
        Role {
            sources: Run { start: 2, len: 1 },
            enclosings: Run { start: 0, len: 1 },
            orders: Run::EMPTY,
            self_orders: Run::EMPTY,
            watches: Run::EMPTY,
            self_watches: Run::EMPTY,
        },
    ],
    hierarchy: &[0, 1, 2],
    blocks: &[
        Block {
            first: 0,
            masks: 0,
            momentary: 7,
        },
        Block {
            first: 3,
            masks: 1,
            momentary: 1,
        },
        Block {
            first: 4,
            masks: 2,
            momentary: 4294967295,
        },
        Block {
            first: 36,
            masks: 3,
            momentary: 1,
        },
    ],
    masks: &[
        Masks {
            timed: 3,
            stored: 3,
            on_activation: 3,
            on_deactivation: 3,
            on_event: 3,
            forcing: 4,
            varying: 0,
        },
        Masks {
            timed: 1,
            stored: 1,
            on_activation: 1,
            on_deactivation: 1,
            on_event: 1,
            forcing: 0,
            varying: 1,
        },
        Masks {
            timed: 4294967295,
            stored: 4294967295,
            on_activation: 4294967295,
            on_deactivation: 4294967295,
            on_event: 4294967295,
            forcing: 0,
            varying: 0,
        },
        Masks {
            timed: 1,
            stored: 1,
            on_activation: 1,
            on_deactivation: 1,
            on_event: 1,
            forcing: 0,
            varying: 0,
        },
    ],
    actors: &[
        Actors {
            momentary: 1,
            masks: Masks {
                timed: 1,
                stored: 1,
                on_activation: 1,
                on_deactivation: 1,
                on_event: 1,
                forcing: 1,
                varying: 1,
            },
        },
    ],
    steps: &[
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 1,
            momentary_count: 1,
        },
        Step {
            first_arm: 1,
            first_momentary: 0,
            duties: 1,
            arm_count: 1,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 2,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 1,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 3,
            first_momentary: 0,
            duties: 1,
            arm_count: 1,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 0,
            first_momentary: 0,
            duties: 1,
            arm_count: 0,
            momentary_count: 1,
        },
        Step {
            first_arm: 4,
            first_momentary: 0,
            duties: 1,
            arm_count: 1,
            momentary_count: 1,
        },
    ],
    duties: &[
        Duties {
            stored: Run::EMPTY,
            on_activation: Run::EMPTY,
            on_deactivation: Run::EMPTY,
            on_event: Run::EMPTY,
            orders: Run::EMPTY,
            activated: None,
            since: None,
        },
        Duties {
            stored: Run { start: 0, len: 1 },
            on_activation: Run { start: 1, len: 1 },
            on_deactivation: Run { start: 0, len: 2 },
            on_event: Run { start: 0, len: 1 },
            orders: Run::EMPTY,
            activated: Some(Stamp(0)),
            since: Some(Since(0)),
        },
        Duties {
            stored: Run::EMPTY,
            on_activation: Run::EMPTY,
            on_deactivation: Run::EMPTY,
            on_event: Run::EMPTY,
            orders: Run { start: 0, len: 1 },
            activated: None,
            since: None,
        },
    ],
    macros: &[
        Macro {
            bit: Bit(192),
            graph: 0,
            steps: Run { start: 1, len: 2 },
            activated: None,
        },
    ],
    transitions: &[
        Transition {
            fires: 1,
            term: 1,
            crossing: 0,
        },
        Transition {
            fires: 2,
            term: 2,
            crossing: 1,
        },
        Transition {
            fires: 0,
            term: 2,
            crossing: 2,
        },
        Transition {
            fires: 3,
            term: 2,
            crossing: 3,
        },
        Transition {
            fires: 4,
            term: 2,
            crossing: 4,
        },
    ],
    crossings: &[
        Crossing::Within {
            actions: 1,
            leaves: 1,
            enters: 2,
        },
        Crossing::Within {
            actions: 1,
            leaves: 2,
            enters: 1,
        },
        Crossing::Within {
            actions: 1,
            leaves: 0,
            enters: 1,
        },
        Crossing::Across {
            actions: 1,
            entrance: Run { start: 0, len: 1 },
            exit: Run { start: 1, len: 1 },
        },
        Crossing::Across {
            actions: 1,
            entrance: Run { start: 1, len: 1 },
            exit: Run { start: 0, len: 1 },
        },
    ],
    do_blocks: &[Run::EMPTY, Run { start: 1, len: 1 }],
    links: &[0, 32],
    arms: &[
        Arm {
            transition: 0,
            course: Course(63),
            shows: 1,
            next: Armed(3145770),
        },
        Arm {
            transition: 1,
            course: Course(32),
            shows: 1,
            next: Armed(135266315),
        },
        Arm {
            transition: 2,
            course: Course(255),
            shows: 0,
            next: Armed(4194282),
        },
        Arm {
            transition: 3,
            course: Course(255),
            shows: 0,
            next: Armed(4194282),
        },
        Arm {
            transition: 4,
            course: Course(255),
            shows: 0,
            next: Armed(4194282),
        },
    ],
    situations: &[1, 1, 5, 1, 0],
    enclosings: &[
        Enclosing {
            step: Bit(65),
            situation: 1,
            at_start: Some(1),
        },
    ],
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
            condition: Condition::ALWAYS,
        },
    ],
    sources: &[1],
    lasting_in_steps: true,
    momentary_varies: true,
    stores_on_change: true,
    stored: &[
        Stored {
            assignment: Assignment::Bit(
                Bit(256),
                Condition {
                    terms: Run::EMPTY,
                    rest: Rest::Code(0),
                },
            ),
            condition: Condition::ALWAYS,
        },
        Stored {
            assignment: Assignment::Number(Number(3), Code { start: 1, len: 1 }),
            condition: Condition {
                terms: Run::EMPTY,
                rest: Rest::Code(0),
            },
        },
    ],
    events: &[
        Event {
            event: Bit(258),
            stored: Run { start: 1, len: 1 },
        },
    ],
    always_stored: Run { start: 0, len: 1 },
    targets: &[
        Target {
            word: 7,
            mask: 2147483649,
        },
    ],
    momentary: &[
        Momentary {
            targets: Run { start: 0, len: 1 },
            condition: 0,
        },
        Momentary {
            targets: Run { start: 0, len: 1 },
            condition: 1,
        },
    ],
    always_momentary: Run::EMPTY,
    dependent: &[
        Dependent {
            owner: Some(Bit(64)),
            statement: Momentary {
                targets: Run { start: 0, len: 1 },
                condition: 2,
            },
        },
        Dependent {
            owner: None,
            statement: Momentary {
                targets: Run { start: 0, len: 1 },
                condition: 5,
            },
        },
    ],
    edges: &[
        Edges {
            word: 1,
            last: 10,
            rises: Some(Seen { word: 11, bits: 1 }),
            falls: Some(Seen { word: 12, bits: 2147483648 }),
        },
    ],
    watches: &[
        Watch::Edge {
            operand: Condition {
                terms: Run { start: 0, len: 1 },
                rest: Rest::Logic(1),
            },
            edge: Edge::Rising,
            last: Bit(257),
            result: Bit(258),
            from_false: true,
        },
        Watch::Edge {
            operand: Condition {
                terms: Run { start: 0, len: 1 },
                rest: Rest::Logic(1),
            },
            edge: Edge::Falling,
            last: Bit(259),
            result: Bit(260),
            from_false: false,
        },
        Watch::Timer {
            enable: Condition {
                terms: Run::EMPTY,
                rest: Rest::Code(0),
            },
            preset: Code { start: 1, len: 1 },
            unit: Unit::Seconds,
            last: Bit(261),
            risen: Stamp(1),
            result: Bit(262),
        },
        Watch::OnDelay {
            enable: Condition::ALWAYS,
            delay: Code { start: 1, len: 1 },
            last: Bit(263),
            risen: Stamp(2),
            result: Bit(264),
        },
        Watch::OffDelay {
            on: Condition::ALWAYS,
            hold: Code { start: 1, len: 1 },
            last: Bit(265),
            fallen: Stamp(3),
            result: Bit(266),
        },
        Watch::Value {
            condition: Condition::ALWAYS,
            gate: Some(Bit(64)),
            result: Bit(267),
        },
    ],
    trigger_watches: Run { start: 0, len: 2 },
    round_watches: Run { start: 2, len: 1 },
    action_watches: Run { start: 3, len: 3 },
    conditions: &[
        Condition::ALWAYS,
        Condition {
            terms: Run { start: 0, len: 1 },
            rest: Rest::Logic(1),
        },
        Condition {
            terms: Run::EMPTY,
            rest: Rest::Code(0),
        },
        Condition {
            terms: Run::EMPTY,
            rest: Rest::Elapsed(0),
        },
        Condition {
            terms: Run::EMPTY,
            rest: Rest::Running(1),
        },
        Condition {
            terms: Run::EMPTY,
            rest: Rest::Code(2),
        },
    ],
    terms: &[
        Term {
            word: 1,
            mask: 2147483649,
            state: 1,
        },
        Term {
            word: 1,
            mask: 1073741825,
            state: 1,
        },
        Term { word: 0, mask: 0, state: 0 },
    ],
    timers: &[
        Timer::Any {
            step: Bit(64),
            activated: Stamp(0),
            preset: Preset::Constant(500),
        },
        Timer::Any {
            step: Bit(64),
            activated: Stamp(0),
            preset: Preset::Number(Number(3), Unit::Seconds),
        },
        Timer::Own {
            since: Since(0),
            preset: Preset::Constant(10),
        },
    ],
    codes: &[
        Code { start: 0, len: 3 },
        Code { start: 3, len: 4 },
        Code { start: 7, len: 37 },
    ],
    ops: &[
        Op::Number(Number(3)),
        Op::Constant(5),
        Op::Less,
        Op::Bit(Bit(32)),
        Op::Not,
        Op::Elapsed(1),
        Op::Or,
        Op::Constant(-2147483648),
        Op::Constant(-1),
        Op::And,
        Op::Constant(-1),
        Op::Or,
        Op::Constant(-1),
        Op::Xor,
        Op::Constant(-1),
        Op::Add,
        Op::Constant(-1),
        Op::Subtract,
        Op::Constant(-1),
        Op::Multiply,
        Op::Constant(-1),
        Op::Divide,
        Op::Constant(-1),
        Op::Modulo,
        Op::Constant(-1),
        Op::Equal,
        Op::Constant(-1),
        Op::NotEqual,
        Op::Constant(-1),
        Op::Less,
        Op::Constant(-1),
        Op::LessOrEqual,
        Op::Constant(-1),
        Op::Greater,
        Op::Constant(-1),
        Op::GreaterOrEqual,
        Op::Not,
        Op::Negate,
        Op::StepTimer {
            step: Bit(64),
            activated: Stamp(0),
            unit: Unit::Milliseconds,
        },
        Op::StepTimer {
            step: Bit(64),
            activated: Stamp(0),
            unit: Unit::Seconds,
        },
        Op::Bit(Bit(0)),
        Op::And,
        Op::Not,
        Op::AndElapsed(2),
    ],
    numbers: &[
        NumberRow {
            initial: 0,
            min: -2147483648,
            max: 2147483647,
        },
        NumberRow {
            initial: 0,
            min: 0,
            max: 0,
        },
        NumberRow {
            initial: -5,
            min: -7,
            max: -1,
        },
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
            key: 4294967295,
        },
        Retained {
            slot: Slot::Number(Number(3)),
            key: 2,
        },
    ],
};
#[allow(long_running_const_eval)]
const _: () = grafcet_core::soundness::demand(&PROGRAM);
/// The program for an engine that is compiled for it alone.
#[derive(Clone, Copy, Debug)]
pub struct ThisProgram;
impl Compiled for ThisProgram {
    #[inline(always)]
    fn program(&self) -> &Program<'_> {
        &PROGRAM
    }
    const UNROLLED: bool = true;
    #[inline(always)]
    fn exchanges(&self, place: usize) -> bool {
        matches!(place, 0 | 2 | 3)
    }
    #[inline(always)]
    fn each_step(&self, visit: &mut impl VisitSteps) {
        if let Some(block) = PROGRAM.blocks.first() {
            let steps = visit.choose(0, block);
            if steps & 1 != 0 && let Some(step) = PROGRAM.steps.first() {
                visit.step(step);
            } else {
                if steps & 2 != 0 && let Some(step) = PROGRAM.steps.get(1) {
                    visit.step(step);
                }
            }
            if steps & 4 != 0 && let Some(step) = PROGRAM.steps.get(2) {
                visit.step(step);
            }
            visit.leave(0);
        }
        if let Some(block) = PROGRAM.blocks.get(1) {
            let steps = visit.choose(1, block);
            if steps & 1 != 0 && let Some(step) = PROGRAM.steps.get(3) {
                visit.step(step);
            }
            visit.leave(1);
        }
        if let Some(block) = PROGRAM.blocks.get(2) {
            let steps = visit.choose(2, block);
            if steps & 15 != 0 {
                if steps & 1 != 0 && let Some(step) = PROGRAM.steps.get(4) {
                    visit.step(step);
                } else {
                    if steps & 2 != 0 && let Some(step) = PROGRAM.steps.get(5) {
                        visit.step(step);
                    } else {
                        if steps & 4 != 0 && let Some(step) = PROGRAM.steps.get(6) {
                            visit.step(step);
                        } else {
                            if let Some(step) = PROGRAM.steps.get(7) {
                                visit.step(step);
                            }
                        }
                    }
                }
            } else {
                if steps & 240 != 0 {
                    if steps & 16 != 0 && let Some(step) = PROGRAM.steps.get(8) {
                        visit.step(step);
                    } else {
                        if steps & 32 != 0 && let Some(step) = PROGRAM.steps.get(9) {
                            visit.step(step);
                        } else {
                            if steps & 64 != 0 && let Some(step) = PROGRAM.steps.get(10)
                            {
                                visit.step(step);
                            } else {
                                if let Some(step) = PROGRAM.steps.get(11) {
                                    visit.step(step);
                                }
                            }
                        }
                    }
                } else {
                    if steps & 3840 != 0 {
                        if steps & 256 != 0 && let Some(step) = PROGRAM.steps.get(12) {
                            visit.step(step);
                        } else {
                            if steps & 512 != 0 && let Some(step) = PROGRAM.steps.get(13)
                            {
                                visit.step(step);
                            } else {
                                if steps & 1024 != 0
                                    && let Some(step) = PROGRAM.steps.get(14)
                                {
                                    visit.step(step);
                                } else {
                                    if let Some(step) = PROGRAM.steps.get(15) {
                                        visit.step(step);
                                    }
                                }
                            }
                        }
                    } else {
                        if steps & 61440 != 0 {
                            if steps & 4096 != 0
                                && let Some(step) = PROGRAM.steps.get(16)
                            {
                                visit.step(step);
                            } else {
                                if steps & 8192 != 0
                                    && let Some(step) = PROGRAM.steps.get(17)
                                {
                                    visit.step(step);
                                } else {
                                    if steps & 16384 != 0
                                        && let Some(step) = PROGRAM.steps.get(18)
                                    {
                                        visit.step(step);
                                    } else {
                                        if let Some(step) = PROGRAM.steps.get(19) {
                                            visit.step(step);
                                        }
                                    }
                                }
                            }
                        } else {
                            if steps & 983040 != 0 {
                                if steps & 65536 != 0
                                    && let Some(step) = PROGRAM.steps.get(20)
                                {
                                    visit.step(step);
                                } else {
                                    if steps & 131072 != 0
                                        && let Some(step) = PROGRAM.steps.get(21)
                                    {
                                        visit.step(step);
                                    } else {
                                        if steps & 262144 != 0
                                            && let Some(step) = PROGRAM.steps.get(22)
                                        {
                                            visit.step(step);
                                        } else {
                                            if let Some(step) = PROGRAM.steps.get(23) {
                                                visit.step(step);
                                            }
                                        }
                                    }
                                }
                            } else {
                                if steps & 15728640 != 0 {
                                    if steps & 1048576 != 0
                                        && let Some(step) = PROGRAM.steps.get(24)
                                    {
                                        visit.step(step);
                                    } else {
                                        if steps & 2097152 != 0
                                            && let Some(step) = PROGRAM.steps.get(25)
                                        {
                                            visit.step(step);
                                        } else {
                                            if steps & 4194304 != 0
                                                && let Some(step) = PROGRAM.steps.get(26)
                                            {
                                                visit.step(step);
                                            } else {
                                                if let Some(step) = PROGRAM.steps.get(27) {
                                                    visit.step(step);
                                                }
                                            }
                                        }
                                    }
                                } else {
                                    if steps & 251658240 != 0 {
                                        if steps & 16777216 != 0
                                            && let Some(step) = PROGRAM.steps.get(28)
                                        {
                                            visit.step(step);
                                        } else {
                                            if steps & 33554432 != 0
                                                && let Some(step) = PROGRAM.steps.get(29)
                                            {
                                                visit.step(step);
                                            } else {
                                                if steps & 67108864 != 0
                                                    && let Some(step) = PROGRAM.steps.get(30)
                                                {
                                                    visit.step(step);
                                                } else {
                                                    if let Some(step) = PROGRAM.steps.get(31) {
                                                        visit.step(step);
                                                    }
                                                }
                                            }
                                        }
                                    } else {
                                        if steps & 4026531840 != 0 {
                                            if steps & 268435456 != 0
                                                && let Some(step) = PROGRAM.steps.get(32)
                                            {
                                                visit.step(step);
                                            } else {
                                                if steps & 536870912 != 0
                                                    && let Some(step) = PROGRAM.steps.get(33)
                                                {
                                                    visit.step(step);
                                                } else {
                                                    if steps & 1073741824 != 0
                                                        && let Some(step) = PROGRAM.steps.get(34)
                                                    {
                                                        visit.step(step);
                                                    } else {
                                                        if let Some(step) = PROGRAM.steps.get(35) {
                                                            visit.step(step);
                                                        }
                                                    }
                                                }
                                            }
                                        }
                                    }
                                }
                            }
                        }
                    }
                }
            }
            visit.leave(2);
        }
        if let Some(block) = PROGRAM.blocks.get(3) {
            let steps = visit.choose(3, block);
            if steps & 1 != 0 && let Some(step) = PROGRAM.steps.get(36) {
                visit.step(step);
            }
            visit.leave(3);
        }
    }
}
/// What the program calls its things.
pub static NAMES: Names<'static> = Names {
    application: "every_row",
    graphs: &["G", "H", "I"],
    steps: &["1", "E2", "S3", "1", "1"],
    transitions: &[1, 2, 7, 8, 9],
    retained: &["Locked", "G:température"],
};
grafcet_core::storage!(
    Storage { image : 13, numbers : 4, before : 5, before_scan : 5, fired : 1, passed :
    0, stack : 2, stamps : 4, since : 1, standings : 3, shown : 0, sets : 0, armed : 0 }
);
const _: () = assert!(Storage::is_sized_for(& PROGRAM));
/// The plants, with the wires between their images and the controller's.
pub static PLANTS: [PlantTables; 1] = [
    PlantTables {
        name: "Mirror",
        program: Program {
            period_ms: 10,
            evolution: Evolution::Stable,
            fingerprint: 4276993775,
            layout: Layout {
                words: 13,
                inputs: Run { start: 1, len: 1 },
                situations: Run { start: 2, len: 4 },
                macros: Run { start: 6, len: 1 },
                momentary: Run { start: 7, len: 1 },
                number_inputs: Run { start: 2, len: 1 },
                outside: Run { start: 9, len: 1 },
                numbers: 4,
                stamps: 4,
                since: 1,
                stack: 2,
                fired: 1,
                passed: 1,
                before: 5,
                remembered: 5,
                standings: 3,
                shown: 0,
                sets: 0,
                armed: 0,
            },
            read_inputs: &[3221225473],
            reads_first_scan: true,
            crosses_at_once: false,
            marks_all: true,
            graphs: &[
                Graph {
                    steps: Run { start: 0, len: 3 },
                    first_word: 2,
                    transitions: Run { start: 0, len: 2 },
                    initial: 0,
                    role: 1,
                },
                Graph {
                    steps: Run { start: 3, len: 1 },
                    first_word: 3,
                    transitions: Run { start: 2, len: 1 },
                    initial: 1,
                    role: 2,
                },
                Graph {
                    steps: Run { start: 4, len: 33 },
                    first_word: 4,
                    transitions: Run { start: 3, len: 2 },
                    initial: 3,
                    role: 0,
                },
            ],
            roles: &[
                Role {
                    sources: Run::EMPTY,
                    enclosings: Run::EMPTY,
                    orders: Run::EMPTY,
                    self_orders: Run::EMPTY,
                    watches: Run::EMPTY,
                    self_watches: Run::EMPTY,
                },
                Role {
                    sources: Run::EMPTY,
                    enclosings: Run::EMPTY,
                    orders: Run::EMPTY,
                    self_orders: Run { start: 1, len: 1 },
                    watches: Run::EMPTY,
                    self_watches: Run::EMPTY,
                },
                Role {
                    sources: Run { start: 2, len: 1 },
                    enclosings: Run { start: 0, len: 1 },
                    orders: Run::EMPTY,
                    self_orders: Run::EMPTY,
                    watches: Run::EMPTY,
                    self_watches: Run::EMPTY,
                },
            ],
            hierarchy: &[0, 1, 2],
            blocks: &[
                Block {
                    first: 0,
                    masks: 0,
                    momentary: 7,
                },
                Block {
                    first: 3,
                    masks: 1,
                    momentary: 1,
                },
                Block {
                    first: 4,
                    masks: 2,
                    momentary: 4294967295,
                },
                Block {
                    first: 36,
                    masks: 3,
                    momentary: 1,
                },
            ],
            masks: &[
                Masks {
                    timed: 3,
                    stored: 3,
                    on_activation: 3,
                    on_deactivation: 3,
                    on_event: 3,
                    forcing: 4,
                    varying: 0,
                },
                Masks {
                    timed: 1,
                    stored: 1,
                    on_activation: 1,
                    on_deactivation: 1,
                    on_event: 1,
                    forcing: 0,
                    varying: 1,
                },
                Masks {
                    timed: 4294967295,
                    stored: 4294967295,
                    on_activation: 4294967295,
                    on_deactivation: 4294967295,
                    on_event: 4294967295,
                    forcing: 0,
                    varying: 0,
                },
                Masks {
                    timed: 1,
                    stored: 1,
                    on_activation: 1,
                    on_deactivation: 1,
                    on_event: 1,
                    forcing: 0,
                    varying: 0,
                },
            ],
            actors: &[
                Actors {
                    momentary: 1,
                    masks: Masks {
                        timed: 1,
                        stored: 1,
                        on_activation: 1,
                        on_deactivation: 1,
                        on_event: 1,
                        forcing: 1,
                        varying: 1,
                    },
                },
            ],
            steps: &[
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 1,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 1,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 1,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 2,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 1,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 3,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 1,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 0,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 0,
                    momentary_count: 1,
                },
                Step {
                    first_arm: 4,
                    first_momentary: 0,
                    duties: 1,
                    arm_count: 1,
                    momentary_count: 1,
                },
            ],
            duties: &[
                Duties {
                    stored: Run::EMPTY,
                    on_activation: Run::EMPTY,
                    on_deactivation: Run::EMPTY,
                    on_event: Run::EMPTY,
                    orders: Run::EMPTY,
                    activated: None,
                    since: None,
                },
                Duties {
                    stored: Run { start: 0, len: 1 },
                    on_activation: Run { start: 1, len: 1 },
                    on_deactivation: Run { start: 0, len: 2 },
                    on_event: Run { start: 0, len: 1 },
                    orders: Run::EMPTY,
                    activated: Some(Stamp(0)),
                    since: Some(Since(0)),
                },
                Duties {
                    stored: Run::EMPTY,
                    on_activation: Run::EMPTY,
                    on_deactivation: Run::EMPTY,
                    on_event: Run::EMPTY,
                    orders: Run { start: 0, len: 1 },
                    activated: None,
                    since: None,
                },
            ],
            macros: &[
                Macro {
                    bit: Bit(192),
                    graph: 0,
                    steps: Run { start: 1, len: 2 },
                    activated: None,
                },
            ],
            transitions: &[
                Transition {
                    fires: 1,
                    term: 1,
                    crossing: 0,
                },
                Transition {
                    fires: 2,
                    term: 2,
                    crossing: 1,
                },
                Transition {
                    fires: 0,
                    term: 2,
                    crossing: 2,
                },
                Transition {
                    fires: 3,
                    term: 2,
                    crossing: 3,
                },
                Transition {
                    fires: 4,
                    term: 2,
                    crossing: 4,
                },
            ],
            crossings: &[
                Crossing::Within {
                    actions: 1,
                    leaves: 1,
                    enters: 2,
                },
                Crossing::Within {
                    actions: 1,
                    leaves: 2,
                    enters: 1,
                },
                Crossing::Within {
                    actions: 1,
                    leaves: 0,
                    enters: 1,
                },
                Crossing::Across {
                    actions: 1,
                    entrance: Run { start: 0, len: 1 },
                    exit: Run { start: 1, len: 1 },
                },
                Crossing::Across {
                    actions: 1,
                    entrance: Run { start: 1, len: 1 },
                    exit: Run { start: 0, len: 1 },
                },
            ],
            do_blocks: &[Run::EMPTY, Run { start: 1, len: 1 }],
            links: &[0, 32],
            arms: &[
                Arm {
                    transition: 0,
                    course: Course(63),
                    shows: 1,
                    next: Armed(3145770),
                },
                Arm {
                    transition: 1,
                    course: Course(32),
                    shows: 1,
                    next: Armed(135266315),
                },
                Arm {
                    transition: 2,
                    course: Course(255),
                    shows: 0,
                    next: Armed(4194282),
                },
                Arm {
                    transition: 3,
                    course: Course(255),
                    shows: 0,
                    next: Armed(4194282),
                },
                Arm {
                    transition: 4,
                    course: Course(255),
                    shows: 0,
                    next: Armed(4194282),
                },
            ],
            situations: &[1, 1, 5, 1, 0],
            enclosings: &[
                Enclosing {
                    step: Bit(65),
                    situation: 1,
                    at_start: Some(1),
                },
            ],
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
                    condition: Condition::ALWAYS,
                },
            ],
            sources: &[1],
            lasting_in_steps: true,
            momentary_varies: true,
            stores_on_change: true,
            stored: &[
                Stored {
                    assignment: Assignment::Bit(
                        Bit(256),
                        Condition {
                            terms: Run::EMPTY,
                            rest: Rest::Code(0),
                        },
                    ),
                    condition: Condition::ALWAYS,
                },
                Stored {
                    assignment: Assignment::Number(Number(3), Code { start: 1, len: 1 }),
                    condition: Condition {
                        terms: Run::EMPTY,
                        rest: Rest::Code(0),
                    },
                },
            ],
            events: &[
                Event {
                    event: Bit(258),
                    stored: Run { start: 1, len: 1 },
                },
            ],
            always_stored: Run { start: 0, len: 1 },
            targets: &[
                Target {
                    word: 7,
                    mask: 2147483649,
                },
            ],
            momentary: &[
                Momentary {
                    targets: Run { start: 0, len: 1 },
                    condition: 0,
                },
                Momentary {
                    targets: Run { start: 0, len: 1 },
                    condition: 1,
                },
            ],
            always_momentary: Run::EMPTY,
            dependent: &[
                Dependent {
                    owner: Some(Bit(64)),
                    statement: Momentary {
                        targets: Run { start: 0, len: 1 },
                        condition: 2,
                    },
                },
                Dependent {
                    owner: None,
                    statement: Momentary {
                        targets: Run { start: 0, len: 1 },
                        condition: 5,
                    },
                },
            ],
            edges: &[],
            watches: &[
                Watch::Edge {
                    operand: Condition {
                        terms: Run { start: 0, len: 1 },
                        rest: Rest::Logic(1),
                    },
                    edge: Edge::Rising,
                    last: Bit(257),
                    result: Bit(258),
                    from_false: true,
                },
                Watch::Edge {
                    operand: Condition {
                        terms: Run { start: 0, len: 1 },
                        rest: Rest::Logic(1),
                    },
                    edge: Edge::Falling,
                    last: Bit(259),
                    result: Bit(260),
                    from_false: false,
                },
                Watch::Timer {
                    enable: Condition {
                        terms: Run::EMPTY,
                        rest: Rest::Code(0),
                    },
                    preset: Code { start: 1, len: 1 },
                    unit: Unit::Seconds,
                    last: Bit(261),
                    risen: Stamp(1),
                    result: Bit(262),
                },
                Watch::OnDelay {
                    enable: Condition::ALWAYS,
                    delay: Code { start: 1, len: 1 },
                    last: Bit(263),
                    risen: Stamp(2),
                    result: Bit(264),
                },
                Watch::OffDelay {
                    on: Condition::ALWAYS,
                    hold: Code { start: 1, len: 1 },
                    last: Bit(265),
                    fallen: Stamp(3),
                    result: Bit(266),
                },
                Watch::Value {
                    condition: Condition::ALWAYS,
                    gate: Some(Bit(64)),
                    result: Bit(267),
                },
            ],
            trigger_watches: Run { start: 0, len: 2 },
            round_watches: Run { start: 2, len: 1 },
            action_watches: Run { start: 3, len: 3 },
            conditions: &[
                Condition::ALWAYS,
                Condition {
                    terms: Run { start: 0, len: 1 },
                    rest: Rest::Logic(1),
                },
                Condition {
                    terms: Run::EMPTY,
                    rest: Rest::Code(0),
                },
                Condition {
                    terms: Run::EMPTY,
                    rest: Rest::Elapsed(0),
                },
                Condition {
                    terms: Run::EMPTY,
                    rest: Rest::Running(1),
                },
                Condition {
                    terms: Run::EMPTY,
                    rest: Rest::Code(2),
                },
            ],
            terms: &[
                Term {
                    word: 1,
                    mask: 2147483649,
                    state: 1,
                },
                Term {
                    word: 1,
                    mask: 1073741825,
                    state: 1,
                },
                Term { word: 0, mask: 0, state: 0 },
            ],
            timers: &[
                Timer::Any {
                    step: Bit(64),
                    activated: Stamp(0),
                    preset: Preset::Constant(500),
                },
                Timer::Any {
                    step: Bit(64),
                    activated: Stamp(0),
                    preset: Preset::Number(Number(3), Unit::Seconds),
                },
                Timer::Own {
                    since: Since(0),
                    preset: Preset::Constant(10),
                },
            ],
            codes: &[
                Code { start: 0, len: 3 },
                Code { start: 3, len: 4 },
                Code { start: 7, len: 37 },
            ],
            ops: &[
                Op::Number(Number(3)),
                Op::Constant(5),
                Op::Less,
                Op::Bit(Bit(32)),
                Op::Not,
                Op::Elapsed(1),
                Op::Or,
                Op::Constant(-2147483648),
                Op::Constant(-1),
                Op::And,
                Op::Constant(-1),
                Op::Or,
                Op::Constant(-1),
                Op::Xor,
                Op::Constant(-1),
                Op::Add,
                Op::Constant(-1),
                Op::Subtract,
                Op::Constant(-1),
                Op::Multiply,
                Op::Constant(-1),
                Op::Divide,
                Op::Constant(-1),
                Op::Modulo,
                Op::Constant(-1),
                Op::Equal,
                Op::Constant(-1),
                Op::NotEqual,
                Op::Constant(-1),
                Op::Less,
                Op::Constant(-1),
                Op::LessOrEqual,
                Op::Constant(-1),
                Op::Greater,
                Op::Constant(-1),
                Op::GreaterOrEqual,
                Op::Not,
                Op::Negate,
                Op::StepTimer {
                    step: Bit(64),
                    activated: Stamp(0),
                    unit: Unit::Milliseconds,
                },
                Op::StepTimer {
                    step: Bit(64),
                    activated: Stamp(0),
                    unit: Unit::Seconds,
                },
                Op::Bit(Bit(0)),
                Op::And,
                Op::Not,
                Op::AndElapsed(2),
            ],
            numbers: &[
                NumberRow {
                    initial: 0,
                    min: -2147483648,
                    max: 2147483647,
                },
                NumberRow {
                    initial: 0,
                    min: 0,
                    max: 0,
                },
                NumberRow {
                    initial: -5,
                    min: -7,
                    max: -1,
                },
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
                    key: 4294967295,
                },
                Retained {
                    slot: Slot::Number(Number(3)),
                    key: 2,
                },
            ],
        },
        reads: &[(Slot::Bit(Bit(224)), Slot::Bit(Bit(32)))],
        writes: &[(Slot::Number(Number(3)), Slot::Number(Number(2)))],
    },
];
