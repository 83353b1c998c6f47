//! Reward and shaping: the paper's worked example, telescoping, and equality of optimal policies on finite MDPs.

use crate::finite::{Mdp, Product, automata, embedding, mdps, table};
use ltl_rover::automaton::{
    Cube, Edge, EmbeddedState, Embedding, FrontierRule, Gaps, Guard, Ldgba, LdgbaParts, Marks, StateSet, StateTracking,
};
use ltl_rover::env::Outcome;
use ltl_rover::labels::{Labels, Propositions};
use ltl_rover::product::{LdgbaReward, Payoff, ProductStep, Reward, RewardSettings, Shaping};
use proptest::prelude::*;
use std::sync::Arc;

const T1: Labels = Labels(1);
const T2: Labels = Labels(2);
const T3: Labels = Labels(4);
const U: Labels = Labels(8);

/// The automaton of Fig. 1, F (t1 & F (t2 & F t3)) & G !u: q0 … q3 and the sink q4. (The figure's q3 has no edge but `t3`; the
/// formula lets it stay as long as `u` does not hold.)
fn figure_1() -> Arc<Ldgba> {
    let guard = |positive: u64, negative: u64| Guard(vec![Cube { positive, negative }]);
    let to = |target, marks| Edge { target, marks: Marks(marks) };
    let mut edges = vec![];
    for q in 0..3_u16 {
        let wanted = 1 << q;
        let mark = u32::from(q == 2);
        edges.push(vec![(guard(wanted, U.0), to(q + 1, mark)), (guard(0, U.0 | wanted), to(q, 0)), (guard(U.0, 0), to(4, 0))]);
    }
    edges.push(vec![(guard(0, U.0), to(3, 1)), (guard(U.0, 0), to(4, 0))]);
    edges.push(vec![(guard(0, 0), to(4, 0))]);
    let propositions = Propositions::new(["t1", "t2", "t3", "u"]).unwrap();
    let parts = LdgbaParts { propositions, initial: 0, sets: 1, edges, epsilon: vec![], names: vec![] };
    Arc::new(Ldgba::new(parts, Gaps::Refuse).unwrap())
}

fn settings(shaping: Shaping) -> RewardSettings {
    RewardSettings { shaping, ..RewardSettings::default() }
}

/// The payoffs of a word whose first letter only chooses where to start.
fn payoffs(embedding: &Embedding, reward: &LdgbaReward, word: &[Labels]) -> Vec<Payoff> {
    let mut at = embedding.read(embedding.start(), word[0]).to;
    let pay = |&sigma: &Labels| {
        let step = ProductStep::read(embedding, at, sigma, Outcome::Running);
        at = step.to;
        reward.payoff(&step)
    };
    word[1..].iter().map(pay).collect()
}

#[test]
fn the_worked_example_of_the_paper() {
    let on = embedding(&figure_1(), FrontierRule::Refill, StateTracking::On);
    let reward = LdgbaReward::new(settings(Shaping::Paper { weight: 1.0 }), &on).unwrap();
    let (accepting, gamma, r_f) = (0.01_f32, 0.9999_f32, 0.99_f32);
    let empty = Labels::EMPTY;
    let found = payoffs(&on, &reward, &[empty, empty, T1, empty, T1, T2, T3, T3, U]);
    let expected = [
        (0.0, gamma),
        (gamma * accepting, gamma), // q0 → q1
        (0.0, gamma),
        (0.0, gamma),                       // q1 is no longer in T_Φ
        (gamma * accepting, gamma),         // q1 → q2
        (accepting + r_f * accepting, r_f), // q2 → q3: accepting, and a first visit
        (accepting, r_f),                   // q3 has left T_Φ, which B has just reset
        (0.0, 0.0),                         // the sink
    ];
    let expected: Vec<Payoff> = expected.map(|(reward, discount)| Payoff { reward, discount }).to_vec();
    assert_eq!(found, expected);
}

#[test]
fn parts_add_up_and_sinks_end() {
    let on = embedding(&figure_1(), FrontierRule::Refill, StateTracking::On);
    let numbers = RewardSettings { sink_reward: -0.5, ..settings(Shaping::Potential { weight: 2.0 }) };
    let reward = LdgbaReward::new(numbers, &on).unwrap();
    let at = on.read(on.start(), T1).to;
    let step = ProductStep::read(&on, at, U, Outcome::Running);
    let parts = reward.parts(&step);
    assert_eq!((parts.base, parts.sink, parts.discount, parts.potential_before), (0.0, -0.5, 0.0, 0.02));
    assert_eq!(parts.payoff(), Payoff { reward: -0.52, discount: 0.0 });
    // The environment's own end is a product sink as well, and may still be accepting.
    let q2 = on.read(at, T2).to;
    let last = ProductStep::read(&on, q2, T3, Outcome::Terminated);
    let parts = reward.parts(&last);
    assert!(last.ends() && !last.sink);
    assert_eq!((parts.base, parts.sink, parts.discount), (0.01, -0.5, 0.0));
}

#[test]
fn numbers_outside_their_range_are_refused() {
    let off = embedding(&figure_1(), FrontierRule::Refill, StateTracking::Off);
    let message = |change: fn(&mut RewardSettings)| {
        let mut numbers = settings(Shaping::None);
        change(&mut numbers);
        LdgbaReward::new(numbers, &off).map(|_| ()).unwrap_err().to_string()
    };
    assert!(message(|s| s.accepting_discount = 1.0).contains("accepting_discount = 1 is outside (0, 1)"));
    assert!(message(|s| s.discount = 0.0).contains("(0, 1]"));
    assert!(message(|s| s.discount = f64::NAN).contains("discount = NaN"));
    assert!(message(|s| s.sink_reward = f64::INFINITY).contains("sink_reward"));
    assert!(message(|s| s.shaping = Shaping::Paper { weight: -1.0 }).contains("weight"));
    assert!(message(|s| s.shaping = Shaping::Potential { weight: 1.0 }).contains("keep track"));
    assert!(LdgbaReward::new(settings(Shaping::None), &off).is_ok());
}

