//! Where everything lies: bits of the image and numbers, in the order of [`Layout`].

use std::collections::{BTreeMap, BTreeSet};

use grafcet_core::program::{Bit, Layout, Number, NumberRow, Run, Slot};

use super::atoms::Atom;
use super::limits::index;
use crate::model::{GraphId, Model, System, Type, VariableId};

/// Bits of one word of the image.
const WORD: usize = 32;

/// What a program holds.
pub(super) struct Contents {
    /// What comes in from outside, in order.
    pub inputs: Vec<Atom>,
    /// Its graphs.
    pub graphs: Vec<GraphId>,
    /// Its own outputs, variables and parameters, in order.
    pub variables: Vec<VariableId>,
    /// Those of them that are the object of momentary actions.
    pub momentary: BTreeSet<VariableId>,
}

/// Where things lie.
#[derive(Default)]
pub(super) struct Places {
    slots: BTreeMap<Atom, Slot>,
    /// Words of each graph's situation, in the order of the graphs.
    pub situations: Vec<Run>,
    /// All but what grows while expressions are lowered.
    pub layout: Layout,
    /// The numbers.
    pub numbers: Vec<NumberRow>,
    /// Booleans with the initial value True.
    pub initially_true: Vec<Bit>,
    /// The first bit behind everything.
    pub next_bit: usize,
}

impl Places {
    /// Gives everything a place.
    pub fn new(model: &Model, contents: &Contents) -> Places {
        let mut places = Places {
            next_bit: WORD,
            ..Places::default()
        };
        places.take_system();
        places.take_inputs(model, &contents.inputs);
        places.take_situations(model, &contents.graphs);
        places.take_variables(model, contents);
        let outside = usize::from(places.layout.number_inputs.len);
        places.layout.outside = places.section(|places| places.next_bit += outside);
        places
    }

    /// Where something lies, if it belongs to this program.
    pub fn slot(&self, atom: Atom) -> Option<Slot> {
        self.slots.get(&atom).copied()
    }

    /// The bit of a Boolean; a model without errors asks only for what there is.
    pub fn bit(&self, atom: Atom) -> Bit {
        match self.slot(atom) {
            Some(Slot::Bit(bit)) => bit,
            _ => Bit(u16::MAX),
        }
    }

    fn take_system(&mut self) {
        for system in System::ALL {
            let slot = match system {
                System::FirstScan => Slot::Bit(Bit::FIRST_SCAN),
                System::Unstable => Slot::Bit(Bit::UNSTABLE),
                System::Recovered => Slot::Bit(Bit::RECOVERED),
                System::Overruns => Slot::Number(Number::OVERRUNS),
                System::ArithmeticFaults => Slot::Number(Number::ARITHMETIC_FAULTS),
            };
            self.slots.insert(Atom::System(system), slot);
        }
        let unlimited = NumberRow {
            initial: 0,
            min: i32::MIN,
            max: i32::MAX,
        };
        self.numbers = vec![unlimited; 2];
    }

    fn take_inputs(&mut self, model: &Model, inputs: &[Atom]) {
        self.layout.inputs = self.section(|places| {
            for atom in inputs {
                if atom.ty(model) == Type::Bool {
                    let bit = places.bit_here();
                    places.slots.insert(*atom, Slot::Bit(bit));
                }
            }
        });
        let start = self.numbers.len();
        for atom in inputs {
            if atom.ty(model) != Type::Bool {
                self.number(model, *atom);
            }
        }
        self.layout.number_inputs = Run {
            start: index(start),
            len: index(self.numbers.len() - start),
        };
    }

    fn take_situations(&mut self, model: &Model, graphs: &[GraphId]) {
        self.layout.situations = self.section(|places| {
            for &graph in graphs {
                let words = places.section(|places| {
                    for step in model[graph].step_ids() {
                        let bit = places.bit_here();
                        places.slots.insert(Atom::Step(step), Slot::Bit(bit));
                    }
                });
                places.situations.push(words);
            }
        });
        self.layout.macros = self.section(|places| {
            for id in graphs.iter().flat_map(|graph| model[*graph].macro_ids()) {
                let bit = places.bit_here();
                places.slots.insert(Atom::Macro(id), Slot::Bit(bit));
            }
        });
    }

    fn take_variables(&mut self, model: &Model, contents: &Contents) {
        let (momentary, others): (Vec<VariableId>, Vec<VariableId>) = contents
            .variables
            .iter()
            .partition(|id| contents.momentary.contains(id));
        self.section(|places| {
            for &id in &others {
                match model[id].ty {
                    Type::Bool => places.variable_bit(model, id),
                    Type::Int | Type::Time => places.number(model, Atom::Variable(id)),
                }
            }
        });
        self.layout.momentary = self.section(|places| {
            for &id in &momentary {
                places.variable_bit(model, id);
            }
        });
    }

    fn variable_bit(&mut self, model: &Model, id: VariableId) {
        let bit = self.bit_here();
        self.slots.insert(Atom::Variable(id), Slot::Bit(bit));
        if model[id].first_value() != 0 {
            self.initially_true.push(bit);
        }
    }

    fn number(&mut self, model: &Model, atom: Atom) {
        let number = Number(index(self.numbers.len()));
        self.slots.insert(atom, Slot::Number(number));
        let (min, max, initial) = match atom {
            Atom::Variable(id) => {
                let (min, max) = model[id].limits();
                (min, max, model[id].first_value())
            }
            _ => (i32::MIN, i32::MAX, 0),
        };
        self.numbers.push(NumberRow { initial, min, max });
    }

    fn bit_here(&mut self) -> Bit {
        let bit = Bit(index(self.next_bit));
        self.next_bit += 1;
        bit
    }

    /// Whole words with what the filler puts there.
    fn section(&mut self, fill: impl FnOnce(&mut Self)) -> Run {
        let start = self.next_bit / WORD;
        fill(self);
        self.next_bit = self.next_bit.next_multiple_of(WORD);
        Run {
            start: index(start),
            len: index(self.next_bit / WORD - start),
        }
    }
}
