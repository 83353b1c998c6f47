//! The memory that turns an automaton state into an embedded state (q, T, T_Φ): which accepting sets and which states are still
//! to be visited.
//!
//! T is the tracking frontier of equation 1 and Definition 4 of [Cai et al. 2021](crate::bib::Cai2021), T_Φ the automaton
//! frontier of its equation 9. Both are functions of the run so far and belong to the state, so that reward and shaping
//! are functions of the state alone \[D4\].
//!
//! **\[D2\] The frontier rule.** Taken to the letter, equation 1 leaves T = ∅ after a round, and the next visit to an accepting set
//! refills T without being accepting itself. With one accepting set that rewards one visit ever; with two it makes F_1^P
//! transient under the run 1, 2, 1, 2, …, against the paper's own Lemma 1. [`FrontierRule::Refill`] refills at once, by the visit
//! that empties T; [`FrontierRule::Printed`] is the letter. Of the sets that this visit belongs to, only those that it took from T
//! are left out of the new T. Leaving out all of them would break Lemma 1 again where accepting sets overlap: visits to
//! {F_1, F_3} and {F_1, F_2} in turn would never find F_1 in T. As it is, every set is taken from T at least once between one
//! refilling visit and the next, both included, which proves the lemma.
//!
//! **Order** (Algorithm 2, lines 10–12): what a visit earns is decided by T and T_Φ from before it; then T ← f_V, then T_Φ ← f_Φ.
//! Where the cases of f_Φ overlap (q' ∈ T_Φ and B), the reset goes first: the text resets T_Φ whenever B becomes true.

use super::ldgba::{Ldgba, Marks, StateId};
use crate::labels::Labels;
use serde::{Deserialize, Serialize};
use std::collections::HashSet;
use std::sync::Arc;

/// A set of automaton states below [`StateSet::CAPACITY`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Debug, Serialize, Deserialize)]
pub struct StateSet([u64; 4]);

impl StateSet {
    /// States 0 … 255 fit.
    pub const CAPACITY: usize = 256;
    /// The set without a state.
    pub const EMPTY: StateSet = StateSet([0; 4]);

    /// Whether `q` is in the set; false for states beyond the capacity.
    pub fn contains(self, q: StateId) -> bool {
        self.0.get(q as usize / 64).is_some_and(|word| word >> (q % 64) & 1 == 1)
    }

    /// The set and `q`.
    ///
    /// # Panics
    /// If `q` is not below [`StateSet::CAPACITY`].
    #[must_use]
    pub fn with(mut self, q: StateId) -> StateSet {
        self.0[q as usize / 64] |= 1 << (q % 64);
        self
    }

    /// The set but for `q`.
    #[must_use]
    pub fn without(mut self, q: StateId) -> StateSet {
        if let Some(word) = self.0.get_mut(q as usize / 64) {
            *word &= !(1 << (q % 64));
        }
        self
    }

    /// How many states are in the set.
    pub fn len(self) -> usize {
        self.0.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// Whether no state is in the set.
    pub fn is_empty(self) -> bool {
        self == StateSet::EMPTY
    }

    /// The states, rising.
    pub fn iter(self) -> impl Iterator<Item = StateId> {
        (0..StateSet::CAPACITY as StateId).filter(move |&q| self.contains(q))
    }
}

/// The embedded automaton state (q, T, T_Φ): everything of a product state x = (s, q, T, T_Φ) but s.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Serialize, Deserialize)]
pub struct EmbeddedState {
    /// The automaton state q.
    pub q: StateId,
    /// T: the accepting sets whose next visit is accepting. Always F under [`FrontierRule::Standard`].
    pub frontier: Marks,
    /// T_Φ: the automaton states not visited yet in this round; empty where [`StateTracking::Off`].
    pub unvisited: StateSet,
}

/// How T is updated when accepting sets are visited.
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FrontierRule {
    /// The visit that empties T ends the round: B is true and T becomes F without the sets that this visit took from T, or all
    /// of F if that is empty. T is never empty. \[D2\]
    #[default]
    Refill,
    /// Equation 1 of [Cai et al. 2021](crate::bib::Cai2021) to the letter: T stays empty until the next visit, which refills it
    /// and is not accepting.
    Printed,
    /// No T at all, the standard product MDP: every visit to an accepting set is accepting and counts as B.
    Standard,
}

/// Whether T_Φ is kept. Only shaping reads it; without shaping it would only multiply the embedded states.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StateTracking {
    /// T_Φ stays empty.
    #[default]
    Off,
    /// T_Φ is kept; the automaton may have at most [`StateSet::CAPACITY`] states.
    On,
}

/// What one letter or one ε-jump does to an embedded state.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Succession {
    /// The embedded state reached.
    pub to: EmbeddedState,
    /// All accepting sets F_j the edge belongs to.
    pub visited: Marks,
    /// Those of them that were in T before the visit: the j for which the state reached is in F_j^P (Definition 4).
    pub fresh: Marks,
    /// B of equation 1: T has come round, and T_Φ is reset.
    pub refilled: bool,
}

/// An automaton with its memory: the pure successor function on embedded states.
#[derive(Clone, Debug)]
pub struct Embedding {
    automaton: Arc<Ldgba>,
    rule: FrontierRule,
    tracking: StateTracking,
    start: EmbeddedState,
}

