//! From symbols to the tree, with Spot's precedence and associativity.
//!
//! From weakest to tightest: `->` and `<->` (one level, from the right) · `|` (from the left) · `^` (from the left) · `&` (from the
//! left) · `U R W M` (one level, from the right) · the unary operators `X F G !`. This is the table of Spot's document *Temporal Logic
//! Formulas* and of its grammar. Where widely used tools read a construct in another way, a [`Note`] says so.

use super::ast::{BinaryOperator, Formula, UnaryOperator};
use super::error::{Note, NoteKind, ParseError, ParseErrorKind, Span};
use super::lexer::{Token, tokens};
use super::print::spelling;
use std::str::FromStr;

/// The longest text of a formula, in bytes.
pub const MAX_LENGTH: usize = 1 << 16;

/// The highest tree (see [`Formula::height`]).
pub const MAX_HEIGHT: usize = 256;

/// A formula together with the remarks on how it was written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Reading {
    /// The formula.
    pub formula: Formula,
    /// Constructs that another tool or a reader may understand otherwise, in the order of the text.
    pub notes: Vec<Note>,
}

impl Formula {
    /// Reads one formula.
    ///
    /// # Errors
    /// The first place at which the text is no formula, with what was expected there; a text longer than [`MAX_LENGTH`], a tree higher
    /// than [`MAX_HEIGHT`].
    pub fn parse(text: &str) -> Result<Formula, ParseError> {
        Formula::read(text).map(|reading| reading.formula)
    }

    /// Reads one formula, and remarks on constructs about which tools disagree.
    ///
    /// # Errors
    /// As [`Formula::parse`].
    pub fn read(text: &str) -> Result<Reading, ParseError> {
        if text.len() > MAX_LENGTH {
            let cut = (0..=80).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0);
            let message = format!("the formula has {} bytes; at most {MAX_LENGTH} are allowed", text.len());
            return Err(ParseError::new(ParseErrorKind::TooLong, Span { start: 0, end: cut }, message, &text[..cut]));
        }
        let symbols = tokens(text)?;
        let mut parser = Parser { source: text, tokens: &symbols.tokens, next: 0, pending: Vec::new(), notes: symbols.notes };
        let formula = parser.whole()?.formula;
        let mut notes = parser.notes;
        notes.sort_by_key(|note| (note.span, note.kind));
        Ok(Reading { formula, notes })
    }
}

impl FromStr for Formula {
    type Err = ParseError;

    fn from_str(text: &str) -> Result<Formula, ParseError> {
        Formula::parse(text)
    }
}

/// How tightly an operator binds: a higher number binds tighter.
pub(super) fn precedence(operator: BinaryOperator) -> u8 {
    use BinaryOperator::{And, Iff, Implies, Or, Release, StrongRelease, Until, WeakUntil, Xor};
    match operator {
        Implies | Iff => 0,
        Or => 1,
        Xor => 2,
        And => 3,
        Until | Release | WeakUntil | StrongRelease => 4,
    }
}

/// Whether `a op b op c` means `a op (b op c)`.
pub(super) fn from_the_right(operator: BinaryOperator) -> bool {
    matches!(precedence(operator), 0 | 4)
}

/// A piece of the text that is a formula.
struct Operand {
    formula: Formula,
    span: Span,
    height: usize,
    /// The binary operator on top, unless parentheses stand around it.
    bare: Option<BinaryOperator>,
}

/// What waits for the operand that is being read.
enum Pending {
    Unary(UnaryOperator, Span),
    Binary(BinaryOperator, Operand),
    Open(Span),
}

/// An operator-precedence parser. It keeps its own stack, so that no text can exhaust the machine's.
struct Parser<'a> {
    source: &'a str,
    tokens: &'a [(Token, Span)],
    next: usize,
    pending: Vec<Pending>,
    notes: Vec<Note>,
}

