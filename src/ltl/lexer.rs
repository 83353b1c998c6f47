//! From text to symbols: ASCII, Unicode and doubled spellings, quoted names, and runs such as `GFa`.
//!
//! The rules for names are Spot's, so that a formula means the same here and there: a name starts with a letter, `_` or `.`, but an
//! initial `F`, `G` or `X` is an operator unless a digit follows (`GFa` is `G F a`, but `X1` and `F1x` are names); the words `true`,
//! `false`, `tt` and `ff` are constants; `U`, `R`, `V`, `W` and `M` alone are operators, and right after an operand they are operators
//! even when letters follow (`(a)Ub` is `(a) U b`, while a leading `Ub` is a name).

use super::ast::{BinaryOperator, UnaryOperator};
use super::error::{Note, NoteKind, ParseError, ParseErrorKind, Span};

/// A symbol.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Token {
    True,
    False,
    Name(String),
    Unary(UnaryOperator),
    Binary(BinaryOperator),
    Open,
    Close,
}

impl Token {
    /// Whether an operand ends with this symbol.
    fn ends_operand(&self) -> bool {
        matches!(self, Token::True | Token::False | Token::Name(_) | Token::Close)
    }
}

/// The spellings made of signs; the first that fits is taken, so a longer one stands before its own beginning.
const SIGNS: &[(&str, Token)] = {
    use BinaryOperator::{And, Iff, Implies, Or, Xor};
    use Token::{Binary, Close, False, Open, True, Unary};
    use UnaryOperator::{Finally, Globally, Next, Not};
    &[
        ("<-->", Binary(Iff)),
        ("<==>", Binary(Iff)),
        ("<->", Binary(Iff)),
        ("<=>", Binary(Iff)),
        ("<>", Unary(Finally)),
        ("-->", Binary(Implies)),
        ("==>", Binary(Implies)),
        ("->", Binary(Implies)),
        ("=>", Binary(Implies)),
        ("&&", Binary(And)),
        ("&", Binary(And)),
        ("/\\", Binary(And)),
        ("||", Binary(Or)),
        ("|", Binary(Or)),
        ("\\/", Binary(Or)),
        ("^", Binary(Xor)),
        ("[]", Unary(Globally)),
        ("!", Unary(Not)),
        ("~", Unary(Not)),
        ("(", Open),
        (")", Close),
        ("1", True),
        ("0", False),
        ("⊤", True),
        ("⊥", False),
        ("¬", Unary(Not)),
        ("∧", Binary(And)),
        ("⋀", Binary(And)),
        ("∨", Binary(Or)),
        ("⋁", Binary(Or)),
        ("⊕", Binary(Xor)),
        ("⊻", Binary(Xor)),
        ("→", Binary(Implies)),
        ("⟶", Binary(Implies)),
        ("⇒", Binary(Implies)),
        ("⟹", Binary(Implies)),
        ("↔", Binary(Iff)),
        ("⟷", Binary(Iff)),
        ("⇔", Binary(Iff)),
        ("⟺", Binary(Iff)),
        ("○", Unary(Next)),
        ("◯", Unary(Next)),
        ("◦", Unary(Next)),
        ("◇", Unary(Finally)),
        ("⋄", Unary(Finally)),
        ("♢", Unary(Finally)),
        ("◊", Unary(Finally)),
        ("□", Unary(Globally)),
        ("⬜", Unary(Globally)),
        ("◻", Unary(Globally)),
        ("☐", Unary(Globally)),
    ]
};

fn starts_name(c: char) -> bool {
    c.is_ascii_alphabetic() || c == '_' || c == '.'
}

fn continues_name(c: char) -> bool {
    starts_name(c) || c.is_ascii_digit()
}

/// Whether `name` can be written without quotes and is then read as one name wherever an operand may stand.
pub(super) fn is_plain_name(name: &str) -> bool {
    name.starts_with(starts_name) && name.chars().all(continues_name) && word(name, false).0 == Token::Name(name.to_owned())
}

