//! What a terminal shows while training: a bar with rate and remaining time; elsewhere a line per evaluation.

use crate::eval::Evaluation;
use crate::train::EpisodeSummary;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::cell::Cell;
use std::io::IsTerminal;

/// Steps between redraws: asking the clock at every step would cost more than the step.
const STRIDE: u64 = 100;

/// The progress of a run on standard error.
pub struct Bar {
    bar: ProgressBar,
    /// Lines instead of a bar.
    lines: bool,
    /// Running means of success and rounds over episodes.
    means: Cell<(f64, f64)>,
}

impl Bar {
    /// A bar of `total` steps, `done` of which are done.
    pub fn new(total: u64, done: u64, quiet: bool) -> Bar {
        let terminal = std::io::stderr().is_terminal();
        let target = if quiet || !terminal { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr_with_hz(10) };
        let bar = ProgressBar::with_draw_target(Some(total), target);
        let style = "{elapsed_precise} {wide_bar} {human_pos}/{human_len} steps  {per_sec}  {eta} left  {msg}";
        bar.set_style(ProgressStyle::with_template(style).expect("the template is well formed"));
        bar.set_position(done);
        bar.reset_eta();
        Bar { bar, lines: !quiet && !terminal, means: Cell::new((0.0, 0.0)) }
    }

    /// Environment steps so far.
    pub fn step(&self, step: u64) {
        if step.is_multiple_of(STRIDE) {
            self.bar.set_position(step);
        }
    }

    /// A training episode has ended.
    pub fn episode(&self, episode: &EpisodeSummary) {
        let (success, rounds) = self.means.get();
        let towards = |mean: f64, value: f64| mean + 0.05 * (value - mean);
        self.means.set((towards(success, f64::from(episode.success)), towards(rounds, f64::from(episode.rounds))));
    }

    /// An evaluation after `step` steps.
    pub fn evaluation(&self, step: u64, e: &Evaluation) {
        let line = format!("greedy {}/{} rounds {:.1}", e.successes, e.runs, e.rounds_mean);
        if self.lines {
            eprintln!("step {step}: {line} sinks {:.0} %", 100.0 * e.sink_rate);
        } else {
            let (success, rounds) = self.means.get();
            self.bar.set_message(format!("{line} · exploring {:.0} % rounds {rounds:.1}", 100.0 * success));
        }
    }

    /// Leaves the bar as it is.
    pub fn finish(&self) {
        self.bar.abandon();
    }
}
