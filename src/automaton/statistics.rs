//! The size of an automaton in numbers.

use super::ldgba::{Ldgba, StateId};
use serde::Serialize;

/// What a summary tells of an automaton.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
pub struct Statistics {
    /// All states.
    pub states: usize,
    /// States that cannot be reached from the initial one.
    pub unreachable: usize,
    /// States from which nothing is accepted.
    pub sinks: usize,
    /// States of Q_N: those from which an ε-jump can be reached.
    pub nondeterministic: usize,
    /// Edges with a letter; all letters with the same target and marks are one.
    pub edges: usize,
    /// ε-jumps.
    pub epsilon: usize,
    /// f, the number of accepting sets.
    pub sets: usize,
    /// Atomic propositions.
    pub propositions: usize,
    /// Whether there is no ε-jump.
    pub deterministic: bool,
    /// Whether acceptance is state-based: all edges into a state belong to the same accepting sets.
    pub state_based: bool,
    /// Whether nothing at all is accepted.
    pub empty_language: bool,
}

impl Ldgba {
    /// The numbers of a summary.
    pub fn statistics(&self) -> Statistics {
        let count = |test: &dyn Fn(StateId) -> bool| self.states().filter(|q| test(*q)).count();
        let nondeterministic = count(&|q| !self.is_deterministic(q));
        Statistics {
            states: self.len(),
            unreachable: self.reachable().into_iter().filter(|reachable| !reachable).count(),
            sinks: count(&|q| self.is_sink(q)),
            nondeterministic,
            edges: self.states().map(|q| self.edges(q).len()).sum(),
            epsilon: self.states().map(|q| self.epsilon(q).len()).sum(),
            sets: self.sets(),
            propositions: self.propositions().len(),
            deterministic: nondeterministic == 0,
            state_based: self.is_state_based(),
            empty_language: self.is_sink(self.initial()),
        }
    }
}
