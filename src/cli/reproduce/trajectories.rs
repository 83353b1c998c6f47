//! The paper's rover figures: one round of a trained policy from two starts, drawn on the map's picture.

use super::map_picture::{Trail, draw};
use super::subject::{PAPER_TASKS, trained};
use super::table1::short;
use super::text::{MISSING, Table};
use crate::cli::failure::Failure;
use crate::cli::files;
use crate::product::MoveKind;
use clap::Args;
use serde_json::json;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Arguments of `trajectories`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  ltl-rover reproduce trajectories
  ltl-rover reproduce trajectories --task melas --run runs/melas --at 228,138 --at 60,250")]
pub struct Trajectories {
    /// Tasks on a map, joined by commas or repeated; by default both Mars maps.
    #[arg(long = "task", value_name = "TASK", value_delimiter = ',', default_value = "melas,victoria")]
    tasks: Vec<String>,
    /// The policy: a folder that `train` wrote, or a checkpoint or policy file. By default the task's in --policies, or else the
    /// first of the task that an earlier table1 left in OUT/policies.
    #[arg(long, value_name = "RUN")]
    run: Option<PathBuf>,
    /// The folder of shipped policies.
    #[arg(long, value_name = "FOLDER", default_value = "assets/policies")]
    policies: PathBuf,
    /// Seeds of the starts.
    #[arg(long, value_delimiter = ',', default_value = "1,2")]
    starts: Vec<u64>,
    /// A start in the map's unit, in place of seeds; may be repeated.
    #[arg(long, value_name = "X,Y")]
    at: Vec<String>,
    /// The folder of results.
    #[arg(long, value_name = "FOLDER", default_value = "results")]
    out: PathBuf,
}

