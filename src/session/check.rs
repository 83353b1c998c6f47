//! Verdicts on texts as the user types them: a formula, an automaton file.

use super::open::read_automaton;
use super::refusal::{Place, Refusal, Subject};
use crate::ltl::{Formula, Parentheses, ParseError, Reading, Span, Style};
use serde::Serialize;

/// A remark on a correct formula, with its place in UTF-16 code units.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Remark {
    /// A sentence.
    pub message: String,
    /// First code unit.
    pub start: usize,
    /// The code unit after the last.
    pub end: usize,
}

/// What is said about a formula that was understood.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct FormulaFacts {
    /// As it was written.
    pub text: String,
    /// With all parentheses, in mathematical signs: how it was read.
    pub parenthesised: String,
    /// Constructs that others read otherwise, and propositions that the environment does not have.
    pub warnings: Vec<Remark>,
    /// The names of its propositions, in order of their first occurrence in the tree.
    pub propositions: Vec<String>,
}

impl FormulaFacts {
    /// The facts of a formula that was read from `text`; `known` are the environment's propositions (none: not checked).
    pub fn new(text: &str, reading: &Reading, known: &[String]) -> FormulaFacts {
        let Reading { formula, notes } = reading;
        let remark = |span: Span, message: String| {
            let (start, end) = span.in_utf16(text);
            Remark { message, start, end }
        };
        let mut warnings: Vec<Remark> = notes.iter().map(|note| remark(note.span, note.message.clone())).collect();
        let propositions: Vec<String> = formula.propositions().iter().map(|name| (*name).to_string()).collect();
        let strange = propositions.iter().filter(|name| !known.is_empty() && !known.contains(name));
        warnings.extend(strange.map(|name| {
            let message = format!("the environment has no proposition `{name}`; it has {}", known.join(", "));
            remark(occurrence(text, name).unwrap_or(Span { start: 0, end: text.len() }), message)
        }));
        let parenthesised = formula.printed(Style::Unicode, Parentheses::Everywhere).to_string();
        FormulaFacts { text: text.to_owned(), parenthesised, warnings, propositions }
    }
}

/// The first place where `name` stands as a word of its own.
pub(super) fn occurrence(text: &str, name: &str) -> Option<Span> {
    let word = |c: char| c.is_alphanumeric() || c == '_';
    let alone = |start: usize| {
        let end = start + name.len();
        !text[..start].chars().next_back().is_some_and(word) && !text[end..].chars().next().is_some_and(word)
    };
    text.match_indices(name)
        .map(|(start, _)| start)
        .find(|&start| alone(start))
        .map(|start| Span { start, end: start + name.len() })
}

/// Reads a formula; `known` are the environment's propositions, for warnings (none: not checked).
///
/// # Errors
/// The first place at which the text is no formula.
pub fn check_formula(text: &str, known: &[String]) -> Result<FormulaFacts, Refusal> {
    let reading = Formula::read(text).map_err(|error| formula_refusal(text, &error))?;
    Ok(FormulaFacts::new(text, &reading, known))
}

pub(super) fn formula_refusal(text: &str, error: &ParseError) -> Refusal {
    let span = error.span();
    Refusal::new(Subject::Formula, error.message()).with_hint(error.suggestion()).at(Place::of(text, span.start..span.end))
}

/// What is said about an automaton file that was understood.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct HoaFacts {
    /// Automaton states, an added sink included.
    pub states: usize,
    /// Accepting sets.
    pub sets: usize,
    /// The names of its propositions.
    pub propositions: Vec<String>,
}

/// Reads an automaton file.
///
/// # Errors
/// The first place at which the file gives no automaton that can be used.
pub fn check_hoa(text: &str) -> Result<HoaFacts, Refusal> {
    let automaton = read_automaton(text)?;
    let propositions = automaton.propositions().iter().map(str::to_owned).collect();
    Ok(HoaFacts { states: automaton.len(), sets: automaton.sets(), propositions })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formula_is_echoed_with_all_parentheses_and_its_warnings() {
        let known = ["a".to_owned(), "b".to_owned()];
        let facts = check_formula("□◇a & b U c", &known).unwrap();
        assert_eq!(facts.parenthesised, "(□(◇a)) ∧ (b U c)");
        assert_eq!(facts.propositions, ["a", "b", "c"]);
        let strange = facts.warnings.iter().find(|w| w.message.contains("no proposition `c`")).unwrap();
        assert_eq!((strange.start, strange.end), (10, 11));
        assert!(check_formula("G F a", &[]).unwrap().warnings.is_empty());
    }

    #[test]
    fn a_wrong_formula_is_refused_at_its_place_in_utf16_units() {
        let refusal = check_formula("□a & & b", &[]).unwrap_err();
        assert_eq!((refusal.subject, refusal.place.start, refusal.place.column), (Subject::Formula, 5, 6));
        assert!(!refusal.message.is_empty());
        assert_eq!(check_formula("", &[]).unwrap_err().place.line, 1);
    }

    #[test]
    fn a_name_is_found_as_a_whole_word_only() {
        assert_eq!(occurrence("ab & a", "a"), Some(Span { start: 5, end: 6 }));
        assert_eq!(occurrence("ab", "a"), None);
    }
}
