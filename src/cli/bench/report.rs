//! The table of a benchmark run: medians, bests, ratios to the bound, and the goals.

use super::measure::Measure;
use crate::nn::fused::Kernel;
use crate::nn::workload::operations;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;

/// The times of all rounds.
pub struct Report {
    names: Vec<String>,
    /// Floating-point operations a second, round by round.
    pub peaks: Vec<f64>,
    /// Of each contender: seconds for one of each measure, round by round.
    pub samples: Vec<BTreeMap<Measure, Vec<f64>>>,
}

/// Something the kernels are meant to reach.
#[derive(Clone, Debug, Serialize)]
pub struct Goal {
    what: String,
    value: f64,
    goal: f64,
    at_least: bool,
}

impl Goal {
    /// Whether it is reached.
    pub fn reached(&self) -> bool {
        if self.at_least { self.value >= self.goal } else { self.value <= self.goal }
    }
}

const SMALL: Measure = Measure::Update { hidden: 64, rows: 64 };
const LARGE: Measure = Measure::Update { hidden: 256, rows: 128 };

impl Report {
    /// No rounds yet.
    pub fn new(names: Vec<String>) -> Report {
        let samples = names.iter().map(|_| BTreeMap::new()).collect();
        Report { names, peaks: Vec::new(), samples }
    }

    fn sorted(&self, contender: usize, measure: Measure) -> Option<Vec<f64>> {
        let mut times = self.samples[contender].get(&measure).filter(|times| !times.is_empty())?.clone();
        times.sort_by(f64::total_cmp);
        Some(times)
    }

    fn median(&self, contender: usize, measure: Measure) -> Option<f64> {
        self.sorted(contender, measure).map(|times| times[times.len() / 2])
    }

    /// The best round: what the contender does when nothing else runs on the machine.
    fn best(&self, contender: usize, measure: Measure) -> Option<f64> {
        self.sorted(contender, measure).map(|times| times[0])
    }

    fn peak(&self) -> f64 {
        self.peaks.iter().copied().fold(0.0, f64::max)
    }

    fn bound(&self, measure: Measure) -> Option<f64> {
        measure.shape().map(|(shape, rows)| operations(&shape, rows) / self.peak())
    }

    fn named(&self, part: &str) -> Option<usize> {
        self.names.iter().position(|name| name.contains(part))
    }

    /// The goals that this run's contenders can be held to.
    pub fn goals(&self) -> Vec<Goal> {
        let mut goals = Vec::new();
        let mut add = |what: &str, at_least: bool, goal: f64, value: Option<f64>| {
            goals.extend(value.map(|value| Goal { what: what.to_owned(), value, goal, at_least }));
        };
        let over_bound = |measure| Some(self.best(0, measure)? / self.bound(measure)?);
        let times_native = |part: &str, measure| Some(self.best(self.named(part)?, measure)? / self.best(0, measure)?);
        add("native time over the bound at (64, 64)", false, 1.6, over_bound(SMALL));
        add("native time over the bound at (256, 128)", false, 1.35, over_bound(LARGE));
        add("WebAssembly time over native at (64, 64)", false, 2.6, times_native("wasm", SMALL));
        add("WebAssembly time over native at (256, 128)", false, 2.6, times_native("wasm", LARGE));
        add("burn-flex time over native at (64, 64)", true, 3.0, times_native("burn-flex", SMALL));
        add("burn-ndarray time over native at (64, 64)", true, 5.0, times_native("burn-ndarray", SMALL));
        // Medians: the best round of steps is one of states whose replay holds no batch yet, without updates.
        let share = self.median(0, Measure::StepUpdate).zip(self.median(0, Measure::Step)).map(|(update, step)| update / step);
        add("native training steps over updates alone", true, 0.85, share);
        goals
    }

    /// Everything as one JSON object.
    pub fn json(&self) -> String {
        #[derive(Serialize)]
        struct Time<'a> {
            contender: &'a str,
            #[serde(flatten)]
            measure: Measure,
            median_us: f64,
            best_us: f64,
            over_bound: Option<f64>,
        }
        let mut times = Vec::new();
        for (contender, name) in self.names.iter().enumerate() {
            for measure in Measure::ALL {
                let both = self.median(contender, measure).zip(self.best(contender, measure));
                times.extend(both.map(|(median, best)| Time {
                    contender: name,
                    measure,
                    median_us: 1e6 * median,
                    best_us: 1e6 * best,
                    over_bound: self.bound(measure).map(|bound| best / bound),
                }));
            }
        }
        let goals: Vec<_> = self
            .goals()
            .into_iter()
            .map(|goal| serde_json::json!({ "what": goal.what, "value": goal.value, "goal": goal.goal, "reached": goal.reached() }))
            .collect();
        serde_json::json!({
            "kernel": Kernel::fastest().name(),
            "peak_gflops": self.peak() / 1e9,
            "rounds": self.peaks.len(),
            "times": times,
            "goals": goals,
        })
        .to_string()
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "one core, {}: {:.1} GFLOP/s of multiply-adds; {} rounds",
            Kernel::fastest().name(),
            self.peak() / 1e9,
            self.peaks.len()
        )?;
        writeln!(f, "one update in microseconds: median (best), best over the bound")?;
        let width = self.names.iter().map(|name| name.len()).max().unwrap_or(0);
        write!(f, "{:width$}", "(hidden, batch)")?;
        let updates = Measure::ALL.into_iter().filter(|measure| measure.shape().is_some());
        for measure in updates.clone() {
            if let Measure::Update { hidden, rows } = measure {
                write!(f, " | {:^25}", format!("({hidden}, {rows})"))?;
            }
        }
        writeln!(f, " | updates/s | env steps/s | action µs")?;
        write!(f, "{:width$}", "bound")?;
        for measure in updates.clone() {
            write!(f, " | {:25.1}", 1e6 * self.bound(measure).unwrap_or(f64::NAN))?;
        }
        writeln!(f, " |           |             |")?;
        for (contender, name) in self.names.iter().enumerate() {
            write!(f, "{name:width$}")?;
            for measure in updates.clone() {
                match (self.median(contender, measure), self.best(contender, measure), self.bound(measure)) {
                    (Some(median), Some(best), Some(bound)) => {
                        write!(f, " | {:8.1} ({:7.1}) {:5.2} ×", 1e6 * median, 1e6 * best, best / bound)?;
                    }
                    _ => write!(f, " | {:25}", "")?,
                }
            }
            let rate = |measure| self.median(contender, measure).map_or(String::new(), |time| format!("{:.0}", 1.0 / time));
            let act = self.median(contender, Measure::Act).map_or(String::new(), |time| format!("{:.2}", 1e6 * time));
            writeln!(f, " | {:>9} | {:>11} | {act:>9}", rate(SMALL), rate(Measure::Step))?;
        }
        writeln!(
            f,
            "updates/s at (64, 64); environment steps/s of Ball-Pass φ_B1, recipe of the paper, one update of 64 a step"
        )?;
        for goal in self.goals() {
            let (bar, end) = (if goal.at_least { "≥" } else { "≤" }, if goal.reached() { "reached" } else { "MISSED" });
            writeln!(f, "{:45} {:6.2}   goal {bar} {:<5} {end}", goal.what, goal.value, goal.goal)?;
        }
        Ok(())
    }
}