/// The first symbol of `word` (letters, digits, `_`, `.`; not starting with a digit), and its length in bytes.
fn word(word: &str, after_operand: bool) -> (Token, usize) {
    use BinaryOperator::{Release, StrongRelease, Until, WeakUntil, Xor};
    use UnaryOperator::{Finally, Globally, Next};
    let binary = match word.as_bytes()[0] {
        b'U' => Some(Until),
        b'R' | b'V' => Some(Release),
        b'W' => Some(WeakUntil),
        b'M' => Some(StrongRelease),
        _ => None,
    };
    let unary = match word.as_bytes()[0] {
        b'F' => Some(Finally),
        b'G' => Some(Globally),
        b'X' => Some(Next),
        _ => None,
    };
    let digit_follows = word.as_bytes().get(1).is_some_and(u8::is_ascii_digit);
    match (word, binary, unary) {
        ("xor", ..) => (Token::Binary(Xor), 3),
        _ if word == "tt" || word.eq_ignore_ascii_case("true") => (Token::True, word.len()),
        _ if word == "ff" || word.eq_ignore_ascii_case("false") => (Token::False, word.len()),
        (_, Some(operator), _) if word.len() == 1 || after_operand => (Token::Binary(operator), 1),
        (_, _, Some(operator)) if !digit_follows => (Token::Unary(operator), 1),
        _ => (Token::Name(word.to_owned()), word.len()),
    }
}

/// What [`tokens`] finds: the symbols in order, each with its place, and the remarks about their spelling.
pub(super) struct Symbols {
    pub tokens: Vec<(Token, Span)>,
    pub notes: Vec<Note>,
}

/// Reads all symbols of `source`.
pub(super) fn tokens(source: &str) -> Result<Symbols, ParseError> {
    let mut symbols = Symbols { tokens: Vec::new(), notes: Vec::new() };
    let mut at = 0;
    while let Some(first) = source[at..].chars().next() {
        let rest = &source[at..];
        let start = at;
        if first.is_whitespace() {
            at += first.len_utf8();
            continue;
        }
        let token = if starts_name(first) {
            let run = &rest[..rest.find(|c| !continues_name(c)).unwrap_or(rest.len())];
            let run_span = Span { start, end: start + run.len() };
            let (token, length) = word(run, symbols.tokens.last().is_some_and(|(last, _)| last.ends_operand()));
            note_run(run, &token, run_span, &mut symbols.notes);
            at += length;
            token
        } else if first == '"' {
            let (name, length) = quoted(source, at)?;
            at += length;
            Token::Name(name)
        } else if let Some((spelling, token)) = SIGNS.iter().find(|(spelling, _)| rest.starts_with(spelling)) {
            at += spelling.len();
            token.clone()
        } else {
            return Err(unknown(source, at, first));
        };
        symbols.tokens.push((token, Span { start, end: at }));
    }
    Ok(symbols)
}

/// Remarks on a run of letters: a name that looks like a formula, or operators that look like a name.
fn note_run(run: &str, token: &Token, span: Span, notes: &mut Vec<Note>) {
    let tail_of_a_noted_run = notes.last().is_some_and(|note| note.span.end == span.end && note.span.start < span.start);
    match token {
        // `aUb`, `p0Rq`: an inner capital operator letter between lower-case letters or digits.
        Token::Name(name) => {
            let bytes = name.as_bytes();
            let low = |b: u8| b.is_ascii_lowercase() || b.is_ascii_digit();
            let inner = (1..bytes.len().saturating_sub(1)).find(|&i| {
                b"URWM".contains(&bytes[i]) && bytes[..i].iter().all(|b| low(*b)) && bytes[i + 1..].iter().all(|b| low(*b))
            });
            if let Some(i) = inner {
                notes.push(Note {
                    kind: NoteKind::NameLikeFormula,
                    span,
                    message: format!(
                        "`{name}` is one proposition; for the operator write `{} {} {}`",
                        &name[..i],
                        &name[i..=i],
                        &name[i + 1..]
                    ),
                });
            }
        }
        // `Goal`, `Final`: one operator letter and then a word of at least three lower-case letters.
        Token::Unary(_) if !tail_of_a_noted_run => {
            let name = run.trim_start_matches(['F', 'G', 'X']);
            if run.len() - name.len() == 1 && name.len() >= 3 && name.starts_with(|c: char| c.is_ascii_lowercase()) {
                notes.push(Note {
                    kind: NoteKind::RunTakenApart,
                    span,
                    message: format!(
                        "`{run}` is read as `{} {name}`, as in Spot; for a proposition of that name write `\"{run}\"`",
                        &run[..1]
                    ),
                });
            }
        }
        _ => {}
    }
}

