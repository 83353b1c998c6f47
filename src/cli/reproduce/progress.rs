//! What a terminal shows while cells are run: one bar for all with the remaining time, one for each that runs; elsewhere lines.

use super::cell::{Cell, Plan};
use indicatif::{HumanDuration, MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// The progress of a campaign on standard error.
pub struct Progress {
    bars: MultiProgress,
    total: ProgressBar,
    /// Lines instead of bars.
    lines: bool,
    cells: usize,
    done: AtomicUsize,
    /// Environment steps, as far as known.
    steps: AtomicU64,
    budget: u64,
    began: Instant,
}

/// The progress of one cell.
pub struct CellBar<'a> {
    bar: ProgressBar,
    all: &'a Progress,
    budget: u64,
    shown: AtomicU64,
}

impl Progress {
    /// Nothing done of `missing`, after `kept` cells that were finished before.
    pub fn new(kept: usize, missing: &[&Plan], quiet: bool) -> Progress {
        let terminal = std::io::stderr().is_terminal();
        let target = if quiet || !terminal { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr_with_hz(5) };
        let bars = MultiProgress::with_draw_target(target);
        let budget = missing.iter().map(|plan| plan.budget).sum();
        let total = bars.add(ProgressBar::new(budget));
        let style = "{elapsed_precise} {wide_bar} at most {eta} left  {msg}";
        total.set_style(ProgressStyle::with_template(style).expect("the template is well formed"));
        let progress = Progress {
            bars,
            total,
            lines: !quiet && !terminal,
            cells: missing.len(),
            done: AtomicUsize::new(0),
            steps: AtomicU64::new(0),
            budget,
            began: Instant::now(),
        };
        progress.total.set_message(progress.count());
        if !quiet {
            eprintln!("{} cells to run, {kept} kept; after Ctrl-C, the same command goes on with the next cell", missing.len());
        }
        progress
    }

    fn count(&self) -> String {
        format!("{}/{} cells", self.done.load(Ordering::Relaxed), self.cells)
    }

    /// A cell begins.
    pub fn begin(&self, plan: &Plan) -> CellBar<'_> {
        let bar = self.bars.add(ProgressBar::new(plan.budget));
        let style = "  {prefix}  {bar:24} {human_pos}/{human_len} steps  {per_sec}";
        bar.set_style(ProgressStyle::with_template(style).expect("the template is well formed"));
        bar.set_prefix(format!("{} {} seed {}", plan.subject.name, plan.variant, plan.seed));
        CellBar { bar, all: self, budget: plan.budget, shown: AtomicU64::new(0) }
    }

    /// The remaining time, if all cells need their whole budget.
    fn left(&self) -> Duration {
        let steps = self.steps.load(Ordering::Relaxed);
        let share = self.budget.saturating_sub(steps) as f64 / steps.max(1) as f64;
        Duration::try_from_secs_f64(self.began.elapsed().as_secs_f64() * share).unwrap_or(Duration::MAX)
    }

    /// All is done.
    pub fn finish(&self) {
        self.total.abandon();
    }
}

impl CellBar<'_> {
    /// Environment steps so far.
    pub fn step(&self, step: u64) {
        let step = step.min(self.budget);
        let more = step.saturating_sub(self.shown.swap(step, Ordering::Relaxed));
        self.all.steps.fetch_add(more, Ordering::Relaxed);
        self.all.total.inc(more);
        self.bar.set_position(step);
    }

    /// The cell is finished: steps that it did not need count as done.
    pub fn finish(&self, cell: Option<&Cell>) {
        self.step(self.budget);
        self.bar.finish_and_clear();
        self.all.done.fetch_add(1, Ordering::Relaxed);
        self.all.total.set_message(self.all.count());
        let (true, Some(cell)) = (self.all.lines, cell) else { return };
        let (e, o) = (&cell.outcome.evaluation, &cell.outcome);
        let first = match o.first_perfect {
            Some(milestone) => format!("perfect after {} steps", milestone.step),
            None if o.evaluating.wall == 0.0 => "not evaluated in between".to_owned(),
            None => "never perfect".to_owned(),
        };
        eprintln!(
            "{}: {} {} seed {}: {}/{}, {first}, {} steps in {:.0} s; at most {} left",
            self.all.count(),
            cell.task,
            cell.variant,
            cell.seed,
            e.successes,
            e.runs,
            o.steps,
            o.training.wall + o.evaluating.wall,
            HumanDuration(self.all.left()),
        );
    }
}
