//! The cursor over tokens that the grammar's parts share, and the expressions of labels and acceptance conditions.

use super::error::{Fault, HoaErrorKind};
use super::lexer::{Lexer, Token};
use super::syntax::{At, Condition, Label};
use crate::ltl::Span;

/// How deep `!` and parentheses may nest.
const MAX_DEPTH: usize = 200;

/// A cursor over the tokens of a text. `--ABORT--` may stand after any token and surfaces as a fault of its own kind.
pub(super) struct Parser<'a> {
    lexer: Lexer<'a>,
    token: Token<'a>,
    span: Span,
    /// The last byte that was consumed.
    end: usize,
}

impl<'a> Parser<'a> {
    /// Stands before the first token.
    pub fn new(source: &'a str) -> Parser<'a> {
        let start = Span { start: 0, end: 0 };
        Parser { lexer: Lexer::new(source), token: Token::Nothing, span: start, end: 0 }
    }

    /// Moves to the next token.
    pub fn advance(&mut self) -> Result<(), Fault> {
        self.end = self.span.end;
        // Also after a fault the cursor must not stay on the old token.
        self.token = Token::Nothing;
        (self.token, self.span) = self.lexer.next()?;
        Ok(())
    }

    /// Whether the whole text has been consumed.
    pub fn at_end(&self) -> bool {
        self.token == Token::Nothing && self.lexer.at_end()
    }

    pub fn token(&self) -> &Token<'a> {
        &self.token
    }

    pub fn span(&self) -> Span {
        self.span
    }

    /// From `start` to the last token that was consumed.
    pub fn since(&self, start: Span) -> Span {
        Span { start: start.start, end: self.end.max(start.end) }
    }

    /// The fault that the present token is none of `expected`.
    pub fn unexpected(&self, expected: &str) -> Fault {
        if self.token == Token::Abort {
            let message = "--ABORT-- discards this automaton: the tool that wrote it met an error";
            return Fault::new(HoaErrorKind::Aborted, self.span, message).hint("produce the file again");
        }
        let message = format!("{expected} expected, but {} found", self.token.describe());
        Fault::new(HoaErrorKind::Syntax, self.span, message)
    }

    /// Whether the present token is `symbol`; moves on if so.
    pub fn accept(&mut self, symbol: char) -> Result<bool, Fault> {
        let found = self.token == Token::Symbol(symbol);
        if found {
            self.advance()?;
        }
        Ok(found)
    }

    pub fn expect(&mut self, symbol: char) -> Result<(), Fault> {
        if self.accept(symbol)? { Ok(()) } else { Err(self.unexpected(&format!("`{symbol}`"))) }
    }

    pub fn number(&mut self, what: &str) -> Result<At<u32>, Fault> {
        let Token::Number(value) = self.token else { return Err(self.unexpected(what)) };
        let span = self.span;
        self.advance()?;
        Ok(At { value, span })
    }

    pub fn string(&mut self, what: &str) -> Result<At<String>, Fault> {
        let span = self.span;
        match self.optional_string()? {
            Some(value) => Ok(At { value, span }),
            None => Err(self.unexpected(what)),
        }
    }

    pub fn optional_string(&mut self) -> Result<Option<String>, Fault> {
        let Token::String(value) = &mut self.token else { return Ok(None) };
        let value = std::mem::take(value);
        self.advance()?;
        Ok(Some(value))
    }

    /// `{0 1}`, or nothing.
    pub fn sets(&mut self) -> Result<Vec<At<u32>>, Fault> {
        let mut sets = Vec::new();
        if self.accept('{')? {
            while !self.accept('}')? {
                sets.push(self.number("the number of an accepting set, or `}`,")?);
            }
        }
        Ok(sets)
    }

    /// `[label]`, or nothing.
    pub fn bracketed_label(&mut self) -> Result<Option<At<Label>>, Fault> {
        if !self.accept('[')? {
            return Ok(None);
        }
        let label = self.label(0)?;
        self.expect(']')?;
        Ok(Some(label))
    }

    /// A label expression: `|` under `&` under `!`.
    pub fn label(&mut self, depth: usize) -> Result<At<Label>, Fault> {
        let start = self.span;
        let mut choices = Vec::new();
        loop {
            let inner = self.span;
            let mut parts = vec![self.label_operand(depth)?];
            while self.accept('&')? {
                parts.push(self.label_operand(depth)?);
            }
            choices.push(joined(parts, Label::And, self.since(inner)));
            if !self.accept('|')? {
                return Ok(joined(choices, Label::Or, self.since(start)));
            }
        }
    }

    fn label_operand(&mut self, depth: usize) -> Result<At<Label>, Fault> {
        let start = self.span;
        self.check_depth(depth)?;
        let value = match self.token {
            Token::Symbol('!') => {
                self.advance()?;
                Label::Not(Box::new(self.label_operand(depth + 1)?))
            }
            Token::Symbol('(') => {
                self.advance()?;
                let inner = self.label(depth + 1)?;
                self.expect(')')?;
                return Ok(At { value: inner.value, span: self.since(start) });
            }
            Token::Number(index) => {
                self.advance()?;
                Label::Proposition(index)
            }
            Token::Alias(name) => {
                self.advance()?;
                Label::Alias(name.into())
            }
            Token::Identifier(name @ ("t" | "f")) => {
                self.advance()?;
                Label::Constant(name == "t")
            }
            _ => return Err(self.unexpected("the number of a proposition, an alias, `t`, `f`, `!` or `(`")),
        };
        Ok(At { value, span: self.since(start) })
    }

    /// An acceptance condition: `|` under `&`.
    pub fn condition(&mut self, depth: usize) -> Result<At<Condition>, Fault> {
        let start = self.span;
        let mut choices = Vec::new();
        loop {
            let inner = self.span;
            let mut parts = vec![self.condition_operand(depth)?];
            while self.accept('&')? {
                parts.push(self.condition_operand(depth)?);
            }
            choices.push(joined(parts, Condition::And, self.since(inner)));
            if !self.accept('|')? {
                return Ok(joined(choices, Condition::Or, self.since(start)));
            }
        }
    }

    fn condition_operand(&mut self, depth: usize) -> Result<At<Condition>, Fault> {
        let start = self.span;
        self.check_depth(depth)?;
        if self.accept('(')? {
            let inner = self.condition(depth + 1)?;
            self.expect(')')?;
            return Ok(At { value: inner.value, span: self.since(start) });
        }
        let value = match self.token {
            Token::Identifier(name @ ("t" | "f")) => {
                self.advance()?;
                Condition::Constant(name == "t")
            }
            Token::Identifier(name @ ("Inf" | "Fin")) => {
                self.advance()?;
                self.expect('(')?;
                let complement = self.accept('!')?;
                let set = self.number("the number of an accepting set")?.value;
                self.expect(')')?;
                Condition::Atom { infinitely: name == "Inf", complement, set }
            }
            _ => return Err(self.unexpected("`Inf(…)`, `Fin(…)`, `t`, `f` or `(`")),
        };
        Ok(At { value, span: self.since(start) })
    }

    fn check_depth(&self, depth: usize) -> Result<(), Fault> {
        let message = || format!("`!` and parentheses nest deeper than {MAX_DEPTH}");
        if depth > MAX_DEPTH { Err(Fault::new(HoaErrorKind::Limit, self.span, message())) } else { Ok(()) }
    }
}

/// A single part as it is, several under `join`.
fn joined<T>(mut parts: Vec<At<T>>, join: fn(Vec<At<T>>) -> T, span: Span) -> At<T> {
    if parts.len() == 1 { parts.remove(0) } else { At { value: join(parts), span } }
}
