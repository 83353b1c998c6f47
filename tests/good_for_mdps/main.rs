//! Are our automata good for MDPs? The maximal probability through a translated automaton must be that through a deterministic one
//! that shares nothing with the translator: a tableau for the formula, made deterministic by Safra's construction, with Rabin acceptance.

mod safra;
mod tableau;

use ltl_rover::automaton::hoa::{self, EpsilonForm, WriteOptions};
use ltl_rover::automaton::translate::{Construction, TranslateOptions, translate};
use ltl_rover::finite::{Interval, Mdp, maximal_probability};
use ltl_rover::labels::{Labels, Propositions};
use ltl_rover::ltl::{BinaryOperator, Formula, UnaryOperator};
use ltl_rover::rng::{Purpose, Rng};

const PRECISION: f64 = 1e-8;

fn propositions() -> Propositions {
    Propositions::new(["a", "b"]).unwrap()
}

/// A random MDP of 3 to 6 states; labels and probabilities are drawn, most choices lead to two or three states. In most of them
/// choices mostly lead to later states, so that chances do not come back and probabilities other than 0 and 1 arise.
fn random_mdp(rng: &mut Rng) -> Mdp {
    let count = 3 + rng.below(4);
    let onward = rng.chance(0.7);
    let most = 1 + rng.below(3);
    let labels = (0..count).map(|_| Labels(rng.below(4) as u64)).collect();
    let distribution = |from: usize, rng: &mut Rng| {
        let mut weights = vec![0u32; count];
        for _ in 0..1 + rng.below(4) {
            let first = if onward && rng.chance(0.97) { from } else { 0 };
            weights[first + rng.below(count - first)] += 1 + rng.below(3) as u32;
        }
        let sum: u32 = weights.iter().sum();
        let positive = weights.into_iter().enumerate().filter(|(_, w)| *w > 0);
        positive.map(|(to, w)| (to, f64::from(w) / f64::from(sum))).collect::<Vec<_>>()
    };
    let choices = (0..count).map(|s| (0..1 + rng.below(most)).map(|_| distribution(s, rng)).collect()).collect();
    Mdp::new(propositions(), if onward { 0 } else { rng.below(count) }, labels, choices).unwrap()
}

/// A random formula over a and b with at most `size` operators.
fn random_formula(size: usize, rng: &mut Rng) -> Formula {
    use BinaryOperator::*;
    use UnaryOperator::*;
    if size == 0 {
        let name = Formula::proposition(["a", "b"][rng.below(2)]);
        return if rng.chance(0.3) { name.negated() } else { name };
    }
    match rng.below(10) {
        0..=4 => Formula::unary([Not, Next, Finally, Globally, Finally, Globally][rng.below(6)], random_formula(size - 1, rng)),
        _ => {
            let left = rng.below(size);
            let operator = [And, Or, Until, Release, WeakUntil, And, Or, Implies][rng.below(8)];
            Formula::binary(operator, random_formula(left, rng), random_formula(size - 1 - left, rng))
        }
    }
}

/// The maximal probability by the deterministic route; `None` if its construction takes too much.
fn reference(formula: &Formula, mdp: &Mdp) -> Option<Interval> {
    let automaton = tableau::automaton(formula)?;
    safra::maximal_probability(&automaton, mdp, PRECISION)
}

/// How many pairs were compared, and how many needed jumps.
#[derive(Default, Debug)]
struct Tally {
    compared: usize,
    with_jumps: usize,
    strictly_between: usize,
}

fn compare(formula: &Formula, mdps: usize, tally: &mut Tally, rng: &mut Rng) {
    compare_by(Construction::All, formula, mdps, tally, rng);
}

fn by(construction: Construction) -> TranslateOptions {
    TranslateOptions { construction, ..TranslateOptions::default() }
}

fn compare_by(construction: Construction, formula: &Formula, mdps: usize, tally: &mut Tally, rng: &mut Rng) {
    let Ok(automaton) = translate(formula, &by(construction)) else { return };
    for _ in 0..mdps {
        let mdp = random_mdp(rng);
        let Some(expected) = reference(formula, &mdp) else { return };
        let named = maximal_probability(&mdp, &automaton, PRECISION).unwrap();
        assert!(
            (named.middle() - expected.middle()).abs() < 1e-6,
            "{construction:?}, {formula}: {named:?} by the automaton, {expected:?} by the deterministic route\n{mdp:?}\n{}",
            automaton.dot()
        );
        tally.compared += 1;
        tally.with_jumps += usize::from(!automaton.statistics().deterministic);
        tally.strictly_between += usize::from(expected.low > 1e-6 && expected.high < 1.0 - 1e-6);
    }
}

#[test]
fn random_formulas_lose_no_probability() {
    let mut rng = Rng::new(1, Purpose::Tool);
    let mut tally = Tally::default();
    for _ in 0..160 {
        let formula = random_formula(1 + rng.below(6), &mut rng);
        compare(&formula, 5, &mut tally, &mut rng);
    }
    println!("{tally:?}");
    assert!(tally.compared >= 600 && tally.strictly_between >= 40, "{tally:?}");
}

