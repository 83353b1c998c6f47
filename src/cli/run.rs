//! `run`: Algorithm 1 of [Cai et al. 2021](crate::bib::Cai2021), a random run of the embedded product MDP.

use super::failure::Failure;
use super::files;
use super::output::outln;
use super::trajectory::{Names, Row};
use crate::product::{Start, product_trace_hash, run};
use crate::task::Override;
use clap::Args;
use serde_json::json;
use std::path::PathBuf;
use std::process::ExitCode;

/// Arguments of `run`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  ltl-rover run specs/ball_pass_b1.toml --steps 50 --seed 3
  ltl-rover run specs/cart_pole_c1.toml --json | tail -n 1

Every row is a product state: the environment's state, the letter read on entering it, the automaton's state q and the frontier T
of accepting sets still to be visited. The last line sums up the run; its trace_hash is the same on every machine.")]
pub struct Run {
    /// The task file.
    #[arg(value_name = "TASK.toml")]
    task: PathBuf,
    /// The recipe that chooses frontier rule and shaping.
    #[arg(long, default_value = "fast")]
    preset: String,
    /// A value in place of the preset's, such as product.frontier=printed; may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<Override>,
    /// The longest run, in steps.
    #[arg(long, default_value_t = 100)]
    steps: usize,
    /// The seed of starts, transitions and controls.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Start anywhere that is safe, instead of where the environment starts.
    #[arg(long)]
    anywhere: bool,
    /// One JSON object per row, and a last one that sums up the run.
    #[arg(long)]
    json: bool,
}

impl Run {
    /// Makes the run and prints it.
    ///
    /// # Errors
    /// What is wrong with the task.
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let setup = files::open(&self.task, &self.preset, &self.overrides)?;
        let mut product = setup.product();
        let start = if self.anywhere { Start::Anywhere } else { Start::Initial };
        let made = run(&mut product, start, self.steps, self.seed);
        let names = Names { automaton: setup.automaton(), spec: product.environment().spec() };
        let first = Row {
            index: 0,
            state: &made.initial,
            labels: made.start.labels,
            at: made.start.at,
            step: None,
            rounds: u32::from(made.start.closes_round),
        };
        let mut rounds = first.rounds;
        let rest = made.states.iter().enumerate().map(|(i, s)| {
            rounds += u32::from(s.step.closes_round);
            Row { index: i + 1, state: &s.state, labels: s.step.labels, at: s.step.to, step: Some(&s.step), rounds }
        });
        if !self.json {
            outln!("{}", names.head());
        }
        for row in std::iter::once(first).chain(rest) {
            if self.json {
                outln!("{}", names.object(&row));
            } else {
                outln!("{}", names.line(&row));
            }
        }
        let (steps, end, hash) = (made.states.len(), format!("{:?}", made.end).to_lowercase(), product_trace_hash(&made));
        if self.json {
            let hash = format!("{hash:016x}");
            outln!("{}", json!({ "steps": steps, "rounds": made.rounds, "end": end, "seed": self.seed, "trace_hash": hash }));
        } else {
            outln!("{steps} steps, {} rounds, end: {end}; trace {hash:016x}", made.rounds);
        }
        Ok(ExitCode::SUCCESS)
    }
}
