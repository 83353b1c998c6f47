//! What the seeds of one contender on one task have shown together. Episodes of one policy and training seeds are never pooled.

use super::cell::Cell;
use crate::eval::{Interval, interquartile_mean, stratified_bootstrap};
use crate::rng::{Purpose, Rng};
use serde_json::{Value, json};

/// Rounds of the bootstrap.
const RESAMPLES: usize = 10_000;

/// The success rate from which on a seed counts as solved.
const SOLVED: f64 = 0.99;

/// The cells of one contender on one task.
#[derive(Clone, Debug)]
pub struct Group {
    /// The task.
    pub task: String,
    /// Contender or variant.
    pub variant: String,
    /// Environment steps in an episode of the evaluation.
    pub max_steps: u32,
    /// One for each seed; `None` where it is not run yet.
    pub cells: Vec<Option<Cell>>,
}

impl Group {
    /// The finished cells.
    pub fn done(&self) -> impl Iterator<Item = &Cell> {
        self.cells.iter().flatten()
    }

    /// Success rates, one for each finished seed.
    pub fn rates(&self) -> Vec<f64> {
        self.done().map(|cell| cell.outcome.evaluation.success_rate).collect()
    }

    /// Their interquartile mean; `None` without any.
    pub fn rate(&self) -> Option<f64> {
        (self.done().count() > 0).then(|| interquartile_mean(&self.rates()))
    }

    /// The bootstrap interval of the interquartile mean over seeds at 95 %; `None` for a single seed, which says nothing of others.
    pub fn interval(&self) -> Option<Interval> {
        let rates = self.rates();
        if rates.len() > 1 { bootstrap(&[&rates]) } else { None }
    }

    /// Seeds whose policy succeeds in at least 99 % of its runs.
    pub fn solved(&self) -> usize {
        self.rates().iter().filter(|&&rate| rate >= SOLVED).count()
    }

    /// Seeds with an evaluation without a failure while training.
    pub fn perfect(&self) -> usize {
        self.done().filter(|cell| cell.outcome.first_perfect.is_some()).count()
    }

    /// The median over finished seeds of a number of each; infinite where half of them or more have none.
    pub fn median(&self, of: impl Fn(&Cell) -> Option<f64>) -> Option<f64> {
        let mut values: Vec<f64> = self.done().map(|cell| of(cell).unwrap_or(f64::INFINITY)).collect();
        values.sort_by(f64::total_cmp);
        let n = values.len();
        match n {
            0 => None,
            _ if n % 2 == 1 => Some(values[n / 2]),
            _ => Some((values[n / 2 - 1] + values[n / 2]) / 2.0),
        }
    }

    /// Finished seeds and all, as `3/5`.
    pub fn progress(&self) -> String {
        format!("{}/{}", self.done().count(), self.cells.len())
    }

    /// All of it as an object.
    pub fn object(&self) -> Value {
        let seeds: Vec<Value> = self
            .done()
            .map(|cell| {
                let o = &cell.outcome;
                json!({
                    "seed": cell.seed,
                    "successes": o.evaluation.successes,
                    "runs": o.evaluation.runs,
                    "ci95_clopper_pearson": o.evaluation.ci95,
                    "rounds_mean": o.evaluation.rounds_mean,
                    "sink_rate": o.evaluation.sink_rate,
                    "steps": o.steps,
                    "episodes": o.episodes,
                    "first_perfect": o.first_perfect,
                    "training": o.training,
                    "evaluating": o.evaluating,
                    "machine": cell.conditions.machine,
                    "jobs": cell.conditions.jobs,
                    "version": cell.conditions.version,
                    "cell": cell.hash,
                })
            })
            .collect();
        json!({
            "task": self.task,
            "variant": self.variant,
            "max_steps": self.max_steps,
            "seeds_finished": self.done().count(),
            "seeds_planned": self.cells.len(),
            "success_iqm": self.rate(),
            "ci95_bootstrap": self.interval(),
            "seeds_solved": self.solved(),
            "seeds_perfect": self.perfect(),
            "seeds": seeds,
        })
    }
}

/// The bootstrap interval of the interquartile mean at 95 %, stratified by task; `None` if there is nothing in a stratum.
pub fn bootstrap(strata: &[&[f64]]) -> Option<Interval> {
    stratified_bootstrap(strata, interquartile_mean, 0.95, RESAMPLES, &mut Rng::new(0, Purpose::Tool))
}

/// Machines and numbers of jobs under which cells were run, each once.
pub fn conditions(groups: &[Group]) -> Vec<String> {
    let mut all: Vec<String> = groups
        .iter()
        .flat_map(Group::done)
        .map(|cell| {
            let c = &cell.conditions;
            format!("{}; {} at a time; ltl-rover {}", c.machine, c.jobs, c.version)
        })
        .collect();
    all.sort();
    all.dedup();
    all
}