#[test]
fn formulas_that_need_jumps_lose_no_probability() {
    let mut rng = Rng::new(2, Purpose::Tool);
    let mut tally = Tally::default();
    for text in WITH_JUMPS {
        compare(&Formula::parse(text).unwrap(), 30, &mut tally, &mut rng);
    }
    println!("{tally:?}");
    assert!(tally.compared >= 400 && tally.with_jumps >= 300 && tally.strictly_between >= 20, "{tally:?}");
}

/// Formulas whose smallest automaton needs jumps.
const WITH_JUMPS: [&str; 14] = [
    "F G a",
    "F (a & G b)",
    "F G a | F G b",
    "F G a & G F b",
    "a & X (F G a | F G b)",
    "F (a & X G (a | b))",
    "F G (a | X b)",
    "(F G a) | (G F b)",
    "F (G a | G b)",
    "F (b & F G a)",
    "G F a -> G F b",
    "F G (a -> X b) | G F (a & b)",
    "(a U G b) | F G a",
    "F (a & X (b U G a))",
];

/// Suffix-invariant formulas are not unfolded before a jump; with many of them pieces are tried first.
#[test]
fn what_forgets_every_prefix_loses_no_probability() {
    let mut rng = Rng::new(5, Purpose::Tool);
    let mut tally = Tally::default();
    for text in SUFFIX_INVARIANT {
        let formula = Formula::parse(text).unwrap();
        for construction in [Construction::All, Construction::Symmetric, Construction::Split, Construction::Asymmetric] {
            compare_by(construction, &formula, 8, &mut tally, &mut rng);
        }
    }
    println!("{tally:?}");
    assert!(tally.compared >= 400 && tally.with_jumps >= 300 && tally.strictly_between >= 20, "{tally:?}");
}

const SUFFIX_INVARIANT: [&str; 16] = [
    "F G a | F G b | F (!a & X !b)",
    "F G a | F G !a | F G b | F G !b | F G (a <-> b) | F G (a ^ b)",
    "F G a | F G !a | F G b | F G !b | F G (a <-> b) | F G (a ^ b) | F (a & X (a & b))",
    "F G (a -> X b) | F G (b -> X a) | F G (a -> X !b)",
    "(F G a | F G b) & G (a | X b)",
    "a U (F G a | F G b)",
    "b & X (a U (F G a & G F b | F G !a))",
    "F G a & G F b | F G !a & G F b | F G b & G F a",
    "G F a & G F !a -> G F (a & b) & G F (a & !b)",
    "(G F a -> G F b) & (G F !a -> G F (a ^ b))",
    "(F G a | G a & F b) W b",
    "G (a | F G b) | F (b & G a)",
    "G (a -> F G b | F (a & b))",
    "F (G a & G (b | X a)) | F (G b | G !a)",
    "(G F a & F a | b) U (G b | F G b)",
    "F G (a | F G b) | X (G b & F G a)",
];

/// Each construction by itself, not only where its result is the smallest.
#[test]
fn no_construction_loses_probability() {
    for construction in [Construction::Symmetric, Construction::Split, Construction::Asymmetric] {
        let mut rng = Rng::new(4, Purpose::Tool);
        let mut tally = Tally::default();
        for text in WITH_JUMPS {
            compare_by(construction, &Formula::parse(text).unwrap(), 12, &mut tally, &mut rng);
        }
        for text in [
            "F G ((a W b) | X !a)",
            "F G ((a W b) | (b W X a))",
            "F (G (a | X b) | G (b | X a))",
            "G F a & F (G b | G (a W X b))",
        ] {
            compare_by(construction, &Formula::parse(text).unwrap(), 20, &mut tally, &mut rng);
        }
        for _ in 0..60 {
            // What must hold from some time on is where guesses are made.
            let inner = random_formula(1 + rng.below(5), &mut rng);
            let formula = Formula::unary(UnaryOperator::Finally, Formula::unary(UnaryOperator::Globally, inner));
            compare_by(construction, &formula, 4, &mut tally, &mut rng);
        }
        println!("{construction:?}: {tally:?}");
        assert!(tally.compared >= 350 && tally.with_jumps >= 150, "{construction:?}: {tally:?}");
    }
}

