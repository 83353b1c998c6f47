//! f_V, f_Φ and rounds: Lemma 1 for `Refill`, its failure for `Printed`, acceptance by frontier.

use crate::finite::{Product, automata, embedding, mdps, table};
use ltl_rover::automaton::{EmbeddedState, Embedding, FrontierRule, Ldgba, Marks, StateSet, StateTracking};
use ltl_rover::labels::Labels;
use ltl_rover::ltl::Lasso;
use ltl_rover::product::Rounds;
use proptest::prelude::*;
use std::sync::Arc;

/// GF a & GF b as one state per last visit: letters ∅, a, b, ab; ab counts for both.
pub fn two_sets() -> Arc<Ldgba> {
    let row = vec![(0, 0), (1, 0b01), (2, 0b10), (1, 0b11)];
    table(2, &[row.clone(), row.clone(), row])
}

/// GF a.
fn one_set() -> Arc<Ldgba> {
    table(1, &[vec![(0, 0), (0, 1), (0, 0), (0, 1)]])
}

/// Reads letters from the start and returns fresh marks and B of each.
fn visits(embedding: &Embedding, word: &[u64]) -> Vec<(u32, bool)> {
    let mut at = embedding.start();
    let visit = |&sigma: &u64| {
        let succession = embedding.read(at, Labels(sigma));
        at = succession.to;
        (succession.fresh.0, succession.refilled)
    };
    word.iter().map(visit).collect()
}

#[test]
fn refill_rewards_every_visit_that_goes_on() {
    let two = embedding(&two_sets(), FrontierRule::Refill, StateTracking::Off);
    let expected = [(0, false), (1, false), (0, false), (2, true), (1, true), (2, true), (0, false), (1, true)];
    assert_eq!(visits(&two, &[0, 1, 1, 2, 1, 2, 2, 1]), expected);
    let one = embedding(&one_set(), FrontierRule::Refill, StateTracking::Off);
    assert_eq!(visits(&one, &[1, 0, 1, 1]), [(1, true), (0, false), (1, true), (1, true)]);
}

#[test]
fn printed_follows_equation_1_and_loses_the_first_set() {
    let two = embedding(&two_sets(), FrontierRule::Printed, StateTracking::Off);
    // After the first round T = ∅; the visit to 1 refills without reward, so that 1 is never accepting again.
    let expected = [(1, false), (2, false), (0, true), (2, false), (0, true), (2, false), (0, true), (2, false)];
    assert_eq!(visits(&two, &[1, 2, 1, 2, 1, 2, 1, 2]), expected);
    let one = embedding(&one_set(), FrontierRule::Printed, StateTracking::Off);
    let found = visits(&one, &[1; 100]);
    assert_eq!(found[0], (1, false));
    assert!(found[1..].iter().all(|&visit| visit == (0, true)), "one set is rewarded once ever");
}

#[test]
fn standard_has_no_memory() {
    let two = embedding(&two_sets(), FrontierRule::Standard, StateTracking::Off);
    assert_eq!(visits(&two, &[1, 1, 0, 3, 2]), [(1, true), (1, true), (0, false), (3, true), (2, true)]);
}

#[test]
fn a_visit_to_several_sets_takes_all_of_them_out() {
    for rule in [FrontierRule::Refill, FrontierRule::Printed] {
        let two = embedding(&two_sets(), rule, StateTracking::Off);
        let once = two.read(two.start(), Labels(3));
        assert_eq!(once.fresh, Marks(3));
        let left = if rule == FrontierRule::Refill { Marks(3) } else { Marks(0) };
        assert_eq!((once.to.frontier, once.refilled), (left, rule == FrontierRule::Refill));
        // With 0 already taken, the visit to both is fresh for 1 only.
        let after = two.read(two.read(two.start(), Labels(1)).to, Labels(3));
        assert_eq!(after.fresh, Marks(2));
    }
}

