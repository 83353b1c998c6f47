//! Options, budgets and cancellation.

use super::words::{difference, random};
use ltl_rover::automaton::Ldgba;
use ltl_rover::automaton::translate::{Acceptance, Budget, TranslateErrorKind, TranslateOptions, translate, translate_unless};
use ltl_rover::ltl::Formula;
use std::cell::Cell;

fn live_states(automaton: &Ldgba) -> usize {
    automaton.states().filter(|q| !automaton.is_sink(*q)).count()
}

fn recurring(count: usize) -> Formula {
    let text: Vec<String> = (1..=count).map(|i| format!("G F v{i}")).collect();
    Formula::parse(&format!("{} & G !unsafe", text.join(" & "))).unwrap()
}

fn regions(count: usize, acceptance: Acceptance) -> TranslateOptions {
    let exclusive = vec![(1..=count).map(|i| format!("v{i}")).collect()];
    TranslateOptions { acceptance, exclusive, ..TranslateOptions::default() }
}

#[test]
fn disjoint_regions_give_the_form_of_the_paper() {
    for (count, states) in [(2, 3), (12, 13)] {
        let automaton = translate(&recurring(count), &regions(count, Acceptance::State)).unwrap();
        assert_eq!((live_states(&automaton), automaton.sets()), (states, count));
        let automaton = translate(&recurring(count), &regions(count, Acceptance::Transition)).unwrap();
        assert_eq!((live_states(&automaton), automaton.sets()), (1, count));
    }
    let both = Formula::parse("G F r1 & G F r2").unwrap();
    let states = |options: &TranslateOptions| translate(&both, options).unwrap().len();
    assert_eq!(states(&TranslateOptions { acceptance: Acceptance::State, ..TranslateOptions::default() }), 4);
}

#[test]
fn with_disjoint_regions_the_language_is_right_on_letters_that_can_occur() {
    let formula = Formula::parse("F (v1 & X (v2 U v3)) & G F (v1 & X v2)").unwrap();
    let automaton = translate(&formula, &regions(3, Acceptance::State)).unwrap();
    let words = random(3, 3000, 5).filter(|word| word.prefix.iter().chain(&word.cycle).all(|sigma| sigma.0.count_ones() <= 1));
    assert_eq!(difference(&automaton, &formula, words), None);
    let impossible = Formula::parse("F (v1 & v2)").unwrap();
    let automaton = translate(&impossible, &regions(2, Acceptance::Transition)).unwrap();
    assert!(automaton.is_sink(automaton.initial()));
}

#[test]
fn exclusive_groups_must_not_overlap() {
    let exclusive = vec![vec!["a".to_owned(), "b".to_owned()], vec!["b".to_owned(), "c".to_owned()]];
    let options = TranslateOptions { exclusive, ..TranslateOptions::default() };
    let error = translate(&Formula::parse("F a").unwrap(), &options).unwrap_err();
    assert_eq!(error.kind(), &TranslateErrorKind::Exclusive { name: "b".to_owned() });
}

#[test]
fn budgets_end_in_an_error_that_names_the_limit() {
    let hard = Formula::parse("G (a -> X X X X X X X b) U (G F (c <-> X X X X X d) | F G (a <-> X X X X c))").unwrap();
    let with = |budget| TranslateOptions { budget, ..TranslateOptions::default() };
    let states = translate(&hard, &with(Budget { states: 30, ..Budget::default() })).unwrap_err();
    assert_eq!(states.kind(), &TranslateErrorKind::States { limit: 30 });
    assert!(states.to_string().contains("more than the 30 states allowed"), "{states}");
    let nodes = translate(&hard, &with(Budget { nodes: 50, ..Budget::default() })).unwrap_err();
    assert_eq!(nodes.kind(), &TranslateErrorKind::Nodes { limit: 50 });
    assert!(nodes.subformula().is_some_and(|part| hard.propositions().iter().any(|name| part.contains(name))), "{nodes}");
    let steps = translate(&hard, &with(Budget { steps: 50, ..Budget::default() })).unwrap_err();
    assert_eq!(steps.kind(), &TranslateErrorKind::Steps { limit: 50 });
    let guesses = Formula::parse("(G F a | F G b) & (G F c | F G d)").unwrap();
    let guesses = translate(&guesses, &with(Budget { guesses: 1, ..Budget::default() })).unwrap_err();
    assert_eq!(guesses.kind(), &TranslateErrorKind::Guesses { found: 2, limit: 1 });
}

#[test]
fn the_caller_can_stop_it() {
    let asked = Cell::new(0);
    let hard = Formula::parse("(G F a <-> G F b) & (G F c <-> G F d) & (G F e <-> G F f)").unwrap();
    let cancelled = || {
        asked.set(asked.get() + 1);
        asked.get() > 3
    };
    let error = translate_unless(&hard, &TranslateOptions::default(), &cancelled).unwrap_err();
    assert_eq!(error.kind(), &TranslateErrorKind::Cancelled);
    assert_eq!(asked.get(), 4);
}