/// A chain that never stops: at odd times it decides about `b` or `d`, at even times about `f` or `h`, and between them `a`, `c` or `e`, `g` hold. One
/// who must say beforehand how the next decision but one falls is wrong half of the time.
#[test]
fn nothing_is_guessed_that_hangs_on_chance() {
    let names = Propositions::new(["a", "b", "c", "d", "e", "f", "g", "h"]).unwrap();
    let letter = |text: &str| text.chars().fold(Labels(0), |sigma, c| sigma.with(c as usize - 'a' as usize, true));
    let labels = ["egb", "egd", "acf", "ach"].map(letter).to_vec();
    let (even, odd) = (vec![(0, 0.5), (1, 0.5)], vec![(2, 0.5), (3, 0.5)]);
    let mdp = Mdp::new(names, 0, labels, vec![vec![odd.clone()], vec![odd], vec![even.clone()], vec![even]]).unwrap();
    let formula = Formula::parse("F G ((a W b | c W d) & (e W f | g W h))").unwrap();
    for construction in [Construction::All, Construction::Symmetric, Construction::Split, Construction::Asymmetric] {
        let automaton = translate(&formula, &by(construction)).unwrap();
        let value = maximal_probability(&mdp, &automaton, PRECISION).unwrap();
        assert!(value.middle() > 1.0 - 1e-6, "{construction:?}: {value:?}");
    }
}

#[test]
fn reading_resolved_jumps_back_loses_no_probability() {
    let mut rng = Rng::new(3, Purpose::Tool);
    let resolved = WriteOptions { epsilon: EpsilonForm::Resolved, ..WriteOptions::default() };
    for text in
        ["F G a", "F (a & G b)", "F G a | F G b", "a & X (F G a | F G b)", "F (a & X G (a | b))", "F (G a | G b)", "X X F G a"]
    {
        let formula = Formula::parse(text).unwrap();
        let automaton = translate(&formula, &TranslateOptions::default()).unwrap();
        let again = hoa::read(&hoa::write(&automaton, &resolved).unwrap()).unwrap().automaton;
        for _ in 0..40 {
            let mdp = random_mdp(&mut rng);
            let value = |automaton| maximal_probability(&mdp, automaton, PRECISION).unwrap().middle();
            assert!((value(&automaton) - value(&again)).abs() < 1e-6, "{text}\n{}\n{}", automaton.dot(), again.dot());
        }
    }
}

#[test]
fn the_deterministic_route_knows_plain_cases() {
    // A coin that is thrown again and again; choosing to stop keeps the last side.
    let (heads, tails) = (Labels(1), Labels(2));
    let toss = vec![(0, 0.5), (1, 0.5)];
    let choices = vec![vec![toss.clone(), vec![(0, 1.0)]], vec![toss, vec![(1, 1.0)]]];
    let mdp = Mdp::new(propositions(), 1, vec![heads, tails], choices).unwrap();
    for (text, value) in [
        ("F G a", 1.0),
        ("X a", 0.5),
        ("X a & X X b", 0.25),
        ("G F a & G F b", 1.0),
        ("G b", 1.0),
        ("G a", 0.0),
        ("X (a & G b)", 0.0),
    ] {
        let formula = Formula::parse(text).unwrap();
        let expected = reference(&formula, &mdp).unwrap();
        assert!((expected.middle() - value).abs() < 1e-6, "{text}: {expected:?}, not {value}");
    }
}

#[test]
fn an_automaton_that_must_guess_loses_probability_and_the_test_would_see_it() {
    // Language F (a & G b) with a jump that must be taken before `a` is seen, and no way to try again.
    let text = "HOA: v1 States: 3 Start: 0 AP: 2 \"a\" \"b\" Acceptance: 1 Inf(0) --BODY--
        State: 0 [t] 0 1 State: 1 [0&1] 2 State: 2 [1] 2 {0} --END--";
    let guessing = hoa::read(text).unwrap().automaton;
    // `a & b` with probability ½, else `b` for ever: a jump beforehand succeeds half of the time only.
    let (both, b, rest) = (Labels(3), Labels(2), Labels(0));
    let choices = vec![vec![vec![(1, 0.5), (2, 0.5)]], vec![vec![(2, 1.0)]], vec![vec![(2, 1.0)]], vec![vec![(3, 1.0)]]];
    let mdp = Mdp::new(propositions(), 0, vec![rest, both, b, rest], choices).unwrap();
    let formula = Formula::parse("F (a & G b)").unwrap();
    let ours = translate(&formula, &TranslateOptions::default()).unwrap();
    let value = |automaton| maximal_probability(&mdp, automaton, PRECISION).unwrap().middle();
    assert!((reference(&formula, &mdp).unwrap().middle() - 0.5).abs() < 1e-6);
    assert!((value(&ours) - 0.5).abs() < 1e-6 && (value(&guessing) - 0.5).abs() < 1e-6);
    // Two tries, of which the guessing automaton can use one only.
    let choices =
        vec![vec![vec![(1, 0.5), (2, 0.5)]], vec![vec![(3, 1.0)]], vec![vec![(1, 0.5), (0, 0.5)]], vec![vec![(3, 1.0)]]];
    let mdp = Mdp::new(propositions(), 0, vec![rest, both, rest, b], choices).unwrap();
    let value = |automaton| maximal_probability(&mdp, automaton, PRECISION).unwrap().middle();
    assert!((reference(&formula, &mdp).unwrap().middle() - 1.0).abs() < 1e-6);
    assert!((value(&ours) - 1.0).abs() < 1e-6);
    assert!(value(&guessing) < 0.6, "{}", value(&guessing));
}
