//! Episodes of a fixed policy, and what is counted as success.
//!
//! **Success** (as in Tables 1 and 2 of [Cai et al. 2021](crate::bib::Cai2021)): the run completes at least one round of all accepting
//! sets within its steps and never enters a product sink. For tasks such as `F (a & F b)`, whose automaton has one accepting set
//! that is reached once and for all, a round is reaching it: one definition serves both kinds. A product sink is Q_sink of the
//! automaton, or a terminated environment (a ball that left the arena, a pole that fell): both end the run before its steps are
//! over, and a run of an infinite word that ends satisfies nothing.

use crate::agent::{Policy, View};
use crate::product::{Chosen, EpMdp, Move, MoveKind, ProductStart, ProductStep, Reward, Start};
use crate::rng::{Purpose, Rng};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// How a policy is tried out.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct RolloutSettings {
    /// Environment steps in an episode; ε-moves take none.
    pub max_steps: u32,
    /// Where episodes start.
    pub start: Start,
}

/// How an episode went.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize)]
pub struct Episode {
    /// Environment steps.
    pub steps: u32,
    /// Completed rounds, a round completed at time 0 included.
    pub rounds: u32,
    /// Environment steps until the first round was complete.
    pub first_round_steps: Option<u32>,
    /// Whether it ended in a product sink: Q_sink, or the environment terminated.
    pub sink: bool,
    /// Σ R(x), without shaping, in the paper's units.
    pub total_reward: f32,
}

impl Episode {
    /// At least one round, and never in a sink.
    pub fn success(&self) -> bool {
        self.rounds > 0 && !self.sink
    }

    /// Takes in one step of the episode; `rounds` is the count after it, `base` its R(x').
    pub fn count(&mut self, step: &ProductStep, rounds: u32, base: f32) {
        if step.kind == MoveKind::Control {
            self.steps += 1;
        }
        if self.rounds == 0 && rounds > 0 {
            self.first_round_steps = Some(self.steps);
        }
        self.rounds = rounds;
        self.sink = step.ends();
        self.total_reward += base;
    }
}

/// One episode of any policy, step by step.
pub struct Rollout {
    product: EpMdp,
    reward: Arc<dyn Reward>,
    settings: RolloutSettings,
    rng: Rng,
    view: View,
    control: Vec<f32>,
    start: ProductStart,
    start_state: Vec<f32>,
    episode: Episode,
}

impl Rollout {
    /// An episode of `product` (a copy of its own) from a start drawn from `seed`.
    pub fn new(mut product: EpMdp, reward: Arc<dyn Reward>, settings: RolloutSettings, seed: u64) -> Rollout {
        let control = vec![0.0; product.environment().spec().action.len()];
        let view = View::new(&product);
        let mut rng = Rng::new(seed, Purpose::Evaluation);
        let start = product.reset(settings.start, &mut rng);
        let start_state = vec![];
        let mut rollout =
            Rollout { product, reward, settings, rng, view, control, start, start_state, episode: Episode::default() };
        rollout.begin(start);
        rollout
    }

    /// Begins another episode from a start drawn from `seed`.
    pub fn restart(&mut self, seed: u64) {
        self.rng = Rng::new(seed, Purpose::Evaluation);
        let start = self.product.reset(self.settings.start, &mut self.rng);
        self.begin(start);
    }

    /// Begins another episode in a given state of the environment, in physical units.
    ///
    /// # Panics
    /// If `state` has another length than the environment's.
    pub fn restart_at(&mut self, state: &[f32]) {
        let start = self.product.reset_to(state);
        self.begin(start);
    }

    fn begin(&mut self, start: ProductStart) {
        let closes_round = start.closes_round;
        self.start = start;
        self.start_state.clear();
        self.start_state.extend_from_slice(self.product.environment().state());
        self.control.fill(0.0);
        self.episode = Episode {
            rounds: u32::from(closes_round),
            first_round_steps: closes_round.then_some(0),
            sink: self.product.ended(),
            ..Episode::default()
        };
        self.view.look(&self.product);
    }

    /// One step of `policy`; `None` once the episode is over.
    pub fn step(&mut self, policy: &mut dyn Policy) -> Option<ProductStep> {
        if self.over() {
            return None;
        }
        let action = match policy.act(&self.view.situation(), &mut self.control) {
            Chosen::Control => Move::Control(&self.control),
            Chosen::Epsilon(target) => Move::Epsilon(target),
        };
        let step = self.product.step(action, &mut self.rng);
        self.episode.count(&step, self.product.rounds().completed(), self.reward.parts(&step).base);
        self.view.look(&self.product);
        Some(step)
    }

    /// Whether the episode is over: its steps are made, or it ended in a sink.
    pub fn over(&self) -> bool {
        self.product.ended() || self.episode.steps >= self.settings.max_steps
    }

    /// How the episode began.
    pub fn start(&self) -> &ProductStart {
        &self.start
    }

    /// The state of the environment in which this episode began, in physical units.
    pub fn start_state(&self) -> &[f32] {
        &self.start_state
    }

    /// How the episode went so far.
    pub fn episode(&self) -> &Episode {
        &self.episode
    }

    /// Where the product stands.
    pub fn product(&self) -> &EpMdp {
        &self.product
    }

    /// The last control, one number in `[-1, 1]` per action channel.
    pub fn control(&self) -> &[f32] {
        &self.control
    }

    /// Plays the episode to its end.
    pub fn finish(&mut self, policy: &mut dyn Policy) -> Episode {
        while self.step(policy).is_some() {}
        self.episode
    }
}
