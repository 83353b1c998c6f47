//! The grammar of the body, and of a stream: automata one after the other, with recovery behind a broken one.

use super::error::{Fault, HoaErrorKind};
use super::header::{conjunction, header};
use super::lexer::Token;
use super::parser::Parser;
use super::syntax::{Document, EdgeItem, StateItem};

/// The largest number of edges written in one automaton.
pub const MAX_EDGES: usize = 1_000_000;

/// Reads the next automaton of a stream; `None` when nothing follows. The cursor stands on the first token of what is to be read.
/// After a fault, [`recover`] finds the place to go on.
pub(super) fn automaton(parser: &mut Parser<'_>) -> Result<Option<Document>, Fault> {
    match *parser.token() {
        Token::Nothing => return Ok(None),
        Token::Header("HOA") => {}
        _ => {
            let known = match parser.token() {
                Token::Identifier("never") => Some("this looks like a never claim of Spin"),
                Token::Identifier("DRA" | "DSA") => Some("this looks like the format of ltl2dstar"),
                Token::Identifier("digraph" | "graph" | "strict") => Some("this looks like a DOT graph"),
                Token::Number(_) => Some("this looks like the format of LBTT"),
                _ => None,
            };
            let message = format!("`HOA:` expected, but {} found", parser.token().describe());
            let hint =
                known.map_or("only the HOA format is read".into(), |known| format!("{known}; only the HOA format is read"));
            return Err(Fault::new(HoaErrorKind::NotHoa, parser.span(), message).hint(hint));
        }
    }
    let start = parser.span();
    let mut document = header(parser)?;
    let mut edges = 0;
    loop {
        match *parser.token() {
            Token::Header("State") => document.body.push(state(parser, &mut edges)?),
            Token::End => break,
            Token::Header("HOA") => {
                return Err(parser.unexpected("`State:` or --END--").hint("a new automaton starts before the last one ended"));
            }
            _ => {
                return Err(parser.unexpected(if document.body.is_empty() {
                    "`State:` or --END--"
                } else {
                    "an edge, `State:` or --END--"
                }));
            }
        }
    }
    // The rest of the stream is another matter: what is wrong there must not harm this automaton.
    document.span = crate::ltl::Span { start: start.start, end: parser.span().end };
    Ok(Some(document))
}

fn state(parser: &mut Parser<'_>, edges: &mut usize) -> Result<StateItem, Fault> {
    parser.advance()?;
    let label = parser.bracketed_label()?;
    let number = parser.number("the number of a state")?;
    let name = parser.optional_string()?;
    let sets = parser.sets()?;
    let mut state = StateItem { number, label, name, sets, edges: Vec::new() };
    while matches!(parser.token(), Token::Symbol('[') | Token::Number(_)) {
        *edges += 1;
        if *edges > MAX_EDGES {
            return Err(Fault::new(HoaErrorKind::Limit, parser.span(), format!("more than {MAX_EDGES} edges")));
        }
        state.edges.push(edge(parser)?);
    }
    Ok(state)
}

fn edge(parser: &mut Parser<'_>) -> Result<EdgeItem, Fault> {
    let start = parser.span();
    let label = parser.bracketed_label()?;
    let targets = conjunction(parser)?;
    let sets = parser.sets()?;
    Ok(EdgeItem { span: parser.since(start), label, targets, sets })
}

/// Moves behind the automaton in which a fault was found: behind `--END--` or `--ABORT--`, or before the next `HOA:`. What is not
/// even a token is passed over.
pub(super) fn recover(parser: &mut Parser<'_>, kind: HoaErrorKind) {
    loop {
        match *parser.token() {
            Token::Header("HOA") => return,
            Token::End | Token::Abort if kind != HoaErrorKind::NotHoa => {
                // A fault of the lexer right behind belongs to the next automaton; it will be met again there.
                return step(parser);
            }
            Token::Nothing if parser.at_end() => return,
            _ => step(parser),
        }
    }
}

/// Moves on over what may be no token.
fn step(parser: &mut Parser<'_>) {
    while parser.advance().is_err() && !parser.at_end() {}
}