impl Trajectories {
    /// Plays and draws.
    ///
    /// # Errors
    /// No policy; a task without a map; what cannot be written.
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let folder = self.out.join("trajectories");
        for task in &self.tasks {
            let policy = match &self.run {
                Some(run) => run.clone(),
                None => self.policy(task)?,
            };
            self.task(task, &policy, &folder)?;
        }
        self.index(&folder)?;
        Ok(ExitCode::SUCCESS)
    }

    fn policy(&self, task: &str) -> Result<PathBuf, Failure> {
        let shipped = self.policies.join(task).with_extension("safetensors");
        if shipped.exists() {
            return Ok(shipped);
        }
        let start = format!("{task}.modular.");
        let entries = std::fs::read_dir(self.out.join("policies")).into_iter().flatten().flatten();
        let mut own: Vec<PathBuf> =
            entries.filter(|entry| entry.file_name().to_string_lossy().starts_with(&start)).map(|entry| entry.path()).collect();
        own.sort();
        own.into_iter().next().ok_or_else(|| {
            Failure::input(format!("there is no policy of `{task}`: {} does not exist", shipped.display()))
                .help(format!("train one: ltl-rover train specs/{task}.toml --out runs/{task}, then give --run runs/{task}"))
        })
    }

    fn task(&self, task: &str, policy: &Path, folder: &Path) -> Result<(), Failure> {
        let (setup, mut learner) = trained(policy)?;
        let spec = setup.product().environment().spec().clone();
        let scene = setup.product().environment().scene();
        let mut table = csv::Writer::from_writer(vec![]);
        let failed = |e: csv::Error| Failure::running(e);
        let channels = spec.state.iter().map(|channel| channel.name.replace(' ', "_"));
        let columns: Vec<String> = ["start", "step", "q", "fresh"].map(str::to_owned).into_iter().chain(channels).collect();
        table.write_record(&columns).map_err(failed)?;
        let starts = self.places(spec.name, spec.state.len())?;
        let (mut trails, mut objects) = (vec![], vec![]);
        for (i, place) in starts.iter().enumerate() {
            let mut rollout = setup.rollout(if let Place::Seed(seed) = place { *seed } else { 0 });
            if let Place::At(state) = place {
                rollout.restart_at(state);
            }
            let mut trail = Trail { points: vec![], visits: vec![] };
            let mut fresh = String::new();
            loop {
                let state = rollout.product().environment().state();
                trail.points.push([state[0], state[1]]);
                let numbers = state.iter().map(|x| format!("{x:.2}"));
                let head = [i.to_string(), rollout.episode().steps.to_string(), rollout.product().at().q.to_string(), fresh];
                table.write_record(head.into_iter().chain(numbers)).map_err(failed)?;
                fresh = String::new();
                if rollout.episode().rounds > 0 {
                    break;
                }
                let Some(step) = rollout.step(&mut learner) else { break };
                if step.fresh.0 != 0 {
                    let state = rollout.product().environment().state();
                    trail.visits.push([state[0], state[1]]);
                    fresh = step.fresh.iter().map(|j| j.to_string()).collect::<Vec<_>>().join(" ");
                }
                debug_assert!(step.kind == MoveKind::Epsilon || rollout.episode().steps > 0);
            }
            let e = rollout.episode();
            objects.push(json!({
                "start": trail.points[0],
                "steps": e.steps,
                "round_completed": e.rounds > 0,
                "sink": e.sink,
                "visits": trail.visits,
            }));
            trails.push(trail);
        }
        let title = &setup.task().file().title;
        files::write(&folder.join(task).with_extension("svg"), draw(&scene, title, &trails))?;
        files::write(&folder.join(task).with_extension("csv"), table.into_inner().map_err(|e| Failure::running(e.error()))?)?;
        let name = policy.file_name().unwrap_or_default().to_string_lossy();
        let all = json!({
            "task": task, "formula": setup.task().file().specification.ltl, "policy": name, "unit": scene.ground.unit, "trails": objects
        });
        let text = serde_json::to_string_pretty(&all).expect("plain data has a form in JSON") + "\n";
        files::write(&folder.join(task).with_extension("json"), text)?;
        for (i, object) in objects.iter().enumerate() {
            let verdict = if object["round_completed"] == true { "a round" } else { "no round" };
            eprintln!("{task}, start {}: {verdict} in {} steps", i + 1, object["steps"]);
        }
        Ok(())
    }

    fn places(&self, environment: &str, channels: usize) -> Result<Vec<Place>, Failure> {
        if channels != 2 {
            return Err(Failure::input(format!("`{environment}` has no map to draw on; tasks on a map are melas and victoria")));
        }
        if self.at.is_empty() {
            return Ok(self.starts.iter().map(|&seed| Place::Seed(seed)).collect());
        }
        let place = |text: &String| {
            let numbers: Result<Vec<f32>, _> = text.split(',').map(|number| number.trim().parse()).collect();
            numbers
                .ok()
                .filter(|numbers| numbers.len() == channels && numbers.iter().all(|x| x.is_finite()))
                .map(Place::At)
                .ok_or_else(|| Failure::input(format!("--at takes two numbers such as 120,80, not `{text}`")))
        };
        self.at.iter().map(place).collect()
    }

    /// `README.md` of the folder: all pictures that are there.
    fn index(&self, folder: &Path) -> Result<(), Failure> {
        let mut text = String::from(
            "# One round from two starts\n\nGreedy policies until every accepting set has been visited. Circle: start; numbers: visits to accepting sets\n\
             in their order.\n\n",
        );
        let mut table = Table::new(&["task", ">steps of the rounds", "picture"]);
        for task in PAPER_TASKS
            .iter()
            .filter(|task| self.tasks.iter().any(|t| t == *task) || folder.join(format!("{task}.json")).exists())
        {
            let Ok(json) = std::fs::read_to_string(folder.join(task).with_extension("json")) else {
                table.row(&[short(task), MISSING, ""]);
                continue;
            };
            let all: serde_json::Value = serde_json::from_str(&json).unwrap_or_default();
            let steps: Vec<String> = all["trails"]
                .as_array()
                .into_iter()
                .flatten()
                .map(
                    |t| if t["round_completed"] == true { t["steps"].to_string() } else { format!("no round in {}", t["steps"]) },
                )
                .collect();
            table.row(&[short(task), &steps.join(", "), &format!("![{task}]({task}.svg)")]);
        }
        text += &table.finish();
        files::write(&folder.join("README.md"), text)
    }
}

/// Where an episode starts.
enum Place {
    /// Drawn by the task from this seed.
    Seed(u64),
    /// Here.
    At(Vec<f32>),
}
