//! One transition of the embedded product MDP, and the pure functions that make it.

use crate::automaton::{EmbeddedState, Embedding, Marks, StateId, Succession};
use crate::env::Outcome;
use crate::labels::Labels;
use serde::{Deserialize, Serialize};

/// An action u ∈ A ∪ {ε} of the product (Definition 4 of [Cai et al. 2021](crate::bib::Cai2021)).
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Move<'a> {
    /// A control of the environment: one number in `[-1, 1]` per action channel.
    Control(&'a [f32]),
    /// The ε-jump to an automaton state: s' = s, no time passes, no letter is read.
    Epsilon(StateId),
}

/// Which kind of [`Move`] made a step.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MoveKind {
    /// The environment moved and a letter was read.
    Control,
    /// The automaton jumped.
    Epsilon,
}

/// A transition x → x' of the product, but for the states s and s' of the environment.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
pub struct ProductStep {
    /// (q, T, T_Φ) that was left.
    pub from: EmbeddedState,
    /// (q', T', T_Φ') that was reached, after f_V and f_Φ.
    pub to: EmbeddedState,
    /// L(s'), as a letter of the automaton (bits as in [`Ldgba::propositions`](crate::automaton::Ldgba::propositions)).
    pub labels: Labels,
    /// All accepting sets F_j that were visited.
    pub visited: Marks,
    /// Those of them in T: x' ∈ F_j^P, with T taken before the update for this visit.
    pub fresh: Marks,
    /// B of f_V: T has come round.
    pub refilled: bool,
    /// Whether this step completes a round as results count them ([`Rounds`](super::rounds::Rounds)). A history and not the state
    /// decides that, hence always false in a step made by the pure functions.
    pub closes_round: bool,
    /// Whether q' ∈ Q_sink (Definition 3).
    pub sink: bool,
    /// Whether the environment terminated.
    pub outcome: Outcome,
    /// What made the step.
    pub kind: MoveKind,
}

impl ProductStep {
    /// The step from `from` by a control after which the environment shows `labels` (a letter of the automaton) and `outcome`:
    /// the successor function of the product for any embedded state, as counterfactual replay needs it.
    pub fn read(embedding: &Embedding, from: EmbeddedState, labels: Labels, outcome: Outcome) -> ProductStep {
        let succession = embedding.read(from, labels);
        ProductStep::new(embedding, from, succession, labels, outcome, MoveKind::Control)
    }

    /// The step from `from` by the ε-jump to `target`, while the environment shows `labels`.
    ///
    /// # Panics
    /// If the automaton has no ε-jump from `from.q` to `target`.
    pub fn jump(embedding: &Embedding, from: EmbeddedState, target: StateId, labels: Labels) -> ProductStep {
        let succession = embedding.jump(from, target);
        ProductStep::new(embedding, from, succession, labels, Outcome::Running, MoveKind::Epsilon)
    }

    pub(super) fn new(
        embedding: &Embedding,
        from: EmbeddedState,
        succession: Succession,
        labels: Labels,
        outcome: Outcome,
        kind: MoveKind,
    ) -> ProductStep {
        let Succession { to, visited, fresh, refilled } = succession;
        let sink = embedding.automaton().is_sink(to.q);
        ProductStep { from, to, labels, visited, fresh, refilled, closes_round: false, sink, outcome, kind }
    }

    /// Whether x' has no future: q' ∈ Q_sink, or the environment terminated. A time limit is never this.
    pub fn ends(&self) -> bool {
        self.sink || self.outcome == Outcome::Terminated
    }
}
