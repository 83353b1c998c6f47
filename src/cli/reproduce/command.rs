//! The experiments and their arguments.

use super::ablation::Ablation;
use super::contest::Contest;
use super::curves::Curves;
use super::trajectories::Trajectories;
use super::{table1, table2};
use crate::cli::failure::Failure;
use clap::{Args, Subcommand};
use std::process::ExitCode;

/// Arguments of `reproduce`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  ltl-rover reproduce table1 --task ball_pass_b1,ball_pass_b2 --jobs 1
  ltl-rover reproduce table2 --report-only
  ltl-rover reproduce curves --task ball_pass_b1 --seeds 3 --budget 60000
  ltl-rover reproduce trajectories --task melas
  ltl-rover reproduce ablation --task ball_pass_b1 --seeds 3 --first-seed 1
  ltl-rover reproduce table1 --preset paper --task ball_pass_b1 --out results-paper

Results go to the folder results/: one small JSON file per finished training run in cells/, its policy in policies/, and reports as
Markdown, CSV, JSON and SVG, rewritten after each run. A run that is finished is kept and not repeated as long as nothing that decides
it has changed (task, automaton, recipe, budget, seed): after an interruption the same command goes on where it was.")]
pub struct Reproduce {
    #[command(subcommand)]
    what: What,
}

#[derive(Subcommand, Debug)]
enum What {
    /// Success over 200 runs: modular DDPG, standard DDPG, and the standard product where there are several accepting sets.
    Table1(Contest),
    /// Training time, and environment steps to the first 200 of 200; the same training runs as table1.
    Table2(Contest),
    /// Average and total reward per training episode, modular against standard DDPG.
    Curves(Curves),
    /// One round of a trained policy from two starts, drawn on the map's picture.
    Trajectories(Trajectories),
    /// Each option that a recipe adds to Algorithm 2 taken out in turn: steps to the first 200 of 200.
    Ablation(Ablation),
}

impl Reproduce {
    /// Runs the experiment and writes its reports.
    ///
    /// # Errors
    /// What is wrong with the tasks; files that cannot be read or written.
    pub fn run(&self) -> Result<ExitCode, Failure> {
        match &self.what {
            What::Table1(contest) => contest.run(table1::write),
            What::Table2(contest) => contest.run(table2::write),
            What::Curves(curves) => curves.run(),
            What::Trajectories(trajectories) => trajectories.run(),
            What::Ablation(ablation) => ablation.run(),
        }
    }
}