#[test]
fn the_printed_shaping_can_change_the_optimal_policy() {
    // Letter a closes the round at once; b leads through two more states first.
    let automaton = table(
        1,
        &[vec![(0, 0), (0, 1), (1, 0), (0, 0)], vec![(1, 0), (0, 1), (2, 0), (1, 0)], vec![(2, 0), (0, 1), (2, 0), (2, 0)]],
    );
    let mdp = Mdp {
        labels: vec![Labels(1), Labels(2)],
        transitions: vec![vec![vec![(0, 1.0)], vec![(1, 1.0)]], vec![vec![(0, 1.0)], vec![(1, 1.0)]]],
    };
    let on = embedding(&automaton, FrontierRule::Refill, StateTracking::On);
    let product = Product::new(&mdp, &on);
    let best = |shaping| {
        let numbers = RewardSettings { accepting_discount: 0.9, discount: 0.95, ..settings(shaping) };
        let reward = LdgbaReward::new(numbers, &on).unwrap();
        let q = product.solve(|step| reward.payoff(step));
        usize::from(q[0][1] > q[0][0])
    };
    assert_eq!(best(Shaping::None), 0);
    assert_eq!(best(Shaping::Potential { weight: 5.0 }), 0);
    assert_eq!(best(Shaping::Paper { weight: 5.0 }), 1, "Φ is paid and never paid back");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    /// Φ(x') of a step is Φ(x) of the next, bit for bit: the sum of γΦ(x') − Φ(x) telescopes, inside a round and beyond it.
    #[test]
    fn the_potential_telescopes(automaton in automata(), word in prop::collection::vec(0_u64..4, 2..40), weight in 0.0..10.0) {
        let on = embedding(&automaton, FrontierRule::Refill, StateTracking::On);
        let reward = LdgbaReward::new(settings(Shaping::Potential { weight }), &on).unwrap();
        let base = LdgbaReward::new(settings(Shaping::None), &on).unwrap();
        let mut at = on.read(on.start(), Labels(word[0])).to;
        let phi = |at: EmbeddedState| {
            let visited = (on.start().unvisited.len() - at.unvisited.len()) as f64;
            weight * (1.0 - 0.99) * visited
        };
        let (first, mut before, mut sum, mut weighting) = (phi(at), None, 0.0_f64, 1.0_f64);
        for &sigma in &word[1..] {
            let step = ProductStep::read(&on, at, Labels(sigma), Outcome::Running);
            at = step.to;
            let parts = reward.parts(&step);
            prop_assert!(before.is_none_or(|phi| phi == parts.potential_before));
            before = Some(parts.potential_after);
            let extra = f64::from(parts.payoff().reward) - f64::from(base.payoff(&step).reward);
            sum += weighting * extra;
            weighting *= f64::from(parts.discount);
        }
        prop_assert!((sum - (weighting * phi(at) - first)).abs() < 1e-4 * (1.0 + weight), "{sum}");
    }

    /// Q' = Q − Φ for all product states and actions, and a policy that is best for the shaped reward is best for the base one.
    #[test]
    fn the_potential_keeps_the_optimal_policies(automaton in automata(), mdp in mdps(2), weight in 0.0..5.0) {
        let on = embedding(&automaton, FrontierRule::Refill, StateTracking::On);
        let product = Product::new(&mdp, &on);
        let reward = |shaping| {
            let numbers = RewardSettings { accepting_discount: 0.8, discount: 0.9, sink_reward: -0.3, shaping };
            LdgbaReward::new(numbers, &on).unwrap()
        };
        let (base, shaped) = (reward(Shaping::None), reward(Shaping::Potential { weight }));
        let (q, q_shaped) = (product.solve(|s| base.payoff(s)), product.solve(|s| shaped.payoff(s)));
        for (x, (_, at)) in product.nodes.iter().enumerate() {
            let phi = weight * 0.2 * (on.start().unvisited.len() - at.unvisited.len()) as f64;
            for u in 0..2 {
                prop_assert!((q_shaped[x][u] + phi - q[x][u]).abs() < 1e-4, "{} + {phi} ≠ {}", q_shaped[x][u], q[x][u]);
            }
        }
        let greedy: Vec<usize> = q_shaped.iter().map(|row| usize::from(row[1] > row[0])).collect();
        let reached = product.evaluate(&greedy, |s| base.payoff(s));
        for (x, row) in q.iter().enumerate() {
            prop_assert!((reached[x] - row[0].max(row[1])).abs() < 1e-4);
        }
    }

    /// Without shaping: rewards are 0 or 1 − r_F, discounts γ_F or r_F, and returns stay within [0, 1].
    #[test]
    fn base_returns_lie_between_0_and_1(automaton in automata(), mdp in mdps(2)) {
        let off = embedding(&automaton, FrontierRule::Refill, StateTracking::Off);
        let numbers = RewardSettings { accepting_discount: 0.9, discount: 0.95, ..settings(Shaping::None) };
        let reward = LdgbaReward::new(numbers, &off).unwrap();
        let product = Product::new(&mdp, &off);
        for row in product.solve(|step| reward.payoff(step)) {
            prop_assert!(row.iter().all(|&q| (-1e-6..=1.0 + 1e-6).contains(&q)));
        }
        prop_assert!(StateSet::EMPTY == off.start().unvisited);
    }
}
