//! The product of a finite MDP and an automaton, and the maximal probability that the automaton accepts.

use super::arena::{Arena, Transition};
use super::end_components::maximal_end_components;
use super::mdp::Mdp;
use super::reachability::{Interval, maximal_reachability};
use crate::automaton::{Ldgba, StateId};
use crate::labels::Labels;
use std::collections::HashMap;

/// The product has a proposition of the automaton that the MDP does not label its states with.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("the automaton speaks of the proposition `{name}`, which the Markov decision process does not have")]
pub struct UnknownProposition {
    /// The proposition.
    pub name: String,
}

/// The reachable part of MDP × automaton. Transitions carry the accepting sets as marks.
#[derive(Clone, PartialEq, Debug)]
pub struct Product {
    /// The product as an arena.
    pub arena: Arena,
    /// Per state of the arena, (s, q); `None` for the initial state, which has read nothing yet.
    pub states: Vec<Option<(usize, StateId)>>,
    /// All accepting sets, as marks.
    pub all_sets: u64,
}

impl Product {
    /// Builds the product: a transition to s' reads L(s') \[D1\]; an ε-jump stays in s, takes no time and reads nothing. The letter
    /// L(s0) is read on the way from the initial state, where the jumps of q0 are choices as well.
    ///
    /// # Errors
    /// [`UnknownProposition`].
    pub fn new(mdp: &Mdp, automaton: &Ldgba) -> Result<Product, UnknownProposition> {
        let places: Vec<usize> = automaton
            .propositions()
            .iter()
            .map(|name| mdp.propositions().index(name).ok_or_else(|| UnknownProposition { name: name.into() }))
            .collect::<Result<_, _>>()?;
        let letter = |s: usize| {
            let sigma = mdp.labels(s);
            places.iter().enumerate().fold(Labels::EMPTY, |all, (i, place)| all.with(i, sigma.holds(*place)))
        };
        let letters: Vec<Labels> = (0..mdp.len()).map(letter).collect();

        let mut states: Vec<Option<(usize, StateId)>> = vec![None];
        let mut index: HashMap<(usize, StateId), usize> = HashMap::new();
        let mut choices: Vec<Vec<Vec<Transition>>> = Vec::new();
        while choices.len() < states.len() {
            let at = states[choices.len()];
            let mut node = |s: usize, q: StateId| {
                *index.entry((s, q)).or_insert_with(|| {
                    states.push(Some((s, q)));
                    states.len() - 1
                })
            };
            let mut read = |q: StateId, (to, probability): (usize, f64)| {
                let edge = automaton.edge(q, letters[to]);
                Transition { target: node(to, edge.target), probability, marks: edge.marks.0.into() }
            };
            choices.push(match at {
                None => {
                    let jumps = automaton.epsilon(automaton.initial()).iter().copied();
                    std::iter::once(automaton.initial()).chain(jumps).map(|q| vec![read(q, (mdp.initial(), 1.0))]).collect()
                }
                Some((s, q)) => {
                    let mut all: Vec<Vec<Transition>> =
                        mdp.choices(s).iter().map(|list| list.iter().map(|to| read(q, *to)).collect()).collect();
                    let jump = |d: &StateId| vec![Transition { target: node(s, *d), probability: 1.0, marks: 0 }];
                    all.extend(automaton.epsilon(q).iter().map(jump));
                    all
                }
            });
        }
        Ok(Product { arena: Arena { initial: 0, choices }, states, all_sets: automaton.all_sets().0.into() })
    }
}

/// The maximal probability, over all policies, that the run of `mdp` is accepted by `automaton` (the jumps are the policy's), up to
/// `precision`. For an automaton that is good for MDPs ([Hahn et al. 2020](crate::bib::Hahn2020)) it is the maximal probability
/// of the automaton's language.
///
/// Almost surely a run ends in an end component and meets all of it again and again, so it is the probability to reach the end
/// components whose transitions belong to all accepting sets ([Baier & Katoen 2008](crate::bib::BaierKatoen2008), section 10.6.4).
///
/// # Errors
/// [`UnknownProposition`].
pub fn maximal_probability(mdp: &Mdp, automaton: &Ldgba, precision: f64) -> Result<Interval, UnknownProposition> {
    let product = Product::new(mdp, automaton)?;
    let mut goal = vec![false; product.arena.len()];
    for component in maximal_end_components(&product.arena, &|_, _| true) {
        if component.marks(&product.arena) & product.all_sets == product.all_sets {
            component.states.iter().for_each(|s| goal[*s] = true);
        }
    }
    Ok(maximal_reachability(&product.arena, &goal, precision)[product.arena.initial])
}
