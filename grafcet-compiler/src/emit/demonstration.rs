//! The test that shows an application at work on a host, as Rust source.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::rows::Row;
use crate::application::{Application, Claim, Place, Test, TestStep, TestStepKind};
use crate::source::{Sources, Span};

/// The name of the test that demonstrates an application.
const NAME: &str = "demonstration";

/// `DEMONSTRATION`: the test of that name, if there is one. `script` is a module of the image.
#[must_use]
pub fn demonstration(application: &Application, sources: &Sources) -> TokenStream {
    let test = application.tests.iter().find(|test| test.name == NAME);
    let script = match test {
        Some(test) => {
            let script = script(test, sources);
            quote!(Some(#script))
        }
        None => quote!(None),
    };
    quote! {
        /// What shows the application at work.
        pub static DEMONSTRATION: Option<script::Script> = #script;
    }
}

fn script(test: &Test, sources: &Sources) -> TokenStream {
    let plants = test.plants.iter().map(|it| Literal::usize_unsuffixed(*it));
    let steps = test.steps.iter().map(|step| {
        let (comment, text) = (comment(step.span, sources), text(step.span, sources));
        let kind = kind(step);
        quote!(script::Step { comment: #comment, text: #text, kind: #kind })
    });
    let observer = test.observer.tables.literal();
    let reads = test.observer.reads.iter().map(|(from, to)| {
        let (from, to) = (place(*from), to.literal());
        quote!((#from, #to))
    });
    quote! {
        script::Script {
            plants: &[#(#plants),*],
            steps: &[#(#steps),*],
            observer: #observer,
            reads: &[#(#reads),*],
        }
    }
}

fn kind(step: &TestStep) -> TokenStream {
    match &step.kind {
        TestStepKind::Set(values) => {
            let values = values.iter().map(|(at, value)| {
                let (at, value) = (place(*at), value.literal());
                quote!((#at, #value))
            });
            quote!(script::StepKind::Set(&[#(#values),*]))
        }
        TestStepKind::Release(places) => {
            let places = places.iter().map(|it| place(*it));
            quote!(script::StepKind::Release(&[#(#places),*]))
        }
        TestStepKind::Pulse { place: at, ms } => {
            let (at, ms) = (place(*at), ms.literal());
            quote!(script::StepKind::Pulse { place: #at, ms: #ms })
        }
        TestStepKind::Wait { ms } => {
            let ms = ms.literal();
            quote!(script::StepKind::Wait { ms: #ms })
        }
        TestStepKind::WaitScans(scans) => {
            let scans = scans.literal();
            quote!(script::StepKind::WaitScans(#scans))
        }
        TestStepKind::WaitUntil { claim, within_ms } => {
            let (result, within_ms) = (result(claim), within_ms.literal());
            quote!(script::StepKind::WaitUntil { result: #result, within_ms: #within_ms })
        }
        TestStepKind::Expect(claim) => claimed(&quote!(Expect), claim),
        TestStepKind::Never(claim) => claimed(&quote!(Never), claim),
        TestStepKind::Always(claim) => claimed(&quote!(Always), claim),
        TestStepKind::PowerCycle => quote!(script::StepKind::PowerCycle),
    }
}

fn claimed(kind: &TokenStream, claim: &Claim) -> TokenStream {
    let result = result(claim);
    quote!(script::StepKind::#kind(#result))
}

fn result(claim: &Claim) -> TokenStream {
    claim.result.literal()
}

fn place(place: Place) -> TokenStream {
    match place {
        Place::Controller(slot) => {
            let slot = slot.literal();
            quote!(script::Place::Controller(#slot))
        }
        Place::Plant(index, slot) => {
            let (index, slot) = (Literal::usize_unsuffixed(index), slot.literal());
            quote!(script::Place::Plant(#index, #slot))
        }
    }
}

/// The comment above a step; empty when there is none.
fn comment(span: Span, sources: &Sources) -> String {
    let whole = sources
        .get(span.file)
        .map_or("", |source| source.text.as_str());
    let before = whole.get(..span.start as usize).unwrap_or("");
    let mut lines: Vec<&str> = before
        .lines()
        .rev()
        .skip(usize::from(!before.ends_with('\n')))
        .map_while(|line| line.trim().strip_prefix("//"))
        .map(str::trim)
        .collect();
    lines.reverse();
    lines.join(" ")
}

/// A step as it is written, on one line.
fn text(span: Span, sources: &Sources) -> String {
    let words: Vec<&str> = sources.text(span).split_whitespace().collect();
    words.join(" ")
}
