//! An evaluation in slices: many greedy episodes with fresh starts, its interval readable at any moment.

use crate::agent::Policy;
use crate::eval::{Episode, Evaluation, Rollout};
use crate::rng::{Purpose, Rng};
use crate::train::Best;
use serde::Serialize;

/// An evaluation that is going on.
pub struct Trial {
    rollout: Rollout,
    seeds: Rng,
    seed: u64,
    wanted: u32,
    /// Failures after which it gives up.
    allowed: Option<u32>,
    played: Vec<Episode>,
    failures: u32,
    running: bool,
}

/// How an evaluation stands.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct TrialProgress {
    /// Episodes asked for.
    pub wanted: u32,
    /// Episodes played.
    pub runs: u32,
    /// Episodes that satisfied the task.
    pub successes: u32,
    /// Lower bound of the 95 % Clopper–Pearson interval of the success rate.
    pub low: f64,
    /// Upper bound.
    pub high: f64,
    /// Mean of completed rounds.
    pub rounds_mean: f64,
    /// Share of episodes that ended in a product sink.
    pub sink_rate: f64,
    /// The seed that the starts are drawn from.
    pub seed: u64,
}

/// The best policy that the recipe's evaluations have seen: which one, and what they saw.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct BestPolicy {
    /// Environment steps of training at the time.
    pub step: u64,
    /// Episodes that were played.
    pub runs: u32,
    /// Episodes that satisfied the task.
    pub successes: u32,
    /// Mean of completed rounds.
    pub rounds_mean: f64,
}

impl BestPolicy {
    /// The facts of what a run has kept.
    pub fn of(best: &Best) -> BestPolicy {
        let Evaluation { runs, successes, rounds_mean, .. } = best.evaluation;
        BestPolicy { step: best.step, runs, successes, rounds_mean }
    }
}

impl Trial {
    /// An evaluation of `wanted` episodes, with the starts that [`evaluate`](crate::eval::evaluate) draws from `seed`.
    pub fn new(rollout: Rollout, wanted: u32, seed: u64) -> Trial {
        Trial {
            rollout,
            seeds: Rng::new(seed, Purpose::Evaluation),
            seed,
            wanted,
            allowed: None,
            played: vec![],
            failures: 0,
            running: false,
        }
    }

    /// The same, given up once more than `failures` episodes have failed.
    #[must_use]
    pub fn giving_up_after(self, failures: u32) -> Trial {
        Trial { allowed: Some(failures), ..self }
    }

    fn over(&self) -> bool {
        self.played.len() >= self.wanted as usize || self.allowed.is_some_and(|allowed| self.failures > allowed)
    }

    /// Makes at most `steps` moves of `policy`; whether there is more to do.
    pub fn advance(&mut self, policy: &mut dyn Policy, steps: u32) -> bool {
        for _ in 0..steps {
            if self.over() {
                return false;
            }
            if !self.running {
                self.rollout.restart(self.seeds.bits());
                self.running = true;
            }
            if self.rollout.step(policy).is_none() {
                let episode = *self.rollout.episode();
                self.failures += u32::from(!episode.success());
                self.played.push(episode);
                self.running = false;
            }
        }
        !self.over()
    }

    /// The episodes played so far.
    pub fn played(&self) -> &[Episode] {
        &self.played
    }

    /// The seed that the starts are drawn from.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// How it stands.
    pub fn progress(&self) -> TrialProgress {
        let sum = Evaluation::of(&self.played, self.seed);
        TrialProgress {
            wanted: self.wanted,
            runs: sum.runs,
            successes: sum.successes,
            low: sum.ci95.low,
            high: sum.ci95.high,
            rounds_mean: sum.rounds_mean,
            sink_rate: sum.sink_rate,
            seed: self.seed,
        }
    }
}
