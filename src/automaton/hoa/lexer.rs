//! From text to the tokens of the HOA format: nested comments, escaped strings, header names that touch their colon.

use super::error::{Fault, HoaErrorKind};
use crate::ltl::Span;

/// A token. Names borrow from the text.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Token<'a> {
    /// `name:` without the colon.
    Header(&'a str),
    /// An identifier; also `t` and `f`, which the grammar tells apart.
    Identifier(&'a str),
    /// `@name` without the `@`.
    Alias(&'a str),
    /// A number below 2^31.
    Number(u32),
    /// A string without quotes and escapes.
    String(String),
    /// One of `! & | ( ) [ ] { }`.
    Symbol(char),
    /// `--BODY--`.
    Body,
    /// `--END--`.
    End,
    /// `--ABORT--`.
    Abort,
    /// Nothing follows.
    Nothing,
}

impl Token<'_> {
    /// How an error message names it.
    pub fn describe(&self) -> String {
        match self {
            Token::Header(name) => format!("`{name}:`"),
            Token::Identifier(name) => format!("`{name}`"),
            Token::Alias(name) => format!("`@{name}`"),
            Token::Number(number) => format!("the number {number}"),
            Token::String(_) => "a string".into(),
            Token::Symbol(symbol) => format!("`{symbol}`"),
            Token::Body => "`--BODY--`".into(),
            Token::End => "`--END--`".into(),
            Token::Abort => "`--ABORT--`".into(),
            Token::Nothing => "the end of the text".into(),
        }
    }
}

/// The tokens of a text, one at a time.
pub(super) struct Lexer<'a> {
    source: &'a str,
    at: usize,
}

fn is_name_start(byte: u8) -> bool {
    byte.is_ascii_alphabetic() || byte == b'_'
}

/// Dots belong to names in version 1.1; nothing else starts with one, so they do no harm in version 1.
fn is_name(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-' | b'.')
}

impl<'a> Lexer<'a> {
    pub fn new(source: &'a str) -> Lexer<'a> {
        Lexer { source, at: 0 }
    }

    /// Whether no byte is left.
    pub fn at_end(&self) -> bool {
        self.at >= self.source.len()
    }

    /// The next token and its place.
    pub fn next(&mut self) -> Result<(Token<'a>, Span), Fault> {
        self.skip_blanks()?;
        let start = self.at;
        let bytes = self.source.as_bytes();
        let Some(&first) = bytes.get(start) else {
            return Ok((Token::Nothing, Span { start, end: start }));
        };
        let token = match first {
            b'!' | b'&' | b'|' | b'(' | b')' | b'[' | b']' | b'{' | b'}' => {
                self.at += 1;
                Token::Symbol(char::from(first))
            }
            b'"' => self.string()?,
            b'0'..=b'9' => self.number()?,
            b'@' => {
                self.at += 1;
                match self.word(is_name) {
                    "" => return Err(self.fault(start, "an alias needs a name after `@`")),
                    name => Token::Alias(name),
                }
            }
            b'-' => self.separator()?,
            _ if is_name_start(first) => self.name(),
            _ => {
                let character = self.source[start..].chars().next().expect("the position is inside the text");
                self.at += character.len_utf8();
                return Err(self.fault(start, format!("the character `{}` starts no token", character.escape_debug())));
            }
        };
        Ok((token, Span { start, end: self.at }))
    }

    fn fault(&self, start: usize, message: impl Into<String>) -> Fault {
        Fault::new(HoaErrorKind::Token, Span { start, end: self.at }, message)
    }

    fn word(&mut self, belongs: fn(u8) -> bool) -> &'a str {
        let rest = &self.source[self.at..];
        let length = rest.bytes().position(|b| !belongs(b)).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    /// An identifier, or a header name if a colon touches it.
    fn name(&mut self) -> Token<'a> {
        let name = self.word(is_name);
        if self.source[self.at..].starts_with(':') {
            self.at += 1;
            return Token::Header(name);
        }
        Token::Identifier(name)
    }

