//! `eval`: many greedy episodes of a trained policy, and what they show.

use super::card;
use super::failure::Failure;
use super::files;
use super::output::outln;
use crate::eval::{Evaluation, Rollout, RolloutSettings, episodes_seen};
use crate::product::Start;
use clap::Args;
use std::path::PathBuf;
use std::process::ExitCode;

/// Arguments of `eval`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  ltl-rover eval runs/b1
  ltl-rover eval runs/b1 --runs 200 --json
  ltl-rover eval runs/b1/policy.safetensors --seed 7
  ltl-rover eval runs/b1 --start initial --runs 1
  ltl-rover eval runs/b1/policy.safetensors --card runs/b1/policy.md
  ltl-rover eval runs/b1 --episodes runs/b1/judged.csv

An episode succeeds if it completes at least one round of all accepting sets within its steps and never enters a sink: a state from
which the automaton cannot accept, or the end of the environment (the arena left, the pole fallen).
Starts are the task's; --start initial takes the environment's own, --start anywhere spreads them over all safe ground. The initial
start of Ball-Pass is a single state and nothing there is random, so that one run from it says as much as two hundred.")]
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
    /// Where the environment starts, in place of the task's choice.
    #[arg(long, value_enum)]
    start: Option<Start>,
    /// Environment steps in an episode, in place of the task's.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    max_steps: Option<u32>,
    /// Write a model card: what the policy is, how it was trained, what these episodes have shown.
    #[arg(long, value_name = "FILE.md")]
    card: Option<PathBuf>,
    /// Write a table with a row per episode: where it began, in physical units, and how it went.
    #[arg(long, value_name = "FILE.csv")]
    episodes: Option<PathBuf>,
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
        let task = setup.rollout_settings();
        let (max_steps, start) = (self.max_steps.unwrap_or(task.max_steps), self.start.unwrap_or(task.start));
        let settings = RolloutSettings { max_steps, start };
        let mut rollout = setup.rollout_under(settings, self.seed);
        let mut rows = vec![header(&rollout)];
        let played = episodes_seen(&mut rollout, &mut learner, runs, None, self.seed, &mut |rollout| {
            rows.push(row(rows.len() - 1, rollout));
        });
        let e = Evaluation::of(&played, self.seed);
        if let Some(file) = &self.episodes {
            files::write(file, rows.concat())?;
        }
        if let Some(file) = &self.card {
            let text = card::card(&files::checkpoint(&self.run)?, &setup, &learner, (&e, settings));
            files::write(file, text)?;
        }
        if self.json {
            outln!("{}", serde_json::to_string(&Json::of(&e, settings)).expect("plain data has a form in JSON"));
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
        outln!("rounds         {:.2} per episode of {max_steps} steps", e.rounds_mean);
        let first = e.first_round_steps_mean.map_or("never".to_owned(), |s| format!("after {s:.1} steps"));
        outln!("first round    {first}");
        outln!("sinks          {}", percent(e.sink_rate));
        outln!("total reward   {:.4} per episode", e.total_reward_mean);
        let start = match start {
            Start::Initial => "the environment's own",
            Start::Anywhere => "anywhere on safe ground",
        };
        outln!("starts         {start}, seed {}", e.seed);
        Ok(ExitCode::SUCCESS)
    }
}

/// The names of the columns of the table of episodes.
fn header(rollout: &Rollout) -> String {
    let channels = &rollout.product().environment().spec().state;
    let start: String = channels.iter().map(|channel| format!("start {},", channel.name)).collect();
    format!("episode,{start}success,rounds,first_round_steps,steps,sink,total_reward\n")
}

/// The row of the episode that is over, the `episode`th from 0.
fn row(episode: usize, rollout: &Rollout) -> String {
    let e = rollout.episode();
    let start: String = rollout.start_state().iter().map(|x| format!("{x},")).collect();
    let first = e.first_round_steps.map_or(String::new(), |steps| steps.to_string());
    let (success, rounds, steps, sink) = (e.success(), e.rounds, e.steps, e.sink);
    format!("{episode},{start}{success},{rounds},{first},{steps},{sink},{}\n", e.total_reward)
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
    start: Start,
    max_steps: u32,
}

impl Json {
    fn of(e: &Evaluation, settings: RolloutSettings) -> Json {
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
            start: settings.start,
            max_steps: settings.max_steps,
        }
    }
}