#[test]
fn lemma_1_fails_for_printed_and_for_standard() {
    // A chain that alternates between a and b for ever.
    let chain =
        crate::finite::Mdp { labels: vec![Labels(1), Labels(2)], transitions: vec![vec![vec![(1, 1.0)]], vec![vec![(0, 1.0)]]] };
    let fresh = |rule| {
        let product = Product::new(&chain, &embedding(&two_sets(), rule, StateTracking::Off));
        let classes = product.recurrent_classes();
        assert_eq!(classes.len(), 1);
        product.marks(&classes[0], |step| step.fresh)
    };
    assert_eq!(fresh(FrontierRule::Refill), Marks(3));
    assert_eq!(fresh(FrontierRule::Printed), Marks(2), "F_1^P is transient although the run is accepted");
    // Without a frontier, a run that is not accepted is rewarded for ever.
    let stuck = crate::finite::Mdp { labels: vec![Labels(1)], transitions: vec![vec![vec![(0, 1.0)]]] };
    let product = Product::new(&stuck, &embedding(&two_sets(), FrontierRule::Standard, StateTracking::Off));
    assert_eq!(product.marks(&product.recurrent_classes()[0], |step| step.fresh), Marks(1));
}

#[test]
fn overlapping_sets_are_all_met_again_and_again() {
    // Visits to {F_0, F_2} and {F_0, F_1} in turn: were F_0 left out of T whenever it is visited, it would never be in T.
    let overlap = table(3, &[vec![(0, 0), (0, 0b101), (0, 0b011), (0, 0)]]);
    let refill = embedding(&overlap, FrontierRule::Refill, StateTracking::Off);
    let found = visits(&refill, &[1, 2, 1, 2, 1, 2]);
    assert_eq!(found, [(0b101, false), (0b010, true), (0b101, true), (0b010, true), (0b101, true), (0b010, true)]);
}

#[test]
fn rounds_are_counted_apart_from_the_frontier() {
    let word = [1, 2, 1, 2, 1, 1, 2, 0, 2, 1, 3, 3];
    for (rule, times_refilled) in [(FrontierRule::Refill, 8), (FrontierRule::Printed, 5), (FrontierRule::Standard, 11)] {
        let two = embedding(&two_sets(), rule, StateTracking::Off);
        let (mut at, mut rounds, mut refilled, mut ends) = (two.start(), Rounds::new(Marks(3)), 0, vec![]);
        for (i, &sigma) in word.iter().enumerate() {
            let succession = two.read(at, Labels(sigma));
            at = succession.to;
            refilled += usize::from(succession.refilled);
            if rounds.visit(succession.visited) {
                ends.push(i);
            }
        }
        // 1,2 | 1,2 | 1,1,2 | 0,2,1 | 3 | 3: the same for every rule, and no visit counts for two rounds.
        assert_eq!(ends, [1, 3, 6, 9, 10, 11]);
        assert_eq!(rounds.completed(), 6);
        assert_eq!(refilled, times_refilled, "{rule:?}");
    }
}

#[test]
fn the_automaton_frontier_is_reset_with_the_round() {
    // 0 -a-> 1 -b-> 2 (accepting) -a-> 1; state 3 is a sink, entered by both letters together.
    let rows = [
        vec![(0, 0), (1, 0), (0, 0), (3, 0)],
        vec![(1, 0), (1, 0), (2, 1), (3, 0)],
        vec![(2, 0), (1, 0), (2, 0), (3, 0)],
        vec![(3, 0); 4],
    ];
    let automaton = table(1, &rows);
    assert!(automaton.is_sink(3));
    let on = embedding(&automaton, FrontierRule::Refill, StateTracking::On);
    let set = |states: &[u16]| states.iter().fold(StateSet::EMPTY, |set, &q| set.with(q));
    assert_eq!(on.start().unvisited, set(&[1, 2]), "Q without q0 and the sink");
    let mut at: EmbeddedState = on.start();
    for (sigma, left) in [(1, vec![2]), (1, vec![2]), (2, vec![1]), (1, vec![]), (0, vec![]), (2, vec![1]), (3, vec![1])] {
        at = on.read(at, Labels(sigma)).to;
        assert_eq!(at.unvisited, set(&left), "after {sigma}");
    }
}

