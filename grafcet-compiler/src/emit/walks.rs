//! The walk over the steps of a small program, written out step by step.

use grafcet_core::program::{Graph, Program};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::activity::{Activity, Together};

/// Steps that are passed over together.
pub const FEW: usize = 4;
/// So many are looked at one by one: mostly one of them is active.
const SOME: usize = 2 * FEW;

/// The items of `Compiled` with which a program is walked over row by row.
pub(super) fn walks(program: &Program<'_>) -> TokenStream {
    let graphs = program.graphs.iter().enumerate();
    let blocks = graphs.flat_map(|(index, graph)| words(program, index, graph));
    quote! {
        const UNROLLED: bool = true;

        #[inline(always)]
        fn each_step(&self, visit: &mut impl VisitSteps) {
            #(#blocks)*
        }
    }
}

/// The walk over the words of a graph.
fn words(program: &Program<'_>, index: usize, graph: &Graph) -> Vec<TokenStream> {
    let together = Activity::of(program, index, graph).steps;
    let first = program.layout.situations.start;
    let words = graph.words().indices().enumerate();
    words
        .map(|(offset, word)| {
            let steps = offset * 32..usize::from(graph.steps.len).min(offset * 32 + 32);
            let alone = |step: &usize| {
                let mut others = steps.clone().filter(|other| other != step);
                !others.any(|other| together.are(*step, other))
            };
            let (alone, others) = steps.clone().partition(alone);
            let chains = chains(&together, others);
            let chains = chains
                .iter()
                .map(|steps| chain(graph, steps, TokenStream::new()));
            let visits = chain(graph, &alone, chains.collect());
            let place = word - usize::from(first);
            let row = row(place);
            let place = Literal::usize_unsuffixed(place);
            quote! {
                if let Some(block) = PROGRAM.blocks.#row {
                    let steps = visit.choose(#place, block);
                    #visits
                    visit.leave(#place);
                }
            }
        })
        .collect()
}

/// Parts steps into chains of which one step can be active at a time: behind an active one nobody looks for another.
/// Steps that can be active together stay in their order.
fn chains(together: &Together, steps: Vec<usize>) -> Vec<Vec<usize>> {
    let mut chains: Vec<Vec<usize>> = Vec::new();
    for step in steps {
        let apart = |chain: &&Vec<usize>| chain.iter().all(|other| !together.are(step, *other));
        let behind = chains.iter().rev().take_while(apart).count();
        let place = chains.len() - behind;
        match chains.get_mut(place) {
            Some(chain) => chain.push(step),
            None => chains.push(vec![step]),
        }
    }
    chains
}

/// Visits the one of some steps that is active, which are counted from the first one of their graph; when there is none
/// does something else.
fn chain(graph: &Graph, steps: &[usize], otherwise: TokenStream) -> TokenStream {
    let visit = |step: &usize| {
        let row = row(usize::from(graph.steps.start) + step);
        let visit = quote! {
            if let Some(step) = PROGRAM.steps.#row {
                visit.step(step);
            }
        };
        (1 << (step % 32), visit)
    };
    let visits: Vec<(u32, TokenStream)> = steps.iter().map(visit).collect();
    if visits.len() <= SOME {
        return choice(&visits, otherwise);
    }
    // With one look several are passed over.
    let groups = visits.chunks(FEW).map(|group| match group {
        [only] => only.clone(),
        group => {
            let mask = group.iter().fold(0, |mask, (bit, _)| mask | bit);
            (mask, choice(group, TokenStream::new()))
        }
    });
    choice(&groups.collect::<Vec<_>>(), otherwise)
}

/// Does the first of what is beside a mask with an active step.
fn choice(choices: &[(u32, TokenStream)], otherwise: TokenStream) -> TokenStream {
    let all = choices.iter().rev();
    all.fold(otherwise, |rest, (mask, what)| {
        let mask = Literal::u32_unsuffixed(*mask);
        let rest = (!rest.is_empty()).then(|| quote!(else { #rest }));
        quote!(if steps & #mask != 0 { #what } #rest)
    })
}

/// The call that gets a row.
fn row(place: usize) -> TokenStream {
    if place == 0 {
        return quote!(first());
    }
    let place = Literal::usize_unsuffixed(place);
    quote!(get(#place))
}