impl Parser<'_> {
    fn whole(&mut self) -> Result<Operand, ParseError> {
        if self.tokens.is_empty() {
            let error = self.error(ParseErrorKind::Empty, Span { start: 0, end: 0 }, "there is no formula");
            return Err(error.hint("for instance `G F a & G !b`"));
        }
        loop {
            let mut operand = self.operand()?;
            loop {
                operand = self.with_unary_operators(operand)?;
                let Some((token, span)) = self.tokens.get(self.next) else {
                    operand = self.reduced(operand, 0)?;
                    return match self.pending.pop() {
                        None => Ok(operand),
                        Some(Pending::Open(open)) => Err(self.unclosed(open)),
                        Some(_) => unreachable!("operators have been applied"),
                    };
                };
                match token {
                    Token::Binary(operator) => {
                        let level = precedence(*operator);
                        let left = self.reduced(operand, if from_the_right(*operator) { level + 1 } else { level })?;
                        self.pending.push(Pending::Binary(*operator, left));
                        self.next += 1;
                        break;
                    }
                    Token::Close => {
                        operand = self.reduced(operand, 0)?;
                        let Some(Pending::Open(open)) = self.pending.pop() else {
                            let error = self.error(ParseErrorKind::UnmatchedParenthesis, *span, "this `)` closes nothing");
                            return Err(error.hint("remove it, or open it with `(` before"));
                        };
                        operand = Operand { span: open.to(*span), bare: None, ..operand };
                        self.next += 1;
                    }
                    _ => return Err(self.operator_expected(*span)),
                }
            }
        }
    }

    /// Reads unary operators and opening parentheses, which wait, up to a constant or a proposition, which is returned.
    fn operand(&mut self) -> Result<Operand, ParseError> {
        loop {
            let Some((token, span)) = self.tokens.get(self.next) else {
                return Err(self.operand_expected());
            };
            let formula = match token {
                Token::True => Formula::True,
                Token::False => Formula::False,
                Token::Name(name) => Formula::Proposition(name.clone()),
                Token::Unary(operator) => {
                    self.pending.push(Pending::Unary(*operator, *span));
                    self.next += 1;
                    continue;
                }
                Token::Open => {
                    self.pending.push(Pending::Open(*span));
                    self.next += 1;
                    continue;
                }
                Token::Binary(_) | Token::Close => return Err(self.operand_expected()),
            };
            self.next += 1;
            return Ok(Operand { formula, span: *span, height: 1, bare: None });
        }
    }

    /// Applies the unary operators that wait right in front of `operand`.
    fn with_unary_operators(&mut self, mut operand: Operand) -> Result<Operand, ParseError> {
        while let Some(Pending::Unary(operator, span)) = self.pending.last() {
            operand = self.checked(Operand {
                formula: Formula::unary(*operator, operand.formula),
                span: span.to(operand.span),
                height: operand.height + 1,
                bare: None,
            })?;
            self.pending.pop();
        }
        Ok(operand)
    }

    /// Applies the binary operators that wait for `operand` as their right side and bind at least as tightly as `weakest`.
    fn reduced(&mut self, mut operand: Operand, weakest: u8) -> Result<Operand, ParseError> {
        loop {
            match self.pending.pop() {
                Some(Pending::Binary(operator, left)) if precedence(operator) >= weakest => {
                    operand = self.joined(operator, left, operand)?;
                }
                Some(other) => {
                    self.pending.push(other);
                    return Ok(operand);
                }
                None => return Ok(operand),
            }
        }
    }

    /// The tree `left operator right`, with the remarks it deserves.
    fn joined(&mut self, operator: BinaryOperator, left: Operand, right: Operand) -> Result<Operand, ParseError> {
        self.remark(operator, &left, &right);
        let (span, height) = (left.span.to(right.span), 1 + left.height.max(right.height));
        let formula = Formula::binary(operator, left.formula, right.formula);
        self.checked(Operand { formula, span, height, bare: Some(operator) })
    }

    fn checked(&self, operand: Operand) -> Result<Operand, ParseError> {
        if operand.height > MAX_HEIGHT { Err(self.too_deep(operand.span)) } else { Ok(operand) }
    }

    fn remark(&mut self, operator: BinaryOperator, left: &Operand, right: &Operand) {
        use BinaryOperator::{And, Iff, Implies, Or, Xor};
        let is = |operand: &Operand, test: fn(BinaryOperator) -> bool| operand.bare.is_some_and(test);
        let temporal = BinaryOperator::is_temporal;
        let implication = |o: BinaryOperator| matches!(o, Implies | Iff);
        let (kind, why) = if operator.is_temporal() && is(right, temporal) {
            (NoteKind::TemporalChain, "as in Spot and Owl; Spin and LTL2BA group from the left")
        } else if matches!(operator, And | Or | Xor) && (is(left, temporal) || is(right, temporal)) {
            (NoteKind::TemporalOperand, "U, R, W and M bind tighter than & ^ |, as in Spot; not in every tool")
        } else if implication(operator) && is(right, implication) {
            (NoteKind::ImplicationChain, "as in Spot; Spin and LTL2BA group from the left")
        } else if operator == Or && (is(left, |o| o == Xor) || is(right, |o| o == Xor))
            || operator == Xor && (is(left, |o| o == And) || is(right, |o| o == And))
        {
            (NoteKind::ExclusiveOr, "^ stands between & and |, as in Spot; not in every tool")
        } else {
            return;
        };
        let shown = |operand: &Operand| {
            let text = shortened(&self.source[operand.span.start..operand.span.end]);
            if operand.bare.is_some() { format!("({text})") } else { text }
        };
        let span = left.span.to(right.span);
        let message = format!("read as `{} {} {}` ({why})", shown(left), spelling(operator), shown(right));
        self.notes.push(Note { kind, span, message });
    }

    fn error(&self, kind: ParseErrorKind, span: Span, message: impl Into<String>) -> ParseError {
        ParseError::new(kind, span, message, self.source)
    }

    fn too_deep(&self, span: Span) -> ParseError {
        self.error(ParseErrorKind::TooDeep, span, format!("the formula is nested deeper than {MAX_HEIGHT} levels"))
    }

    fn unclosed(&self, open: Span) -> ParseError {
        self.error(ParseErrorKind::UnclosedParenthesis, open, "this `(` is never closed").hint("add a `)`")
    }

    /// The error for a place where an operand should start: the present symbol, or the end.
    fn operand_expected(&self) -> ParseError {
        let after = self.next.checked_sub(1).map(|before| {
            let span = self.tokens[before].1;
            format!(" after `{}`", &self.source[span.start..span.end])
        });
        let message = format!("a formula is expected{}", after.unwrap_or_default());
        match self.tokens.get(self.next) {
            Some((token, span)) => {
                let error = self.error(ParseErrorKind::ExpectedOperand, *span, message);
                match token {
                    Token::Close => error.hint("a proposition, true, false, a unary operator or `(`"),
                    _ if self.next == 0 => error.hint("this operator needs a left side"),
                    _ => error.hint("two operators cannot stand side by side"),
                }
            }
            None => {
                let end = self.tokens.last().map_or(0, |(_, span)| span.end);
                self.error(ParseErrorKind::ExpectedOperand, Span { start: end, end }, message).hint("the formula ends too early")
            }
        }
    }

    /// The error for a place where an operator, a `)` or the end should stand.
    fn operator_expected(&self, span: Span) -> ParseError {
        let found = &self.source[span.start..span.end];
        let open = self.pending.iter().any(|pending| matches!(pending, Pending::Open(_)));
        let allowed = if open { "a binary operator or `)`" } else { "a binary operator or the end" };
        let error = self.error(ParseErrorKind::ExpectedOperator, span, format!("{allowed} is expected, not `{found}`"));
        match found.to_ascii_lowercase().as_str() {
            "and" => error.hint("conjunction is `&`"),
            "or" => error.hint("disjunction is `|`"),
            "implies" => error.hint("implication is `->`"),
            "iff" | "equiv" => error.hint("equivalence is `<->`"),
            "until" | "u" => error.hint("until is `U`"),
            "release" | "releases" | "r" => error.hint("release is `R`"),
            "weak" | "w" | "unless" => error.hint("weak until is `W`"),
            _ => match self.tokens[self.next - 1].0 {
                Token::Name(ref name)
                    if ["not", "next", "always", "eventually", "globally", "finally"].contains(&name.as_str()) =>
                {
                    error.hint("negation is `!`, next `X`, eventually `F`, always `G`")
                }
                Token::Name(ref name) if ["x", "f", "g"].contains(&name.as_str()) => {
                    error.hint("operators are capital letters: `X`, `F`, `G`")
                }
                _ => error.hint("write `&`, `|`, `->`, `U` … in between"),
            },
        }
    }
}

/// `text` if it is short, else its beginning and its end.
fn shortened(text: &str) -> String {
    const LONGEST: usize = 60;
    let length = text.chars().count();
    if length <= LONGEST {
        return text.to_owned();
    }
    let (head, tail) = (text.chars().take(LONGEST / 2), text.chars().skip(length - LONGEST / 2));
    head.chain(['…']).chain(tail).collect()
}
