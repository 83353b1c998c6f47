//! `eval`: many greedy episodes of a trained policy, and what they show.

use super::failure::Failure;
use super::files;
use super::output::outln;
use crate::eval::evaluate;
use clap::Args;
use std::path::PathBuf;
use std::process::ExitCode;

/// Arguments of `eval`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  ltl-rover eval runs/b1
  ltl-rover eval runs/b1 --runs 200 --json
  ltl-rover eval runs/b1/policy.safetensors --seed 7

An episode succeeds if it completes at least one round of all accepting sets within its steps and never enters a sink: a state from
which the automaton cannot accept, or the end of the environment (the arena left, the pole fallen).")]
pub struct Eval {
    /// A folder that `train` wrote, or a checkpoint or policy file.
    #[arg(value_name = "RUN")]
    run: PathBuf,
    /// Episodes; by default the task's.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    runs: Option<u32>,
    /// The seed of the starts: equal seeds give equal starts to all policies.
    #[arg(long, default_value_t = 1000)]
    seed: u64,
    /// One JSON object.
    #[arg(long)]
    json: bool,
}

impl Eval {
    /// Plays the episodes and prints what they show.
    ///
    /// # Errors
    /// A run that cannot be read.
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let (setup, mut learner) = files::policy(&self.run)?;
        let runs = self.runs.unwrap_or(setup.task().file().evaluation.runs);
        let e = evaluate(&mut setup.rollout(self.seed), &mut learner, runs, self.seed);
        if self.json {
            outln!("{}", serde_json::to_string(&Json::from(&e)).expect("plain data has a form in JSON"));
            return Ok(ExitCode::SUCCESS);
        }
        let percent = |x: f64| format!("{:.1} %", 100.0 * x);
        outln!("{} — {}", setup.task().file().title, setup.task().file().specification.ltl);
        outln!(
            "success        {}/{} = {}, 95 % interval [{}, {}] (Clopper–Pearson)",
            e.successes,
            e.runs,
            percent(e.success_rate),
            percent(e.ci95.low),
            percent(e.ci95.high)
        );
        outln!("rounds         {:.2} per episode of {} steps", e.rounds_mean, setup.rollout_settings().max_steps);
        let first = e.first_round_steps_mean.map_or("never".to_owned(), |s| format!("after {s:.1} steps"));
        outln!("first round    {first}");
        outln!("sinks          {}", percent(e.sink_rate));
        outln!("total reward   {:.4} per episode", e.total_reward_mean);
        outln!("seed           {}", e.seed);
        Ok(ExitCode::SUCCESS)
    }
}

/// An evaluation with its interval as `[low, high]`.
#[derive(serde::Serialize)]
struct Json {
    runs: u32,
    successes: u32,
    success_rate: f64,
    ci95: [f64; 2],
    rounds_mean: f64,
    sink_rate: f64,
    first_round_steps_mean: Option<f64>,
    total_reward_mean: f64,
    seed: u64,
}

impl From<&crate::eval::Evaluation> for Json {
    fn from(e: &crate::eval::Evaluation) -> Json {
        Json {
            runs: e.runs,
            successes: e.successes,
            success_rate: e.success_rate,
            ci95: [e.ci95.low, e.ci95.high],
            rounds_mean: e.rounds_mean,
            sink_rate: e.sink_rate,
            first_round_steps_mean: e.first_round_steps_mean,
            total_reward_mean: e.total_reward_mean,
            seed: e.seed,
        }
    }
}
