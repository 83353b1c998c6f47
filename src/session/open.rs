//! From a shell's request to a checked set-up: which task, which formula, which automaton, which recipe.

use super::builtin;
use super::check::formula_refusal;
use super::own_map;
use super::refusal::{Place, Refusal, Subject};
use crate::automaton::{Ldgba, hoa};
use crate::ltl::Formula;
use crate::task::{Override, Setup, Task, TaskError, TaskFile};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What to open.
#[derive(Clone, PartialEq, Default, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct OpenRequest {
    /// The name of a built-in task, or the text of a task file (told apart by a line end).
    pub task: String,
    /// A formula in place of the task's.
    pub formula: Option<String>,
    /// An automaton in the HOA format in place of the task's.
    pub hoa: Option<String>,
    /// A map file (JSON) in place of a rover task's map. If it does not have the formula's propositions, and no other formula is
    /// given, the formula is the one that [`MapFacts::suggested`](super::MapFacts) names.
    pub map: Option<String>,
    /// The seed of everything.
    pub seed: u64,
    /// A preset; without one `fast`, or else the first.
    pub preset: Option<String>,
    /// Values in place of the preset's: dotted key → TOML value.
    pub overrides: BTreeMap<String, String>,
}

/// The set-up of a request, with the name of its task and the text of its automaton.
pub(super) struct Opened {
    pub setup: Setup,
    pub name: String,
    pub hoa: String,
}

impl OpenRequest {
    /// Checks everything and makes the set-up.
    ///
    /// # Errors
    /// A [`Refusal`] that names the text at fault and the place in it.
    pub(super) fn open(&self) -> Result<Opened, Refusal> {
        let (name, toml, shipped, shipped_map) = if self.task.contains('\n') {
            ("task", self.task.as_str(), None, None)
        } else {
            let builtin = builtin::find(&self.task)?;
            (builtin.name, builtin.toml, Some(builtin.hoa), builtin::map_of(builtin.name))
        };
        let mut task = Task::parse(toml, name).map_err(task_refusal)?;
        let mut hoa_text = self.hoa.as_deref().or(shipped);
        let mut formula = self.formula.clone();
        if let Some(text) = self.map.as_deref().or(shipped_map) {
            let map = own_map::read(text, None)?;
            if formula.is_none() && !own_map::has_all(&map, &task) {
                formula = Some(own_map::begin_with(&map)?);
            }
            task = own_map::on_map(&task, map)?;
        }
        if let Some(formula) = formula.filter(|f| *f != task.file().specification.ltl) {
            Formula::parse(&formula).map_err(|e| formula_refusal(&formula, &e))?;
            task = with_formula(&task, &formula)?;
            hoa_text = self.hoa.as_deref();
        }
        if let Some(text) = hoa_text {
            // Read once more below, together with the task: here for the place in the text that the user sees.
            read_automaton(text)?;
        }
        let presets = builtin::presets(&task);
        let preset = self.preset.as_deref().unwrap_or(&presets[0]);
        let change = |(path, value): (&String, &String)| Override { path: path.clone(), value: value.clone() };
        let overrides: Vec<Override> = self.overrides.iter().map(change).collect();
        task.preset(preset, &overrides).map_err(task_refusal)?;
        // The recipe is sound, so what goes wrong from here on is due to what the user brought. Its place in the task file says nothing.
        let setup = Setup::open(task, preset, &overrides, hoa_text).map_err(|error| {
            let refusal = task_refusal(error);
            let subject = match self {
                OpenRequest { hoa: Some(_), .. } => Subject::Hoa,
                OpenRequest { formula: Some(_), .. } => Subject::Formula,
                OpenRequest { map: Some(_), .. } => Subject::Map,
                _ => return refusal,
            };
            Refusal { subject, place: Place::default(), ..refusal }
        })?;
        let hoa = hoa_text.map_or_else(|| written(setup.automaton()), str::to_owned);
        Ok(Opened { setup, name: name.to_owned(), hoa })
    }
}

/// The task with another formula, and without an automaton file, which was the other formula's.
fn with_formula(task: &Task, formula: &str) -> Result<Task, Refusal> {
    let mut file = task.file().clone();
    file.specification.ltl = formula.to_owned();
    file.specification.hoa = None;
    rewritten(task, &file)
}

/// The task with another file, on the same map.
pub(super) fn rewritten(task: &Task, file: &TaskFile) -> Result<Task, Refusal> {
    let text = toml::to_string(file).map_err(|e| Refusal::new(Subject::Task, e.to_string()))?;
    let next = Task::parse(&text, task.name()).map_err(task_refusal)?;
    Ok(match task.map() {
        Some(map) => next.with_map(map.clone()),
        None => next,
    })
}

pub(super) fn read_automaton(text: &str) -> Result<Ldgba, Refusal> {
    read_hoa(text).map(|reading| reading.automaton)
}

pub(super) fn read_hoa(text: &str) -> Result<hoa::Reading, Refusal> {
    hoa::read(text).map_err(|error| {
        let span = error.place().span;
        Refusal::new(Subject::Hoa, error.message()).with_hint(error.suggestion()).at(Place::of(text, span.start..span.end))
    })
}

/// An automaton in the HOA format, for one that came without a file.
pub(super) fn written(automaton: &Ldgba) -> String {
    hoa::write(automaton, &hoa::WriteOptions::default()).unwrap_or_default()
}

pub(super) fn task_refusal(error: TaskError) -> Refusal {
    let refusal = Refusal::new(Subject::Task, error.message()).with_hint(error.help());
    match error.span() {
        Some(span) => refusal.at(Place::of(error.text(), span)),
        None => refusal,
    }
}
