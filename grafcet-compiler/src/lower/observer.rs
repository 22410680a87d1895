//! Tests: their expressions become a program without graphs that follows the others scan for scan.

use std::collections::BTreeSet;

use grafcet_core::program::Slot;

use super::atoms::{Atom, collect, collect_named};
use super::places::{Contents, Places};
use super::plant;
use super::unit::{Kind, Lowering};
use crate::application::{Claim, Observer, Place, Test, TestStep, TestStepKind};
use crate::diagnostic::Diagnostic;
use crate::model::{self, Expression, GraphId, Model, VariableId};

/// What a test can look at.
struct Scene<'s> {
    model: &'s Model,
    controller: &'s Places,
    plants: &'s [plant::Lowered],
}

/// Lowers a test.
pub(super) fn lower(
    model: &Model,
    test: &model::Test,
    controller: &Places,
    plants: &[plant::Lowered],
) -> Result<Test, Vec<Diagnostic>> {
    let scene = Scene {
        model,
        controller,
        plants,
    };
    let mut atoms = BTreeSet::new();
    for expression in test.expressions() {
        collect(model, expression, &mut atoms);
    }
    let contents = Contents {
        inputs: atoms.iter().copied().collect(),
        graphs: Vec::new(),
        variables: Vec::new(),
        momentary: BTreeSet::new(),
    };
    let mut lowering = Lowering::new(model, Kind::Observer, contents);
    let steps = test.steps.iter().filter_map(|step| {
        Some(TestStep {
            kind: scene.step(&step.kind, &mut lowering)?,
            span: step.span,
        })
    });
    let steps = steps.collect();
    let (tables, places) = lowering.finish()?;
    let reads = atoms
        .iter()
        .filter_map(|atom| Some((scene.place(*atom)?, places.slot(*atom)?)));
    Ok(Test {
        name: test.name.clone(),
        plants: test
            .plants
            .iter()
            .filter_map(|plant| scene.plant(*plant))
            .collect(),
        steps,
        observer: Observer {
            reads: reads.collect(),
            tables,
        },
        span: test.span,
    })
}

impl Scene<'_> {
    fn step(&self, step: &model::TestStepKind, lowering: &mut Lowering) -> Option<TestStepKind> {
        let mut claim = |expression: &Expression| self.claim(expression, lowering);
        Some(match step {
            model::TestStepKind::Set(pairs) => {
                let pairs = pairs.iter();
                TestStepKind::Set(
                    pairs
                        .filter_map(|(id, value)| Some((self.variable(*id)?, *value)))
                        .collect(),
                )
            }
            model::TestStepKind::Release(names) => {
                TestStepKind::Release(names.iter().filter_map(|id| self.variable(*id)).collect())
            }
            model::TestStepKind::Pulse(id, ms) => TestStepKind::Pulse {
                place: self.variable(*id)?,
                ms: *ms,
            },
            model::TestStepKind::Wait(ms) => TestStepKind::Wait { ms: *ms },
            model::TestStepKind::WaitScans(scans) => TestStepKind::WaitScans(*scans),
            model::TestStepKind::WaitUntil(expression, within_ms) => TestStepKind::WaitUntil {
                claim: claim(expression),
                within_ms: *within_ms,
            },
            model::TestStepKind::Expect(expression) => TestStepKind::Expect(claim(expression)),
            model::TestStepKind::Never(expression) => TestStepKind::Never(claim(expression)),
            model::TestStepKind::Always(expression) => TestStepKind::Always(claim(expression)),
            model::TestStepKind::PowerCycle => TestStepKind::PowerCycle,
        })
    }

    fn claim(&self, expression: &Expression, lowering: &mut Lowering) -> Claim {
        let mut atoms = BTreeSet::new();
        collect_named(self.model, expression, &mut atoms);
        let mentions = atoms.into_iter();
        let mentions = mentions.filter_map(|atom| Some((atom.name(self.model), self.place(atom)?)));
        Claim {
            mentions: mentions.collect(),
            result: lowering.claim(expression),
        }
    }

    fn variable(&self, id: VariableId) -> Option<Place> {
        self.place(Atom::Variable(id))
    }

    /// Where something lies, in the controller or in a plant.
    fn place(&self, atom: Atom) -> Option<Place> {
        let owner = match atom {
            Atom::System(_) => None,
            Atom::Variable(id) => self.model[id].owner,
            Atom::Step(id) => Some(self.model[id].graph),
            Atom::Macro(id) => Some(self.model[id].graph),
        };
        let plant = owner.and_then(|owner| self.plant(owner));
        let in_plant = |index: usize| -> Option<Slot> { self.plants.get(index)?.places.slot(atom) };
        match plant {
            Some(index) => in_plant(index).map(|slot| Place::Plant(index, slot)),
            None => self.controller.slot(atom).map(Place::Controller),
        }
    }

    fn plant(&self, graph: GraphId) -> Option<usize> {
        // Plants are lowered in the order of the model.
        let found = self
            .plants
            .binary_search_by_key(&graph, |plant| plant.graph);
        found.ok()
    }
}