#[test]
fn state_sets_hold_256_states_and_bigger_automata_are_refused_only_where_needed() {
    let all = (0..256).fold(StateSet::EMPTY, StateSet::with);
    assert_eq!(all.len(), 256);
    assert_eq!(all.without(255).iter().last(), Some(254));
    assert!(!all.contains(256) && all.contains(64) && !all.without(64).contains(64));
    assert_eq!(all.without(300), all);
    let rows: Vec<_> = (0..300_u16).map(|q| vec![((q + 1) % 300, 1); 4]).collect();
    let long = table(1, &rows);
    let error = Embedding::new(long.clone(), FrontierRule::Refill, StateTracking::On).unwrap_err();
    assert!(error.to_string().contains("300 states"), "{error}");
    let without = Embedding::new(long, FrontierRule::Refill, StateTracking::Off).unwrap();
    assert_eq!(without.reachable(1_000).unwrap().len(), 300);
    assert_eq!(without.reachable(299), None);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// Lemma 1: a recurrent class meets every F_i^P or none of them; and it meets them exactly if its runs are accepted.
    #[test]
    fn lemma_1_holds_for_refill(automaton in automata(), chain in mdps(2), tracked in any::<bool>()) {
        let tracking = if tracked { StateTracking::On } else { StateTracking::Off };
        let product = Product::new(&chain, &embedding(&automaton, FrontierRule::Refill, tracking));
        for class in product.recurrent_classes() {
            let fresh = product.marks(&class, |step| step.fresh);
            let visited = product.marks(&class, |step| step.visited);
            let all = automaton.all_sets();
            prop_assert!(fresh == all || fresh == Marks(0), "{fresh:?} of {all:?}");
            prop_assert_eq!(fresh == all, visited == all);
        }
    }

    /// On a single word: rewards go on for ever, and rounds are completed for ever, exactly if the word is accepted.
    #[test]
    fn a_word_is_accepted_exactly_if_refill_rewards_it_for_ever(
        automaton in automata(),
        prefix in prop::collection::vec(0_u64..4, 0..4),
        cycle in prop::collection::vec(0_u64..4, 1..5),
    ) {
        let word = Lasso { prefix: prefix.into_iter().map(Labels).collect(), cycle: cycle.into_iter().map(Labels).collect() };
        let refill = embedding(&automaton, FrontierRule::Refill, StateTracking::Off);
        let (mut at, mut rounds) = (refill.start(), Rounds::new(automaton.all_sets()));
        let letters = word.prefix.iter().chain(word.cycle.iter().cycle());
        // 4 states × 4 positions × 7 frontiers bound the time until everything repeats; watch twice that long after it.
        let mut late = (0, 0);
        for (i, &sigma) in letters.take(400).enumerate() {
            let succession = refill.read(at, sigma);
            at = succession.to;
            let closes = rounds.visit(succession.visited);
            if i >= 150 {
                late.0 += u32::from(succession.fresh.0 != 0);
                late.1 += u32::from(closes);
            }
        }
        prop_assert_eq!(late.0 > 0, automaton.accepts(&word));
        prop_assert_eq!(late.1 > 0, automaton.accepts(&word));
    }

    /// T is never empty under `Refill`, and both frontiers stay within what they track.
    #[test]
    fn frontiers_stay_in_range(automaton in automata(), rule in 0..3, word in prop::collection::vec(0_u64..4, 0..60)) {
        let rule = [FrontierRule::Refill, FrontierRule::Printed, FrontierRule::Standard][rule as usize];
        let embedding = embedding(&automaton, rule, StateTracking::On);
        let reachable = embedding.reachable(100_000).unwrap();
        let mut at = embedding.start();
        for sigma in word {
            let next = embedding.read(at, Labels(sigma));
            prop_assert_eq!(next.fresh.0 & !next.visited.0, 0);
            prop_assert_eq!(next.fresh.0 & !at.frontier.0, 0);
            at = next.to;
            prop_assert!(at.frontier.0 != 0 || rule == FrontierRule::Printed);
            prop_assert_eq!(at.frontier.0 & !automaton.all_sets().0, 0);
            prop_assert!(!at.unvisited.contains(at.q));
            prop_assert!(reachable.binary_search(&at).is_ok());
        }
    }
}
