//! What the training loop asks of a learner, and what a rollout asks of a policy.

use crate::automaton::EmbeddedState;
use crate::labels::Labels;
use crate::nn::Losses;
use crate::product::{Chosen, EpMdp, ProductStep};

/// Where a policy has to choose.
#[derive(Clone, Copy, Debug)]
pub struct Situation<'a> {
    /// The environment's scaled observation of s, numbers of order 1.
    pub observation: &'a [f32],
    /// (q, T, T_Φ).
    pub at: EmbeddedState,
    /// The steps that the ε-moves of this moment would be; empty where there are none.
    pub jumps: &'a [ProductStep],
}

/// What can be seen of a product where it stands, in buffers that are kept from step to step.
#[derive(Clone, PartialEq, Debug)]
pub struct View {
    observation: Vec<f32>,
    at: EmbeddedState,
    jumps: Vec<ProductStep>,
}

impl View {
    /// The view of `product` where it stands now.
    pub fn new(product: &EpMdp) -> View {
        let observation = vec![0.0; product.environment().spec().observation];
        let mut view = View { observation, at: product.at(), jumps: vec![] };
        view.look(product);
        view
    }

    /// Looks again.
    pub fn look(&mut self, product: &EpMdp) {
        product.environment().observe(&mut self.observation);
        self.at = product.at();
        self.jumps.clear();
        self.jumps.extend(product.epsilon_moves().iter().filter_map(|&target| product.look_ahead(target)));
    }

    /// The environment's scaled observation.
    pub fn observation(&self) -> &[f32] {
        &self.observation
    }

    /// What a policy chooses by.
    pub fn situation(&self) -> Situation<'_> {
        Situation { observation: &self.observation, at: self.at, jumps: &self.jumps }
    }
}

/// A way to choose moves.
pub trait Policy {
    /// The move for `now`: an ε-move, or the control (one number in `[-1, 1]` per action channel) that it writes.
    fn act(&mut self, now: &Situation<'_>, control: &mut [f32]) -> Chosen;
}

/// One transition of the product, as a learner takes it in.
#[derive(Clone, Copy, Debug)]
pub struct Transition<'a> {
    /// The observation of s.
    pub observation: &'a [f32],
    /// L(s), as a letter of the automaton.
    pub labels: Labels,
    /// The control; meaningless for an ε-move.
    pub control: &'a [f32],
    /// The step of the product, L(s') with it.
    pub step: &'a ProductStep,
    /// The observation of s'.
    pub next: &'a [f32],
}

/// One gradient update: whose, and what it measured.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Update {
    /// The module that was updated.
    pub module: usize,
    /// Its losses, in units of the scaled reward.
    pub losses: Losses,
}

/// A policy that gets better by what it records.
pub trait Learner: Policy {
    /// The move for `now` while training: the policy's with exploration.
    fn explore(&mut self, now: &Situation<'_>, control: &mut [f32]) -> Chosen;
    /// Takes in one transition.
    fn record(&mut self, transition: &Transition<'_>);
    /// Ends the episode: what was recorded and is still waiting for later rewards is bootstrapped from the last state, unless that
    /// was a terminal one.
    fn finish_episode(&mut self);
    /// Performs the updates that are due after a transition; the last one made, if any.
    fn update(&mut self) -> Option<Update>;
}
