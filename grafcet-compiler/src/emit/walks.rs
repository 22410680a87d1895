//! The walk over the steps of a small program, written out step by step.

use std::ops::Range;

use grafcet_core::program::{Graph, Program};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::activity::{Activity, Together};

/// Steps that are passed over together.
pub const FEW: usize = 4;
/// So many are looked at one by one: mostly one of them is active.
const SOME: usize = 2 * FEW;

/// In which order steps are looked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Walk {
    /// Of each word of situations.
    pub words: Vec<Word>,
}

/// In which order the steps of a word are looked for, by the bits that are theirs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word {
    /// Row of the step that is the lowest bit.
    pub first: u16,
    /// Steps that are never active together with another one of the word: behind an active one nobody looks for others.
    pub alone: Vec<u32>,
    /// Of all others, chains of which one step can be active at a time: behind an active one nobody looks for others
    /// of its chain. Steps that can be active together stay in the order of the source.
    pub chains: Vec<Vec<u32>>,
    /// What [`Compiled::exchanges`](grafcet_core::program::Compiled::exchanges) tells.
    pub exchanges: bool,
}

impl Walk {
    /// Over the steps of a program.
    #[must_use]
    pub fn of(program: &Program<'_>) -> Self {
        let graphs = program.graphs.iter().enumerate();
        let words = graphs.flat_map(|(index, graph)| {
            let activity = Activity::of(program, index, graph);
            let exchanges = firing_exchanges(&activity);
            let together = activity.steps;
            let count = usize::from(graph.steps.len);
            let starts = (0..count).step_by(32);
            let words = starts.map(|start| Word {
                exchanges,
                ..word(&together, graph, start..count.min(start + 32))
            });
            words.collect::<Vec<_>>()
        });
        let words = words.collect();
        Walk { words }
    }
}

/// Whether no transition of a graph enters a step that is active then, but one that it alone leaves.
fn firing_exchanges(activity: &Activity) -> bool {
    let firings = &activity.firings;
    firings.iter().all(|one| {
        one.enters.iter().all(|step| {
            let mut leaving = firings.iter().filter(|it| it.leaves.contains(step));
            match one.leaves.contains(step) {
                true => leaving.all(|it| it.row == one.row),
                false => !one.leaves.iter().all(|it| activity.steps.are(*step, *it)),
            }
        })
    })
}

/// Of some steps of a graph, counted from its first one.
fn word(together: &Together, graph: &Graph, steps: Range<usize>) -> Word {
    let alone = |step: &usize| {
        let mut others = steps.clone().filter(|other| other != step);
        !others.any(|other| together.are(*step, other))
    };
    let (alone, others): (Vec<usize>, Vec<usize>) = steps.clone().partition(alone);
    let bits = |steps: &Vec<usize>| steps.iter().map(|step| (step % 32) as u32).collect();
    Word {
        first: graph.steps.start + steps.start as u16,
        alone: bits(&alone),
        chains: chains(together, &others).iter().map(bits).collect(),
        exchanges: false,
    }
}

/// Parts steps into chains of which one step can be active at a time.
fn chains(together: &Together, steps: &[usize]) -> Vec<Vec<usize>> {
    let mut chains: Vec<Vec<usize>> = Vec::new();
    for &step in steps {
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

/// The items of `Compiled` with which a program is walked over row by row.
pub(super) fn walks(program: &Program<'_>) -> TokenStream {
    let words = Walk::of(program).words;
    let exchanging = words.iter().enumerate().filter(|(_, word)| word.exchanges);
    let exchanging: Vec<Literal> = exchanging
        .map(|(place, _)| Literal::usize_unsuffixed(place))
        .collect();
    let words = words.iter().enumerate().map(|(place, word)| {
        let chains = word.chains.iter();
        let chains = chains.map(|steps| chain(word, steps, TokenStream::new()));
        let visits = chain(word, &word.alone, chains.collect());
        let row = row(place);
        let place = Literal::usize_unsuffixed(place);
        quote! {
            if let Some(block) = PROGRAM.blocks.#row {
                let steps = visit.choose(#place, block);
                #visits
                visit.leave(#place);
            }
        }
    });
    // Where none is, what the trait says stands.
    let exchanges = (!exchanging.is_empty()).then(|| {
        quote! {
            #[inline(always)]
            fn exchanges(&self, place: usize) -> bool {
                matches!(place, #(#exchanging)|*)
            }
        }
    });
    quote! {
        const UNROLLED: bool = true;

        #exchanges

        #[inline(always)]
        fn each_step(&self, visit: &mut impl VisitSteps) {
            #(#words)*
        }
    }
}

/// Visits the one of some steps that is active; when there is none does something else.
fn chain(word: &Word, steps: &[u32], otherwise: TokenStream) -> TokenStream {
    let visits: Vec<Choice> = steps.iter().map(|bit| Choice::step(word, *bit)).collect();
    // With one look several are passed over: to get behind all of them, or where there are many.
    let together = match visits.len() {
        3..=SOME if !otherwise.is_empty() => SOME,
        ..=SOME => 1,
        _ => FEW,
    };
    let groups: Vec<Choice> = visits.chunks(together).filter_map(Choice::one_of).collect();
    choose(&groups, otherwise)
}

/// What is done when a step of a mask is active.
#[derive(Clone)]
struct Choice {
    mask: u32,
    /// The call that gets the only step, if there is but one.
    step: Option<TokenStream>,
    action: TokenStream,
}

impl Choice {
    /// Visits a step.
    fn step(word: &Word, bit: u32) -> Self {
        Choice {
            mask: 1 << bit,
            step: Some(row(usize::from(word.first) + bit as usize)),
            action: quote!(visit.step(step);),
        }
    }

    /// Does that of some which there is a step for: when it is none of the others, it is the last one.
    fn one_of(choices: &[Choice]) -> Option<Self> {
        match choices.split_last() {
            Some((last, others)) if !others.is_empty() => Some(Choice {
                mask: choices.iter().fold(0, |mask, choice| mask | choice.mask),
                step: None,
                action: choose(others, last.unasked()),
            }),
            _ => choices.first().cloned(),
        }
    }

    /// What is done when it is known that the step is active.
    fn unasked(&self) -> TokenStream {
        let action = &self.action;
        match &self.step {
            Some(row) => quote!(if let Some(step) = PROGRAM.steps.#row { #action }),
            None => action.clone(),
        }
    }
}

/// Does the first that there is a step for.
fn choose(choices: &[Choice], otherwise: TokenStream) -> TokenStream {
    choices.iter().rev().fold(otherwise, |rest, choice| {
        let mask = Literal::u32_unsuffixed(choice.mask);
        let step = choice
            .step
            .iter()
            .map(|row| quote!(&& let Some(step) = PROGRAM.steps.#row));
        let action = &choice.action;
        let rest = (!rest.is_empty()).then(|| quote!(else { #rest }));
        quote!(if steps & #mask != 0 #(#step)* { #action } #rest)
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
