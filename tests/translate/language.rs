//! The automaton accepts exactly the words that satisfy the formula.

use super::words::{LENGTH, all, difference, random};
use ltl_rover::automaton::Ldgba;
use ltl_rover::automaton::translate::{Acceptance, Construction, TranslateOptions, translate};
use ltl_rover::ltl::{BinaryOperator as B, Formula, UnaryOperator as U};
use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;
use std::path::Path;

/// Formulas over two propositions.
fn formulas(depth: u32, size: u32) -> impl Strategy<Value = Formula> {
    let leaf = prop_oneof![
        1 => Just(Formula::True),
        9 => prop::sample::select(&["a", "b"][..]).prop_map(Formula::proposition),
    ];
    leaf.prop_recursive(depth, size, 2, |inner| {
        prop_oneof![
            (prop::sample::select(vec![U::Not, U::Next, U::Finally, U::Globally]), inner.clone())
                .prop_map(|(o, x)| Formula::unary(o, x)),
            (
                prop::sample::select(vec![
                    B::And,
                    B::Or,
                    B::Implies,
                    B::Iff,
                    B::Until,
                    B::Release,
                    B::WeakUntil,
                    B::StrongRelease
                ]),
                inner.clone(),
                inner
            )
                .prop_map(|(o, x, y)| Formula::binary(o, x, y)),
        ]
    })
}

fn options(acceptance: Acceptance) -> TranslateOptions {
    TranslateOptions { acceptance, propositions: vec!["a".into(), "b".into()], ..TranslateOptions::default() }
}

/// Letters on which an edge with different marks from others enters the same state.
fn is_state_based(automaton: &Ldgba) -> bool {
    let mut entered = vec![None; automaton.len()];
    automaton
        .states()
        .flat_map(|q| automaton.edges(q))
        .all(|(_, edge)| *entered[usize::from(edge.target)].get_or_insert(edge.marks) == edge.marks)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: if cfg!(debug_assertions) { 100 } else { 3000 },
        failure_persistence: Some(Box::new(FileFailurePersistence::Direct("tests/translate/regressions.txt"))),
        ..ProptestConfig::default()
    })]

    #[test]
    fn of_random_formulas(formula in formulas(5, 12)) {
        let automaton = translate(&formula, &options(Acceptance::Transition)).unwrap();
        prop_assert_eq!(difference(&automaton, &formula, all(2, LENGTH).chain(random(2, 200, 1))), None, "{}", formula);
        let again = translate(&formula, &options(Acceptance::Transition)).unwrap();
        prop_assert_eq!(automaton, again, "not the same automaton twice");
    }

    #[test]
    fn with_acceptance_on_states(formula in formulas(4, 8)) {
        let automaton = translate(&formula, &options(Acceptance::State)).unwrap();
        prop_assert!(is_state_based(&automaton), "{}", formula);
        prop_assert_eq!(difference(&automaton, &formula, all(2, LENGTH).chain(random(2, 100, 2))), None, "{}", formula);
    }
}

/// The formulas of a file of the shared collection, one a line.
fn shared(file: &str) -> Option<Vec<Formula>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/ltl/formulas").join(file);
    let text = std::fs::read_to_string(path).ok()?;
    Some(text.lines().filter(|line| !line.trim().is_empty()).map(|line| Formula::parse(line).unwrap()).collect())
}

/// Formulas on which a construction was wrong once, by each of them.
#[test]
fn of_formulas_that_were_wrong_once() {
    for text in [
        "G F (F (c ^ G (a <-> (c <-> F c))) <-> G c M b)",
        // A disjunction that is seen to be valid only when it is negated.
        "(F G a | G F !a) & F (b & X c)",
        "G (!b | (a U (F G a | F G c | G F !a)))",
    ] {
        let formula = Formula::parse(text).unwrap();
        for construction in [Construction::All, Construction::Symmetric, Construction::Split, Construction::Asymmetric] {
            let automaton = translate(&formula, &TranslateOptions { construction, ..TranslateOptions::default() }).unwrap();
            let words = all(3, 2).chain(random(3, 300, 6));
            assert_eq!(difference(&automaton, &formula, words), None, "{formula}, {construction:?}");
        }
    }
}

#[test]
fn of_collected_formulas() {
    let sets = [
        "dac-patterns",
        "eh-patterns",
        "hkrss-patterns",
        "p-patterns",
        "sb-patterns",
        "sejk-patterns",
        "paper-tasks",
        "parametrised",
        "sejk-families",
    ];
    for (i, formula) in sets.iter().flat_map(|set| shared(&format!("{set}.txt")).unwrap_or_default()).enumerate() {
        let both = [formula.negated(), formula];
        for formula in
            both.into_iter().skip(if cfg!(debug_assertions) { i % 2 } else { 0 }).take(if cfg!(debug_assertions) { 1 } else { 2 })
        {
            let automaton =
                translate(&formula, &TranslateOptions::default()).unwrap_or_else(|error| panic!("{formula}: {error}"));
            let propositions = automaton.propositions().len();
            let exhaustive = all(propositions, if propositions <= 2 { LENGTH } else { 0 });
            assert_eq!(difference(&automaton, &formula, exhaustive.chain(random(propositions, 40, 3))), None, "{formula}");
        }
    }
}
