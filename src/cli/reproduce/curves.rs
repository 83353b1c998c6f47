//! The paper's reward curves: average and total reward per training episode, modular against standard DDPG, over seeds.

use super::campaign::Campaign;
use super::cell::{Bin, Cell, Plan};
use super::chart::{self, Band};
use super::method::Method;
use super::subject::Subject;
use super::table1::short;
use super::text::{MISSING, Table};
use crate::cli::failure::Failure;
use crate::cli::files;
use crate::task::Override;
use clap::Args;
use serde_json::json;
use std::process::ExitCode;

/// Points of a curve.
const POINTS: usize = 200;

/// Arguments of `curves`.
#[derive(Args, Debug)]
#[command(after_help = "Example:
  ltl-rover reproduce curves --task ball_pass_b1,cart_pole_c1 --seeds 3 --budget 60000")]
pub struct Curves {
    #[command(flatten)]
    campaign: Campaign,
    /// Contenders, joined by commas or repeated.
    #[arg(long = "method", value_enum, value_delimiter = ',', default_values_t = [Method::Modular, Method::StandardDdpg])]
    methods: Vec<Method>,
    /// Training episodes in the running mean.
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u64).range(1..=100_000))]
    window: u64,
}

/// A contender's finished cells on a task.
struct Contender {
    method: Method,
    cells: Vec<Cell>,
}

/// One of the two quantities.
struct Quantity {
    key: &'static str,
    title: &'static str,
    of: fn(&Bin) -> f64,
}

const QUANTITIES: [Quantity; 2] = [
    Quantity { key: "average_reward", title: "average reward per step", of: |bin| bin.average_reward },
    Quantity { key: "total_reward", title: "total reward per episode", of: |bin| bin.total_reward },
];

impl Curves {
    /// Runs what is missing and draws.
    ///
    /// # Errors
    /// What is wrong with the tasks; what cannot be written.
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let asked = self.campaign.subjects()?;
        let mut plans = vec![];
        for subject in &asked {
            for seed in self.campaign.seeds() {
                for &method in self.methods.iter().filter(|method| method.applies(subject.sets)) {
                    plans.push(self.plan(subject, method, seed)?);
                }
            }
        }
        self.campaign.run(&plans, &|| self.write(&asked))?;
        Ok(ExitCode::SUCCESS)
    }

    /// A curve goes on to the end of the budget, and needs no evaluation.
    fn plan(&self, subject: &Subject, method: Method, seed: u64) -> Result<Plan, Failure> {
        let whole = [("training.stop", "budget"), ("training.evaluate_every", "0")];
        let whole = whole.map(|(path, value)| Override { path: path.to_owned(), value: value.to_owned() });
        let overrides: Vec<Override> = method.overrides().into_iter().chain(whole).collect();
        Ok(self.campaign.plan(subject, &format!("curve-{}", method.key()), &overrides, seed)?.with_curve())
    }

    fn write(&self, subjects: &[Subject]) -> Result<(), Failure> {
        let folder = self.campaign.out.join(self.campaign.report_name("curves"));
        for subject in subjects {
            let mut contenders = vec![];
            for &method in self.methods.iter().filter(|method| method.applies(subject.sets)) {
                let plans = self.campaign.seeds().map(|seed| self.plan(subject, method, seed));
                let plans: Vec<Plan> = plans.collect::<Result<_, _>>()?;
                contenders.push(Contender { method, cells: self.campaign.finished(&plans).into_iter().flatten().collect() });
            }
            self.write_task(&folder, subject, &contenders)?;
        }
        self.index(&folder)
    }

    fn write_task(&self, folder: &std::path::Path, subject: &Subject, contenders: &[Contender]) -> Result<(), Failure> {
        let mut table = csv::Writer::from_writer(vec![]);
        let failed = |e: csv::Error| Failure::running(e);
        table.write_record(["quantity", "contender", "episode", "mean", "low", "high", "seeds"]).map_err(failed)?;
        for quantity in &QUANTITIES {
            let mut bands = vec![];
            for contender in contenders.iter().filter(|c| !c.cells.is_empty()) {
                let seeds = contender.cells.len().to_string();
                let points = over_seeds(&contender.cells, quantity.of, self.window);
                for [episode, mean, low, high] in &points {
                    let [mean, low, high] = [mean, low, high].map(|v| format!("{v:.6}"));
                    let record = [quantity.key, contender.method.key(), &format!("{episode:.0}"), &mean, &low, &high, &seeds];
                    table.write_record(record).map_err(failed)?;
                }
                let seeds = if contender.cells.len() == 1 { "1 seed".to_owned() } else { format!("{seeds} seeds") };
                let name = format!("{}, {seeds}", contender.method.title());
                bands.push(Band { name, colour: contender.method as usize, points });
            }
            if !bands.is_empty() {
                let out = folder.join(format!("{}-{}.svg", subject.name, quantity.key.replace('_', "-")));
                chart::bands(&out, ("training episode", &format!("{}: {}", short(&subject.name), quantity.title)), &bands)?;
            }
        }
        if contenders.iter().all(|contender| contender.cells.is_empty()) {
            return Ok(());
        }
        let table = table.into_inner().map_err(|e| Failure::running(e.error()))?;
        files::write(&folder.join(&subject.name).with_extension("csv"), table)?;
        let last = |contender: &Contender| -> Vec<f64> {
            let ends = contender.cells.iter().filter_map(|cell| cell.outcome.curve.last());
            ends.map(|bin| bin.total_reward).collect()
        };
        let lines: Vec<_> = contenders
            .iter()
            .map(|c| {
                json!({
                    "contender": c.method.key(),
                    "seeds": c.cells.iter().map(|cell| cell.seed).collect::<Vec<_>>(),
                    "episodes": c.cells.iter().map(|cell| cell.outcome.episodes).collect::<Vec<_>>(),
                    "steps": c.cells.iter().map(|cell| cell.outcome.steps).collect::<Vec<_>>(),
                    "last_total_reward": last(c),
                })
            })
            .collect();
        let all = json!({ "task": subject.name, "recipe": self.campaign.preset(), "window": self.window, "contenders": lines });
        let text = serde_json::to_string_pretty(&all).expect("plain data has a form in JSON") + "\n";
        files::write(&folder.join(&subject.name).with_extension("json"), text)
    }

    /// `README.md` of the folder: all pictures that are there.
    fn index(&self, folder: &std::path::Path) -> Result<(), Failure> {
        let mut text = format!(
            "# Reward per training episode\n\nRecipe `{}` to the end of its budget, rewards in the paper's units (an accepting step pays 1 − r_F), without\n\
             shaping and sink rewards. Running mean over {} episodes; line: mean over seeds; band: least to greatest.\n\n",
            self.campaign.preset(),
            self.window
        );
        let mut table = Table::new(&["task", "average reward per step", "total reward per episode"]);
        for name in self.campaign.reported(&self.campaign.subjects()?)?.iter().map(|subject| &subject.name) {
            let cell = |key: &str| {
                let file = format!("{name}-{key}.svg");
                if folder.join(&file).exists() { format!("![{key}]({file})") } else { MISSING.to_owned() }
            };
            table.row(&[short(name).to_owned(), cell("average-reward"), cell("total-reward")]);
        }
        text += &table.finish();
        files::write(&folder.join("README.md"), text)
    }
}

