//! Formulas that nobody would write: large ones end in time, strange options and small budgets do no harm.

use super::words::{difference, random};
use ltl_rover::automaton::translate::{
    Acceptance, Budget, Preference, TranslateErrorKind, TranslateOptions, translate, translate_unless,
};
use ltl_rover::ltl::{BinaryOperator, Formula, UnaryOperator};
use ltl_rover::rng::{Purpose, Rng};
use std::cell::Cell;

/// A random formula with exactly `size` operators over the first `names` letters of the alphabet.
fn formula(size: usize, names: usize, rng: &mut Rng) -> Formula {
    use BinaryOperator::*;
    use UnaryOperator::*;
    if size == 0 {
        return Formula::proposition(["a", "b", "c", "d"][rng.below(names)]);
    }
    if rng.chance(0.45) {
        return Formula::unary([Not, Next, Finally, Globally][rng.below(4)], formula(size - 1, names, rng));
    }
    let left = rng.below(size);
    let operator = [And, Or, Implies, Iff, Xor, Until, Release, WeakUntil, StrongRelease][rng.below(9)];
    Formula::binary(operator, formula(left, names, rng), formula(size - 1 - left, names, rng))
}

/// Many in an optimised build, some otherwise.
fn many(optimised: usize) -> usize {
    if cfg!(debug_assertions) { optimised / 20 } else { optimised }
}

#[test]
fn formulas_of_size_25_end_with_an_automaton_or_with_the_budgets_message() {
    let mut rng = Rng::new(25, Purpose::Tool);
    let budget =
        Budget { states: 4_000, nodes: 100_000, steps: if cfg!(debug_assertions) { 60_000 } else { 500_000 }, guesses: 8 };
    let (mut made, mut refused) = (0, 0);
    for _ in 0..many(1000) {
        let formula = formula(25, 3, &mut rng);
        match translate(&formula, &TranslateOptions { budget, ..TranslateOptions::default() }) {
            Ok(automaton) => {
                made += 1;
                let words = random(automaton.propositions().len(), if automaton.len() < 300 { 40 } else { 4 }, made);
                assert_eq!(difference(&automaton, &formula, words), None, "{formula}");
            }
            Err(error) => {
                refused += 1;
                let known = matches!(
                    error.kind(),
                    TranslateErrorKind::States { .. }
                        | TranslateErrorKind::Nodes { .. }
                        | TranslateErrorKind::Steps { .. }
                        | TranslateErrorKind::Guesses { .. }
                );
                assert!(known && error.to_string().contains("allowed"), "{formula}: {error}");
            }
        }
    }
    println!("{made} translated, {refused} refused");
    assert!(made > refused, "{made} translated, {refused} refused");
}

#[test]
fn strange_options_small_budgets_and_cancellation_do_no_harm() {
    let mut rng = Rng::new(26, Purpose::Tool);
    let (mut made, mut refused) = (0, 0);
    for _ in 0..many(6000) {
        let (size, names) = (rng.below(16), 1 + rng.below(4));
        let formula = formula(size, names, &mut rng);
        let names = ["a", "b", "c", "d", "e"];
        let mut list = |most: usize| (0..rng.below(most)).map(|_| names[rng.below(5)].to_owned()).collect::<Vec<_>>();
        let (exclusive, propositions) = (vec![list(4), list(3)], list(3));
        let limit = |rng: &mut Rng| 1usize << rng.below(15);
        let options = TranslateOptions {
            acceptance: if rng.chance(0.5) { Acceptance::State } else { Acceptance::Transition },
            prefer: if rng.chance(0.5) { Preference::Deterministic } else { Preference::Smallest },
            exclusive: if rng.chance(0.5) { exclusive } else { vec![] },
            propositions: if rng.chance(0.2) { propositions } else { vec![] },
            budget: Budget {
                states: limit(&mut rng),
                nodes: limit(&mut rng),
                steps: limit(&mut rng) as u64,
                guesses: rng.below(9),
            },
            ..TranslateOptions::default()
        };
        let (patience, asked) = (limit(&mut rng), Cell::new(0));
        let cancelled = || {
            asked.set(asked.get() + 1);
            asked.get() > patience
        };
        match translate_unless(&formula, &options, &cancelled) {
            Ok(automaton) => {
                made += 1;
                let apart = |sigma: u64| {
                    let holds = |name: &String| automaton.propositions().index(name).is_some_and(|i| sigma >> i & 1 == 1);
                    options.exclusive.iter().all(|group| group.iter().filter(|name| holds(name)).count() <= 1)
                };
                let words = random(automaton.propositions().len(), 30, made)
                    .filter(|word| word.prefix.iter().chain(&word.cycle).all(|sigma| apart(sigma.0)));
                assert_eq!(difference(&automaton, &formula, words), None, "{formula}, {options:?}");
            }
            Err(error) => {
                refused += 1;
                assert!(!error.to_string().is_empty());
            }
        }
    }
    assert!(made > 30 && refused > 30, "{made} translated, {refused} refused");
}
