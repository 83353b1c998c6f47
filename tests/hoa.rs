//! The HOA reader on the project's own corpus (`specs/corpus/hoa`), on broken and random texts, and on formulas it is told to match.

use ltl_rover::automaton::hoa::{self, HoaErrorKind, StreamItem};
use ltl_rover::automaton::{Mismatch, WordBudget, matches, matches_where};
use ltl_rover::ltl::Formula;
use proptest::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};

fn corpus(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("specs/corpus/hoa").join(folder)
}

fn files(folder: &str) -> Vec<(String, String)> {
    let paths = fs::read_dir(corpus(folder)).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<(String, String)> = paths
        .filter(|path| path.extension().is_some_and(|extension| extension == "hoa"))
        .map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), fs::read_to_string(&path).unwrap()))
        .collect();
    files.sort();
    files
}

fn words(random: usize) -> WordBudget {
    WordBudget { exhaustive: 3_000, random, ..WordBudget::default() }
}

/// `/* states 2, sets 1, epsilon 0, formula a U b */`, or with `formula …, made 3` where states are added that are no sinks.
struct Expected {
    states: usize,
    sets: usize,
    epsilon: usize,
    formula: Formula,
    made: usize,
}

fn expected(text: &str) -> Expected {
    let comment = text.strip_prefix("/* ").and_then(|rest| rest.split_once(" */\n")).expect("a comment comes first").0;
    let (numbers, formula) = comment.split_once(", formula ").expect("the comment names a formula");
    let number = |name: &str| -> Option<usize> {
        numbers.split(", ").find_map(|part| part.strip_prefix(name)).map(|number| number.trim().parse().unwrap())
    };
    let (formula, made) = match formula.split_once(", made ") {
        Some((formula, made)) => (formula, made.parse().unwrap()),
        None => (formula, number("states").unwrap()),
    };
    Expected {
        states: number("states").unwrap(),
        sets: number("sets").unwrap(),
        epsilon: number("epsilon").unwrap(),
        formula: Formula::parse(formula).unwrap(),
        made,
    }
}

