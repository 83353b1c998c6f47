//! The solvers on finite MDPs against brute force: end components by trying all sets of states, probabilities by trying all policies
//! without memory.

use ltl_rover::finite::{Arena, Mdp, MdpError, Transition, maximal_end_components, maximal_reachability};
use ltl_rover::labels::{Labels, Propositions};
use proptest::prelude::*;

/// A random arena of up to 5 states with up to 2 choices each.
fn arenas() -> impl Strategy<Value = Arena> {
    (1usize..6).prop_flat_map(|count| {
        let choice = proptest::collection::vec((0..count, 1u32..4), 1..4);
        let state = proptest::collection::vec(choice, 1..3);
        proptest::collection::vec(state, count).prop_map(|states| {
            let transitions = |list: Vec<(usize, u32)>| {
                let sum: u32 = list.iter().map(|(_, weight)| weight).sum();
                let one = |(target, weight): (usize, u32)| Transition {
                    target,
                    probability: f64::from(weight) / f64::from(sum),
                    marks: 1 << weight,
                };
                list.into_iter().map(one).collect()
            };
            let choices = states.into_iter().map(|list| list.into_iter().map(transitions).collect()).collect();
            Arena { initial: 0, choices }
        })
    })
}

/// The choices of `s` that stay in `set`.
fn staying(arena: &Arena, s: usize, set: &[usize]) -> Vec<usize> {
    (0..arena.choices[s].len()).filter(|c| arena.choices[s][*c].iter().all(|t| set.contains(&t.target))).collect()
}

/// Whether a set of states is an end component with all choices that stay in it.
fn is_end_component(arena: &Arena, set: &[usize]) -> bool {
    let reached = |from: usize| {
        let mut seen = vec![from];
        let mut next = 0;
        while next < seen.len() {
            for c in staying(arena, seen[next], set) {
                for t in &arena.choices[seen[next]][c] {
                    if !seen.contains(&t.target) {
                        seen.push(t.target);
                    }
                }
            }
            next += 1;
        }
        seen.len() == set.len()
    };
    !set.is_empty() && set.iter().all(|s| !staying(arena, *s, set).is_empty() && reached(*s))
}

/// Per state, the probability to reach a goal when choice `policy[s]` is taken in s: long iteration from below.
fn under(arena: &Arena, goal: &[bool], policy: &[usize]) -> Vec<f64> {
    let mut values: Vec<f64> = goal.iter().map(|g| f64::from(u8::from(*g))).collect();
    for _ in 0..4000 {
        for s in (0..arena.len()).filter(|s| !goal[*s]) {
            values[s] = arena.choices[s][policy[s]].iter().map(|t| t.probability * values[t.target]).sum();
        }
    }
    values
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn end_components_are_the_largest_sets_that_are_ones(arena in arenas()) {
        let sets: Vec<Vec<usize>> = (0..1u32 << arena.len())
            .map(|bits| (0..arena.len()).filter(|s| bits >> s & 1 == 1).collect::<Vec<_>>())
            .filter(|set| is_end_component(&arena, set))
            .collect();
        let maximal: Vec<&Vec<usize>> =
            sets.iter().filter(|set| !sets.iter().any(|other| other.len() > set.len() && set.iter().all(|s| other.contains(s)))).collect();
        let found = maximal_end_components(&arena, &|_, _| true);
        prop_assert_eq!(found.len(), maximal.len());
        for component in found {
            prop_assert!(maximal.contains(&&component.states));
            for (s, choices) in component.states.iter().zip(&component.choices) {
                prop_assert_eq!(choices, &staying(&arena, *s, &component.states));
            }
        }
    }

    #[test]
    fn bounds_enclose_the_best_policy(arena in arenas(), bits in any::<u32>()) {
        let goal: Vec<bool> = (0..arena.len()).map(|s| bits >> s & 1 == 1).collect();
        let bounds = maximal_reachability(&arena, &goal, 1e-9);
        let mut best = vec![0.0f64; arena.len()];
        for number in 0..1usize << arena.len() {
            let policy: Vec<usize> = (0..arena.len()).map(|s| (number >> s & 1).min(arena.choices[s].len() - 1)).collect();
            for (best, value) in best.iter_mut().zip(under(&arena, &goal, &policy)) {
                *best = best.max(value);
            }
        }
        for (interval, best) in bounds.iter().zip(best) {
            prop_assert!(interval.high - interval.low <= 1e-9 && interval.low <= best + 1e-7 && best <= interval.high + 1e-7, "{:?} {}", interval, best);
        }
    }
}

#[test]
fn value_iteration_from_below_would_stop_too_early_here() {
    // A loop that is left with probability 1e-6 a step: the goal is reached with probability 1, but slowly.
    let to = |target, probability| Transition { target, probability, marks: 0 };
    let arena = Arena { initial: 0, choices: vec![vec![vec![to(0, 1.0 - 1e-6), to(1, 1e-6)]], vec![vec![to(1, 1.0)]]] };
    let bounds = maximal_reachability(&arena, &[false, true], 1e-9);
    assert!(bounds[0].low > 1.0 - 1e-8);
}

#[test]
fn what_is_no_process_is_refused() {
    let ap = || Propositions::new(["a"]).unwrap();
    let make = |labels: Vec<u64>, choices| Mdp::new(ap(), 0, labels.into_iter().map(Labels).collect(), choices);
    assert!(make(vec![1], vec![vec![vec![(0, 1.0)]]]).is_ok());
    assert!(matches!(make(vec![], vec![]), Err(MdpError::Lengths { .. })));
    assert_eq!(make(vec![0], vec![vec![vec![(1, 1.0)]]]), Err(MdpError::NoSuchState { state: 1 }));
    assert_eq!(make(vec![0], vec![vec![]]), Err(MdpError::Deadlock { state: 0 }));
    assert_eq!(make(vec![2], vec![vec![vec![(0, 1.0)]]]), Err(MdpError::NoSuchProposition { state: 0 }));
    assert!(matches!(make(vec![0], vec![vec![vec![(0, 0.9)]]]), Err(MdpError::Probabilities { state: 0, choice: 0, .. })));
    assert!(matches!(make(vec![0], vec![vec![vec![(0, f64::NAN)]]]), Err(MdpError::Probabilities { .. })));
}
