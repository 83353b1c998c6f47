//! Families of formulas made by rules, and their negations: language, forms of output, the same automaton again.

use super::words::{LENGTH, all, difference, random};
use ltl_rover::automaton::hoa::{self, AcceptanceForm, EpsilonForm, WriteOptions};
use ltl_rover::automaton::translate::{Acceptance, Construction, Preference, TranslateOptions, translate};
use ltl_rover::automaton::{Ldgba, Letters, Matched, WordBudget, matches};
use ltl_rover::ltl::{Formula, families};

/// All members, and their negations.
fn members() -> impl Iterator<Item = Formula> {
    families::all().into_iter().flat_map(|family| family.formulas).flat_map(|formula| [formula.negated(), formula])
}

fn made(formula: &Formula, options: &TranslateOptions) -> Ldgba {
    translate(formula, options).unwrap_or_else(|error| panic!("{formula}: {error}"))
}

#[test]
fn accept_what_they_should() {
    for formula in members() {
        let automaton = made(&formula, &TranslateOptions::default());
        let propositions = automaton.propositions().len();
        // Letters are too many beyond some propositions.
        let length = [LENGTH, 1, 0][usize::from(propositions > 2) + usize::from(propositions > 8)];
        let short = all(propositions, length);
        let words = short.chain(random(propositions, 60, 1));
        assert_eq!(difference(&automaton, &formula, words), None, "{formula}");
        let budget = WordBudget { exhaustive: 200, random: 60, seed: 2 };
        let Matched { words, .. } = matches(&automaton, &formula, budget).unwrap_or_else(|error| panic!("{formula}: {error}"));
        assert!(words >= 60);
    }
}

#[test]
fn accept_it_however_they_are_made() {
    let by = |construction| TranslateOptions { construction, ..TranslateOptions::default() };
    for options in [
        by(Construction::Symmetric),
        by(Construction::Split),
        by(Construction::Asymmetric),
        TranslateOptions { prefer: Preference::Deterministic, ..TranslateOptions::default() },
        TranslateOptions { acceptance: Acceptance::State, ..TranslateOptions::default() },
    ] {
        for formula in members().step_by(if cfg!(debug_assertions) { 7 } else { 1 }) {
            // One construction alone may take more than the budget, or too much time here.
            if formula.propositions().len() > 8 {
                continue;
            }
            let Ok(automaton) = translate(&formula, &options) else { continue };
            if automaton.len() > 200 {
                continue;
            }
            let words = random(automaton.propositions().len(), 60, 3);
            assert_eq!(difference(&automaton, &formula, words), None, "{formula}, {options:?}");
        }
    }
}

#[test]
fn are_written_in_every_form_and_read_back() {
    for formula in members().step_by(if cfg!(debug_assertions) { 5 } else { 1 }) {
        let automaton = made(&formula, &TranslateOptions::default());
        // Where jumps are resolved, labels of so many propositions may be more than a reader takes.
        if automaton.len() > 60 || automaton.statistics().edges > 200 || automaton.propositions().len() > 12 {
            continue;
        }
        for epsilon in [EpsilonForm::Unlabelled, EpsilonForm::Resolved] {
            for acceptance in [AcceptanceForm::Transitions, AcceptanceForm::States(Letters::All)] {
                let text = hoa::write(&automaton, &WriteOptions { acceptance, epsilon, name: formula.to_string() }).unwrap();
                let again = hoa::read(&text).unwrap_or_else(|error| panic!("{formula}: {error}\n{text}"));
                assert_eq!(again.name.as_deref(), Some(&*formula.to_string()));
                let words = random(automaton.propositions().len(), 30, 4);
                assert_eq!(difference(&again.automaton, &formula, words), None, "{formula}, {epsilon:?}, {acceptance:?}");
            }
        }
    }
}

/// No automaton is larger than it was when this was written.
#[test]
fn stay_small() {
    for (name, goal) in SIZES {
        let family = families::all().into_iter().find(|family| family.name == *name).unwrap();
        let sizes = family.formulas.iter().map(|formula| {
            let automaton = made(formula, &TranslateOptions::default());
            automaton.states().filter(|&q| !automaton.is_sink(q)).count().max(1)
        });
        let states: usize = sizes.sum();
        assert!(states <= *goal, "{name}: {states} states, more than {goal}");
    }
}

/// Sums of states from which something is accepted.
const SIZES: &[(&str, usize)] = &[
    ("patterns in scopes", 47),
    ("recurrence", 39),
    ("fairness", 46),
    ("pairs", 26),
    ("chains", 128),
    ("visits in order", 70),
    ("delays", 112),
    ("nested promises", 40),
    ("many limits", 99),
];
