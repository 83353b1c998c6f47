//! The limit-deterministic generalised Büchi automaton that everything above uses: total, deterministic but for ε-jumps.

use super::guard::Guard;
use crate::labels::{Labels, Propositions};
use serde::{Deserialize, Serialize};

/// An automaton state q, a dense index.
pub type StateId = u16;

/// A set of accepting sets: bit `j` stands for F_j (0-based, at most 32 sets).
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Debug, Serialize, Deserialize)]
pub struct Marks(pub u32);

impl Marks {
    /// No accepting set.
    pub const NONE: Marks = Marks(0);

    /// Whether accepting set `j` (below 32) is one of them.
    pub fn has(self, j: usize) -> bool {
        self.0 >> j & 1 == 1
    }

    /// The sets of both.
    #[must_use]
    pub fn union(self, other: Marks) -> Marks {
        Marks(self.0 | other.0)
    }

    /// The indices of the sets, ascending.
    pub fn iter(self) -> impl Iterator<Item = usize> {
        (0..32).filter(move |j| self.has(*j))
    }
}

/// Where a letter leads, and the accepting sets the edge belongs to.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
pub struct Edge {
    /// The state reached.
    pub target: StateId,
    /// The accepting sets F_j visited by taking this edge; state-based marks stand on the edges that enter the state.
    pub marks: Marks,
}

/// A limit-deterministic generalised Büchi automaton (Definitions 1–3 of [Cai et al. 2021](crate::bib::Cai2021)).
///
/// Every state has for every letter exactly one [`Edge`]; what non-determinism there is stands in the ε-jumps.
/// Valid by construction ([`Ldgba::new`]): the guards of a state are disjoint and cover all letters; an ε-jump leads from Q_N into
/// Q_D, which has none and is not left; no accepting run stays in Q_N.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Ldgba {
    pub(super) propositions: Propositions,
    pub(super) initial: StateId,
    pub(super) sets: usize,
    /// Per state: guarded edges, disjoint and total.
    pub(super) edges: Vec<Vec<(Guard, Edge)>>,
    /// Per state: targets of ε-jumps.
    pub(super) epsilon: Vec<Vec<StateId>>,
    /// Per state: whether no accepting run starts there (Definition 3).
    pub(super) sinks: Vec<bool>,
    /// Per state: whether it belongs to Q_D.
    pub(super) deterministic: Vec<bool>,
    /// Per state: a name for views, such as the formula that is left; may be empty.
    pub(super) names: Vec<String>,
}

impl Ldgba {
    /// The atomic propositions; letters given to [`Ldgba::edge`] follow their order.
    pub fn propositions(&self) -> &Propositions {
        &self.propositions
    }

    /// The number of states, sinks included.
    pub fn len(&self) -> usize {
        self.edges.len()
    }

    /// Never: there is an initial state.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// q0.
    pub fn initial(&self) -> StateId {
        self.initial
    }

    /// f, the number of accepting sets (at least 1, at most 32).
    pub fn sets(&self) -> usize {
        self.sets
    }

    /// All accepting sets F_0 … F_{f−1}.
    pub fn all_sets(&self) -> Marks {
        Marks(u32::MAX >> (32 - self.sets))
    }

    /// δ(q, σ): the one edge of `q` whose guard has the letter `sigma`.
    pub fn edge(&self, q: StateId, sigma: Labels) -> Edge {
        self.edges[q as usize]
            .iter()
            .find(|(guard, _)| guard.contains(sigma))
            .map(|(_, edge)| *edge)
            .expect("guards cover all letters by construction")
    }

    /// The guarded edges of `q`, disjoint and total.
    pub fn edges(&self, q: StateId) -> &[(Guard, Edge)] {
        &self.edges[q as usize]
    }

    /// The targets of the ε-jumps of `q`; empty in the deterministic part.
    pub fn epsilon(&self, q: StateId) -> &[StateId] {
        &self.epsilon[q as usize]
    }

    /// Whether `q` belongs to a non-accepting sink component (Definition 3): no word is accepted from it.
    pub fn is_sink(&self, q: StateId) -> bool {
        self.sinks[q as usize]
    }

    /// Whether `q` belongs to Q_D: no ε-jump is reachable. All other states are Q_N.
    pub fn is_deterministic(&self, q: StateId) -> bool {
        self.deterministic[q as usize]
    }

    /// A name of `q` for views; may be empty.
    pub fn name(&self, q: StateId) -> &str {
        &self.names[q as usize]
    }

    /// All states.
    pub fn states(&self) -> impl Iterator<Item = StateId> + use<> {
        0..self.edges.len() as StateId
    }
}
