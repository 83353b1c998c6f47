//! What each option of a recipe is worth: taken out in turn, everything else as it was, and counted in steps to the first 200 of 200.

use super::campaign::Campaign;
use super::cell::{Plan, differences};
use super::subject::Subject;
use super::summary::{Group, conditions};
use super::text::{MISSING, Table, count, or_missing, percent, percents};
use crate::cli::failure::Failure;
use crate::cli::files;
use crate::task::{Override, Preset};
use clap::Args;
use serde_json::{Map, Value, json};
use std::process::ExitCode;

/// Arguments of `ablation`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  ltl-rover reproduce ablation --task ball_pass_b1 --seeds 3 --first-seed 1
  ltl-rover reproduce ablation --task melas --option n_step,holding")]
pub struct Ablation {
    #[command(flatten)]
    campaign: Campaign,
    /// Only these options, by the words in the first column of the report, joined by commas or repeated.
    #[arg(long = "option", value_delimiter = ',')]
    options: Vec<String>,
}

/// Options that belong together: a word for file names, and their keys.
const TOGETHER: [(&str, &[&str]); 8] = [
    ("discounts", &["product.accepting_discount", "product.discount"]),
    ("rates", &["learner.actor_rate", "learner.critic_rate", "learner.tau"]),
    ("holding", &["learner.exploration.hold_probability", "learner.exploration.hold_steps"]),
    ("counterfactual", &["learner.counterfactual.samples"]),
    ("smoothing", &["learner.target_smoothing.sigma", "learner.target_smoothing.clip"]),
    ("updates", &["learner.updates_per_step", "learner.update_every"]),
    ("warm_up", &["learner.exploration.warm_up"]),
    ("short_episodes", &["training.short_episodes.share", "training.short_episodes.max_steps"]),
];

/// What belongs to the experiment and not to the recipe.
const FIXED: [&str; 9] = [
    "training.steps",
    "training.episodes",
    "training.max_steps",
    "training.evaluate_every",
    "training.evaluation_runs",
    "training.evaluation_failures",
    "training.stop",
    "learner.replay",
    "description",
];

/// An option that is taken out.
#[derive(Clone, Debug)]
struct Variant {
    /// A word for file names; `whole` for the recipe as it is.
    key: String,
    /// What it is in the recipe and without.
    with: String,
    without: String,
    overrides: Vec<Override>,
}

impl Ablation {
    /// Runs what is missing and writes the report.
    ///
    /// # Errors
    /// What is wrong with the tasks; what cannot be written.
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let subjects = self.campaign.subjects()?;
        let mut plans = vec![];
        for subject in &subjects {
            let variants = self.variants(subject)?;
            for seed in self.campaign.seeds() {
                for variant in &variants {
                    plans.push(self.plan(subject, variant, seed)?);
                }
            }
        }
        self.campaign.run(&plans, &|| self.write(&subjects))?;
        Ok(ExitCode::SUCCESS)
    }

    fn variants(&self, subject: &Subject) -> Result<Vec<Variant>, Failure> {
        let mut all = vec![];
        for variant in variants(&subject.preset(self.campaign.preset(), &[])?)? {
            if self.options.is_empty() || variant.key == "whole" || self.options.contains(&variant.key) {
                all.push(variant);
            }
        }
        let unknown = self.options.iter().find(|wanted| all.iter().all(|variant| variant.key != **wanted));
        match unknown {
            None => Ok(all),
            Some(wanted) => {
                let known: Vec<String> =
                    variants(&subject.preset(self.campaign.preset(), &[])?)?.into_iter().skip(1).map(|v| v.key).collect();
                let message = format!("the recipe of {} has no option `{wanted}` that Algorithm 2 has not", subject.name);
                Err(Failure::input(message).help(format!("it has {}", known.join(", "))))
            }
        }
    }

    /// The whole recipe is a cell of the tables as well.
    fn plan(&self, subject: &Subject, variant: &Variant, seed: u64) -> Result<Plan, Failure> {
        let name = if variant.key == "whole" { "modular".to_owned() } else { format!("without-{}", variant.key) };
        self.campaign.plan(subject, &name, &variant.overrides, seed)
    }

    fn write(&self, subjects: &[Subject]) -> Result<(), Failure> {
        let mut text = String::from("# What each option of the recipe is worth\n\n");
        let mut table = csv::Writer::from_writer(vec![]);
        let failed = |e: csv::Error| Failure::running(e);
        table.write_record(["task", "option", "seed", "successes", "runs", "steps", "first_perfect_step"]).map_err(failed)?;
        let mut objects = vec![];
        let mut groups = vec![];
        for subject in subjects {
            text += &format!("## {}\n\n", subject.task().file().title);
            let mut rows = Table::new(&[
                "without",
                "in the recipe",
                "instead",
                ">seeds that got to 200/200",
                ">steps to it",
                ">relative",
                ">success",
                "95 %",
            ]);
            let mut whole = None;
            for variant in self.variants(subject)? {
                let plans = self.campaign.seeds().map(|seed| self.plan(subject, &variant, seed));
                let plans: Vec<Plan> = plans.collect::<Result<_, _>>()?;
                let max_steps = subject.task().file().evaluation.max_steps;
                let cells = self.campaign.finished(&plans);
                let group = Group { task: subject.name.clone(), variant: variant.key.clone(), max_steps, cells };
                for cell in group.done() {
                    let (o, e) = (&cell.outcome, &cell.outcome.evaluation);
                    let first = o.first_perfect.map_or_else(String::new, |m| m.step.to_string());
                    let numbers = [cell.seed, e.successes.into(), e.runs.into(), o.steps].map(|n| n.to_string());
                    let record = [&subject.name, &variant.key].into_iter().chain(&numbers).chain([&first]);
                    table.write_record(record).map_err(failed)?;
                }
                let steps = group.median(|cell| Some(cell.outcome.first_perfect?.step as f64));
                if variant.key == "whole" {
                    whole = steps;
                }
                let relative =
                    steps.zip(whole).filter(|(a, b)| a.is_finite() && b.is_finite()).map(|(a, b)| format!("{:.1} ×", a / b));
                let seeds = format!("{}/{}", group.perfect(), group.done().count());
                rows.row(&[
                    if variant.key == "whole" { "– (the whole recipe)".to_owned() } else { variant.key.clone() },
                    variant.with.clone(),
                    variant.without.clone(),
                    if group.done().next().is_some() { seeds } else { MISSING.to_owned() },
                    steps.map_or_else(String::new, count),
                    relative.unwrap_or_default(),
                    or_missing(group.rate(), percent),
                    group.interval().map_or_else(String::new, percents),
                ]);
                objects.push(group.object());
                groups.push(group);
            }
            text += &rows.finish();
            text.push('\n');
        }
        let seeds: Vec<String> = self.campaign.seeds().map(|seed| seed.to_string()).collect();
        text += &format!(
            "Recipe `{}`, seeds {}; each option set back to what Algorithm 2 has, one at a time. Medians over seeds; `never`: half of the\n\
             seeds or more did not get there within the budget. Success: interquartile mean over seeds of the judged policies, bootstrap.\n",
            self.campaign.preset(),
            seeds.join(", ")
        );
        for line in conditions(&groups) {
            text += &format!("Machine: {line}.\n");
        }
        let path = |ending: &str| self.campaign.out.join(self.campaign.report_name("ablation")).with_extension(ending);
        files::write(&path("md"), text)?;
        files::write(&path("csv"), table.into_inner().map_err(|e| Failure::running(e.error()))?)?;
        let all = json!({ "recipe": self.campaign.preset(), "rows": objects });
        files::write(&path("json"), serde_json::to_string_pretty(&all).expect("plain data has a form in JSON") + "\n")
    }
}