#[test]
fn good_files_give_the_automaton_they_describe() {
    let files = files("ok");
    assert!(files.len() >= 20);
    for (name, text) in files {
        let reading = hoa::read(&text).unwrap_or_else(|error| panic!("{name}: {error}\n{}", error.caret()));
        let (expected, automaton) = (expected(&text), &reading.automaton);
        let statistics = automaton.statistics();
        assert_eq!(reading.states, expected.states, "{name}: states of the file");
        assert_eq!((statistics.sets, statistics.epsilon), (expected.sets, expected.epsilon), "{name}: sets, ε-jumps");
        let added_sink = automaton.states().any(|q| automaton.name(q) == "sink");
        let empty = statistics.empty_language && statistics.states == 1;
        assert_eq!(statistics.states - usize::from(added_sink && !empty), expected.made, "{name}: states made");
        matches(automaton, &expected.formula, words(400)).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}

#[test]
fn bad_files_are_refused_at_their_place() {
    let table = fs::read_to_string(corpus("err").join("expected.tsv")).unwrap();
    let mut rows: Vec<&str> = table.lines().filter(|line| !line.starts_with('#')).collect();
    let files = files("err");
    assert!(files.len() >= 50 && files.len() == rows.len());
    for (name, text) in files {
        let position =
            rows.iter().position(|row| row.starts_with(&format!("{name}\t"))).unwrap_or_else(|| panic!("{name} has no row"));
        let row: Vec<&str> = rows.swap_remove(position).split('\t').collect();
        let error = hoa::read(&text).expect_err(&name);
        let found = format!("{} {}:{}", error.kind().code(), error.place().line, error.place().column);
        assert_eq!(found, format!("{} {}", row[1], row[2]), "{name}: {error}\n{}", error.caret());
        assert!(!error.message().is_empty() && error.caret().ends_with('^'), "{name}");
    }
}

#[test]
fn automata_of_regions_are_compared_on_letters_that_occur() {
    // Two regions that do not overlap, one state each: a state for both at once is missing on purpose.
    let text = "HOA: v1 States: 3 Start: 0 AP: 2 \"r1\" \"r2\" Acceptance: 2 Inf(0) & Inf(1) --BODY--
        State: 0 [!0&!1] 0 [0] 1 [!0&1] 2 State: 1 {0} [!0&!1] 0 [0] 1 [!0&1] 2 State: 2 {1} [!0&!1] 0 [0] 1 [!0&1] 2 --END--";
    let automaton = hoa::read(text).unwrap().automaton;
    let formula = Formula::parse("G F r1 & G F r2").unwrap();
    let found = matches(&automaton, &formula, words(100));
    assert!(matches!(found, Err(Mismatch::Word(word)) if word.text() == "cycle{{r1, r2}}"));
    let regions = [vec!["r2".to_owned(), "r1".to_owned(), "r3".to_owned()]];
    assert!(matches_where(&automaton, &formula, words(1000), &regions).is_ok());
    // What does not overlap in one group may overlap with another.
    let both = Formula::parse("G (r1 -> !x) & G F r1 & G F r2").unwrap();
    let found = matches_where(&automaton, &both, words(1000), &regions);
    assert!(matches!(found, Err(Mismatch::Word(word)) if word.text() == "cycle{{r1, x}; {r2}}"));
}

#[test]
fn limits_hold_without_hanging() {
    let many = |body: &str, count: usize| {
        let edges = body.repeat(count);
        format!("HOA: v1 States: 1 Start: 0 AP: 40 {} Acceptance: 0 t --BODY-- State: 0 {edges} --END--", names(40))
    };
    fn names(count: usize) -> String {
        (0..count).map(|i| format!("\"p{i}\" ")).collect()
    }
    // "An odd number of propositions hold": 2^39 cubes if written out.
    let nested = format!("HOA: v1 States: 1 Start: 0 AP: 40 {} Acceptance: 0 t --BODY-- State: 0 [{}] 0 --END--", names(40), {
        let aliases = 39;
        format!("@x{aliases}")
    });
    let aliases: String =
        (1..40).fold("Alias: @x0 0 ".to_owned(), |all, i| all + &format!("Alias: @x{i} {i}&!@x{}|!{i}&@x{} ", i - 1, i - 1));
    let kind = |text: &str| hoa::read(text).unwrap_err().kind();
    assert_eq!(kind(&nested.replace("Acceptance", &format!("{aliases} Acceptance"))), HoaErrorKind::TooComplex);
    assert_eq!(kind(&many("[0] 0 ", 1_000_001)), HoaErrorKind::Limit);
    assert_eq!(kind(&" ".repeat((16 << 20) + 1)), HoaErrorKind::Limit);
    assert_eq!(kind(&format!("HOA: v1 Acceptance: 1 {}Inf(0)", "(".repeat(100_000))), HoaErrorKind::Limit);
    assert_eq!(kind("HOA: v1 Start: 2147483647 Acceptance: 0 t --BODY-- --END--"), HoaErrorKind::Limit);
}

#[test]
fn choices_that_need_too_many_sets_are_refused() {
    // "The 24th letter from the end of the non-accepting part is a": 2^24 sets of states.
    let n = 24;
    let states: String = (1..=n).map(|i| format!("State: {i} [t] {} ", i + 1)).collect();
    let text = format!(
        "HOA: v1 States: {} Start: 0 AP: 2 \"a\" \"b\" Acceptance: 1 Inf(0) --BODY-- State: 0 [t] 0 [0] 1 {states}
         State: {} [1] {} [!1] 0 State: {} [t] {} {{0}} --END--",
        n + 3,
        n + 1,
        n + 2,
        n + 2,
        n + 2
    );
    assert_eq!(hoa::read(&text).unwrap_err().kind(), HoaErrorKind::TooComplex);
}

/// Whatever is read must be usable: every state has an edge for every letter, and drawing and writing work.
fn exercise(text: &str) {
    for item in hoa::read_stream(text) {
        if let StreamItem::Automaton(reading) = item {
            let automaton = reading.automaton.trimmed();
            for q in automaton.states() {
                automaton.edge(q, ltl_rover::labels::Labels(0x5555));
            }
            let written = hoa::write(&automaton, &hoa::WriteOptions::default()).unwrap();
            assert!(hoa::read(&written).is_ok(), "{written}");
            automaton.dot();
        }
    }
    if let Err(error) = hoa::read(text) {
        assert!(text.is_char_boundary(error.place().span.start) && text.is_char_boundary(error.place().span.end));
        error.caret();
    }
}

const PIECES: &[&str] = &[
    "HOA:",
    "v1",
    "States:",
    "Start:",
    "AP:",
    "Alias:",
    "@a",
    "Acceptance:",
    "Inf(0)",
    "Fin(0)",
    "&",
    "|",
    "!",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    "0",
    "1",
    "2",
    "t",
    "f",
    "\"a\"",
    "\"b\"",
    "acc-name:",
    "Buchi",
    "properties:",
    "deterministic",
    "--BODY--",
    "--END--",
    "--ABORT--",
    "State:",
    "/*",
    "*/",
    "\"",
    "x:",
    "\n",
    "é",
    "4000000000",
    "-",
    "#",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn random_bytes_do_no_harm(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        exercise(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn random_tokens_do_no_harm(tokens in proptest::collection::vec(0..PIECES.len(), 0..60), start in any::<bool>()) {
        let mut text = if start { "HOA: v1 Acceptance: 1 Inf(0) AP: 2 \"a\" \"b\" Start: 0 --BODY-- State: 0 ".to_owned() } else { String::new() };
        for token in tokens {
            text += PIECES[token];
            text.push(' ');
        }
        exercise(&text);
    }

    #[test]
    fn changed_files_do_no_harm(file in 0usize..1000, cuts in proptest::collection::vec((0usize..1 << 16, 0usize..12, 0..PIECES.len()), 1..4)) {
        let files = files("ok");
        let mut text = files[file % files.len()].1.clone();
        for (at, length, piece) in cuts {
            let boundary = |mut i: usize| { while !text.is_char_boundary(i) { i -= 1; } i };
            let start = boundary(at % (text.len() + 1));
            let end = boundary((start + length).min(text.len())).max(start);
            text.replace_range(start..end, PIECES[piece]);
        }
        exercise(&text);
    }
}