    fn number(&mut self) -> Result<Token<'a>, Fault> {
        let start = self.at;
        let digits = self.word(|b| b.is_ascii_digit());
        if digits.len() > 1 && digits.starts_with('0') {
            return Err(self.fault(start, "a number must not start with useless zeros"));
        }
        match digits.parse::<u32>() {
            Ok(number) if number < 1 << 31 => Ok(Token::Number(number)),
            _ => Err(self.fault(start, "a number must be below 2^31")),
        }
    }

    fn string(&mut self) -> Result<Token<'a>, Fault> {
        let start = self.at;
        let mut text = String::new();
        let mut characters = self.source[start..].char_indices().skip(1);
        while let Some((offset, character)) = characters.next() {
            match character {
                '"' => {
                    self.at = start + offset + 1;
                    return Ok(Token::String(text));
                }
                '\\' => match characters.next() {
                    Some((_, escaped)) => text.push(escaped),
                    None => break,
                },
                _ => text.push(character),
            }
        }
        self.at = self.source.len();
        let opening = Span { start, end: start + 1 };
        Err(Fault::new(HoaErrorKind::UnclosedString, opening, "this string is never closed"))
    }

    fn separator(&mut self) -> Result<Token<'a>, Fault> {
        let start = self.at;
        for (text, token) in [("--BODY--", Token::Body), ("--END--", Token::End), ("--ABORT--", Token::Abort)] {
            if self.source[start..].starts_with(text) {
                self.at += text.len();
                return Ok(token);
            }
        }
        self.word(is_name);
        Err(self.fault(start, "only --BODY--, --END-- and --ABORT-- start with a hyphen"))
    }

    fn skip_blanks(&mut self) -> Result<(), Fault> {
        let bytes = self.source.as_bytes();
        loop {
            match bytes.get(self.at) {
                Some(b' ' | b'\t' | b'\n' | b'\r') => self.at += 1,
                Some(b'/') if bytes.get(self.at + 1) == Some(&b'*') => self.skip_comment()?,
                _ => return Ok(()),
            }
        }
    }

    fn skip_comment(&mut self) -> Result<(), Fault> {
        let start = self.at;
        let bytes = self.source.as_bytes();
        let mut depth = 0usize;
        while self.at + 1 < bytes.len() {
            match &bytes[self.at..self.at + 2] {
                b"/*" => {
                    depth += 1;
                    self.at += 2;
                }
                b"*/" => {
                    depth -= 1;
                    self.at += 2;
                    if depth == 0 {
                        return Ok(());
                    }
                }
                _ => self.at += 1,
            }
        }
        self.at = bytes.len();
        let opening = Span { start, end: start + 2 };
        Err(Fault::new(HoaErrorKind::UnclosedComment, opening, "this comment is never closed").hint("comments nest"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(source: &str) -> Vec<Token<'_>> {
        let mut lexer = Lexer::new(source);
        std::iter::from_fn(|| Some(lexer.next().unwrap().0)).take_while(|t| *t != Token::Nothing).collect()
    }

    #[test]
    fn what_readers_get_wrong() {
        use Token::*;
        assert_eq!(tokens("/*a/*b*/c*/ t"), [Identifier("t")]);
        assert_eq!(tokens(r#""b\"q" "--ABORT--""#), [String("b\"q".into()), String("--ABORT--".into())]);
        assert_eq!(tokens("foo--ABORT-- --ABORT--"), [Identifier("foo--ABORT--"), Abort]);
        assert_eq!(
            tokens("t: spot.state-player: @a-b v1.1"),
            [Header("t"), Header("spot.state-player"), Alias("a-b"), Identifier("v1.1")]
        );
        assert_eq!(tokens("acc-name:Buchi"), [Header("acc-name"), Identifier("Buchi")]);
        assert_eq!(
            tokens("[!0&1]2{3}"),
            [
                Symbol('['),
                Symbol('!'),
                Number(0),
                Symbol('&'),
                Number(1),
                Symbol(']'),
                Number(2),
                Symbol('{'),
                Number(3),
                Symbol('}')
            ]
        );
    }

    #[test]
    fn errors_are_located() {
        let error = |source: &str| {
            let mut lexer = Lexer::new(source);
            loop {
                match lexer.next() {
                    Err(fault) => return (fault.kind.code(), fault.span.start),
                    Ok((token, _)) => assert_ne!(token, Token::Nothing),
                }
            }
        };
        assert_eq!(error("a /* b /* c */"), ("unclosed-comment", 2));
        assert_eq!(error("a \"b \\\" c"), ("unclosed-string", 2));
        assert_eq!(error("a 007"), ("token", 2));
        assert_eq!(error("2147483647 2147483648"), ("token", 11));
        assert_eq!(error("a \u{e9}"), ("token", 2));
        assert_eq!(error("@ a"), ("token", 0));
        assert_eq!(error("--BOD--"), ("token", 0));
    }
}
