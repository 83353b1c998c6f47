//! What can be wrong with a text in the HOA format: kind, place, hint, and how the place is shown.

use crate::ltl::Span;
use std::fmt;

/// What is wrong with an automaton's text, or what in it lies outside of what is supported.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
#[non_exhaustive]
pub enum HoaErrorKind {
    /// There is no automaton at all, or something else than one.
    NotHoa,
    /// A version of the format other than 1 and 1.1.
    Version,
    /// A comment that is never closed.
    UnclosedComment,
    /// A string that is never closed.
    UnclosedString,
    /// A character that starts no token, or a number with useless zeros or beyond 2^31 − 1.
    Token,
    /// A token where another one must stand.
    Syntax,
    /// `--ABORT--` discards the only automaton.
    Aborted,
    /// More than one automaton where one is asked for.
    Several,
    /// A header item that may stand only once.
    DuplicateHeader,
    /// The header item `Acceptance:` is missing.
    MissingAcceptance,
    /// Another number of names than `AP:` announces.
    PropositionCount,
    /// The same name twice in `AP:`, or an empty one.
    PropositionName,
    /// An alias that is not defined before it is used.
    UnknownAlias,
    /// An alias that is defined twice.
    DuplicateAlias,
    /// A state, a proposition or an accepting set beyond the number that the header announces.
    OutOfRange,
    /// A state that is defined twice.
    DuplicateState,
    /// A state that is announced or used but not defined.
    UndefinedState,
    /// Labels on a state and on its edges, or a number of unlabelled edges that is not 2^|AP|.
    Labels,
    /// `properties:` states what the automaton contradicts.
    Property,
    /// An acceptance condition other than generalised Büchi.
    Acceptance,
    /// A conjunction of states: an alternating automaton.
    UniversalBranching,
    /// Non-determinism that an accepting run may meet infinitely often.
    NotLimitDeterministic,
    /// A limit on the size of the text, or on the numbers of states, propositions, sets or edges.
    Limit,
    /// Labels that take too many cubes, or non-determinism that takes too many states to resolve.
    TooComplex,
}

impl HoaErrorKind {
    /// Whether the text may be a correct automaton, only one that this program cannot use.
    pub fn is_unsupported(self) -> bool {
        use HoaErrorKind::*;
        matches!(self, Aborted | Several | Acceptance | UniversalBranching | NotLimitDeterministic | Limit | TooComplex | Version)
    }

    /// A short fixed name, for tests and machine-readable output.
    pub fn code(self) -> &'static str {
        match self {
            HoaErrorKind::NotHoa => "not-hoa",
            HoaErrorKind::Version => "version",
            HoaErrorKind::UnclosedComment => "unclosed-comment",
            HoaErrorKind::UnclosedString => "unclosed-string",
            HoaErrorKind::Token => "token",
            HoaErrorKind::Syntax => "syntax",
            HoaErrorKind::Aborted => "aborted",
            HoaErrorKind::Several => "several-automata",
            HoaErrorKind::DuplicateHeader => "duplicate-header",
            HoaErrorKind::MissingAcceptance => "missing-acceptance",
            HoaErrorKind::PropositionCount => "proposition-count",
            HoaErrorKind::PropositionName => "proposition-name",
            HoaErrorKind::UnknownAlias => "unknown-alias",
            HoaErrorKind::DuplicateAlias => "duplicate-alias",
            HoaErrorKind::OutOfRange => "out-of-range",
            HoaErrorKind::DuplicateState => "duplicate-state",
            HoaErrorKind::UndefinedState => "undefined-state",
            HoaErrorKind::Labels => "labels",
            HoaErrorKind::Property => "property",
            HoaErrorKind::Acceptance => "acceptance",
            HoaErrorKind::UniversalBranching => "universal-branching",
            HoaErrorKind::NotLimitDeterministic => "not-limit-deterministic",
            HoaErrorKind::Limit => "limit",
            HoaErrorKind::TooComplex => "too-complex",
        }
    }
}

/// An error without its text: what the reader's own parts report.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Fault {
    pub kind: HoaErrorKind,
    pub span: Span,
    pub message: String,
    pub hint: Option<String>,
}

