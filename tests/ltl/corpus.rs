//! The corpus: `specs/corpus/ok/*.ltl`, `specs/corpus/err/*.ltl` and `specs/regressions.ltl`, run by one `check`.
//!
//! A file is a list of cases separated by blank lines; a case is a list of `key: value` lines, `#` starts a comment line. Every case has a
//! `formula` (with `\n`, `\t` for line ends and tabs). Then `prints` (the text in ASCII with needed parentheses), `full` (all parentheses),
//! `unicode`, `notes` (codes with byte spans, or `none`) of a correct formula; `error` (code and byte span), `says` and `hint` (pieces of the
//! message and of the suggestion) of a wrong one.

use ltl_rover::ltl::{Formula, Parentheses, Span, Style};
use std::path::{Path, PathBuf};

fn corpus(folder: &str) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("specs").join(folder);
    let mut files: Vec<_> = std::fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "ltl"));
    files.sort();
    assert!(!files.is_empty());
    files
}

fn at(span: Span) -> String {
    format!("{}..{}", span.start, span.end)
}

/// Runs the cases of one file; returns how many there were.
fn check(path: &Path) -> usize {
    let text = std::fs::read_to_string(path).unwrap();
    let mut cases = 0;
    for case in text.split("\n\n") {
        let lines: Vec<(&str, &str)> = case
            .lines()
            .filter(|line| !line.starts_with('#') && !line.is_empty())
            .map(|line| line.split_once(": ").unwrap_or_else(|| panic!("{}: no key in `{line}`", path.display())))
            .collect();
        let Some(&(first, written)) = lines.first() else { continue };
        assert_eq!(first, "formula", "{}: {case}", path.display());
        let source = written.replace("\\n", "\n").replace("\\t", "\t");
        let reading = Formula::read(&source);
        cases += 1;
        for &(key, expected) in &lines[1..] {
            let place = format!("{}: `{written}`: {key}", path.display());
            let ok = || reading.as_ref().unwrap_or_else(|error| panic!("{place}: {error}"));
            let err = || reading.as_ref().err().unwrap_or_else(|| panic!("{place}: it parses"));
            match key {
                "prints" => assert_eq!(ok().formula.to_string(), expected, "{place}"),
                "full" => {
                    assert_eq!(ok().formula.printed(Style::Ascii, Parentheses::Everywhere).to_string(), expected, "{place}")
                }
                "unicode" => {
                    assert_eq!(ok().formula.printed(Style::Unicode, Parentheses::Needed).to_string(), expected, "{place}")
                }
                "notes" => {
                    let notes: Vec<_> = ok().notes.iter().map(|note| format!("{} {}", note.kind.code(), at(note.span))).collect();
                    assert_eq!(if notes.is_empty() { "none".to_owned() } else { notes.join(", ") }, expected, "{place}");
                }
                "error" => assert_eq!(format!("{} {}", err().kind().code(), at(err().span())), expected, "{place}"),
                "says" => assert!(err().message().contains(expected), "{place}: {}", err()),
                "hint" => assert!(err().suggestion().is_some_and(|hint| hint.contains(expected)), "{place}: {}", err()),
                _ => panic!("{place}: unknown key"),
            }
        }
        assert!(lines.len() > 1, "{}: `{written}` states nothing", path.display());
    }
    cases
}

#[test]
fn the_corpus_is_read_as_it_says() {
    let cases: usize = [corpus("corpus/ok"), corpus("corpus/err")].concat().iter().map(|path| check(path)).sum();
    assert!(cases >= 100, "only {cases} cases");
}

#[test]
fn old_bugs_stay_fixed() {
    check(&Path::new(env!("CARGO_MANIFEST_DIR")).join("specs/regressions.ltl"));
}

#[test]
fn carets_stand_below_the_place() {
    let error = Formula::parse("G F a &\n\t& b").unwrap_err();
    assert_eq!(error.caret(), "\t& b\n\t^");
    assert_eq!(error.to_string(), "line 2, column 2: a formula is expected after `&` (two operators cannot stand side by side)");
    let error = Formula::parse("□ a ∧ € b").unwrap_err();
    assert_eq!(error.span().in_characters(error.source_text()), (6, 7));
    assert_eq!(error.caret(), "□ a ∧ € b\n      ^");
    let error = Formula::parse("\"😀\" =").unwrap_err();
    assert_eq!(error.span().in_utf16(error.source_text()), (5, 6));
    assert_eq!(error.span().in_characters(error.source_text()), (4, 5));
}
