//! The automaton of a task: read from its HOA file and held against its formula, or translated from it.

use super::error::TaskError;
use super::parse::Task;
use crate::automaton::translate::{Acceptance, TranslateOptions, translate};
use crate::automaton::{Ldgba, Letters, WordBudget, hoa, matches};
use crate::env::EnvSpec;
use crate::product::LetterMap;
use std::sync::Arc;

/// Words that an automaton is held against its formula on: a set-up should not take long.
const BUDGET: WordBudget = WordBudget { exhaustive: 3_000, random: 1_000, seed: 0, letters: Letters::All };

/// The automaton in `text`, or the translation of the formula.
///
/// An automaton is held against the formula on words in which regions that never overlap do not hold together. Where the environment
/// does not say that of all its labels, an automaton that reads overlaps in its own way is accepted as well.
///
/// # Errors
/// A text that is no automaton, at its place; an automaton that differs from the formula, with a word; a formula that is too hard.
pub(super) fn automaton(task: &Task, text: Option<&str>) -> Result<Arc<Ldgba>, TaskError> {
    let place = task.place(&["specification", "ltl"]);
    let environment = task.environment()?;
    let spec = environment.spec();
    let Some(text) = text else {
        let error = |message| TaskError::new(&task.name, &task.text, place, message);
        let made = translate(&task.formula, &options(task, spec)).map_err(|e| error(e.to_string()))?;
        return Ok(Arc::new(made));
    };
    let name = task.file.specification.hoa.as_deref().unwrap_or("automaton");
    let read = hoa::read(text).map_err(|e| {
        let span = e.place().span;
        TaskError::new(name, text, Some(span.start..span.end), e.message()).with_help(e.suggestion().map(str::to_owned))
    })?;
    // Unknown labels have an error of their own, with a better place than a word on which two languages differ.
    let known = LetterMap::new(read.automaton.propositions(), spec, &task.file.specification.labels).is_ok();
    if known {
        let exclusive = WordBudget { letters: Letters::Exclusive, ..BUDGET };
        let budget = if spec.exclusive { exclusive } else { BUDGET };
        let held = matches(&read.automaton, &task.formula, budget)
            .or_else(|e| if spec.exclusive { Err(e) } else { matches(&read.automaton, &task.formula, exclusive) });
        held.map_err(|e| {
            let place = task.place(&["specification", "hoa"]).or(place);
            TaskError::new(&task.name, &task.text, place, format!("`{name}` is not the automaton of this formula: {e}"))
        })?;
    }
    Ok(Arc::new(read.automaton))
}

/// How a formula is translated for an environment: the paper's form, with marks on states, of which modules are made.
fn options(task: &Task, spec: &EnvSpec) -> TranslateOptions {
    let exclusive = if spec.exclusive { vec![regions(task)] } else { vec![] };
    TranslateOptions { acceptance: Acceptance::State, exclusive, ..TranslateOptions::default() }
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
