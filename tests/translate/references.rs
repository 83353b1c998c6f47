//! Our automaton of φ against a reference automaton of ¬φ made by another tool: no word in common, decided exactly. And the sizes.

use ltl_rover::automaton::hoa::{StreamItem, read_stream};
use ltl_rover::automaton::translate::{TranslateOptions, translate};
use ltl_rover::automaton::{Gaps, Ldgba, LdgbaParts, common_word};
use ltl_rover::labels::Propositions;
use ltl_rover::ltl::Formula;
use std::fs;
use std::path::PathBuf;

/// A file of the collection beside the project, where it is there.
fn collected(path: &str) -> Option<String> {
    fs::read_to_string(PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/ltl").join(path)).ok()
}

/// The same automaton over an alphabet with `propositions` behind its own.
fn widened(automaton: &Ldgba, propositions: &Propositions) -> Ldgba {
    let parts = LdgbaParts {
        propositions: propositions.clone(),
        initial: automaton.initial(),
        sets: automaton.sets(),
        edges: automaton.states().map(|q| automaton.edges(q).to_vec()).collect(),
        epsilon: automaton.states().map(|q| automaton.epsilon(q).to_vec()).collect(),
        names: vec![],
    };
    Ldgba::new(parts, Gaps::Refuse).unwrap()
}

/// Checks one set and tells for how many formulas there is a reference that can be read.
fn disjoint_from_negations(set: &str) -> (usize, usize) {
    let (Some(formulas), Some(negations)) =
        (collected(&format!("formulas/{set}.txt")), collected(&format!("refs/{set}.neg.hoa")))
    else {
        return (0, 0);
    };
    let formulas: Vec<&str> = formulas.lines().filter(|line| !line.trim().is_empty()).collect();
    let negations: Vec<&str> = negations.split_inclusive("--END--").filter(|text| text.contains("HOA:")).collect();
    assert_eq!(formulas.len(), negations.len(), "{set}: one reference a formula");
    let mut compared = 0;
    for (text, negation) in formulas.iter().zip(negations) {
        // References that are not limit-deterministic cannot be read; the words of `language` cover those formulas.
        let Some(StreamItem::Automaton(negation)) = read_stream(negation).pop() else { continue };
        let own: Vec<String> = negation.automaton.propositions().iter().map(str::to_owned).collect();
        let options = TranslateOptions { propositions: own, ..TranslateOptions::default() };
        let automaton = translate(&Formula::parse(text).unwrap(), &options).unwrap_or_else(|e| panic!("{text}: {e}"));
        let negation = widened(&negation.automaton, automaton.propositions());
        let common = common_word(&automaton, &negation).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert_eq!(common, None, "{set}: {text}: accepted by the automaton and by the reference of its negation");
        compared += 1;
    }
    (compared, formulas.len())
}

#[test]
fn no_word_is_accepted_by_an_automaton_and_by_the_reference_of_the_negation() {
    let sets = ["dac-patterns", "eh-patterns", "hkrss-patterns", "p-patterns", "sb-patterns", "sejk-patterns", "paper-tasks"];
    let results = sets.map(disjoint_from_negations);
    let (compared, all) = results.iter().fold((0, 0), |sum, r| (sum.0 + r.0, sum.1 + r.1));
    assert!(3 * compared >= 2 * all, "only {compared} of {all} references can be read: {results:?}");
}

/// The pattern collections together have at most as many states as they had when this was written.
#[test]
fn the_pattern_collections_stay_small() {
    for (set, goal) in [
        ("dac-patterns", 278),
        ("hkrss-patterns", 196),
        ("parametrised", 320),
        ("eh-patterns", 40),
        ("sb-patterns", 84),
        ("p-patterns", 55),
        ("sejk-patterns", 13),
    ] {
        let Some(formulas) = collected(&format!("formulas/{set}.txt")) else { continue };
        let sizes = formulas.lines().filter(|line| !line.trim().is_empty()).map(|text| {
            let automaton = translate(&Formula::parse(text).unwrap(), &TranslateOptions::default()).unwrap();
            automaton.states().filter(|&q| !automaton.is_sink(q)).count().max(1)
        });
        let states: usize = sizes.sum();
        assert!(states <= goal, "{set}: {states} states, more than {goal}");
    }
}
