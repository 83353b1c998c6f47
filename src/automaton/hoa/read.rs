//! The doors: one automaton, or a stream of them.

use super::super::ldgba::Ldgba;
use super::body::{automaton, recover};
use super::build::build;
use super::error::{Fault, HoaError, HoaErrorKind, HoaNote, Place};
use super::parser::Parser;
use super::syntax::Document;
use crate::ltl::Span;

/// The longest text, in bytes.
pub const MAX_LENGTH: usize = 16 << 20;
/// The largest number of automata in a stream.
pub const MAX_AUTOMATA: usize = 1000;
/// Remarks beyond this number are not kept.
const MAX_NOTES: usize = 20;

/// An automaton and what its text says besides.
#[derive(Clone, PartialEq, Debug)]
pub struct Reading {
    /// The automaton.
    pub automaton: Ldgba,
    /// `name:`, often the formula.
    pub name: Option<String>,
    /// `tool:` with its version.
    pub tool: Option<(String, Option<String>)>,
    /// The number of states in the text.
    pub states: usize,
    /// What was passed over, or read in one of several ways.
    pub notes: Vec<HoaNote>,
    /// From `HOA:` to `--END--`, in bytes of the text.
    pub span: Span,
}

/// What stands at one place of a stream.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub enum StreamItem {
    /// An automaton that can be used.
    Automaton(Box<Reading>),
    /// Something that cannot.
    Refused(HoaError),
    /// An automaton that `--ABORT--` discards.
    Aborted(HoaError),
}

/// Reads the text of one automaton.
///
/// # Errors
/// The first thing that is wrong or not supported, with its place; also when there is a second automaton. Automata that
/// `--ABORT--` discards before the one are passed over with a remark.
pub fn read(source: &str) -> Result<Reading, HoaError> {
    let mut aborted: Option<HoaError> = None;
    let mut found: Option<Box<Reading>> = None;
    for item in Stream::new(source) {
        match item {
            StreamItem::Automaton(reading) if found.is_none() => found = Some(reading),
            StreamItem::Automaton(reading) => {
                let span = Span { start: reading.span.start, end: reading.span.start + "HOA:".len() };
                let fault = Fault::new(HoaErrorKind::Several, span, "a second automaton starts here, but one is asked for");
                return Err(fault.hint("keep one automaton per file").located(source));
            }
            StreamItem::Aborted(error) => {
                aborted.get_or_insert(error);
            }
            StreamItem::Refused(error) => return Err(error),
        }
    }
    match (found, aborted) {
        (Some(mut reading), Some(error)) => {
            let message = "an automaton discarded by --ABORT-- is passed over".into();
            reading.notes.push(HoaNote { place: error.place().clone(), message });
            Ok(*reading)
        }
        (Some(reading), None) => Ok(*reading),
        (None, Some(error)) => Err(error),
        (None, None) => {
            let span = Span { start: source.len(), end: source.len() };
            let fault = Fault::new(HoaErrorKind::NotHoa, span, "there is no automaton in this text");
            Err(fault.hint("an automaton starts with `HOA: v1`").located(source))
        }
    }
}

/// Reads a stream: automata one after the other. A broken one does not harm those behind it. Empty if there is nothing.
pub fn read_stream(source: &str) -> Vec<StreamItem> {
    let mut items: Vec<StreamItem> = Stream::new(source).take(MAX_AUTOMATA + 1).collect();
    if items.len() > MAX_AUTOMATA {
        let span = Span { start: source.len(), end: source.len() };
        let fault = Fault::new(HoaErrorKind::Limit, span, format!("more than {MAX_AUTOMATA} automata"));
        items[MAX_AUTOMATA] = StreamItem::Refused(fault.located(source));
    }
    items
}

/// Reads item by item.
struct Stream<'a> {
    source: &'a str,
    parser: Parser<'a>,
    /// Whether the cursor must move on before the next item.
    behind: bool,
    ended: bool,
}

