//! From text to a checked [`Task`].

use super::check::out_of_range;
use super::error::{TaskError, did_you_mean, in_words, suggestion};
use super::file::TaskFile;
use super::parts::environment;
use super::preset::Preset;
use crate::env::Environment;
use crate::env::map::RoverMap;
use crate::ltl::Formula;
use std::ops::Range;
use std::sync::Arc;
use toml::de::DeTable;

/// The longest task file that is read, in bytes.
pub const MAX_TEXT: usize = 1 << 20;

/// A checked task file: its formula parses, its recipes are within their ranges. Its automaton comes in with
/// [`Task::open`](super::Setup), since the core reads no files.
#[derive(Clone, PartialEq, Debug)]
pub struct Task {
    pub(super) file: TaskFile,
    pub(super) formula: Formula,
    pub(super) text: String,
    pub(super) name: String,
    pub(super) map: Option<Arc<RoverMap>>,
}

/// A value to put in place of a preset's: where, and what.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Override {
    /// Keys below the preset, joined by dots: `learner.n_step`.
    pub path: String,
    /// A value in TOML; what is none is taken as a string, so that `per_state` needs no quotes.
    pub value: String,
}

impl std::str::FromStr for Override {
    type Err = String;

    fn from_str(text: &str) -> Result<Override, String> {
        let (path, value) = text.split_once('=').ok_or_else(|| format!("`{text}` is not of the form KEY=VALUE"))?;
        Ok(Override { path: path.trim().to_owned(), value: value.trim().to_owned() })
    }
}

impl Task {
    /// Reads a task file; `name` is what errors call it.
    ///
    /// # Errors
    /// What is wrong with it, and where: TOML, unknown or missing keys, values outside their ranges, a formula that does not parse.
    pub fn parse(text: &str, name: &str) -> Result<Task, TaskError> {
        if text.len() > MAX_TEXT {
            return Err(TaskError::new(name, "", None, format!("a task file has at most {MAX_TEXT} bytes")));
        }
        let file: TaskFile = toml::from_str(text).map_err(|e| {
            let message = in_words(e.message());
            TaskError::new(name, text, e.span(), &message).with_help(suggestion(&message))
        })?;
        let task = Task { formula: Formula::True, file, text: text.to_owned(), name: name.to_owned(), map: None };
        let error = |path: &[&str], message: String| TaskError::new(name, text, task.place(path), message);
        if task.file.presets.is_empty() {
            return Err(error(&["presets"], "a task needs at least one preset".to_owned()));
        }
        let evaluation = &task.file.evaluation;
        if !(1..=10_000_000).contains(&evaluation.max_steps) {
            return Err(error(&["evaluation", "max_steps"], "`max_steps` must be 1 to 10000000".to_owned()));
        }
        if !(1..=1_000_000).contains(&evaluation.runs) {
            return Err(error(&["evaluation", "runs"], "`runs` must be 1 to 1000000".to_owned()));
        }
        for (preset_name, preset) in &task.file.presets {
            if let Some(wrong) = out_of_range(preset) {
                let path: Vec<&str> = ["presets", preset_name].iter().chain(wrong.path).copied().collect();
                return Err(error(&path, wrong.message));
            }
        }
        let formula = Formula::parse(&task.file.specification.ltl).map_err(|e| {
            let place = task.formula_place(e.span().start..e.span().end);
            TaskError::new(name, text, place, e.message()).with_help(e.suggestion().map(str::to_owned))
        })?;
        Ok(Task { formula, ..task })
    }

    /// The file's contents.
    pub fn file(&self) -> &TaskFile {
        &self.file
    }

    /// The text it was read from.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// What errors call it: the name given to [`Task::parse`].
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The formula.
    pub fn formula(&self) -> &Formula {
        &self.formula
    }

    /// The file of the user's own rover map, if the task names one: whoever may read files reads it, and hands it in by
    /// [`Task::with_map`].
    pub fn map_file(&self) -> Option<&str> {
        self.file.environment.map.as_deref().filter(|name| RoverMap::shipped(name).is_none())
    }

    /// With the map that was read from [`Task::map_file`].
    #[must_use]
    pub fn with_map(self, map: impl Into<Arc<RoverMap>>) -> Task {
        Task { map: Some(map.into()), ..self }
    }

    /// The map given by [`Task::with_map`].
    pub fn map(&self) -> Option<&Arc<RoverMap>> {
        self.map.as_ref()
    }