/// The quoted name that starts at byte `at`, and its length with quotes. `\"` stands for a quote, `\\` for a backslash.
fn quoted(source: &str, at: usize) -> Result<(String, usize), ParseError> {
    let mut name = String::new();
    let mut escaped = false;
    for (offset, c) in source[at..].char_indices().skip(1) {
        match c {
            '\n' | '\r' => break,
            '"' if !escaped => {
                let length = offset + 1;
                if name.is_empty() {
                    let span = Span { start: at, end: at + length };
                    return Err(ParseError::new(ParseErrorKind::EmptyName, span, "a proposition needs a name", source));
                }
                return Ok((name, length));
            }
            '\\' if !escaped => {
                escaped = true;
                continue;
            }
            _ => name.push(c),
        }
        escaped = false;
    }
    let span = Span { start: at, end: at + 1 };
    Err(ParseError::new(ParseErrorKind::UnclosedQuote, span, "this quoted name does not end", source)
        .hint("close it with `\"` on the same line"))
}

/// The error for a character that starts no symbol.
fn unknown(source: &str, at: usize, character: char) -> ParseError {
    let span = Span { start: at, end: at + character.len_utf8() };
    let error =
        ParseError::new(ParseErrorKind::UnknownCharacter(character), span, format!("`{character}` is no symbol of LTL"), source);
    match character {
        '=' => error.hint("implication is `->` or `=>`, equivalence `<->` or `<=>`"),
        '-' => error.hint("implication is `->`; negation is `!`; a name with `-` needs quotes"),
        '<' => error.hint("equivalence is `<->`, eventually is `F` or `<>`"),
        '[' | ']' => error.hint("always is `G` or `[]`"),
        '{' | '}' => error.hint("group with `(` and `)`"),
        '/' | '\\' => error.hint("conjunction is `&` or `/\\`, disjunction `|` or `\\/`"),
        '+' => error.hint("disjunction is `|`"),
        '*' => error.hint("conjunction is `&`"),
        ',' | ';' => error.hint("conjunction is `&`"),
        '\'' | '“' | '”' | '‘' | '’' => error.hint("quote names with `\"`"),
        c if c.is_ascii_digit() => error.hint("`0` and `1` are constants; a name starts with a letter, or stands in quotes"),
        c if c.is_alphabetic() => error.hint("a name with other letters than a–z, A–Z needs quotes"),
        _ => error.hint("allowed: names, true, false, ! & | ^ -> <-> X F G U R W M ( )"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spelled(source: &str) -> Vec<String> {
        tokens(source).unwrap().tokens.iter().map(|(_, span)| source[span.start..span.end].to_owned()).collect()
    }

    #[test]
    fn runs_are_taken_apart_as_in_spot() {
        assert_eq!(spelled("GFa"), ["G", "F", "a"]);
        assert_eq!(spelled("XXp0"), ["X", "X", "p0"]);
        assert_eq!(spelled("X1 & F1x"), ["X1", "&", "F1x"]);
        assert_eq!(spelled("(a)UGb"), ["(", "a", ")", "U", "G", "b"]);
        assert_eq!(spelled("aUb"), ["aUb"]);
        assert_eq!(spelled("Ub"), ["Ub"]);
        assert_eq!(spelled("GFtrue"), ["G", "F", "true"]);
        assert_eq!(spelled("FALSE"), ["FALSE"]);
    }

    #[test]
    fn no_spelling_hides_behind_an_earlier_one() {
        for (i, (spelling, _)) in SIGNS.iter().enumerate() {
            assert!(SIGNS[..i].iter().all(|(earlier, _)| !spelling.starts_with(earlier)), "{spelling} is never reached");
        }
    }
}
