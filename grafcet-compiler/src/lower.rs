//! From the model to tables: where everything lies, and what is evaluated when.
//!
//! Every program - the controller, each plant, the observer of each test - is lowered by one [`unit::Lowering`]: first
//! its [`places`] are given out, then expressions become conditions and code in its [`pool`], edges and timers become
//! [`watch`]es of the phase in which they stand, and rows refer to all of it.

mod action;
mod atoms;
mod controller;
mod expression;
mod fingerprint;
mod graph;
mod limits;
mod node;
mod observer;
mod places;
mod plant;
mod pool;
mod reads;
mod sequence;
mod structure;
mod symbols;
mod timing;
mod unit;
mod watch;

use crate::application::Application;
use crate::diagnostic::Diagnostic;
use crate::model::Model;

/// Lowers a model without errors. What refuses it here is its size alone.
pub(crate) fn lower(model: &Model) -> Result<Application, Vec<Diagnostic>> {
    let controller = controller::lower(model)?;
    let plants: Vec<plant::Lowered> = model
        .plants()
        .map(|plant| plant::lower(model, plant, &controller.places))
        .collect::<Result<_, _>>()?;
    let tests = model
        .tests
        .iter()
        .map(|test| observer::lower(model, test, &controller.places, &plants))
        .collect::<Result<_, _>>()?;
    Ok(Application {
        name: model.name.clone(),
        text: model.text.clone(),
        controller: controller.unit,
        plants: plants.into_iter().map(|plant| plant.plant).collect(),
        tests,
    })
}
