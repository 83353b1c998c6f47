//! The automaton under construction: states with guarded, marked edges and ε-jumps. Letters without an edge reject.

use super::work::{Stop, Work};
use crate::bdd::{Bdd, Manager, Memo};
use std::hash::Hash;

/// A set of accepting sets, bit j for set j.
pub(super) type MarkSet = u64;

/// An edge.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Arrow {
    pub guard: Bdd,
    pub target: usize,
    pub marks: MarkSet,
}

/// A state.
#[derive(Clone, Debug, Default)]
pub(super) struct State {
    /// Disjoint guards.
    pub edges: Vec<Arrow>,
    /// The states to which an ε-jump leads; empty in the deterministic part.
    pub jumps: Vec<usize>,
    /// The formulas that are left, as states of the unfolding; their conjunction names the state.
    pub left: Vec<Bdd>,
}

/// An automaton with `sets` accepting sets, numbered from 0; with no set, every infinite run is accepting.
#[derive(Clone, Debug, Default)]
pub(super) struct Graph {
    pub states: Vec<State>,
    pub initial: usize,
    pub sets: usize,
}

impl Graph {
    /// All accepting sets.
    pub fn all_sets(&self) -> MarkSet {
        all_sets(self.sets)
    }

    /// The number of ε-jumps.
    pub fn jumps(&self) -> usize {
        self.states.iter().map(|state| state.jumps.len()).sum()
    }

    /// The number of edges.
    pub fn edges(&self) -> usize {
        self.states.iter().map(|state| state.edges.len()).sum()
    }
}

/// The sets 0 … `sets` − 1.
pub(super) fn all_sets(sets: usize) -> MarkSet {
    if sets == 0 { 0 } else { MarkSet::MAX >> (64 - sets) }
}

/// Edges with the same target and marks become one.
pub(super) fn merge_edges(bdd: &mut Manager, edges: Vec<Arrow>) -> Result<Vec<Arrow>, Stop> {
    let mut places: Memo<(usize, MarkSet), usize> = Memo::default();
    let mut merged: Vec<Arrow> = Vec::new();
    for edge in edges {
        match places.get(&(edge.target, edge.marks)) {
            Some(&at) => merged[at].guard = bdd.or(merged[at].guard, edge.guard)?,
            None => {
                places.insert((edge.target, edge.marks), merged.len());
                merged.push(edge);
            }
        }
    }
    Ok(merged)
}

/// The numbers of the states met so far.
pub(super) struct Numbering<S> {
    numbers: Memo<S, usize>,
    states: Vec<S>,
}

impl<S: Clone + Eq + Hash> Numbering<S> {
    pub fn new() -> Numbering<S> {
        Numbering { numbers: Memo::default(), states: Vec::new() }
    }

    /// The number of `state`, which is new if it was not met before.
    pub fn number(&mut self, state: S, work: &mut Work<'_>) -> Result<usize, Stop> {
        if let Some(&known) = self.numbers.get(&state) {
            return Ok(known);
        }
        work.state()?;
        let number = self.states.len();
        self.numbers.insert(state.clone(), number);
        self.states.push(state);
        Ok(number)
    }

    /// The state with that number, if there are so many.
    pub fn get(&self, number: usize) -> Option<&S> {
        self.states.get(number)
    }

    /// How many states were met.
    pub fn len(&self) -> usize {
        self.states.len()
    }
}
