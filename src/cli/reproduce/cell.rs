//! A cell: one training run of one contender on one task with one seed, planned, identified by all that decides it, kept as JSON.

use super::machine::Seconds;
use super::subject::Subject;
use crate::cli::card::fingerprint;
use crate::cli::failure::Failure;
use crate::cli::files;
use crate::eval::Evaluation;
use crate::task::{Override, Preset};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

/// The seed of the starts on which finished policies are judged: that of `eval`, which training never uses.
pub const EVALUATION_SEED: u64 = 1000;

/// The version of the format. Cells of others are run anew.
const FORMAT: u32 = 1;

/// A cell that may have to be run.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The task.
    pub subject: Subject,
    /// The contender, or the variant of a recipe: a word for file names.
    pub variant: String,
    /// The recipe.
    pub preset: String,
    /// What is changed in it.
    pub overrides: Vec<Override>,
    /// The seed of training.
    pub seed: u64,
    /// Episodes of the final evaluation.
    pub runs: u32,
    /// Whether the curve over training episodes is kept.
    pub curve: bool,
    /// Environment steps at most.
    pub budget: u64,
    config: Value,
}

impl Plan {
    /// A cell of `subject`: training by `preset` with `overrides`.
    ///
    /// # Errors
    /// No such preset, or overrides that do not fit.
    pub fn new(
        subject: &Subject,
        variant: &str,
        recipe: (&str, Vec<Override>),
        seed: u64,
        runs: Option<u32>,
    ) -> Result<Plan, Failure> {
        let (preset, overrides) = recipe;
        let resolved = subject.preset(preset, &overrides)?;
        let runs = runs.unwrap_or(subject.task().file().evaluation.runs);
        Ok(Plan {
            variant: variant.to_owned(),
            preset: preset.to_owned(),
            seed,
            runs,
            curve: false,
            budget: resolved.training.steps,
            config: config(subject, &resolved, seed, runs),
            subject: subject.clone(),
            overrides,
        })
    }

    /// The same cell with the curve over its training episodes.
    #[must_use]
    pub fn with_curve(mut self) -> Plan {
        self.config["curve"] = true.into();
        Plan { curve: true, ..self }
    }

    /// 64 bits that stand for all that decides the outcome.
    pub fn hash(&self) -> String {
        format!("{:016x}", fingerprint(&self.config.to_string()))
    }

    /// The cell's file in the folder `out`.
    pub fn file(&self, out: &Path) -> PathBuf {
        let name = format!("{}.{}.{}.{}.json", self.subject.name, self.variant, self.seed, &self.hash()[..8]);
        out.join("cells").join(name)
    }

    /// The policy's file in the folder `out`.
    pub fn policy_file(&self, out: &Path) -> PathBuf {
        let name = format!("{}.{}.{}.{}.safetensors", self.subject.name, self.variant, self.seed, &self.hash()[..8]);
        out.join("policies").join(name)
    }

    /// The finished cell, if it is there and of this very plan.
    pub fn load(&self, out: &Path) -> Option<Cell> {
        let cell: Cell = serde_json::from_str(&std::fs::read_to_string(self.file(out)).ok()?).ok()?;
        (cell.format == FORMAT && cell.hash == self.hash()).then_some(cell)
    }

    /// The cell with its outcome.
    pub fn finished(&self, outcome: Outcome, conditions: Conditions) -> Cell {
        Cell {
            format: FORMAT,
            task: self.subject.name.clone(),
            variant: self.variant.clone(),
            preset: self.preset.clone(),
            seed: self.seed,
            hash: self.hash(),
            config: self.config.clone(),
            outcome,
            conditions,
        }
    }
}

/// A finished cell.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Cell {
    format: u32,
    /// The task's name.
    pub task: String,
    /// Contender or variant.
    pub variant: String,
    /// The recipe.
    pub preset: String,
    /// The seed of training.
    pub seed: u64,
    /// The plan's hash.
    pub hash: String,
    /// All that decides the outcome. Of a recipe, what differs from Algorithm 2: options that come later do not change it.
    pub config: Value,
    /// What came out.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// Where and how it ran.
    #[serde(flatten)]
    pub conditions: Conditions,
}

/// What training has led to.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Outcome {
    /// Environment steps.
    pub steps: u64,
    /// Episodes begun.
    pub episodes: u64,
    /// Updates of all modules.
    pub updates: u64,
    /// Training without evaluations.
    pub training: Seconds,
    /// The evaluations in between.
    pub evaluating: Seconds,
    /// The first evaluation without a failure.
    pub first_perfect: Option<Milestone>,
    /// Environment steps of the policy that is judged: the best that the evaluations in between have seen.
    pub best_step: u64,
    /// Its 200 runs (or as many as were asked for) on starts of their own.
    pub evaluation: Evaluation,
    /// The curve over training episodes, if it was asked for.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub curve: Vec<Bin>,
}

