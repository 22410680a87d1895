//! What constants alone decide: triggers and presets.

use crate::diagnostic::{Diagnostic, Rule};
use crate::model::{
    Expression, ExpressionKind, Inside, Model, System, Transition, Trigger, Type, combine,
};

/// Warns of constant triggers and of presets below the scan period.
pub(super) fn advise(model: &Model, diagnostics: &mut Vec<Diagnostic>) {
    for transition in &model.transitions {
        diagnostics.extend(constant_trigger(model, transition));
    }
    for expression in super::expressions(model) {
        short_presets(model, expression, diagnostics);
    }
}

fn constant_trigger(model: &Model, transition: &Transition) -> Option<Diagnostic> {
    let Trigger::Expression(trigger) = &transition.trigger else {
        return None;
    };
    let number = transition.number;
    let (rule, message, help) = if truth(model, trigger)? {
        (
            Rule::AlwaysFires,
            format!("the trigger of transition {number} is always True"),
            "write `when True`, or leave it out",
        )
    } else {
        (
            Rule::NeverFires,
            format!("the trigger of transition {number} is always False: it never fires"),
            if trigger.contains(|it| matches!(it.kind, ExpressionKind::System(System::FirstScan))) {
                "no transition fires in the first scan: write what happens then as the action of an initial step"
            } else {
                "leave the transition out, or mend its trigger"
            },
        )
    };
    Some(Diagnostic::new(rule, trigger.span, message).help(help))
}

/// Whether a trigger is constant. No trigger is looked at in scan 0, so `System:first_scan` is False in all of them;
/// only edges and timers have seen it.
pub(super) fn truth(model: &Model, trigger: &Expression) -> Option<bool> {
    value(model, trigger).map(|value| value != 0)
}

fn value(model: &Model, expression: &Expression) -> Option<i32> {
    match &expression.kind {
        ExpressionKind::System(System::FirstScan) => Some(0),
        ExpressionKind::Bound(_, inner) => value(model, inner),
        ExpressionKind::Not(inner) => value(model, inner).map(|value| i32::from(value == 0)),
        ExpressionKind::Binary(operator, left, right) => {
            combine(*operator, value(model, left), value(model, right))
        }
        // What never changes has no edge, and what is never True starts no timer.
        ExpressionKind::Edge(_, inner) => inner.constant(model).map(|_| 0),
        ExpressionKind::Timer { enable, .. } | ExpressionKind::Delay { enable, .. } => {
            enable.constant(model).filter(|value| *value == 0)
        }
        _ => expression.constant(model),
    }
}

fn short_presets(model: &Model, expression: &Expression, diagnostics: &mut Vec<Diagnostic>) {
    expression.visit(|expression| {
        let presets = match &expression.kind {
            ExpressionKind::Timer { preset, .. } => vec![preset],
            ExpressionKind::Delay { on, off, .. } => std::iter::once(on).chain(off).collect(),
            _ => Vec::new(),
        };
        for preset in presets {
            diagnostics.extend(short_preset(model, preset));
        }
        Inside::Visit
    });
}

fn short_preset(model: &Model, preset: &Expression) -> Option<Diagnostic> {
    let value = i64::from(preset.constant(model)?);
    let ms = if preset.ty == Some(Type::Int) {
        value * 1000
    } else {
        value
    };
    let period = model.period_ms;
    (ms < i64::from(period)).then(|| {
        let message = format!("a preset of {ms} ms is below the scan period of {period} ms");
        Diagnostic::new(Rule::ShortPreset, preset.span, message)
            .help("the timer goes by whole scans: give it at least one, or scan faster")
    })
}