impl Fault {
    pub fn new(kind: HoaErrorKind, span: Span, message: impl Into<String>) -> Fault {
        Fault { kind, span, message: message.into(), hint: None }
    }

    pub fn hint(mut self, hint: impl Into<String>) -> Fault {
        self.hint = Some(hint.into());
        self
    }

    /// The error as the user sees it, with the place in `source`.
    pub fn located(self, source: &str) -> HoaError {
        HoaError { place: Box::new(Place::new(source, self.span)), kind: self.kind, message: self.message, hint: self.hint }
    }
}

/// A place in a text: line and column, both from 1, and the line itself.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Place {
    /// The piece of text, in bytes.
    pub span: Span,
    /// The line in which it starts, from 1.
    pub line: usize,
    /// The column in which it starts, in characters from 1.
    pub column: usize,
    excerpt: String,
    margin: String,
    carets: usize,
}

/// At most this many characters of a line are shown on each side of a place.
const EXCERPT: usize = 60;

impl Place {
    pub(super) fn new(source: &str, span: Span) -> Place {
        let start = span.start.min(source.len());
        let end = span.end.clamp(start, source.len());
        let line_start = source[..start].rfind('\n').map_or(0, |newline| newline + 1);
        let line_end = source[start..].find('\n').map_or(source.len(), |newline| start + newline);
        let before = source[line_start..start].chars().count();
        let left: Vec<char> = source[line_start..start].chars().skip(before.saturating_sub(EXCERPT)).collect();
        let right: String = source[start..line_end].trim_end_matches('\r').chars().take(EXCERPT).collect();
        let cut = if before > EXCERPT { "…" } else { "" };
        // A tab stays a tab in front of the caret, so that both lines keep the same columns.
        let margin = cut.chars().chain(left.iter().copied()).map(|c| if c == '\t' { '\t' } else { ' ' }).collect();
        let carets = source[start..end.min(line_end)].chars().count().clamp(1, right.chars().count().max(1));
        let excerpt = format!("{cut}{}{right}", left.into_iter().collect::<String>());
        let line = 1 + source[..start].matches('\n').count();
        Place { span: Span { start, end }, line, column: before + 1, excerpt, margin, carets }
    }

    /// The part of the line that is shown, and where in it the place is, in bytes.
    pub fn excerpt(&self) -> (&str, std::ops::Range<usize>) {
        let start = self.excerpt.char_indices().nth(self.margin.chars().count()).map_or(self.excerpt.len(), |(at, _)| at);
        let end = self.excerpt[start..].char_indices().nth(self.carets).map_or(self.excerpt.len(), |(at, _)| start + at);
        (&self.excerpt, start..end)
    }

    /// The line of the text (of a long one, the part around the place), and under it a line with carets below the place.
    pub fn caret(&self) -> String {
        format!("{}\n{}{}", self.excerpt, self.margin, "^".repeat(self.carets))
    }
}

/// Why a text gives no automaton that can be used: what, where, and what is allowed.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct HoaError {
    kind: HoaErrorKind,
    place: Box<Place>,
    message: String,
    hint: Option<String>,
}

impl HoaError {
    /// What kind of error it is.
    pub fn kind(&self) -> HoaErrorKind {
        self.kind
    }

    /// Where it is.
    pub fn place(&self) -> &Place {
        &self.place
    }

    /// What is wrong, in one sentence without the place.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// What to do instead, or what is allowed, where that can be told.
    pub fn suggestion(&self) -> Option<&str> {
        self.hint.as_deref()
    }

    /// The line with the place, and under it carets.
    pub fn caret(&self) -> String {
        self.place.caret()
    }
}

impl fmt::Display for HoaError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, column {}: {}", self.place.line, self.place.column, self.message)?;
        match &self.hint {
            Some(hint) => write!(f, " ({hint})"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for HoaError {}

/// A remark about a text that gives an automaton: something that was passed over, or read in one of several ways.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct HoaNote {
    /// Where.
    pub place: Place,
    /// A sentence for the user.
    pub message: String,
}

impl fmt::Display for HoaNote {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, column {}: {}", self.place.line, self.place.column, self.message)
    }
}
