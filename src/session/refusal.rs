//! Why a shell's request is refused: a sentence, the text it is about, and the place in it as a text field counts.

use serde::Serialize;
use std::fmt;
use std::ops::Range;

/// Which of the user's texts an error is about.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Subject {
    /// The task file, its preset or an override.
    Task,
    /// The formula.
    Formula,
    /// The automaton.
    Hoa,
    /// A rover map, or the picture it is made of.
    Map,
    /// A checkpoint.
    Checkpoint,
    /// None of them.
    Session,
}

/// A place in a text.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug, Serialize)]
pub struct Place {
    /// First UTF-16 code unit, as text fields of browsers count.
    pub start: usize,
    /// The code unit after the last.
    pub end: usize,
    /// Line from 1; 0 where there is no place.
    pub line: usize,
    /// Column in characters from 1; 0 where there is no place.
    pub column: usize,
}

impl Place {
    /// The place of the bytes `span` of `text`.
    pub fn of(text: &str, span: Range<usize>) -> Place {
        let floor = |mut at: usize| {
            at = at.min(text.len());
            while !text.is_char_boundary(at) {
                at -= 1;
            }
            at
        };
        let (start, end) = (floor(span.start), floor(span.end.max(span.start)));
        let units = |at: usize| text[..at].encode_utf16().count();
        let before = &text[..start];
        Place {
            start: units(start),
            end: units(end),
            line: before.matches('\n').count() + 1,
            column: before.rsplit('\n').next().map_or(0, |l| l.chars().count()) + 1,
        }
    }
}

/// A refused request.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Refusal {
    /// Which text it is about.
    #[serde(rename = "field")]
    pub subject: Subject,
    /// What is wrong, in a sentence.
    pub message: String,
    /// What to do about it; may be empty.
    pub hint: String,
    /// Where.
    #[serde(flatten)]
    pub place: Place,
}

impl Refusal {
    /// A refusal without a place.
    pub fn new(subject: Subject, message: impl Into<String>) -> Refusal {
        Refusal { subject, message: message.into(), hint: String::new(), place: Place::default() }
    }

    /// With advice.
    #[must_use]
    pub fn with_hint(mut self, hint: Option<&str>) -> Refusal {
        self.hint = hint.unwrap_or_default().to_owned();
        self
    }

    /// At a place.
    #[must_use]
    pub fn at(mut self, place: Place) -> Refusal {
        self.place = place;
        self
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.place.line {
            0 => write!(f, "{}", self.message)?,
            line => write!(f, "{line}:{}: {}", self.place.column, self.message)?,
        }
        if self.hint.is_empty() { Ok(()) } else { write!(f, " ({})", self.hint) }
    }
}

impl std::error::Error for Refusal {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_utf16_units_lines_and_characters() {
        // □ has three bytes and one unit, 𝜑 four bytes and two units.
        let text = "□a\n𝜑 & b";
        let b = text.find('b').unwrap();
        assert_eq!(Place::of(text, b..b + 1), Place { start: 8, end: 9, line: 2, column: 5 });
        assert_eq!(Place::of(text, 1..2).start, 0, "a byte inside a character stands for the character");
        assert_eq!(Place::of("ab", 7..9), Place { start: 2, end: 2, line: 1, column: 3 });
    }
}
