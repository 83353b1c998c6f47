//! What is wrong with a task, and where.

use std::fmt;
use std::ops::Range;

/// Why a task file, its automaton or an override is refused. Displays as `file:line:column: message (help)`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct TaskError {
    inner: Box<Inner>,
}

#[derive(Clone, PartialEq, Eq, Debug)]
struct Inner {
    file: String,
    text: String,
    message: String,
    help: Option<String>,
    span: Option<Range<usize>>,
}

impl TaskError {
    /// An error in `text`, which was read from `file`, at bytes `span` of it if it has a place.
    pub fn new(file: &str, text: &str, span: Option<Range<usize>>, message: impl Into<String>) -> TaskError {
        let (file, text, message) = (file.to_owned(), text.to_owned(), message.into());
        TaskError { inner: Box::new(Inner { file, text, message, help: None, span }) }
    }

    /// Adds advice.
    #[must_use]
    pub fn with_help(mut self, help: Option<String>) -> TaskError {
        self.inner.help = help;
        self
    }

    /// What is wrong, in a sentence.
    pub fn message(&self) -> &str {
        &self.inner.message
    }

    /// What to do about it.
    pub fn help(&self) -> Option<&str> {
        self.inner.help.as_deref()
    }

    /// The place, as bytes of [`TaskError::text`].
    pub fn span(&self) -> Option<Range<usize>> {
        self.inner.span.clone()
    }

    /// The text that is wrong: the task file, the automaton's file or an override.
    pub fn text(&self) -> &str {
        &self.inner.text
    }

    /// The file it was read from.
    pub fn file(&self) -> &str {
        &self.inner.file
    }

    /// Line and column (of characters) of the place, from 1.
    pub fn position(&self) -> Option<(usize, usize)> {
        let mut start = self.inner.span.as_ref()?.start.min(self.inner.text.len());
        while !self.inner.text.is_char_boundary(start) {
            start -= 1;
        }
        let before = &self.inner.text[..start];
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().map_or(0, |l| l.chars().count()) + 1;
        Some((line, column))
    }
}

impl fmt::Display for TaskError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.inner.file)?;
        if let Some((line, column)) = self.position() {
            write!(f, ":{line}:{column}")?;
        }
        write!(f, ": {}", self.inner.message)?;
        match &self.inner.help {
            Some(help) => write!(f, " ({help})"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for TaskError {}

/// The name among `names` that `wanted` was most likely meant to be, as a question.
pub(super) fn did_you_mean<'a>(wanted: &str, names: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let near = names.into_iter().map(|name| (strsim::damerau_levenshtein(wanted, name), name)).min()?;
    (near.0 <= 1 + wanted.chars().count() / 3).then(|| format!("did you mean `{}`?", near.1))
}

/// The question for an unknown key or value, from serde's own words: "unknown field `x`, expected one of `a`, `b`".
pub(super) fn suggestion(message: &str) -> Option<String> {
    let rest = message.split_once("unknown field `").or_else(|| message.split_once("unknown variant `"))?.1;
    let (wanted, rest) = rest.split_once('`')?;
    did_you_mean(wanted, rest.split('`').skip(1).step_by(2))
}

/// Serde's message with the types of Rust said in words.
pub(super) fn in_words(message: &str) -> String {
    let (before, expected) = match message.trim().rsplit_once("expected ") {
        Some((before, "usize" | "u64" | "u32" | "u8")) => (before, "a whole number, 0 or more"),
        Some((before, "f32" | "f64")) => (before, "a number"),
        Some((before, "a boolean")) => (before, "true or false"),
        _ => return message.trim().to_owned(),
    };
    format!("{before}expected {expected}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn serdes_words_become_a_question() {
        let message = "unknown field `n_stp`, expected one of `modules`, `n_step`, `tau`";
        assert_eq!(suggestion(message).as_deref(), Some("did you mean `n_step`?"));
        assert_eq!(suggestion("unknown field `zzzzzz`, expected `a` or `b`"), None);
        assert_eq!(suggestion("invalid type: string \"x\", expected f32"), None);
    }

    #[test]
    fn types_are_said_in_words() {
        let said = in_words("invalid value: integer `-3`, expected usize\n");
        assert_eq!(said, "invalid value: integer `-3`, expected a whole number, 0 or more");
        assert_eq!(in_words("missing field `name`"), "missing field `name`");
    }

    #[test]
    fn places_are_counted_in_lines_and_characters() {
        let error = TaskError::new("t.toml", "a\n□x = 1", Some(5..6), "wrong");
        assert_eq!(error.to_string(), "t.toml:2:2: wrong");
        let inside = TaskError::new("t.toml", "□", Some(1..2), "wrong");
        assert_eq!(inside.position(), Some((1, 1)));
    }
}