impl Stream<'_> {
    fn new(source: &str) -> Stream<'_> {
        Stream { source, parser: Parser::new(source), behind: true, ended: false }
    }

    /// The next tree; on a fault the cursor has moved to where the stream goes on.
    fn document(&mut self) -> Result<Option<Document>, Fault> {
        let moved = if std::mem::take(&mut self.behind) { self.parser.advance() } else { Ok(()) };
        let document = moved
            .map_err(|fault| Fault {
                kind: if fault.kind == HoaErrorKind::Token { HoaErrorKind::NotHoa } else { fault.kind },
                ..fault
            })
            .and_then(|()| automaton(&mut self.parser));
        match &document {
            // The cursor stands on --END--.
            Ok(_) => self.behind = true,
            Err(fault) => recover(&mut self.parser, fault.kind),
        }
        document
    }
}

impl Iterator for Stream<'_> {
    type Item = StreamItem;

    fn next(&mut self) -> Option<StreamItem> {
        if self.ended {
            return None;
        }
        if self.source.len() > MAX_LENGTH {
            self.ended = true;
            let message = format!("the text has {} bytes; at most {MAX_LENGTH} are allowed", self.source.len());
            let fault = Fault::new(HoaErrorKind::Limit, Span { start: 0, end: 0 }, message);
            return Some(StreamItem::Refused(fault.located(self.source)));
        }
        let mut notes = Vec::new();
        let built = match self.document() {
            Ok(None) => {
                self.ended = true;
                return None;
            }
            Ok(Some(document)) => build(&document, &mut notes).map(|automaton| (document, automaton)),
            Err(fault) => Err(fault),
        };
        Some(match built {
            Ok((document, automaton)) => StreamItem::Automaton(Box::new(Reading {
                automaton,
                states: document.body.len(),
                name: document.name,
                tool: document.tool,
                notes: notes
                    .into_iter()
                    .take(MAX_NOTES)
                    .map(|(span, message)| HoaNote { place: Place::new(self.source, span), message })
                    .collect(),
                span: document.span,
            })),
            Err(fault) if fault.kind == HoaErrorKind::Aborted => StreamItem::Aborted(fault.located(self.source)),
            Err(fault) => StreamItem::Refused(fault.located(self.source)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::labels::Labels;
    use crate::ltl::Lasso;

    fn word(prefix: &[u64], cycle: &[u64]) -> Lasso {
        Lasso { prefix: prefix.iter().map(|l| Labels(*l)).collect(), cycle: cycle.iter().map(|l| Labels(*l)).collect() }
    }

    #[test]
    fn state_marks_are_met_when_the_state_is_reached() {
        let reading = read(
            "HOA: v1 name: \"GF a\" States: 2 Start: 0 AP: 1 \"a\" Acceptance: 1 Inf(0)
             --BODY-- State: 0 [!0] 0 [0] 1 State: 1 {0} [!0] 0 [0] 1 --END--",
        )
        .unwrap();
        let automaton = &reading.automaton;
        assert_eq!((automaton.len(), reading.name.as_deref()), (2, Some("GF a")));
        assert_eq!(automaton.edge(0, Labels(1)).marks.0, 1);
        assert_eq!(automaton.edge(1, Labels(0)).marks.0, 0);
        assert!(automaton.accepts(&word(&[], &[0, 1])) && !automaton.accepts(&word(&[1], &[0])));
    }

    #[test]
    fn a_jump_that_was_resolved_is_recovered_without_a_new_state() {
        let reading = read(
            "HOA: v1 States: 2 Start: 0 AP: 1 \"a\" Acceptance: 1 Inf(0)
             --BODY-- State: 0 [t] 0 [0] 1 State: 1 [0] 1 {0} --END--",
        )
        .unwrap();
        let automaton = &reading.automaton;
        // The third is the sink of state 1 for !a.
        assert_eq!((automaton.len(), automaton.epsilon(0)), (3, &[1][..]));
        assert!(automaton.accepts(&word(&[0, 1, 0], &[1])) && !automaton.accepts(&word(&[], &[1, 0])));
    }

    #[test]
    fn a_jump_that_must_be_decided_after_the_letter_gets_a_state_that_remembers_it() {
        // F (a & G b): deciding for state 1 before the letter is read would gamble on `a`.
        let reading = read(
            "HOA: v1 States: 2 Start: 0 AP: 2 \"a\" \"b\" Acceptance: 1 Inf(0)
             --BODY-- State: 0 [t] 0 [0&1] 1 State: 1 [1] 1 {0} --END--",
        )
        .unwrap();
        let automaton = &reading.automaton;
        assert_eq!(automaton.len(), 4);
        assert!(automaton.epsilon(0).is_empty());
        let after = automaton.edge(0, Labels(3)).target;
        assert_eq!((automaton.epsilon(after), automaton.name(after)), (&[1][..], "{0} or 1"));
        assert_eq!(automaton.edge(after, Labels(2)).target, 0);
        assert!(automaton.accepts(&word(&[0, 3], &[2])) && !automaton.accepts(&word(&[0, 2], &[2])));
    }

    #[test]
    fn streams_go_on_behind_broken_and_aborted_automata() {
        let good = "HOA: v1 States: 1 Start: 0 AP: 0 Acceptance: 0 t --BODY-- State: 0 [t] 0 --END--\n";
        let text = format!("{good}HOA: v1 States: --ABORT-- {good}HOA: v1 Start: x --END-- {good} # ? {good}");
        let codes: Vec<&str> = read_stream(&text)
            .iter()
            .map(|item| match item {
                StreamItem::Automaton(_) => "ok",
                StreamItem::Refused(error) | StreamItem::Aborted(error) => error.kind().code(),
            })
            .collect();
        assert_eq!(codes, ["ok", "aborted", "ok", "syntax", "ok", "not-hoa", "ok"]);
        assert_eq!(read(&format!("HOA: v1 --ABORT-- {good}")).unwrap().notes.len(), 1);
        assert_eq!(read(&format!("{good}{good}")).unwrap_err().kind(), HoaErrorKind::Several);
        assert_eq!(read("HOA: v1 --ABORT--").unwrap_err().kind(), HoaErrorKind::Aborted);
        assert_eq!(read(" ").unwrap_err().kind(), HoaErrorKind::NotHoa);
    }

    #[test]
    fn complements_of_sets_are_generalised_buchi_too() {
        let body = "State: 0 {0} [0] 0 [!0] 1 State: 1 [0] 0 [!0] 1 --END--";
        let reading = read(&format!("HOA: v1 Start: 0 AP: 1 \"a\" Acceptance: 2 Inf(!0) & Inf(0) --BODY-- {body}")).unwrap();
        assert_eq!(reading.automaton.sets(), 2);
        assert!(reading.automaton.accepts(&word(&[], &[0, 1])) && !reading.automaton.accepts(&word(&[], &[1])));
        let mixed = "State: 0 {0} [0] 0 [!0] 1 State: 1 [0] 0 {0} [!0] 1 --END--";
        let reading = read(&format!("HOA: v1 Start: 0 AP: 1 \"a\" Acceptance: 1 Inf(!0) --BODY-- {mixed}")).unwrap();
        // Outside of the set is only the loop of state 1 on !a.
        assert!(reading.automaton.accepts(&word(&[], &[0])) && !reading.automaton.accepts(&word(&[], &[0, 1])));
    }

    #[test]
    fn places_are_shown() {
        let error = read("HOA: v1\nStart: 0\nAcceptance: 1 Fin(0)\n--BODY--\nState: 0 [t] 0\n--END--").unwrap_err();
        assert_eq!(error.caret(), "Acceptance: 1 Fin(0)\n              ^^^^^^");
        assert!(error.to_string().starts_with("line 3, column 15: the acceptance condition is not generalised Büchi: `Fin`"));
    }
}
