//! A task that experiments are made on: a shipped one by its name, or a file of one's own.

use crate::agent::ModularDdpg;
use crate::automaton::hoa;
use crate::cli::failure::Failure;
use crate::cli::files;
use crate::session;
use crate::task::{Override, Preset, Setup, Task};
use std::path::Path;

/// The six tasks of the paper, which an experiment takes unless told otherwise.
pub const PAPER_TASKS: [&str; 6] = ["ball_pass_b1", "ball_pass_b2", "cart_pole_c1", "cart_pole_c2", "melas", "victoria"];

/// A task with its automaton's file.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Its name in tables and files.
    pub name: String,
    task: Task,
    hoa: Option<String>,
    /// Accepting sets of its automaton.
    pub sets: usize,
}

impl Subject {
    /// The shipped task of that name, or the task file at that path.
    ///
    /// # Errors
    /// A name that is neither; what is wrong with the task; no preset of that name.
    pub fn open(name: &str, preset: &str) -> Result<Subject, Failure> {
        if let Some((task, text)) = session::builtin_task(name) {
            // Held against its formula when it is set up, and by the tests.
            let automaton = hoa::read(text).map_err(|e| Failure::input(format!("{name}: {}", e.message())))?.automaton;
            return Ok(Subject { name: name.to_owned(), task, hoa: Some(text.to_owned()), sets: automaton.sets() });
        }
        let path = Path::new(name);
        if path.extension().is_some_and(|e| e == "toml") {
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            let setup = files::open(path, preset, &[])?;
            let (task, hoa) = (setup.task().clone(), setup.hoa().map(str::to_owned));
            return Ok(Subject { name: stem.into_owned(), task, hoa, sets: setup.automaton().sets() });
        }
        let known: Vec<String> = session::builtin_tasks().into_iter().map(|task| task.name).collect();
        Err(Failure::input(format!("there is no shipped task `{name}`"))
            .help(format!("shipped are {}; or give the path of a task file (.toml)", known.join(", "))))
    }

    /// The task.
    pub fn task(&self) -> &Task {
        &self.task
    }

    /// The text of its automaton.
    pub fn hoa(&self) -> Option<&str> {
        self.hoa.as_deref()
    }

    /// A recipe with overrides in place.
    ///
    /// # Errors
    /// No preset of that name, or an override that does not fit.
    pub fn preset(&self, name: &str, overrides: &[Override]) -> Result<Preset, Failure> {
        Ok(self.task.preset(name, overrides)?)
    }

    /// The set-up for a recipe with overrides in place.
    ///
    /// # Errors
    /// What does not go together.
    pub fn setup(&self, preset: &str, overrides: &[Override]) -> Result<Setup, Failure> {
        Ok(Setup::open(self.task.clone(), preset, overrides, self.hoa())?)
    }
}

/// Environment, set-up and trained policy in a policy file or run.
///
/// # Errors
/// A file that cannot be read, or is no policy.
pub fn trained(path: &Path) -> Result<(Setup, ModularDdpg), Failure> {
    files::policy(path)
}