/// (episode, mean, least, greatest) over the cells, as far as all of them go.
fn over_seeds(cells: &[Cell], of: fn(&Bin) -> f64, window: u64) -> Vec<[f64; 4]> {
    let curves: Vec<Vec<(f64, f64)>> = cells.iter().map(|cell| smoothed(&cell.outcome.curve, of, window)).collect();
    let end = curves.iter().map(|curve| curve.last().map_or(0.0, |p| p.0)).fold(f64::INFINITY, f64::min);
    if !end.is_finite() || end <= 0.0 {
        return vec![];
    }
    let points = POINTS.min(end as usize + 1).max(2);
    (0..points)
        .map(|i| {
            let x = end * i as f64 / (points - 1) as f64;
            let values: Vec<f64> = curves.iter().map(|curve| at(curve, x)).collect();
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            let greatest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            [x, crate::eval::mean(&values), least, greatest]
        })
        .collect()
}

/// (episode, mean of the last `window` episodes) at the end of each bin.
fn smoothed(bins: &[Bin], of: fn(&Bin) -> f64, window: u64) -> Vec<(f64, f64)> {
    let mut points = vec![];
    let mut episodes = 0;
    for (i, bin) in bins.iter().enumerate() {
        episodes += bin.episodes;
        let (mut sum, mut count) = (0.0, 0);
        for bin in bins[..=i].iter().rev() {
            sum += of(bin) * bin.episodes as f64;
            count += bin.episodes;
            if count >= window {
                break;
            }
        }
        points.push((episodes as f64, sum / count as f64));
    }
    points
}

/// The value at `x`, by straight lines between the points and level outside.
fn at(points: &[(f64, f64)], x: f64) -> f64 {
    let after = points.partition_point(|p| p.0 < x);
    match (after.checked_sub(1).map(|i| points[i]), points.get(after)) {
        (Some((x0, y0)), Some(&(x1, y1))) => y0 + (y1 - y0) * (x - x0) / (x1 - x0),
        (Some((_, y)), None) | (None, Some(&(_, y))) => y,
        (None, None) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smoothing_weighs_episodes_and_lines_run_between_points() {
        let bin = |episodes, total_reward| Bin { episodes, step: 0, average_reward: 0.0, total_reward };
        let bins = [bin(2, 1.0), bin(2, 3.0), bin(1, 6.0)];
        let points = smoothed(&bins, |bin| bin.total_reward, 3);
        assert_eq!(points, [(2.0, 1.0), (4.0, 2.0), (5.0, 4.0)]);
        assert_eq!([0.0, 3.0, 4.5, 9.0].map(|x| at(&points, x)), [1.0, 1.5, 3.0, 4.0]);
    }
}