/// How far training had come at an event.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct Milestone {
    /// Environment steps.
    pub step: u64,
    /// Episodes.
    pub episode: u64,
    /// Training without evaluations.
    pub training: Seconds,
}

/// Neighbouring episodes of training.
#[derive(Clone, Copy, PartialEq, Default, Debug, Serialize, Deserialize)]
pub struct Bin {
    /// How many.
    #[serde(rename = "n")]
    pub episodes: u64,
    /// Environment steps of training at the end of the last.
    pub step: u64,
    /// Mean reward per step, in the paper's units.
    #[serde(rename = "average")]
    pub average_reward: f64,
    /// Mean of the total rewards.
    #[serde(rename = "total")]
    pub total_reward: f64,
}

/// Where and how a cell ran.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Conditions {
    /// The machine in words.
    pub machine: String,
    /// Cells that ran side by side.
    pub jobs: usize,
    /// The program's version.
    pub version: String,
}

impl Cell {
    /// Writes the cell to the plan's file.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn store(&self, plan: &Plan, out: &Path) -> Result<(), Failure> {
        let value = serde_json::to_value(self).expect("plain data has a form in JSON");
        files::write(&plan.file(out), lines(&value))
    }
}

/// An object with one line for each of its keys.
fn lines(value: &Value) -> String {
    let object = value.as_object().expect("a cell is an object");
    let lines: Vec<String> = object.iter().map(|(key, inner)| format!("  {}: {inner}", json!(key))).collect();
    format!("{{\n{}\n}}\n", lines.join(",\n"))
}

/// All that decides a cell's outcome, but for the program's version.
fn config(subject: &Subject, preset: &Preset, seed: u64, runs: u32) -> Value {
    let file = subject.task().file();
    // By way of text, in which an f32 is as short as it was meant.
    let text = |preset: &Preset| serde_json::to_string(preset).expect("a preset has a form in JSON");
    let value = |preset: &Preset| serde_json::from_str::<Value>(&text(preset)).expect("what was written can be read");
    let mut recipe = Map::new();
    differences("", &value(preset), &value(&Preset::default()), &mut recipe);
    recipe.remove("description");
    json!({
        "environment": file.environment,
        "ltl": file.specification.ltl,
        "labels": file.specification.labels,
        "automaton": subject.hoa().map(|text| format!("{:016x}", fingerprint(text))),
        "max_steps": file.evaluation.max_steps,
        "start": file.evaluation.start,
        "recipe": recipe,
        "budget": preset.training.steps,
        "seed": seed,
        "evaluation": { "runs": runs, "seed": EVALUATION_SEED },
    })
}

/// The leaves of `value` that differ from those of `default`, under their dotted paths.
pub fn differences(path: &str, value: &Value, default: &Value, found: &mut Map<String, Value>) {
    match (value, default) {
        (Value::Object(a), Value::Object(b)) if !a.contains_key("kind") && !a.contains_key("from") => {
            for (key, inner) in a {
                let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                differences(&path, inner, b.get(key).unwrap_or(&Value::Null), found);
            }
        }
        _ if value != default => {
            found.insert(path.to_owned(), value.clone());
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cells_identity_is_what_decides_it() {
        let subject = Subject::open("ball_pass_b1", "fast").unwrap();
        let plan = |change: &str, seed| {
            let overrides = change.split_whitespace().map(|o| o.parse().unwrap()).collect();
            Plan::new(&subject, "modular", ("fast", overrides), seed, None).unwrap()
        };
        let plain = plan("", 1);
        assert_eq!(plain.hash(), plan("", 1).hash());
        for other in [plan("", 2), plan("learner.n_step=3", 1), plan("training.steps=7", 1), plan("", 1).with_curve()] {
            assert_ne!(plain.hash(), other.hash());
        }
        assert_eq!(
            (&plain.config["recipe"]["product.accepting_discount"], &plain.config["recipe"]["learner.tau"]),
            (&0.9.into(), &0.005.into())
        );
        assert!(plain.config["recipe"].get("learner.policy_delay").is_none(), "what Algorithm 2 has is not listed");
    }

    #[test]
    fn a_cell_is_written_key_by_key_and_reads_the_same() {
        let value = json!({ "a": { "b": [1, 2], "s": "x {y}\n" }, "d": [] });
        let text = lines(&value);
        assert_eq!(serde_json::from_str::<Value>(&text).unwrap(), value);
        assert_eq!(text.lines().count(), 4, "{text}");
    }
}
