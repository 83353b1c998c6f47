//! One cell is run: training with its evaluations, each timed apart, then the final judgement of the best policy.

use super::cell::{Bin, Conditions, EVALUATION_SEED, Milestone, Outcome, Plan};
use super::machine::{Seconds, Watch};
use crate::cli::failure::Failure;
use crate::cli::files;
use crate::eval::{episodes, evaluate};
use crate::train::{EpisodeSummary, Metrics, Run};
use std::path::Path;

/// Neighbouring episodes are put together so that a curve has at most this many bins.
const MAX_BINS: usize = 400;

/// Environment steps between two reports of progress.
const STRIDE: u64 = 200;

/// Trains by the plan, judges the best policy, and writes both into the folder `out`; `progress` hears the environment steps so far.
///
/// # Errors
/// What does not go together in the task; files that cannot be written.
pub fn learn(plan: &Plan, out: &Path, conditions: Conditions, progress: &dyn Fn(u64)) -> Result<(), Failure> {
    let setup = plan.subject.setup(&plan.preset, &plan.overrides)?;
    let mut run = setup.run(plan.seed);
    let mut rollout = setup.rollout(plan.seed);
    let mut metrics = Metrics::of(run.trainer());
    let mut curve = Bins::default();
    let (mut training, mut evaluating) = (Seconds::default(), Seconds::default());
    let mut first_perfect = None;
    let mut watch = Watch::start();
    while !run.finished() {
        let tick = run.trainer_mut().step();
        if let Some(episode) = metrics.fold(&tick)
            && plan.curve
        {
            curve.add(&episode);
        }
        if tick.step.is_multiple_of(STRIDE) {
            progress(tick.step);
        }
        let Some(seed) = run.due() else { continue };
        training.add(watch.read());
        watch = Watch::start();
        let perfect = judge(&mut run, &mut rollout, seed);
        evaluating.add(watch.read());
        if perfect && first_perfect.is_none() {
            first_perfect = Some(Milestone { step: tick.step, episode: run.trainer().episodes(), training });
        }
        watch = Watch::start();
    }
    training.add(watch.read());
    let mut policy = setup.learner(plan.seed);
    policy.load_policy(&run.policy()).expect("the policy is of a learner of this very set-up");
    let evaluation = evaluate(&mut setup.rollout(EVALUATION_SEED), &mut policy, plan.runs, EVALUATION_SEED);
    let outcome = Outcome {
        steps: run.trainer().steps(),
        episodes: run.trainer().episodes(),
        updates: run.trainer().learner().updates(),
        training,
        evaluating,
        first_perfect,
        best_step: run.best().map_or(run.trainer().steps(), |best| best.step),
        evaluation,
        curve: curve.bins.iter().map(rounded).collect(),
    };
    files::write(&plan.policy_file(out), run.save_policy(&setup.origin()))?;
    plan.finished(outcome, conditions).store(plan, out)
}

/// The evaluation that is due, as [`Run::advance`] makes it; whether it was without a failure.
fn judge(run: &mut Run, rollout: &mut crate::eval::Rollout, seed: u64) -> bool {
    let settings = *run.trainer().settings();
    let (runs, allowed) = (settings.evaluation_runs, Some(settings.evaluation_failures));
    let played = episodes(rollout, run.trainer_mut().learner_mut(), runs, allowed, seed);
    run.take_in(&played, seed).perfect()
}

/// A curve that halves its resolution whenever it grows too long.
#[derive(Clone, Debug)]
struct Bins {
    bins: Vec<Bin>,
    /// Episodes in a full bin.
    width: u64,
}

impl Default for Bins {
    fn default() -> Bins {
        Bins { bins: vec![], width: 1 }
    }
}

impl Bins {
    fn add(&mut self, episode: &EpisodeSummary) {
        let one =
            Bin { episodes: 1, step: episode.step, average_reward: episode.average_reward, total_reward: episode.total_reward };
        match self.bins.last_mut() {
            Some(last) if last.episodes < self.width => *last = joined(last, &one),
            _ => self.bins.push(one),
        }
        if self.bins.len() > MAX_BINS {
            self.bins = self.bins.chunks(2).map(|pair| pair[1..].iter().fold(pair[0], |a, b| joined(&a, b))).collect();
            self.width *= 2;
        }
    }
}

/// With as many digits as a picture shows.
fn rounded(bin: &Bin) -> Bin {
    let (fine, coarse) = ((bin.average_reward * 1e7).round() / 1e7, (bin.total_reward * 1e5).round() / 1e5);
    Bin { average_reward: fine, total_reward: coarse, ..*bin }
}

fn joined(a: &Bin, b: &Bin) -> Bin {
    let episodes = a.episodes + b.episodes;
    let mean = |of: fn(&Bin) -> f64| (of(a) * a.episodes as f64 + of(b) * b.episodes as f64) / episodes as f64;
    Bin { episodes, step: b.step, average_reward: mean(|bin| bin.average_reward), total_reward: mean(|bin| bin.total_reward) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bins_keep_sums_however_often_they_are_halved() {
        let mut bins = Bins::default();
        let episode = |i: u64| EpisodeSummary {
            episode: i,
            step: 10 * (i + 1),
            steps: 10,
            total_reward: i as f64,
            average_reward: i as f64 / 10.0,
            shaped_reward: 0.0,
            rounds: 0,
            success: 0,
            sink: 0,
        };
        let n = 5 * MAX_BINS as u64 + 3;
        (0..n).for_each(|i| bins.add(&episode(i)));
        assert!(bins.bins.len() <= MAX_BINS && bins.width == 8);
        assert_eq!(bins.bins.iter().map(|b| b.episodes).sum::<u64>(), n);
        let total: f64 = bins.bins.iter().map(|b| b.total_reward * b.episodes as f64).sum();
        assert!((total - (n * (n - 1) / 2) as f64).abs() < 1e-6);
        assert_eq!(bins.bins.last().unwrap().step, 10 * n);
    }
}
