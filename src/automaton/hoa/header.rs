//! The grammar of the header: `HOA:` to `--BODY--`.

use super::error::{Fault, HoaErrorKind};
use super::lexer::Token;
use super::parser::Parser;
use super::syntax::{At, Document, Property};
use crate::ltl::Span;

/// Which header items have been seen, to refuse those that stand twice.
type Seen<'a> = Vec<&'a str>;

/// Reads from `HOA:` up to and including `--BODY--`.
pub(super) fn header<'a>(parser: &mut Parser<'a>) -> Result<Document, Fault> {
    let start = parser.span();
    parser.advance()?;
    let mut document = Document {
        span: start,
        version: version(parser)?,
        states: None,
        starts: Vec::new(),
        propositions: None,
        aliases: Vec::new(),
        acceptance: None,
        acceptance_name: None,
        tool: None,
        name: None,
        properties: Vec::new(),
        unknown: Vec::new(),
        body: Vec::new(),
    };
    let mut seen = Seen::new();
    loop {
        match *parser.token() {
            Token::Header(name) => {
                let span = parser.span();
                if !matches!(name, "Start" | "Alias" | "properties") {
                    if seen.contains(&name) {
                        let message = format!("`{name}:` stands a second time");
                        let hint = "only Start:, Alias: and properties: may be repeated";
                        return Err(Fault::new(HoaErrorKind::DuplicateHeader, span, message).hint(hint));
                    }
                    if seen.len() >= 1000 {
                        return Err(Fault::new(HoaErrorKind::Limit, span, "more than 1000 header items"));
                    }
                    seen.push(name);
                }
                parser.advance()?;
                item(parser, &mut document, At { value: name, span })?;
            }
            Token::Body => break,
            _ => return Err(parser.unexpected("a header item or --BODY--")),
        }
    }
    if document.acceptance.is_none() {
        let fault = Fault::new(HoaErrorKind::MissingAcceptance, parser.span(), "the header has no `Acceptance:`");
        return Err(fault.hint("for a Büchi automaton: `Acceptance: 1 Inf(0)`"));
    }
    parser.advance()?;
    Ok(document)
}

/// The version, if it is another one than 1 and 1.1 but a compatible one: `v1a`, `v1.2`.
fn version(parser: &mut Parser<'_>) -> Result<Option<At<String>>, Fault> {
    let Token::Identifier(version) = *parser.token() else {
        return Err(parser.unexpected("the version of the format, `v1`,"));
    };
    let span = parser.span();
    let Some(rest) = version.strip_prefix("v1").filter(|rest| !rest.starts_with(|c: char| c.is_ascii_digit())) else {
        let fault = Fault::new(HoaErrorKind::Version, span, format!("version `{version}` of the HOA format is not known"));
        return Err(fault.hint("known are v1 and v1.1"));
    };
    parser.advance()?;
    Ok((!matches!(rest, "" | ".1")).then(|| At { value: version.to_owned(), span }))
}

fn item(parser: &mut Parser<'_>, document: &mut Document, header: At<&str>) -> Result<(), Fault> {
    match header.value {
        "HOA" => {
            let fault = Fault::new(HoaErrorKind::Syntax, header.span, "a new automaton starts before the last one ended");
            return Err(fault.hint("is --END-- missing?"));
        }
        "States" => document.states = Some(parser.number("the number of states")?),
        "Start" => {
            let states = conjunction(parser)?;
            document.starts.push(At { value: states, span: parser.since(header.span) });
        }
        "AP" => document.propositions = Some(propositions(parser, header.span)?),
        "Alias" => {
            let Token::Alias(name) = *parser.token() else { return Err(parser.unexpected("an alias, `@name`,")) };
            let name = At { value: name.to_owned(), span: parser.span() };
            parser.advance()?;
            let label = parser.label(0)?;
            document.aliases.push((name, label));
        }
        "Acceptance" => {
            let count = parser.number("the number of accepting sets")?;
            document.acceptance = Some((count, parser.condition(0)?));
        }
        "acc-name" => {
            if !matches!(parser.token(), Token::Identifier(_)) {
                return Err(parser.unexpected("the name of an acceptance condition"));
            }
            let value = words(parser)?.join(" ");
            document.acceptance_name = Some(At { value, span: parser.since(header.span) });
        }
        "tool" => {
            let name = parser.string("the name of a tool, in quotes,")?.value;
            document.tool = Some((name, parser.optional_string()?));
        }
        "name" => document.name = Some(parser.string("a name in quotes")?.value),
        "properties" => properties(parser, document)?,
        name => {
            words(parser)?;
            if name.starts_with(|c: char| c.is_ascii_uppercase()) {
                document.unknown.push(At { value: name.to_owned(), span: header.span });
            }
        }
    }
    Ok(())
}

/// `0`, or `0 & 2`.
pub(super) fn conjunction(parser: &mut Parser<'_>) -> Result<Vec<At<u32>>, Fault> {
    let mut states = vec![parser.number("the number of a state")?];
    while parser.accept('&')? {
        states.push(parser.number("the number of a state")?);
    }
    Ok(states)
}

fn propositions(parser: &mut Parser<'_>, start: Span) -> Result<At<Vec<At<String>>>, Fault> {
    let count = parser.number("the number of atomic propositions")?;
    let mut names = Vec::new();
    while let Token::String(_) = parser.token() {
        names.push(parser.string("the name of a proposition")?);
    }
    if names.len() != count.value as usize {
        let message = format!("`AP:` announces {} propositions, but {} names follow", count.value, names.len());
        return Err(Fault::new(HoaErrorKind::PropositionCount, parser.since(start), message));
    }
    Ok(At { value: names, span: parser.since(start) })
}

fn properties(parser: &mut Parser<'_>, document: &mut Document) -> Result<(), Fault> {
    loop {
        let start = parser.span();
        let negated = parser.accept('!')?;
        let Token::Identifier(name) = *parser.token() else {
            return if negated { Err(parser.unexpected("the name of a property")) } else { Ok(()) };
        };
        parser.advance()?;
        let value = Property { name: name.to_owned(), negated };
        document.properties.push(At { value, span: parser.since(start) });
    }
}

/// `(BOOLEAN | INT | STRING | IDENTIFIER)*`
fn words(parser: &mut Parser<'_>) -> Result<Vec<String>, Fault> {
    let mut words = Vec::new();
    loop {
        words.push(match parser.token() {
            Token::Identifier(name) => (*name).to_owned(),
            Token::Number(number) => number.to_string(),
            Token::String(text) => text.clone(),
            _ => return Ok(words),
        });
        parser.advance()?;
    }
}
