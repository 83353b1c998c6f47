//! Many episodes of one policy, summed up.

use super::rollout::{Episode, Rollout};
use super::statistics::{Interval, clopper_pearson};
use crate::agent::Policy;
use crate::rng::{Purpose, Rng};
use serde::{Deserialize, Serialize};

/// What a number of episodes of one policy have shown.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct Evaluation {
    /// Episodes.
    pub runs: u32,
    /// Episodes with at least one round and without a sink.
    pub successes: u32,
    /// successes / runs.
    pub success_rate: f64,
    /// The Clopper–Pearson interval of the success rate at 95 %.
    pub ci95: Interval,
    /// Mean of completed rounds.
    pub rounds_mean: f64,
    /// Share of the episodes that ended in a product sink.
    pub sink_rate: f64,
    /// Mean of the environment steps to the first round, over the episodes that completed one; `None` if none did.
    pub first_round_steps_mean: Option<f64>,
    /// Mean of Σ R(x), in the paper's units.
    pub total_reward_mean: f64,
    /// The seed that the starts were drawn from.
    pub seed: u64,
}

impl Evaluation {
    /// Sums up episodes.
    pub fn of(episodes: &[Episode], seed: u64) -> Evaluation {
        let runs = episodes.len() as u32;
        let mean = |f: &dyn Fn(&Episode) -> f64| episodes.iter().map(f).sum::<f64>() / f64::from(runs.max(1));
        let successes = episodes.iter().filter(|e| e.success()).count() as u32;
        let first: Vec<f64> = episodes.iter().filter_map(|e| e.first_round_steps).map(f64::from).collect();
        Evaluation {
            runs,
            successes,
            success_rate: f64::from(successes) / f64::from(runs.max(1)),
            ci95: clopper_pearson(successes, runs, 0.95),
            rounds_mean: mean(&|e| f64::from(e.rounds)),
            sink_rate: mean(&|e| f64::from(u8::from(e.sink))),
            first_round_steps_mean: (!first.is_empty()).then(|| first.iter().sum::<f64>() / first.len() as f64),
            total_reward_mean: mean(&|e| f64::from(e.total_reward)),
            seed,
        }
    }

    /// Whether every episode succeeded.
    pub fn perfect(&self) -> bool {
        self.runs > 0 && self.successes == self.runs
    }
}

/// Plays `runs` episodes of `policy`, each from a start of its own drawn from `seed`, and gives up early once `failures_allowed`
/// is exceeded: what is worth keeping is then already known not to be found. The same seed gives the same starts to every policy.
pub fn episodes(
    rollout: &mut Rollout,
    policy: &mut dyn Policy,
    runs: u32,
    failures_allowed: Option<u32>,
    seed: u64,
) -> Vec<Episode> {
    episodes_seen(rollout, policy, runs, failures_allowed, seed, &mut |_| ())
}

/// [`episodes`] with a look at each as it stands when it is over.
pub fn episodes_seen(
    rollout: &mut Rollout,
    policy: &mut dyn Policy,
    runs: u32,
    failures_allowed: Option<u32>,
    seed: u64,
    seen: &mut dyn FnMut(&Rollout),
) -> Vec<Episode> {
    let mut seeds = Rng::new(seed, Purpose::Evaluation);
    let mut played = Vec::new();
    let mut failures = 0;
    for _ in 0..runs {
        rollout.restart(seeds.bits());
        let episode = rollout.finish(policy);
        seen(rollout);
        failures += u32::from(!episode.success());
        played.push(episode);
        if failures_allowed.is_some_and(|allowed| failures > allowed) {
            break;
        }
    }
    played
}

/// [`episodes`] summed up, without giving up early.
pub fn evaluate(rollout: &mut Rollout, policy: &mut dyn Policy, runs: u32, seed: u64) -> Evaluation {
    Evaluation::of(&episodes(rollout, policy, runs, None, seed), seed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn success_needs_a_round_and_no_sink() {
        let good = Episode { steps: 200, rounds: 2, first_round_steps: Some(80), sink: false, total_reward: 0.04 };
        let fell = Episode { sink: true, ..good };
        let none = Episode { rounds: 0, first_round_steps: None, ..good };
        let all = Evaluation::of(&[good, fell, none, good], 3);
        assert_eq!((all.runs, all.successes, all.success_rate, all.sink_rate), (4, 2, 0.5, 0.25));
        assert_eq!((all.rounds_mean, all.first_round_steps_mean), (1.5, Some(80.0)));
        assert!(!all.perfect() && Evaluation::of(&[good], 0).perfect() && !Evaluation::of(&[], 0).perfect());
    }
}
