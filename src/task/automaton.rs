//! The automaton of a task: read from its HOA file and held against its formula.

use super::error::TaskError;
use super::parse::Task;
use crate::automaton::Ldgba;
use crate::automaton::hoa;
use std::sync::Arc;

/// The automaton in `text`, or the translation of the formula.
///
/// # Errors
/// A text that is no automaton, at its place; no text.
pub(super) fn automaton(task: &Task, text: Option<&str>) -> Result<Arc<Ldgba>, TaskError> {
    let place = task.place(&["specification", "ltl"]);
    let Some(text) = text else {
        let message = "formulas are not translated yet: the task needs an automaton in the HOA format";
        return Err(TaskError::new(&task.name, &task.text, place, message).with_help(Some("add `hoa = \"FILE\"`".to_owned())));
    };
    let reading = hoa::read(text).map_err(|e| {
        let name = task.file.specification.hoa.as_deref().unwrap_or("automaton");
        let span = e.place().span;
        TaskError::new(name, text, Some(span.start..span.end), e.message()).with_help(e.suggestion().map(str::to_owned))
    })?;
    Ok(Arc::new(reading.automaton))
}
