//! `replay`: one greedy episode of a trained policy, step by step.

use super::failure::Failure;
use super::files;
use super::output::outln;
use super::trajectory::{Names, Row};
use clap::Args;
use serde_json::json;
use std::path::PathBuf;
use std::process::ExitCode;

/// Arguments of `replay`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  ltl-rover replay runs/b1
  ltl-rover replay runs/b1 --at 100,50,0,0 --csv path.csv
  ltl-rover replay runs/b1 --seed 7 --json | tail -n 1")]
pub struct Replay {
    /// A folder that `train` wrote, or a checkpoint or policy file.
    #[arg(value_name = "RUN")]
    run: PathBuf,
    /// The seed of the start.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Start in this state of the environment, in physical units.
    #[arg(long, value_name = "X,Y,…", value_delimiter = ',', allow_negative_numbers = true)]
    at: Option<Vec<f32>>,
    /// One JSON object per row, and a last one that sums up the episode.
    #[arg(long)]
    json: bool,
    /// Write the rows to a CSV file instead.
    #[arg(long, value_name = "FILE", conflicts_with = "json")]
    csv: Option<PathBuf>,
}

impl Replay {
    /// Plays the episode and prints it.
    ///
    /// # Errors
    /// A run that cannot be read, a start of the wrong length, a file that cannot be written.
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let (setup, mut learner) = files::policy(&self.run)?;
        let mut rollout = setup.rollout(self.seed);
        let spec = rollout.product().environment().spec().clone();
        if let Some(state) = &self.at {
            if state.len() != spec.state.len() {
                let names: Vec<String> = spec.state.iter().map(|c| c.name.to_string()).collect();
                return Err(Failure::input(format!("--at takes {} numbers: {}", names.len(), names.join(", "))));
            }
            rollout.restart_at(state);
        }
        let names = Names { automaton: setup.automaton(), spec: &spec };
        let mut table =
            self.csv.as_ref().map(|path| csv::Writer::from_path(path).map_err(|e| Failure::file(path, e))).transpose()?;
        let failed = |e: csv::Error| Failure::running(e);
        match &mut table {
            Some(table) => table.write_record(names.columns()).map_err(failed)?,
            None if !self.json => outln!("{}", names.head()),
            None => {}
        }
        let (mut index, mut step) = (0, None);
        loop {
            let product = rollout.product();
            let row = Row {
                index,
                state: product.environment().state(),
                labels: product.labels(),
                at: product.at(),
                step: step.as_ref(),
                rounds: product.rounds().completed(),
            };
            match &mut table {
                Some(table) => table.write_record(names.record(&row)).map_err(failed)?,
                None if self.json => outln!("{}", names.object(&row)),
                None => outln!("{}", names.line(&row)),
            }
            step = rollout.step(&mut learner);
            index += 1;
            if step.is_none() {
                break;
            }
        }
        let e = rollout.episode();
        if self.json {
            outln!("{}", json!({ "episode": e, "success": e.success(), "seed": self.seed }));
        } else {
            let verdict = if e.success() { "success" } else { "failure" };
            let first = e.first_round_steps.map_or(String::new(), |s| format!(", the first after {s}"));
            let sink = if e.sink { ", ended in a sink" } else { "" };
            outln!("{verdict}: {} rounds in {} steps{first}{sink}", e.rounds, e.steps);
        }
        Ok(ExitCode::SUCCESS)
    }
}