/// Why an automaton cannot be embedded.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EmbeddingError {
    /// T_Φ is asked for, and the automaton has more states than a [`StateSet`] holds.
    #[error(
        "the automaton has {states} states; keeping track of visited states (needed by reward shaping) allows at most {}",
        StateSet::CAPACITY
    )]
    TooManyStates {
        /// How many states there are.
        states: usize,
    },
}

impl Embedding {
    /// Gives `automaton` its memory.
    ///
    /// # Errors
    /// [`EmbeddingError::TooManyStates`] for more than [`StateSet::CAPACITY`] states under [`StateTracking::On`].
    pub fn new(automaton: Arc<Ldgba>, rule: FrontierRule, tracking: StateTracking) -> Result<Embedding, EmbeddingError> {
        let mut unvisited = StateSet::EMPTY;
        if tracking == StateTracking::On {
            if automaton.len() > StateSet::CAPACITY {
                return Err(EmbeddingError::TooManyStates { states: automaton.len() });
            }
            // T_Φ0 = Q \ ({q0} ∪ Q_sink).
            for q in automaton.states().filter(|&q| q != automaton.initial() && !automaton.is_sink(q)) {
                unvisited = unvisited.with(q);
            }
        }
        let start = EmbeddedState { q: automaton.initial(), frontier: automaton.all_sets(), unvisited };
        Ok(Embedding { automaton, rule, tracking, start })
    }

    /// The automaton.
    pub fn automaton(&self) -> &Arc<Ldgba> {
        &self.automaton
    }

    /// How T is updated.
    pub fn rule(&self) -> FrontierRule {
        self.rule
    }

    /// Whether T_Φ is kept.
    pub fn tracking(&self) -> StateTracking {
        self.tracking
    }

    /// (q0, T_0 = F, T_Φ0), before the first letter.
    pub fn start(&self) -> EmbeddedState {
        self.start
    }

    /// Reads the letter `sigma` (bits as in [`Ldgba::propositions`]) at `at`.
    pub fn read(&self, at: EmbeddedState, sigma: Labels) -> Succession {
        let edge = self.automaton.edge(at.q, sigma);
        self.visit(at, edge.target, edge.marks)
    }

    /// Takes the ε-jump from `at` to `target`: no letter is read, and no accepting set is visited.
    ///
    /// # Panics
    /// If the automaton has no ε-jump from `at.q` to `target`.
    pub fn jump(&self, at: EmbeddedState, target: StateId) -> Succession {
        assert!(self.automaton.epsilon(at.q).contains(&target), "there is no ε-jump from {} to {target}", at.q);
        self.visit(at, target, Marks(0))
    }

    /// f_V (equation 1) for a visit to all sets of `visited` at once: the new T, and B.
    pub fn update_frontier(&self, visited: Marks, frontier: Marks) -> (Marks, bool) {
        let all = self.automaton.all_sets();
        let left = Marks(frontier.0 & !visited.0);
        let hit = left != frontier;
        match self.rule {
            FrontierRule::Refill if hit && left.0 == 0 => {
                let others = all.0 & !(visited.0 & frontier.0);
                (if others == 0 { all } else { Marks(others) }, true)
            }
            FrontierRule::Refill => (left, false),
            FrontierRule::Printed if frontier.0 == 0 && visited.0 != 0 => (Marks(all.0 & !visited.0), true),
            FrontierRule::Printed => (left, false),
            FrontierRule::Standard => (all, visited.0 != 0),
        }
    }

    /// f_Φ (equation 9) for a visit to `q`: the new T_Φ.
    fn update_unvisited(&self, q: StateId, unvisited: StateSet, refilled: bool) -> StateSet {
        if refilled { self.start.unvisited.without(q) } else { unvisited.without(q) }
    }

    fn visit(&self, at: EmbeddedState, q: StateId, visited: Marks) -> Succession {
        let fresh = Marks(visited.0 & at.frontier.0);
        let (frontier, refilled) = self.update_frontier(visited, at.frontier);
        let unvisited = self.update_unvisited(q, at.unvisited, refilled);
        Succession { to: EmbeddedState { q, frontier, unvisited }, visited, fresh, refilled }
    }

    /// The embedded states in which a run can stand once its first letter is read, sorted; `None` if there are more than
    /// `limit`. ε-jumps count, before the first letter as well.
    pub fn reachable(&self, limit: usize) -> Option<Vec<EmbeddedState>> {
        let mut found = HashSet::new();
        let mut open = vec![];
        for unread in std::iter::once(self.start).chain(self.jumps(self.start)) {
            open.extend(self.letters(unread));
        }
        while let Some(at) = open.pop() {
            if found.insert(at) {
                if found.len() > limit {
                    return None;
                }
                open.extend(self.letters(at));
                open.extend(self.jumps(at));
            }
        }
        let mut found: Vec<EmbeddedState> = found.into_iter().collect();
        found.sort_unstable();
        Some(found)
    }

    fn letters(&self, at: EmbeddedState) -> impl Iterator<Item = EmbeddedState> {
        self.automaton.edges(at.q).iter().map(move |(_, edge)| self.visit(at, edge.target, edge.marks).to)
    }

    fn jumps(&self, at: EmbeddedState) -> impl Iterator<Item = EmbeddedState> {
        self.automaton.epsilon(at.q).iter().map(move |&q| self.visit(at, q, Marks(0)).to)
    }
}
