//! The HOA reader on files of other tools, where they are there (`../shared/ltl/hoa`, a table of verdicts beside them), against that
//! table, against a plain classification of acceptance, against a letter-by-letter check of limit-determinism, and against the
//! formulas that the files name.

use ltl_rover::automaton::hoa::{self, HoaErrorKind, Reading, StreamItem};
use ltl_rover::automaton::{WordBudget, matches};
use ltl_rover::ltl::Formula;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Where the verdict table and the reader part, and why the reader is right by the text of the format.
const DIFFERENCES: &[(&str, &str)] = &[
    ("spot-tests/parseaut-171.hoa", "the fourth automaton is in another format (LBTT)"),
    ("spot-tests/parseaut-174.hoa", "the table only warns: an unknown capital header item is passed over, here with a remark"),
    ("tricky/abort_in_string_and_stream.hoa", "the table counts the discarded automaton; the third is refused for its `Fin`"),
];

/// Files whose number of states in the table is that after Spot's reading: it leaves out states that cannot be reached, and joins
/// several initial states in a new one. The number of `State:` items is ours.
const REACHABLE_ONLY: &[&str] = &[
    "spot-tests/522-001.hoa",
    "spot-tests/522-003.hoa",
    "spot-tests/complement-040.hoa",
    "spot-tests/det-064.hoa",
    "spot-tests/format-107.hoa",
    "spot-tests/readsave-207.hoa",
    "spot-tests/readsave-213.hoa",
    "spot-tests/strength-276.hoa",
    "spot-tests/strength-277.hoa",
    "spot-tests/strength-279.hoa",
];

fn folder() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/ltl/hoa");
    folder.join("autfilt-verdict.tsv").is_file().then_some(folder)
}

fn text(path: &Path) -> String {
    String::from_utf8_lossy(&fs::read(path).unwrap()).into_owned()
}

/// All files, by name below the folder.
fn files() -> BTreeMap<String, String> {
    let Some(root) = folder() else { return BTreeMap::new() };
    let mut files = BTreeMap::new();
    let mut open = vec![root.clone()];
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
        } else if path.extension().is_some_and(|extension| extension == "hoa") {
            files.insert(path.strip_prefix(&root).unwrap().to_str().unwrap().replace('\\', "/"), text(&path));
        }
    }
    files
}

#[test]
fn verdicts_are_those_of_the_table() {
    let Some(root) = folder() else { return };
    let files = files();
    let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    let table = text(&root.join("autfilt-verdict.tsv"));
    for row in table.lines() {
        let fields: Vec<&str> = row.split('\t').collect();
        let (name, valid) = (fields[0], fields[1] == "OK");
        let items = hoa::read_stream(&files[name]);
        let refused: Vec<HoaErrorKind> = items
            .iter()
            .filter_map(|item| match item {
                StreamItem::Refused(error) => Some(error.kind()),
                _ => None,
            })
            .collect();
        let usable: Vec<&Reading> = items
            .iter()
            .filter_map(|item| match item {
                StreamItem::Automaton(reading) => Some(reading.as_ref()),
                _ => None,
            })
            .collect();
        let malformed = refused.iter().any(|kind| !kind.is_unsupported());
        let ours = match (malformed, refused.is_empty() && !usable.is_empty()) {
            (true, _) => "malformed",
            (false, true) => "usable",
            (false, false) => "outside",
        };
        *counts.entry((fields[1], ours)).or_default() += 1;
        if DIFFERENCES.iter().any(|(known, _)| *known == name) {
            continue;
        }
        // What the table calls invalid is refused; what it calls valid is at most outside of generalised Büchi.
        assert!(if valid { !malformed } else { !refused.is_empty() }, "{name}: {ours}, {refused:?}; table: {row}");
        let states: Vec<usize> =
            fields[2].trim_start_matches("states=").split(',').filter(|n| !n.is_empty()).map(|n| n.parse().unwrap()).collect();
        if valid && states.len() == items.len() && !REACHABLE_ONLY.contains(&name) {
            for (item, count) in items.iter().zip(states) {
                if let StreamItem::Automaton(reading) = item {
                    assert_eq!(reading.states, count, "{name}: number of states");
                }
            }
        }
    }
    println!("{counts:?}");
    assert!(counts[&("OK", "usable")] >= 139);
}

/// The pieces of a text that are automata, cut at `HOA:` and `--END--`; only files whose every item is one are looked at.
fn automata(text: &str) -> Vec<&str> {
    text.split_inclusive("--END--").filter(|piece| piece.contains("--END--")).collect()
}

/// The acceptance condition without blanks, and without comments, which no file has at that place.
fn condition(automaton: &str) -> Option<String> {
    let rest = automaton.split_once("Acceptance:")?.1.trim_start();
    let rest = rest.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start();
    let line = rest.lines().next()?;
    let mut condition = String::new();
    let mut characters = line.chars().filter(|c| !c.is_whitespace()).peekable();
    while let Some(c) = characters.next() {
        match c {
            '(' | ')' | '&' | '|' | '!' | '0'..='9' => condition.push(c),
            't' | 'f' if condition.is_empty() || condition.ends_with(['(', '&', '|']) => condition.push(c),
            'I' | 'F' => {
                let rest: String = characters.by_ref().take(2).collect();
                condition += &format!("{c}{rest}");
            }
            _ => break,
        }
    }
    Some(condition)
}

#[test]
fn every_other_acceptance_is_refused_as_such() {
    let (mut outside, mut inside) = (0, 0);
    for (name, text) in files() {
        let pieces = automata(&text);
        let items = hoa::read_stream(&text);
        if pieces.len() != items.len() {
            continue;
        }
        for (piece, item) in pieces.iter().zip(&items) {
            let Some(condition) = condition(piece) else { continue };
            let generalised_buchi =
                !condition.contains("Fin") && !condition.contains('|') && !condition.replace("Inf", "").contains('f');
            match item {
                StreamItem::Automaton(_) => {
                    inside += 1;
                    assert!(generalised_buchi, "{name}: {condition} was accepted");
                }
                StreamItem::Refused(error) if error.kind() == HoaErrorKind::Acceptance => {
                    outside += 1;
                    assert!(!generalised_buchi, "{name}: {condition} was refused: {error}");
                }
                _ => {}
            }
        }
    }
    println!("{inside} usable, {outside} refused for their acceptance");
    assert!(folder().is_none() || (inside > 400 && outside > 150));
}

#[test]
fn files_that_name_their_formula_accept_its_words() {
    let mut checked = 0;
    let budget = WordBudget { exhaustive: 600, random: 200, ..WordBudget::default() };
    for (name, text) in files().into_iter().filter(|(name, _)| name.starts_with("generated/")) {
        for item in hoa::read_stream(&text) {
            let StreamItem::Automaton(reading) = item else { continue };
            let Some(title) = &reading.name else { continue };
            let formula = title.strip_prefix("Automaton for ").unwrap_or(title);
            let Ok(formula) = Formula::parse(formula) else { continue };
            matches(&reading.automaton, &formula, budget).unwrap_or_else(|error| panic!("{name}, {title}: {error}"));
            checked += 1;
        }
    }
    println!("{checked} automata against their formulas");
    assert!(folder().is_none() || checked > 150, "{checked}");
}
