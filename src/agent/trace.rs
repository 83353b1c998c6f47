//! The last transitions of an episode, and the n-step samples made of them: as they were, or from another embedded state.

use super::learner::Transition;
use super::replay::Sample;
use crate::automaton::{EmbeddedState, Embedding};
use crate::env::Outcome;
use crate::labels::Labels;
use crate::product::{ProductStep, Reward};

/// What is remembered of one transition by a control.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Entry {
    pub observation: Vec<f32>,
    pub at: EmbeddedState,
    pub labels: Labels,
    pub control: Vec<f32>,
    pub next: Vec<f32>,
    pub next_labels: Labels,
    pub outcome: Outcome,
}

/// A window over the last n transitions. Buffers are kept and used again.
#[derive(Clone, PartialEq, Debug)]
pub struct Trace {
    entries: Vec<Entry>,
    /// Where the oldest transition is.
    first: usize,
    len: usize,
}

impl Trace {
    /// An empty window over `n` transitions, with observations and controls of the given lengths.
    ///
    /// # Panics
    /// If `n` is 0.
    pub fn new(n: usize, observation: usize, control: usize) -> Trace {
        assert!(n > 0, "a return has at least one step");
        let entry = Entry {
            observation: vec![0.0; observation],
            at: EmbeddedState { q: 0, frontier: Default::default(), unvisited: Default::default() },
            labels: Labels::EMPTY,
            control: vec![0.0; control],
            next: vec![0.0; observation],
            next_labels: Labels::EMPTY,
            outcome: Outcome::Running,
        };
        Trace { entries: vec![entry; n], first: 0, len: 0 }
    }

    /// How many transitions are waiting.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether none is waiting.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Whether the oldest transition has all its n steps.
    pub fn is_full(&self) -> bool {
        self.len == self.entries.len()
    }

    /// Takes in a transition by a control.
    ///
    /// # Panics
    /// If the window is full.
    pub fn push(&mut self, transition: &Transition<'_>) {
        assert!(!self.is_full(), "the oldest transition is taken out before");
        let place = (self.first + self.len) % self.entries.len();
        let entry = &mut self.entries[place];
        entry.observation.copy_from_slice(transition.observation);
        entry.at = transition.step.from;
        entry.labels = transition.labels;
        entry.control.copy_from_slice(transition.control);
        entry.next.copy_from_slice(transition.next);
        entry.next_labels = transition.step.labels;
        entry.outcome = transition.step.outcome;
        self.len += 1;
    }

    /// Forgets the oldest transition.
    pub fn pop(&mut self) {
        self.first = (self.first + 1) % self.entries.len();
        self.len -= 1;
    }

    fn entry(&self, index: usize) -> &Entry {
        &self.entries[(self.first + index) % self.entries.len()]
    }

    /// The waiting transitions, oldest first.
    pub(super) fn entries(&self) -> impl Iterator<Item = &Entry> {
        (0..self.len).map(|i| self.entry(i))
    }

    /// L(s) where the oldest transition begins.
    pub fn labels(&self) -> Labels {
        self.entry(0).labels
    }

    /// The embedded state in which the oldest transition was made.
    pub fn at(&self) -> EmbeddedState {
        self.entry(0).at
    }

    /// The sample of the oldest transition and all later ones, had the first begun in `at`: the automaton reads the letters that were
    /// read, R = Σ_k Γ_k R'_k with Γ_k = Π_{j<k} γ_j, and x' is the state after the last transition, or the first sink, where Γ = 0.
    ///
    /// # Panics
    /// If nothing is waiting.
    pub fn sample(&self, at: EmbeddedState, embedding: &Embedding, reward: &dyn Reward, scale: f32) -> Sample<'_> {
        assert!(!self.is_empty(), "a sample needs a transition");
        let (mut sum, mut discount, mut now) = (0.0, 1.0, at);
        let mut last = self.entry(0);
        for i in 0..self.len {
            last = self.entry(i);
            let step = ProductStep::read(embedding, now, last.next_labels, last.outcome);
            let payoff = reward.payoff(&step);
            sum += discount * payoff.reward;
            discount *= payoff.discount;
            now = step.to;
            if discount == 0.0 {
                break;
            }
        }
        let first = self.entry(0);
        Sample {
            observation: &first.observation,
            at,
            control: &first.control,
            reward: scale * sum,
            discount,
            next: &last.next,
            next_at: now,
        }
    }

    /// Replaces the window's content, oldest first; `false`, and nothing is changed, if it does not fit.
    #[must_use]
    pub(super) fn restore(&mut self, entries: Vec<Entry>) -> bool {
        let like = &self.entries[0];
        let (observation, control) = (like.observation.len(), like.control.len());
        let fits = entries.len() <= self.entries.len()
            && entries
                .iter()
                .all(|e| (e.observation.len(), e.next.len(), e.control.len()) == (observation, observation, control));
        if fits {
            (self.first, self.len) = (0, entries.len());
            self.entries.iter_mut().zip(entries).for_each(|(place, entry)| *place = entry);
        }
        fits
    }
}
