//! The tasks that come with the program: their files, compiled in, so that a page needs no file system.

use super::refusal::{Refusal, Subject};
use crate::env::map::RoverMap;
use crate::task::Task;
use serde::Serialize;

/// A task file and the automaton file it names.
pub(super) struct Builtin {
    /// The name by which a shell opens it.
    pub name: &'static str,
    pub toml: &'static str,
    pub hoa: &'static str,
}

macro_rules! builtin {
    ($($name:literal),* $(,)?) => {
        &[$(Builtin {
            name: $name,
            toml: include_str!(concat!("../../specs/", $name, ".toml")),
            hoa: include_str!(concat!("../../specs/", $name, ".hoa")),
        }),*]
    };
}

const BUILTINS: &[Builtin] =
    builtin!["ball_pass_b1", "ball_pass_b2", "cart_pole_c1", "cart_pole_c2", "melas", "victoria", "phi_p", "islands", "own_map"];

/// The built-in task with exactly this text.
pub(super) fn with_text(text: &str) -> Option<&'static Builtin> {
    BUILTINS.iter().find(|b| b.toml == text)
}

/// The map file that a built-in task names, if it names one that is not among the shipped maps.
pub(super) fn map_of(name: &str) -> Option<&'static str> {
    (name == "own_map").then_some(include_str!("../../specs/own_map.json"))
}

/// A built-in task, for a list to choose from.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct TaskEntry {
    /// The name by which it is opened.
    pub name: String,
    /// Its title.
    pub title: String,
    /// Its environment.
    pub environment: String,
    /// Its formula.
    pub formula: String,
    /// Its presets, the one to begin with first.
    pub presets: Vec<String>,
}

/// The built-in tasks, in the order of the paper.
pub fn builtin_tasks() -> Vec<TaskEntry> {
    let entry = |builtin: &Builtin| {
        let task = Task::parse(builtin.toml, builtin.name).expect("the files in specs/ are tested to parse");
        TaskEntry {
            name: builtin.name.to_owned(),
            title: task.file().title.clone(),
            environment: task.file().environment.name.clone(),
            formula: task.file().specification.ltl.clone(),
            presets: presets(&task),
        }
    };
    BUILTINS.iter().map(entry).collect()
}

/// The built-in task of that name and the text of its automaton.
pub fn builtin_task(name: &str) -> Option<(Task, &'static str)> {
    let builtin = BUILTINS.iter().find(|b| b.name == name)?;
    let task = Task::parse(builtin.toml, name).expect("the files in specs/ are tested to parse");
    let map = map_of(name).map(|text| RoverMap::from_json(text, None).expect("the files in specs/ are tested to parse"));
    Some((map.into_iter().fold(task, Task::with_map), builtin.hoa))
}

/// The presets of a task, `fast` first: it is the one that a person waits for.
pub(super) fn presets(task: &Task) -> Vec<String> {
    let mut names: Vec<String> = task.presets().map(str::to_owned).collect();
    names.sort_by_key(|name| name != "fast");
    names
}

/// The built-in task of that name.
pub(super) fn find(name: &str) -> Result<&'static Builtin, Refusal> {
    BUILTINS.iter().find(|b| b.name == name).ok_or_else(|| {
        let known: Vec<&str> = BUILTINS.iter().map(|b| b.name).collect();
        let message = format!("there is no built-in task `{name}`; known are {}", known.join(", "));
        Refusal::new(Subject::Task, message)
    })
}
