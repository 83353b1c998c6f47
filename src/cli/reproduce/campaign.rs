//! The arguments that experiments share, and the way from them to finished cells: what is there is kept, the rest is run.

use super::cell::{Cell, Conditions, Plan};
use super::learn::learn;
use super::machine::machine;
use super::progress::Progress;
use super::subject::{PAPER_TASKS, Subject};
use crate::cli::failure::Failure;
use crate::task::Override;
use clap::Args;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Arguments of every experiment.
#[derive(Args, Debug)]
pub struct Campaign {
    /// Tasks: names of shipped ones or task files, joined by commas or repeated; by default the six of the paper.
    #[arg(long = "task", value_name = "TASK", value_delimiter = ',')]
    tasks: Vec<String>,
    /// Training seeds per contender.
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u64).range(1..=1000))]
    seeds: u64,
    /// The first of them; recipes were chosen on seeds 1 to 10.
    #[arg(long, default_value_t = 11)]
    first_seed: u64,
    /// The recipe in the task files.
    #[arg(long, default_value = "fast")]
    preset: String,
    /// A value in place of the recipe's, such as learner.n_step=5; may be repeated. Choose another --out with it.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<Override>,
    /// Environment steps of each training run, in place of the recipe's.
    #[arg(long, value_name = "STEPS")]
    budget: Option<u64>,
    /// Episodes in the final evaluation of each policy; by default the task's, 200.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    runs: Option<u32>,
    /// Training runs side by side. Times by the clock are fair only where each has a processor of its own.
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u8).range(1..=64))]
    jobs: u8,
    /// The folder of results.
    #[arg(long, value_name = "FOLDER", default_value = "results")]
    pub out: PathBuf,
    /// Run nothing; write the reports of what is finished.
    #[arg(long)]
    report_only: bool,
    /// No progress.
    #[arg(long, short)]
    quiet: bool,
}

impl Campaign {
    /// The tasks that were asked for.
    ///
    /// # Errors
    /// An unknown name, or what is wrong with a task.
    pub fn subjects(&self) -> Result<Vec<Subject>, Failure> {
        let names = if self.tasks.is_empty() { PAPER_TASKS.map(str::to_owned).to_vec() } else { self.tasks.clone() };
        names.iter().map(|name| Subject::open(name, &self.preset)).collect()
    }

    /// The tasks that a report lists: the paper's and those asked for.
    ///
    /// # Errors
    /// What is wrong with a task.
    pub fn reported(&self, asked: &[Subject]) -> Result<Vec<Subject>, Failure> {
        let mut all = vec![];
        for name in PAPER_TASKS {
            match asked.iter().find(|subject| subject.name == name) {
                Some(subject) => all.push(subject.clone()),
                None => all.push(Subject::open(name, &self.preset)?),
            }
        }
        all.extend(asked.iter().filter(|subject| !PAPER_TASKS.contains(&subject.name.as_str())).cloned());
        Ok(all)
    }

    /// The seeds of training.
    pub fn seeds(&self) -> impl Iterator<Item = u64> + '_ {
        (0..self.seeds).map(|k| self.first_seed.saturating_add(k))
    }

    /// The recipe's name.
    pub fn preset(&self) -> &str {
        &self.preset
    }

    /// `name`, with the recipe's in it unless it is the usual one.
    pub fn report_name(&self, name: &str) -> String {
        if self.preset == "fast" { name.to_owned() } else { format!("{name}-{}", self.preset) }
    }

    /// What was changed in the recipes, in words for a report; empty for nothing.
    pub fn changes(&self) -> String {
        let all = self.overrides.iter().map(|o| format!("{} = {}", o.path, o.value));
        let budget = self.budget.map(|steps| format!("training.steps = {steps}"));
        all.chain(budget).collect::<Vec<_>>().join(", ")
    }

    /// The cell of a contender or variant, which changes `overrides` in the recipe before the user does.
    ///
    /// # Errors
    /// No such preset, or overrides that do not fit.
    pub fn plan(&self, subject: &Subject, variant: &str, overrides: &[Override], seed: u64) -> Result<Plan, Failure> {
        let budget = self.budget.map(|steps| Override { path: "training.steps".to_owned(), value: steps.to_string() });
        let all = overrides.iter().chain(&self.overrides).cloned().chain(budget).collect();
        Plan::new(subject, variant, (&self.preset, all), seed, self.runs)
    }

    /// Runs the plans that are not finished yet, and calls `report` at first and after each.
    ///
    /// # Errors
    /// The first failure; cells that were finished before it are kept.
    pub fn run(&self, plans: &[Plan], report: &(dyn Fn() -> Result<(), Failure> + Sync)) -> Result<(), Failure> {
        let missing: Vec<&Plan> = plans.iter().filter(|plan| plan.load(&self.out).is_none()).collect();
        report()?;
        if self.report_only || missing.is_empty() {
            return Ok(());
        }
        let progress = Progress::new(plans.len() - missing.len(), &missing, self.quiet);
        let (next, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
        let failure: Mutex<Option<Failure>> = Mutex::new(None);
        let reporting = Mutex::new(());
        let jobs = usize::from(self.jobs).min(missing.len());
        let conditions = Conditions { machine: machine(), jobs, version: env!("CARGO_PKG_VERSION").to_owned() };
        let one = |plan: &Plan| -> Result<(), Failure> {
            let bar = progress.begin(plan);
            learn(plan, &self.out, conditions.clone(), &|step| bar.step(step))?;
            bar.finish(plan.load(&self.out).as_ref());
            let _guard = reporting.lock().expect("reports do not panic");
            report()
        };
        std::thread::scope(|scope| {
            for _ in 0..jobs {
                scope.spawn(|| {
                    while !stop.load(Ordering::Relaxed) {
                        let Some(plan) = missing.get(next.fetch_add(1, Ordering::Relaxed)) else { break };
                        if let Err(error) = one(plan) {
                            stop.store(true, Ordering::Relaxed);
                            failure.lock().expect("nobody panics while holding it").get_or_insert(error);
                        }
                    }
                });
            }
        });
        progress.finish();
        failure.into_inner().expect("nobody panics while holding it").map_or(Ok(()), Err)
    }

    /// The finished ones of `plans`, in their order.
    pub fn finished(&self, plans: &[Plan]) -> Vec<Option<Cell>> {
        plans.iter().map(|plan| plan.load(&self.out)).collect()
    }
}
