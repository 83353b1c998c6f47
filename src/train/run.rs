//! One training run: a trainer, evaluations of its greedy policy in between, and the best policy they have found.

use super::settings::Stop;
use super::trainer::{Tick, Trainer};
use crate::eval::{Episode, Evaluation, Rollout, episodes};
use crate::nn::NetworkTensor;
use crate::rng::{Purpose, Rng};

/// The networks of a policy: the tensors of each module, without optimisers.
pub type PolicyTensors = Vec<Vec<NetworkTensor>>;

/// The best policy so far.
#[derive(Clone, PartialEq, Debug)]
pub struct Best {
    /// Environment steps it had been trained for.
    pub step: u64,
    /// What was seen of it.
    pub evaluation: Evaluation,
    /// Its networks.
    pub policy: PolicyTensors,
}

/// One step of a run.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Progress {
    /// The transition.
    pub tick: Tick,
    /// The evaluation that followed it, if one was due.
    pub evaluation: Option<Evaluation>,
}

/// A training run.
pub struct Run {
    pub(super) trainer: Trainer,
    rollout: Rollout,
    /// Seeds of the evaluations, a stream of its own: they change nothing about training.
    pub(super) seeds: Rng,
    pub(super) seed: u64,
    pub(super) best: Option<Best>,
    pub(super) first_perfect_step: Option<u64>,
    pub(super) last_evaluated: u64,
}

impl Run {
    /// A run of `trainer`, evaluated on `rollout`; `seed` is the run's, for the record and for the seeds of its evaluations.
    pub fn new(trainer: Trainer, rollout: Rollout, seed: u64) -> Run {
        let seeds = Rng::new(seed, Purpose::Evaluation);
        Run { trainer, rollout, seeds, seed, best: None, first_perfect_step: None, last_evaluated: 0 }
    }

    /// One transition, its updates, and the evaluation that is due after it.
    pub fn advance(&mut self) -> Progress {
        let tick = self.trainer.step();
        let evaluation = self.due().map(|seed| self.evaluate_from(seed));
        Progress { tick, evaluation }
    }

    /// The seed of the evaluation that is due now, if one is: for a shell that plays it in slices, hands the episodes to
    /// [`Run::take_in`] and trains on by [`Trainer::step`]. [`Run::advance`] is all of that in one.
    pub fn due(&mut self) -> Option<u64> {
        let (step, every) = (self.trainer.step, self.trainer.settings.evaluate_every);
        // An ε-move leaves the number of steps as it was: it must not evaluate a second time.
        let due = every > 0 && step.is_multiple_of(every) && step > self.last_evaluated;
        due.then(|| {
            self.last_evaluated = step;
            self.next_seed()
        })
    }

    /// Evaluates the greedy policy as it is now, and keeps it if it is the best so far.
    pub fn evaluate(&mut self) -> Evaluation {
        self.last_evaluated = self.trainer.step;
        let seed = self.next_seed();
        self.evaluate_from(seed)
    }

    /// 53 bits: every JSON reader can say which seed it was.
    fn next_seed(&mut self) -> u64 {
        self.seeds.bits() >> 11
    }

    fn evaluate_from(&mut self, seed: u64) -> Evaluation {
        let settings = self.trainer.settings;
        let allowed = Some(settings.evaluation_failures);
        let played = episodes(&mut self.rollout, &mut self.trainer.learner, settings.evaluation_runs, allowed, seed);
        self.take_in(&played, seed)
    }

    /// Takes in the episodes of an evaluation of the greedy policy as it is now, and keeps it if it is the best so far.
    pub fn take_in(&mut self, played: &[Episode], seed: u64) -> Evaluation {
        let step = self.trainer.step;
        let evaluation = Evaluation::of(played, seed);
        if evaluation.perfect() && self.first_perfect_step.is_none() {
            self.first_perfect_step = Some(step);
        }
        let quality = |e: &Evaluation| (e.success_rate, e.rounds_mean);
        if self.best.as_ref().is_none_or(|best| quality(&evaluation) > quality(&best.evaluation)) {
            self.best = Some(Best { step, evaluation, policy: self.trainer.learner.policy() });
        }
        evaluation
    }

    /// Whether training is over: its budget is spent, or it was to stop at a perfect evaluation and there was one.
    pub fn finished(&self) -> bool {
        let perfect = self.trainer.settings.stop == Stop::Perfect && self.first_perfect_step.is_some();
        perfect || self.trainer.budget_spent()
    }

    /// The trainer.
    pub fn trainer(&self) -> &Trainer {
        &self.trainer
    }

    /// The trainer, to act with its policy.
    pub fn trainer_mut(&mut self) -> &mut Trainer {
        &mut self.trainer
    }

    /// The best policy that an evaluation has seen.
    pub fn best(&self) -> Option<&Best> {
        self.best.as_ref()
    }

    /// Environment steps at the first evaluation without a failure.
    pub fn first_perfect_step(&self) -> Option<u64> {
        self.first_perfect_step
    }

    /// The run's seed.
    pub fn seed(&self) -> u64 {
        self.seed
    }
}
