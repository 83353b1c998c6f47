//! The automaton of a task: read from its HOA file and held against its formula, or translated from the formula.

use super::error::TaskError;
use super::parse::Task;
use crate::automaton::translate::{TranslateOptions, translate};
use crate::automaton::{Ldgba, Letters, WordBudget, hoa, matches};
use std::sync::Arc;

/// The automaton in `text`, or without one the translation of the formula.
///
/// # Errors
/// A text that is no automaton, at its place; an automaton that differs from the formula, with a word that shows it; a formula whose
/// translation grows too large.
pub(super) fn automaton(task: &Task, text: Option<&str>) -> Result<Arc<Ldgba>, TaskError> {
    let Some(text) = text else {
        let exclusive = if task.environment()?.spec().exclusive { vec![regions(task)] } else { vec![] };
        let options = TranslateOptions { exclusive, ..TranslateOptions::default() };
        let error = |message| TaskError::new(&task.name, &task.text, task.place(&["specification", "ltl"]), message);
        return translate(&task.formula, &options).map(Arc::new).map_err(|e| error(e.to_string()));
    };
    let name = task.file.specification.hoa.as_deref().unwrap_or("automaton");
    let reading = hoa::read(text).map_err(|e| {
        let span = e.place().span;
        TaskError::new(name, text, Some(span.start..span.end), e.message()).with_help(e.suggestion().map(str::to_owned))
    })?;
    // Words in which propositions do not coincide: where regions are disjoint, an automaton may leave open what overlaps would mean.
    let letters = Letters::Exclusive;
    let help = "the automaton and the formula must say the same; leave one of them out";
    matches(&reading.automaton, &task.formula, WordBudget { letters, ..WordBudget::default() })
        .map_err(|e| TaskError::new(name, text, None, e.to_string()).with_help(Some(help.to_owned())))?;
    Ok(Arc::new(reading.automaton))
}

/// The formula's propositions, which stand for disjoint regions: one group, unless several stand for the same region.
fn regions(task: &Task) -> Vec<String> {
    let labels = &task.file.specification.labels;
    let mut met = vec![];
    let mut group = vec![];
    for name in task.formula.propositions() {
        let label = labels.get(&name).unwrap_or(&name).clone();
        if !met.contains(&label) {
            met.push(label);
            group.push(name);
        }
    }
    group
}
