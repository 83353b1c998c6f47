//! The automaton of a task: read from its HOA file and held against its formula, or translated from it.

use super::error::TaskError;
use super::parse::Task;
use crate::automaton::translate::{Acceptance, TranslateOptions, translate};
use crate::automaton::{Ldgba, WordBudget, hoa, matches_where};
use crate::env::EnvSpec;
use crate::product::{LetterMap, Renaming};
use std::sync::Arc;

/// Words that an automaton is held against its formula on: a set-up should not take long.
const BUDGET: WordBudget = WordBudget { exhaustive: 3_000, random: 1_000, seed: 0 };

/// The automaton in `text`, or the translation of the formula.
///
/// An automaton is held against the formula on words in which labels that exclude one another in the environment never hold together; what it
/// does on others does not matter.
///
/// # Errors
/// A text that is no automaton, at its place; an automaton that differs from the formula, with a word; a formula that is too hard.
pub(super) fn automaton(task: &Task, text: Option<&str>) -> Result<Arc<Ldgba>, TaskError> {
    let place = task.place(&["specification", "ltl"]);
    let environment = task.environment()?;
    let spec = environment.spec();
    let renaming = &task.file.specification.labels;
    let Some(text) = text else {
        let error = |message| TaskError::new(&task.name, &task.text, place, message);
        let exclusive = exclusive(&task.formula.propositions(), spec, renaming);
        let made = translate(&task.formula, &options(exclusive)).map_err(|e| error(e.to_string()))?;
        return Ok(Arc::new(made));
    };
    let name = task.file.specification.hoa.as_deref().unwrap_or("automaton");
    let read = hoa::read(text).map_err(|e| {
        let span = e.place().span;
        TaskError::new(name, text, Some(span.start..span.end), e.message()).with_help(e.suggestion().map(str::to_owned))
    })?;
    // Unknown labels have an error of their own, with a better place than a word on which two languages differ.
    if LetterMap::new(read.automaton.propositions(), spec, renaming).is_ok() {
        let mut names = task.formula.propositions();
        names.extend(read.automaton.propositions().iter().map(str::to_owned));
        matches_where(&read.automaton, &task.formula, BUDGET, &exclusive(&names, spec, renaming)).map_err(|e| {
            let place = task.place(&["specification", "hoa"]).or(place);
            TaskError::new(&task.name, &task.text, place, format!("`{name}` is not the automaton of this formula: {e}"))
        })?;
    }
    Ok(Arc::new(read.automaton))
}

/// How a formula is translated for a task: the paper's form, with marks on states, of which modules are made.
pub fn options(exclusive: Vec<Vec<String>>) -> TranslateOptions {
    TranslateOptions { acceptance: Acceptance::State, exclusive, ..TranslateOptions::default() }
}

/// Groups of the propositions `names` of which at most one holds at a time in an environment: those that stand for labels that exclude one
/// another. Of several that stand for the same label only the first is in a group; names that stand for no label are in none.
pub fn exclusive(names: &[String], environment: &EnvSpec, renaming: &Renaming) -> Vec<Vec<String>> {
    let mut met = vec![];
    let mut sources = vec![];
    for name in names {
        let label = environment.propositions.index(renaming.get(name).unwrap_or(name));
        if let Some(label) = label.filter(|label| !met.contains(label)) {
            met.push(label);
            sources.push((label, name));
        }
    }
    let members = |group: Vec<usize>| {
        let inside = sources.iter().filter(|(label, _)| group.contains(label));
        inside.map(|(_, name)| (*name).clone()).collect::<Vec<String>>()
    };
    environment.disjoint().into_iter().map(members).filter(|group| group.len() > 1).collect()
}
