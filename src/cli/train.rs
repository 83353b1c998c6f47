//! `train`: learns a task and writes the run into a folder.

use super::curves::{self, Curve};
use super::failure::Failure;
use super::files;
use super::logs::Logs;
use super::output::outln;
use super::plot::Metric;
use super::progress::Bar;
use crate::agent::Replays;
use crate::task::{Override, Setup};
use crate::train::{Metrics, Run};
use clap::Args;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Arguments of `train`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  ltl-rover train specs/ball_pass_b1.toml --preset fast --seed 1 --out runs/b1
  ltl-rover train specs/ball_pass_b1.toml --set learner.modules=one --out runs/b1-standard
  ltl-rover train specs/cart_pole_c1.toml --steps 20000 --json | tail -n 1
  ltl-rover train specs/ball_pass_b1.toml --out runs/b1 --resume
  ltl-rover train specs/melas.toml --from runs/melas --set training.max_steps=20 --out runs/melas-finer

The folder receives task.toml, config.toml (all numbers, resolved), checkpoint.safetensors, policy.safetensors, episodes.csv,
progress.csv, progress.jsonl, evaluations.csv, summary.json and the reward curves.")]
pub struct Train {
    /// The task file.
    #[arg(value_name = "TASK.toml")]
    task: PathBuf,
    /// The recipe in the task file.
    #[arg(long, default_value = "fast")]
    preset: String,
    /// The seed of everything: the same seed gives the same run.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The run's folder; by default runs/TASK-PRESET-SEED.
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// A value in place of the preset's, such as learner.n_step=5; may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<Override>,
    /// The budget in environment steps, in place of the preset's.
    #[arg(long)]
    steps: Option<u64>,
    /// Go on from the checkpoint in the run's folder.
    #[arg(long)]
    resume: bool,
    /// Start with the networks of this run, checkpoint or policy file, whatever recipe they were trained by; their shapes must be
    /// the recipe's. Replays, optimisers and schedules begin anew.
    #[arg(long, value_name = "RUN", conflicts_with = "resume")]
    from: Option<PathBuf>,
    /// Keep the replays in the checkpoint, so that --resume goes on bit by bit (a larger file).
    #[arg(long)]
    save_replay: bool,
    /// Environment steps between checkpoints and rows of the logs.
    #[arg(long, default_value_t = 5000, value_parser = clap::value_parser!(u64).range(1..))]
    log_every: u64,
    /// One JSON object per evaluation, and a last one that sums up the run.
    #[arg(long)]
    json: bool,
    /// No progress.
    #[arg(long, short)]
    quiet: bool,
}

/// The last line of `train --json`, and `summary.json`.
#[derive(Serialize)]
struct Summary<'a> {
    /// Environment steps.
    steps: u64,
    /// Episodes begun.
    episodes: u64,
    /// Updates of all modules.
    updates: u64,
    /// Seconds, evaluations included.
    wall_s: f64,
    /// Environment steps of this session per second.
    steps_per_s: f64,
    /// Environment steps at the first periodic evaluation without a failure.
    first_perfect_step: Option<u64>,
    /// The best evaluation's success rate, and where it was.
    best_success_rate: Option<f64>,
    best_step: Option<u64>,
    seed: u64,
    preset: &'a str,
    out: String,
}