/// The recipe as it is, and without each of the options that it adds to Algorithm 2.
fn variants(preset: &Preset) -> Result<Vec<Variant>, Failure> {
    let value = |preset: &Preset| -> Value {
        let text = serde_json::to_string(preset).expect("a preset has a form in JSON");
        serde_json::from_str(&text).expect("what was written can be read")
    };
    let (recipe, plain) = (value(preset), value(&Preset::default()));
    let mut changed = Map::new();
    differences("", &recipe, &plain, &mut changed);
    changed.retain(|path, _| !FIXED.contains(&path.as_str()));
    let mut all = vec![Variant { key: "whole".to_owned(), with: String::new(), without: String::new(), overrides: vec![] }];
    let single = |path: &String| TOGETHER.iter().all(|(_, paths)| !paths.contains(&path.as_str()));
    let groups = TOGETHER.iter().map(|(key, paths)| {
        let inside: Vec<String> = paths.iter().filter(|path| changed.contains_key(**path)).map(|&path| path.to_owned()).collect();
        ((*key).to_owned(), inside)
    });
    let alone = changed.keys().filter(|path| single(path)).map(|path| {
        let key = path.rsplit('.').next().unwrap_or(path).to_owned();
        (key, vec![path.clone()])
    });
    for (key, paths) in groups.chain(alone).filter(|(_, paths)| !paths.is_empty()) {
        let mut overrides = vec![];
        for path in &paths {
            let value = plain.pointer(&format!("/{}", path.replace('.', "/"))).unwrap_or(&Value::Null);
            let value = toml::Value::try_from(value).map_err(|e| Failure::running(format!("{path}: {e}")))?;
            overrides.push(Override { path: path.clone(), value: value.to_string() });
        }
        let shown = |value: &dyn Fn(&String) -> String| paths.iter().map(value).collect::<Vec<_>>().join("; ");
        let last = |path: &String| path.rsplit('.').next().unwrap_or(path).to_owned();
        all.push(Variant {
            with: shown(&|path| format!("{} = {}", last(path), bare(&changed[path]))),
            without: overrides.iter().map(|o| o.value.replace('"', "")).collect::<Vec<_>>().join("; "),
            key,
            overrides,
        });
    }
    Ok(all)
}

/// JSON without quotation marks, for people.
fn bare(value: &Value) -> String {
    value.to_string().replace('"', "").replace(',', ", ").replace(':', ": ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn taking_out_every_option_leaves_algorithm_2() {
        for name in super::super::subject::PAPER_TASKS {
            let subject = Subject::open(name, "fast").unwrap();
            let recipe = subject.preset("fast", &[]).unwrap();
            let all = variants(&recipe).unwrap();
            assert!(all.len() > 4 && all.iter().any(|v| v.key == "n_step"), "{name}");
            let overrides: Vec<Override> = all.iter().flat_map(|v| v.overrides.clone()).collect();
            let plain = subject.preset("fast", &overrides).unwrap();
            let default = Preset::default();
            assert_eq!(plain.product, default.product, "{name}");
            assert_eq!(plain.learner.n_step, 1);
            let ours = crate::agent::LearnerSettings { replay: default.learner.replay, ..plain.learner };
            assert_eq!(ours, default.learner, "{name}");
            for (i, a) in all.iter().enumerate() {
                assert!(all[..i].iter().all(|b| b.key != a.key), "{name}: two options are called {}", a.key);
            }
        }
    }
}
