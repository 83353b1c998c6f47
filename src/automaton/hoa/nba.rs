//! The automaton as the text gives it: non-deterministic, perhaps incomplete, marks on edges, labels as sets of letters.

use super::super::guard::Guard;
use super::super::ldgba::Marks;
use crate::labels::Propositions;
use crate::ltl::Span;

/// An edge with a label.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct NbaEdge {
    pub guard: Guard,
    pub target: usize,
    pub marks: Marks,
    pub span: Span,
}

/// A state.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct NbaState {
    pub name: String,
    pub span: Span,
    pub edges: Vec<NbaEdge>,
    /// Targets of edges without a label beside edges with one.
    pub epsilon: Vec<usize>,
}

/// A non-deterministic generalised Büchi automaton with ε-edges.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Nba {
    pub propositions: Propositions,
    /// f ≥ 1; a condition without sets has become one set on every edge.
    pub sets: usize,
    pub states: Vec<NbaState>,
    pub starts: Vec<usize>,
}

impl Nba {
    /// All accepting sets.
    pub fn all_sets(&self) -> Marks {
        Marks(u32::MAX >> (32 - self.sets))
    }
}