impl Train {
    /// Trains until the recipe says so.
    ///
    /// # Errors
    /// What is wrong with the task; files that cannot be read or written.
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let stem = self.task.file_stem().unwrap_or_default().to_string_lossy();
        let default_out = || PathBuf::from("runs").join(format!("{stem}-{}-{}", self.preset, self.seed));
        let out = self.out.clone().unwrap_or_else(default_out);
        let (setup, mut run) = if self.resume { self.resumed(&out)? } else { self.fresh()? };
        self.describe(&out, &setup)?;
        let began = Instant::now();
        let first_step = run.trainer().steps();
        let mut logs = Logs::open(&out, self.resume)?;
        let mut metrics = Metrics::of(run.trainer());
        let bar = Bar::new(run.trainer().settings().steps, first_step, self.quiet);
        let rate = |run: &Run| (run.trainer().steps() - first_step) as f64 / began.elapsed().as_secs_f64().max(1e-9);
        while !run.finished() {
            let progress = run.advance();
            if let Some(episode) = metrics.fold(&progress.tick) {
                logs.episode(&episode)?;
                bar.episode(&episode);
            }
            let step = progress.tick.step;
            bar.step(step);
            if let Some(evaluation) = &progress.evaluation {
                logs.evaluation(step, evaluation)?;
                bar.evaluation(step, evaluation);
                if self.json {
                    print_json(&serde_json::json!({ "step": step, "evaluation": evaluation }));
                }
            }
            if step.is_multiple_of(self.log_every) {
                logs.progress(metrics.row(), rate(&run), began.elapsed().as_secs_f64())?;
                self.save(&out, &setup, &run)?;
            }
        }
        if run.best().is_none() && run.trainer().settings().evaluate_every > 0 {
            let evaluation = run.evaluate();
            logs.evaluation(run.trainer().steps(), &evaluation)?;
            bar.evaluation(run.trainer().steps(), &evaluation);
        }
        logs.progress(metrics.row(), rate(&run), began.elapsed().as_secs_f64())?;
        logs.flush()?;
        self.save(&out, &setup, &run)?;
        let summary = Summary {
            steps: run.trainer().steps(),
            episodes: run.trainer().episodes(),
            updates: run.trainer().learner().updates(),
            wall_s: began.elapsed().as_secs_f64(),
            steps_per_s: rate(&run),
            first_perfect_step: run.first_perfect_step(),
            best_success_rate: run.best().map(|b| b.evaluation.success_rate),
            best_step: run.best().map(|b| b.step),
            seed: run.seed(),
            preset: setup.preset_name(),
            out: out.display().to_string(),
        };
        let json = serde_json::to_string(&summary).expect("plain data has a form in JSON");
        files::write(&out.join("summary.json"), &json)?;
        // A run that was too short for one episode has nothing to draw.
        for metric in [Metric::AverageReward, Metric::TotalReward] {
            if let Ok(curve) = Curve::read(&out, metric, 50) {
                curves::draw(&out.join(metric.column()).with_extension("svg"), metric, &[curve])?;
            }
        }
        bar.finish();
        if self.json {
            outln!("{json}");
        } else {
            outln!("{}", sentence(&summary));
        }
        Ok(ExitCode::SUCCESS)
    }

    fn overrides(&self) -> Vec<Override> {
        let steps = self.steps.map(|steps| Override { path: "training.steps".to_owned(), value: steps.to_string() });
        self.overrides.iter().cloned().chain(steps).collect()
    }

    fn fresh(&self) -> Result<(Setup, Run), Failure> {
        let setup = files::open(&self.task, &self.preset, &self.overrides())?;
        let mut run = setup.run(self.seed);
        if let Some(file) = &self.from {
            let policy = files::checkpoint(file)?.policy(run.trainer().learner().modules().len());
            run.trainer_mut().start_from(&policy).map_err(|e| Failure::file(file, e))?;
        }
        Ok((setup, run))
    }

    fn resumed(&self, out: &Path) -> Result<(Setup, Run), Failure> {
        if !self.overrides.is_empty() {
            return Err(Failure::input("--resume goes on with the numbers of the checkpoint; --set does not go with it"));
        }
        let checkpoint = files::checkpoint(out)?;
        if !checkpoint.resumable() {
            return Err(Failure::file(out, "this is a policy, on which training cannot go on"));
        }
        let setup = Setup::from_checkpoint(&checkpoint)?;
        let mut run = setup.resume(&checkpoint).map_err(|e| Failure::file(out, e))?;
        if let Some(steps) = self.steps {
            run.trainer_mut().set_budget(steps);
        }
        Ok((setup, run))
    }

    /// Writes the task, its automaton and all its numbers beside the results.
    fn describe(&self, out: &Path, setup: &Setup) -> Result<(), Failure> {
        files::write(&out.join("task.toml"), setup.task().text())?;
        if let (Some(hoa), Some(name)) = (setup.hoa(), &setup.task().file().specification.hoa) {
            let name = Path::new(name).file_name().unwrap_or("automaton.hoa".as_ref());
            files::write(&out.join(name), hoa)?;
        }
        files::write(&out.join("config.toml"), setup.resolved())
    }

    fn save(&self, out: &Path, setup: &Setup, run: &Run) -> Result<(), Failure> {
        let origin = setup.origin();
        let replays = if self.save_replay { Replays::Keep } else { Replays::Leave };
        files::write(&out.join(files::CHECKPOINT), run.save(&origin, replays))?;
        files::write(&out.join(files::POLICY), run.save_policy(&origin))
    }
}

fn print_json(value: &serde_json::Value) {
    outln!("{value}");
}

fn sentence(summary: &Summary<'_>) -> String {
    let perfect = match (summary.first_perfect_step, summary.best_success_rate) {
        (Some(step), _) => format!("first evaluation without a failure after {step} steps"),
        (None, Some(rate)) => format!("best evaluation {:.1} %, none without a failure", 100.0 * rate),
        (None, None) => "never evaluated".to_owned(),
    };
    let Summary { steps, episodes, updates, wall_s, steps_per_s, out, .. } = summary;
    format!("{steps} steps, {episodes} episodes, {updates} updates in {wall_s:.1} s ({steps_per_s:.0} steps/s): {perfect}; {out}")
}
