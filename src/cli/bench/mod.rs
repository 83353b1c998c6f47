//! `bench`: how fast the networks and whole training steps are, all implementations in turn, as ratios within one run.

mod measure;
mod node;
mod report;
mod translate;

use super::failure::Failure;
use crate::cli::output::{out, outln};
use crate::nn::fused::Kernel;
use crate::nn::workload::peak;
use clap::{Args, Subcommand};
use measure::{Contender, Measure, Native};
use report::Report;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

/// Arguments of `bench`.
#[derive(Args, Debug)]
#[command(
    args_conflicts_with_subcommands = true,
    after_help = "Examples:
  ltl-rover bench
  ltl-rover bench --rounds 101 --json
  ltl-rover bench --wasm target/wasm32-unknown-unknown/release/examples/kernels_wasm.wasm
  ltl-rover bench translate

The contenders take turns, round after round, each for a few milliseconds; the table shows the median and the best round.
The bound is the time that the matrix products of an update take at the measured rate of multiply-adds of one core.
`make bench` builds everything that takes part: burn's two backends and the WebAssembly module."
)]
pub struct Bench {
    /// Something else than the networks.
    #[command(subcommand)]
    what: Option<What>,
    /// Rounds; each contender computes every measure once in each.
    #[arg(long, default_value_t = 31, value_parser = clap::value_parser!(u32).range(1..=1000))]
    rounds: u32,
    /// Milliseconds of each measure in each round.
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    milliseconds: u32,
    /// The kernel's WebAssembly build, to be run by Node.
    #[arg(long, value_name = "FILE")]
    wasm: Option<PathBuf>,
    /// Exit with code 1 if a goal is missed.
    #[arg(long)]
    check: bool,
    /// One JSON object.
    #[arg(long)]
    json: bool,
}

/// What can be measured beside the networks.
#[derive(Subcommand, Debug)]
enum What {
    /// How small the automata of whole collections of formulas are, and how long it takes to make them.
    Translate(translate::Translate),
}

impl Bench {
    /// Times everybody and prints the table.
    ///
    /// # Errors
    /// If the WebAssembly module cannot be run.
    pub fn run(&self) -> Result<ExitCode, Failure> {
        if let Some(What::Translate(translate)) = &self.what {
            return translate.run();
        }
        let mut contenders: Vec<Box<dyn Contender>> = Vec::new();
        contenders.extend(Native::all().into_iter().map(|native| Box::new(native) as Box<dyn Contender>));
        if let Some(module) = &self.wasm {
            let node = node::Kernels::start(module).map_err(Failure::input)?;
            contenders.insert(1, Box::new(node));
        }
        let mut report = Report::new(contenders.iter().map(|contender| contender.name().to_owned()).collect());
        for round in 0..self.rounds {
            eprint!("\rround {} of {}", round + 1, self.rounds);
            report.peaks.push(measured_peak());
            for measure in Measure::ALL {
                for (contender, samples) in contenders.iter_mut().zip(&mut report.samples) {
                    let own = samples.entry(measure).or_default();
                    // The first round finds out how many fit the time.
                    let one = match own.last() {
                        Some(&last) => last,
                        None => contender.time(measure, 3).map_err(Failure::running)?.unwrap_or(1.0),
                    };
                    let count = (f64::from(self.milliseconds) / 1000.0 / one).clamp(1.0, 1e7) as usize;
                    own.extend(contender.time(measure, count).map_err(Failure::running)?);
                }
            }
        }
        eprintln!();
        if self.json {
            outln!("{}", report.json());
        } else {
            out!("{report}");
        }
        let missed = report.goals().iter().any(|goal| !goal.reached());
        Ok(ExitCode::from(u8::from(self.check && missed)))
    }
}

/// Floating-point operations a second of one core that does nothing but multiply-adds.
fn measured_peak() -> f64 {
    let start = Instant::now();
    peak(Kernel::fastest(), 1_000_000) / start.elapsed().as_secs_f64()
}
