//! The commands, and the way from the program's arguments to its exit code.

use super::bench;
use super::check;
use super::classify;
use super::eval;
use super::failure::Failure;
use super::plot;
use super::replay;
use super::reproduce::Reproduce;
use super::run;
use super::schema;
use super::train;
use super::translate;
use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Tasks in linear temporal logic, learned by modular deep reinforcement learning.
#[derive(Parser, Debug)]
#[command(name = "ltl-rover", version, propagate_version = true, arg_required_else_help = true, max_term_width = 110)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The commands. Each variant holds the arguments of the module of its name.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// Check automata in the HOA format, a formula, or both against one another.
    Check(check::Check),
    /// Tell what kind of property a formula is, and what it says in English.
    Classify(classify::Classify),
    /// Translate formulas to small automata, as HOA, DOT or JSON.
    Translate(translate::Translate),
    /// Learn a task: train until it is solved or the budget is spent.
    Train(train::Train),
    /// Judge a trained policy: success rate with its interval, rounds, sinks.
    Eval(eval::Eval),
    /// Walk the embedded product at random (Algorithm 1 of the paper).
    Run(run::Run),
    /// Play one greedy episode of a trained policy, step by step.
    Replay(replay::Replay),
    /// Draw the curves of one or several runs: average and total reward, rounds, success.
    Plot(plot::Plot),
    /// Make the tables and figures of the paper: trainings over seeds, intervals, curves, trajectories.
    Reproduce(Reproduce),
    /// Time the networks and whole training steps: all implementations in one table of ratios.
    Bench(bench::Bench),
    /// Print the JSON schema of task files.
    Schema(schema::Schema),
}

/// Reads the program's arguments, runs the command, prints its error if there is one.
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            let _ = error.print();
            return ExitCode::from(error.exit_code() as u8);
        }
    };
    let done: Result<ExitCode, Failure> = match &cli.command {
        Command::Check(check) => check.run(),
        Command::Classify(classify) => classify.run(),
        Command::Translate(translate) => translate.run(),
        Command::Train(train) => train.run(),
        Command::Eval(eval) => eval.run(),
        Command::Run(run) => run.run(),
        Command::Replay(replay) => replay.run(),
        Command::Plot(plot) => plot.run(),
        Command::Reproduce(reproduce) => reproduce.run(),
        Command::Bench(bench) => bench.run(),
        Command::Schema(schema) => schema.run(),
    };
    done.unwrap_or_else(|failure| failure.print())
}
