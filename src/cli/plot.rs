//! `plot`: the reward curves of one or several runs, as SVG or PNG.

use super::curves::{self, Curve};
use super::failure::Failure;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use std::process::ExitCode;

/// Arguments of `plot`.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  ltl-rover plot runs/b1\n  ltl-rover plot runs/b1 runs/b1-standard --metric total-reward --out compare.png"
)]
pub struct Plot {
    /// Folders that `train` wrote; each becomes one curve.
    #[arg(required = true, value_name = "RUN")]
    runs: Vec<PathBuf>,
    /// What to draw, per episode.
    #[arg(long, value_enum, default_value_t = Metric::AverageReward)]
    metric: Metric,
    /// Episodes in the running mean.
    #[arg(long, default_value_t = 50, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    window: u32,
    /// Where to write; the ending decides between SVG and PNG. Default: METRIC.svg in the first run's folder.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// A column of `episodes.csv`.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub enum Metric {
    /// Reward per step of the episode.
    AverageReward,
    /// Sum of the episode's rewards.
    TotalReward,
    /// Rounds of accepting sets completed in the episode.
    Rounds,
    /// Whether the episode completed a round and never met a sink.
    Success,
}

impl Metric {
    /// The column's name in `episodes.csv`.
    pub fn column(self) -> &'static str {
        match self {
            Metric::AverageReward => "average_reward",
            Metric::TotalReward => "total_reward",
            Metric::Rounds => "rounds",
            Metric::Success => "success",
        }
    }

    /// The axis title.
    pub fn title(self) -> &'static str {
        match self {
            Metric::AverageReward => "average reward per step",
            Metric::TotalReward => "total reward per episode",
            Metric::Rounds => "rounds per episode",
            Metric::Success => "success rate",
        }
    }
}

impl Plot {
    /// Reads the runs' `episodes.csv` and writes the picture.
    ///
    /// # Errors
    /// A run without episodes, a file that cannot be read or written, an ending that is neither `.svg` nor `.png`.
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let mut drawn = Vec::new();
        for run in &self.runs {
            drawn.push(Curve::read(run, self.metric, self.window as usize)?);
        }
        let out = self.out.clone().unwrap_or_else(|| self.runs[0].join(self.metric.column()).with_extension("svg"));
        curves::draw(&out, self.metric, &drawn)?;
        eprintln!("wrote {}", out.display());
        Ok(ExitCode::SUCCESS)
    }
}