    /// The environment.
    ///
    /// # Errors
    /// If there is none of that name, or its map or options do not go with it.
    pub fn environment(&self) -> Result<Box<dyn Environment>, TaskError> {
        environment(&self.file.environment, self.map.as_ref()).map_err(|no| {
            let place = self.place(&["environment", no.key]);
            TaskError::new(&self.name, &self.text, place, no.message).with_help(no.help)
        })
    }

    /// The names of the presets, sorted.
    pub fn presets(&self) -> impl Iterator<Item = &str> {
        self.file.presets.keys().map(String::as_str)
    }

    /// A preset with overrides in place.
    ///
    /// # Errors
    /// A preset that does not exist, an override of no key, or of a value that does not fit.
    pub fn preset(&self, name: &str, overrides: &[Override]) -> Result<Preset, TaskError> {
        let preset = self.file.presets.get(name).ok_or_else(|| {
            let names: Vec<&str> = self.presets().collect();
            let message = format!("there is no preset `{name}`; this task has `{}`", names.join("`, `"));
            TaskError::new(&self.name, &self.text, None, message).with_help(did_you_mean(name, names))
        })?;
        let mut preset = preset.clone();
        for change in overrides {
            preset = changed(&preset, change)?;
        }
        match out_of_range(&preset) {
            None => Ok(preset),
            Some(wrong) => {
                let path: Vec<&str> = ["presets", name].iter().chain(wrong.path).copied().collect();
                Err(TaskError::new(&self.name, &self.text, self.place(&path), wrong.message))
            }
        }
    }

    /// Where a key's value stands in the text, or the nearest table around it that is written out.
    pub(super) fn place(&self, path: &[&str]) -> Option<Range<usize>> {
        let root = DeTable::parse(&self.text).ok()?;
        let (mut table, mut place) = (root.get_ref(), None);
        for key in path {
            let Some(value) = table.get(*key) else { break };
            place = Some(value.span());
            match value.get_ref().as_table() {
                Some(inner) => table = inner,
                None => break,
            }
        }
        place
    }

    /// Where bytes of the formula stand in the text, if it is written without escapes.
    fn formula_place(&self, span: Range<usize>) -> Option<Range<usize>> {
        let value = self.place(&["specification", "ltl"])?;
        let written = &self.text[value.clone()];
        let quotes = if written.starts_with("\"\"\"") || written.starts_with("'''") { 3 } else { 1 };
        let inside = written.get(quotes..written.len().checked_sub(quotes)?)?;
        let start = value.start + quotes;
        if inside == self.file.specification.ltl { Some(start + span.start..start + span.end) } else { Some(value) }
    }
}

impl Preset {
    /// Reads a preset that stands alone, as a checkpoint keeps it.
    ///
    /// # Errors
    /// What is wrong with it, and where.
    pub fn parse(text: &str, name: &str) -> Result<Preset, TaskError> {
        let preset: Preset = toml::from_str(text).map_err(|e| {
            let message = in_words(e.message());
            TaskError::new(name, text, e.span(), &message).with_help(suggestion(&message))
        })?;
        match out_of_range(&preset) {
            None => Ok(preset),
            Some(wrong) => Err(TaskError::new(name, text, None, wrong.message)),
        }
    }
}

/// `preset` with one value changed.
fn changed(preset: &Preset, change: &Override) -> Result<Preset, TaskError> {
    let shown = format!("{} = {}", change.path, change.value);
    let error = |message: &str| TaskError::new("override", &shown, None, message).with_help(suggestion(message));
    let value = match toml::from_str::<toml::Table>(&format!("value = {}", change.value)) {
        Ok(mut table) => table.remove("value").expect("the table was written with this key"),
        Err(_) => toml::Value::String(change.value.clone()),
    };
    let mut tree = toml::Value::try_from(preset).map_err(|e| error(&e.to_string()))?;
    let mut place = &mut tree;
    for key in change.path.split('.') {
        let table = match place {
            toml::Value::Table(table) => table,
            _ => return Err(error(&format!("`{}` goes below a value that is no table", change.path))),
        };
        // A key that is not there may still be one that was left out; if it is not, reading the whole says so.
        place = table.entry(key).or_insert_with(|| toml::Value::Table(toml::Table::new()));
    }
    *place = value;
    tree.try_into().map_err(|e: toml::de::Error| error(&format!("{shown}: {}", in_words(e.message()))))
}
