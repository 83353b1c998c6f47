//! Places in a formula's text, and what can be wrong there.

use std::fmt;

/// A piece of text, as offsets in bytes: `start` included, `end` excluded. Both lie on character boundaries of the text.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Span {
    /// The first byte.
    pub start: usize,
    /// The byte after the last one; equal to `start` for a place between characters.
    pub end: usize,
}

impl Span {
    /// The smallest span that has both.
    #[must_use]
    pub fn to(self, other: Span) -> Span {
        Span { start: self.start.min(other.start), end: self.end.max(other.end) }
    }

    /// The same piece counted in characters (Unicode scalar values) of `text`.
    pub fn in_characters(self, text: &str) -> (usize, usize) {
        let count = |end: usize| text.char_indices().take_while(|(at, _)| *at < end).count();
        (count(self.start), count(self.end))
    }

    /// The same piece counted in UTF-16 code units of `text`, as JavaScript and text fields of browsers count.
    pub fn in_utf16(self, text: &str) -> (usize, usize) {
        let count =
            |end: usize| text.char_indices().take_while(|(at, _)| *at < end).map(|(_, character)| character.len_utf16()).sum();
        (count(self.start), count(self.end))
    }
}

/// What is wrong with a text that is no formula.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum ParseErrorKind {
    /// There is nothing but white space.
    Empty,
    /// The text is longer than [`MAX_LENGTH`](super::parse::MAX_LENGTH) bytes.
    TooLong,
    /// The tree would be higher than [`MAX_HEIGHT`](super::parse::MAX_HEIGHT).
    TooDeep,
    /// A character that starts no symbol.
    UnknownCharacter(char),
    /// A quoted name that does not end.
    UnclosedQuote,
    /// A quoted name without a character.
    EmptyName,
    /// A formula was expected: a proposition, a constant, a unary operator or `(`.
    ExpectedOperand,
    /// A binary operator or the end was expected.
    ExpectedOperator,
    /// A `(` that is never closed.
    UnclosedParenthesis,
    /// A `)` that closes nothing.
    UnmatchedParenthesis,
}

impl ParseErrorKind {
    /// A short fixed name, for tests and machine-readable output.
    pub fn code(&self) -> &'static str {
        match self {
            ParseErrorKind::Empty => "empty",
            ParseErrorKind::TooLong => "too-long",
            ParseErrorKind::TooDeep => "too-deep",
            ParseErrorKind::UnknownCharacter(_) => "unknown-character",
            ParseErrorKind::UnclosedQuote => "unclosed-quote",
            ParseErrorKind::EmptyName => "empty-name",
            ParseErrorKind::ExpectedOperand => "expected-operand",
            ParseErrorKind::ExpectedOperator => "expected-operator",
            ParseErrorKind::UnclosedParenthesis => "unclosed-parenthesis",
            ParseErrorKind::UnmatchedParenthesis => "unmatched-parenthesis",
        }
    }
}

/// Why a text is no formula: what, where, and what to write instead.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ParseError {
    kind: ParseErrorKind,
    span: Span,
    message: String,
    hint: Option<String>,
    source: String,
}

impl ParseError {
    pub(super) fn new(kind: ParseErrorKind, span: Span, message: impl Into<String>, source: &str) -> ParseError {
        ParseError { kind, span, message: message.into(), hint: None, source: source.to_owned() }
    }

    pub(super) fn hint(mut self, hint: impl Into<String>) -> ParseError {
        self.hint = Some(hint.into());
        self
    }

    /// What kind of error it is.
    pub fn kind(&self) -> &ParseErrorKind {
        &self.kind
    }

    /// Where it is, in bytes of the text; see [`Span::in_utf16`] for a page.
    pub fn span(&self) -> Span {
        self.span
    }

    /// What is wrong, in one sentence without the place.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// What to write instead, where that can be told.
    pub fn suggestion(&self) -> Option<&str> {
        self.hint.as_deref()
    }

    /// The text that was read. Of a text that is too long, the beginning.
    pub fn source_text(&self) -> &str {
        &self.source
    }

    /// The line of the text with the place, and under it a line with carets below the place.
    ///
    /// ```
    /// let error = ltl_rover::ltl::Formula::parse("a & & b").unwrap_err();
    /// assert_eq!(error.caret(), "a & & b\n    ^");
    /// ```
    pub fn caret(&self) -> String {
        caret(&self.source, self.span)
    }
}

/// The line of `source` in which `span` starts, and under it carets below the span.
pub(super) fn caret(source: &str, span: Span) -> String {
    let start = source[..span.start].rfind('\n').map_or(0, |newline| newline + 1);
    let end = source[span.start..].find('\n').map_or(source.len(), |newline| span.start + newline);
    let (line, last) = (&source[start..end], span.end.min(end).max(span.start));
    // A tab in the text stays a tab in front of the caret, so that both lines keep the same columns.
    let margin: String = source[start..span.start].chars().map(|c| if c == '\t' { '\t' } else { ' ' }).collect();
    let carets = source[span.start..last].chars().count().max(1);
    format!("{}\n{margin}{}", line.trim_end_matches('\r'), "^".repeat(carets))
}

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let line = 1 + self.source[..self.span.start].matches('\n').count();
        let line_start = self.source[..self.span.start].rfind('\n').map_or(0, |newline| newline + 1);
        let column = 1 + self.source[line_start..self.span.start].chars().count();
        if self.source.contains('\n') {
            write!(f, "line {line}, ")?;
        }
        write!(f, "column {column}: {}", self.message)?;
        match &self.hint {
            Some(hint) => write!(f, " ({hint})"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for ParseError {}

/// Something in a correct formula that a reader, or another tool, may understand otherwise.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
#[non_exhaustive]
pub enum NoteKind {
    /// `a U b U c`: read from the right here and in Spot and Owl, from the left by Spin and LTL2BA.
    TemporalChain,
    /// `a & b U c`: the temporal operator binds tighter here and in Spot; not in every tool.
    TemporalOperand,
    /// `a -> b -> c`: read from the right here and in Spot, from the left by Spin and LTL2BA.
    ImplicationChain,
    /// `a | b ^ c`: `^` binds tighter than `|` and weaker than `&` here and in Spot; not in every tool.
    ExclusiveOr,
    /// A name such as `aUb` that looks like operators and operands written together.
    NameLikeFormula,
    /// A run such as `GFa` that was taken apart into operators, though it could be meant as a name.
    RunTakenApart,
}

impl NoteKind {
    /// A short fixed name, for tests and machine-readable output.
    pub fn code(self) -> &'static str {
        match self {
            NoteKind::TemporalChain => "temporal-chain",
            NoteKind::TemporalOperand => "temporal-operand",
            NoteKind::ImplicationChain => "implication-chain",
            NoteKind::ExclusiveOr => "exclusive-or",
            NoteKind::NameLikeFormula => "name-like-formula",
            NoteKind::RunTakenApart => "run-taken-apart",
        }
    }
}

/// A warning about a correct formula: tools disagree about this construct, or it may not be what was meant.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Note {
    /// What it is about.
    pub kind: NoteKind,
    /// Where, in bytes of the text.
    pub span: Span,
    /// A sentence for the user, which says how the construct was read.
    pub message: String,
}
