//! The limit-deterministic generalised Büchi automaton that everything above uses: total, deterministic but for ε-jumps.

use crate::labels::{Labels, Propositions};
use serde::{Deserialize, Serialize};

/// An automaton state q, a dense index.
pub type StateId = u16;

/// A set of accepting sets: bit `j` stands for F_j (0-based, at most 32 sets).
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Debug, Serialize, Deserialize)]
pub struct Marks(pub u32);

/// A conjunction of literals: the propositions of `positive` hold, those of `negative` do not (disjoint bit masks).
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Debug, Serialize, Deserialize)]
pub struct Cube {
    /// Propositions that must hold.
    pub positive: u64,
    /// Propositions that must not hold.
    pub negative: u64,
}

impl Cube {
    /// Whether `sigma` satisfies every literal.
    pub fn contains(self, sigma: Labels) -> bool {
        sigma.0 & self.positive == self.positive && sigma.0 & self.negative == 0
    }
}

/// A set of letters, as a disjunction of cubes; empty = no letter, one empty cube = every letter.
#[derive(Clone, PartialEq, Eq, Hash, Default, Debug, Serialize, Deserialize)]
pub struct Guard(pub Vec<Cube>);

impl Guard {
    /// Whether `sigma` is one of the letters.
    pub fn contains(&self, sigma: Labels) -> bool {
        self.0.iter().any(|cube| cube.contains(sigma))
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
/// Valid by construction: guards of a state are disjoint and cover all letters.
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

    /// A name of `q` for views; may be empty.
    pub fn name(&self, q: StateId) -> &str {
        &self.names[q as usize]
    }

    /// All states.
    pub fn states(&self) -> impl Iterator<Item = StateId> + use<> {
        0..self.edges.len() as StateId
    }
}
