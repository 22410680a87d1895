//! The graphs of that controller.

use grafcet_core::program::{
    Arm, Armed, Block, Course, Crossing, Duties, Graph, Masks, Role, Run, Since, Stamp, Step, Term,
    Transition,
};

use super::run;

/// Three steps, one step without an entrance, 33 steps.
pub fn graphs() -> Vec<Graph> {
    let graph = |steps, first_word, transitions, initial, role| Graph {
        steps,
        first_word,
        transitions,
        initial,
        role,
    };
    vec![
        graph(run(0, 3), 2, run(0, 2), 0, 1),
        graph(run(3, 1), 3, run(2, 1), 1, 2),
        graph(run(4, 33), 4, run(3, 2), 3, 0),
    ]
}

pub fn roles() -> Vec<Role> {
    vec![
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
    ]
}

/// The steps of each word; there is a row of the masks for each.
pub const BLOCKS: [(u16, u32); 4] = [(0, 0b111), (3, 0b1), (4, u32::MAX), (36, 0b1)];

pub fn blocks() -> Vec<Block> {
    let blocks = BLOCKS.iter().zip(0..);
    let block = |((first, momentary), masks): (&(u16, u32), u16)| Block {
        first: *first,
        masks,
        momentary: *momentary,
    };
    blocks.map(block).collect()
}

pub fn masks((first, steps): (u16, u32)) -> Masks {
    // The third step only forces.
    let act = if first == 0 { steps & !0b100 } else { steps };
    Masks {
        timed: act,
        stored: act,
        on_activation: act,
        on_deactivation: act,
        on_event: act,
        forcing: steps & !act,
        varying: u32::from(first == 3),
    }
}

pub fn step(index: u16) -> Step {
    let arm = [0, 1, 4, 36].iter().position(|step| *step == index);
    Step {
        first_arm: arm.map_or(0, |place| [0, 1, 3, 4][place]),
        first_momentary: u16::from(index == 3),
        duties: 1 + u16::from(index == 2),
        arm_count: u8::from(arm.is_some()),
        momentary_count: 1,
    }
}

pub fn duties() -> Vec<Duties> {
    let nothing = Duties {
        stored: Run::EMPTY,
        on_activation: Run::EMPTY,
        on_deactivation: Run::EMPTY,
        on_event: Run::EMPTY,
        orders: Run::EMPTY,
        activated: None,
        since: None,
    };
    vec![
        nothing,
        Duties {
            stored: run(0, 1),
            on_activation: run(1, 1),
            on_deactivation: run(0, 2),
            on_event: run(0, 1),
            activated: Some(Stamp(0)),
            since: Some(Since(0)),
            ..nothing
        },
        Duties {
            orders: run(0, 1),
            ..nothing
        },
    ]
}

/// The first terms of the first two transitions.
pub const FIRST_TERMS: [Term; 2] = [
    Term {
        word: 1,
        mask: 0x4000_0001,
        state: 1,
    },
    Term {
        word: 0,
        mask: 0,
        state: 0,
    },
];

pub fn arm(transition: u16) -> Arm {
    match transition {
        // From the first step of the first graph to its second one, and back.
        0 | 1 => Arm {
            transition,
            course: Course::to(1 - transition as u8, false),
            shows: 1,
            next: Armed::by(
                1 - transition,
                &FIRST_TERMS[1 - usize::from(transition)],
                true,
            ),
        },
        _ => Arm::alone(transition),
    }
}

pub fn within(leaves: u32, enters: u32) -> Crossing {
    Crossing::Within {
        actions: 1,
        leaves,
        enters,
    }
}

pub fn across(entrance: u16, exit: u16) -> Crossing {
    Crossing::Across {
        actions: 1,
        entrance: run(entrance, 1),
        exit: run(exit, 1),
    }
}

pub fn transition(crossing: u16, fires: u16) -> Transition {
    Transition {
        fires,
        term: 1 + crossing.min(1),
        crossing,
    }
}
