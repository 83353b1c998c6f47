//! Tables 1 and 2: modular DDPG and its baselines on the same tasks, with the same recipes, budgets and seeds.

use super::campaign::Campaign;
use super::cell::Plan;
use super::method::Method;
use super::subject::Subject;
use super::summary::{Group, conditions};
use crate::cli::failure::Failure;
use clap::Args;
use std::process::ExitCode;

/// Arguments of `table1` and `table2`, which share their cells.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  ltl-rover reproduce table1 --task ball_pass_b1,ball_pass_b2 --jobs 1
  ltl-rover reproduce table1 --method modular --seeds 3 --first-seed 101
  ltl-rover reproduce table2 --report-only")]
pub struct Contest {
    #[command(flatten)]
    pub campaign: Campaign,
    /// Contenders, joined by commas or repeated; by default all three. The standard product differs only where the automaton has
    /// several accepting sets.
    #[arg(long = "method", value_enum, value_delimiter = ',')]
    methods: Vec<Method>,
}

/// What is reported: a contender on a task.
pub struct Row {
    /// The contender.
    pub method: Method,
    /// Its cells.
    pub group: Group,
}

impl Contest {
    /// Runs what is missing, and writes the report by `write` at first and after each cell.
    ///
    /// # Errors
    /// What is wrong with the tasks; what cannot be written.
    pub fn run(&self, write: fn(&Contest, &[Row]) -> Result<(), Failure>) -> Result<ExitCode, Failure> {
        let asked = self.campaign.subjects()?;
        let listed = self.campaign.reported(&asked)?;
        let mut plans = vec![];
        for subject in &asked {
            for seed in self.campaign.seeds() {
                for method in self.chosen().filter(|method| method.applies(subject.sets)) {
                    plans.push(self.plan(subject, method, seed)?);
                }
            }
        }
        self.campaign.run(&plans, &|| write(self, &self.rows(&listed)?))?;
        Ok(ExitCode::SUCCESS)
    }

    fn chosen(&self) -> impl Iterator<Item = Method> + '_ {
        Method::ALL.into_iter().filter(|method| self.methods.is_empty() || self.methods.contains(method))
    }

    fn plan(&self, subject: &Subject, method: Method, seed: u64) -> Result<Plan, Failure> {
        self.campaign.plan(subject, method.key(), &method.overrides(), seed)
    }

    /// Every contender on every task, with the cells that are finished.
    fn rows(&self, listed: &[Subject]) -> Result<Vec<Row>, Failure> {
        let mut rows = vec![];
        for subject in listed {
            for method in Method::ALL.into_iter().filter(|method| method.applies(subject.sets)) {
                let plans = self.campaign.seeds().map(|seed| self.plan(subject, method, seed));
                let plans: Vec<Plan> = plans.collect::<Result<_, _>>()?;
                let group = Group {
                    task: subject.name.clone(),
                    variant: method.key().to_owned(),
                    max_steps: subject.task().file().evaluation.max_steps,
                    cells: self.campaign.finished(&plans),
                };
                rows.push(Row { method, group });
            }
        }
        Ok(rows)
    }

    /// How the numbers came about, in sentences.
    pub fn about(&self, rows: &[Row]) -> String {
        let seeds: Vec<u64> = self.campaign.seeds().collect();
        let mut text = format!(
            "Recipe `{}`, training seeds {} to {}. All contenders have the same recipe and budget; they differ by one switch.\n",
            self.campaign.preset(),
            seeds[0],
            seeds[seeds.len() - 1],
        );
        let changes = self.campaign.changes();
        if !changes.is_empty() {
            text += &format!("Changed in the recipes: {changes}.\n");
        }
        let groups: Vec<Group> = rows.iter().map(|row| row.group.clone()).collect();
        for line in conditions(&groups) {
            text += &format!("Machine: {line}.\n");
        }
        text
    }
}
