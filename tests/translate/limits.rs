//! Many subformulas that forget every prefix: `F G` and `G F` of many propositions give automata of linear size, in little time.

use super::words::{all, difference, random};
use ltl_rover::automaton::translate::{TranslateOptions, translate, translate_counting};
use ltl_rover::labels::{Labels, Propositions};
use ltl_rover::ltl::{Evaluator, Formula, Lasso};
use ltl_rover::rng::{Purpose, Rng};

fn joined(operator: &str, parts: impl Iterator<Item = String>) -> String {
    parts.collect::<Vec<_>>().join(operator)
}

fn persists(n: usize) -> String {
    joined(" | ", (1..=n).map(|i| format!("F G !v{i}")))
}

fn recurs(name: &str, n: usize) -> String {
    joined(" & ", (1..=n).map(|i| format!("G F {name}{i}")))
}

/// The formula with n subformulas, and how many states accept something.
type Rule = (fn(usize) -> String, fn(usize) -> usize);

const RULES: [Rule; 9] = [
    (persists, |n| n + 1),
    (|n| format!("{} | F u", persists(n)), |n| n + 2),
    (|n| format!("({}) & G u", persists(n)), |n| n + 1),
    (|n| format!("u U ({})", persists(n)), |n| n + 1),
    (|n| joined(" | ", (1..=n).map(|i| format!("F G (a{i} -> X b{i})"))), |n| 2 * n + 1),
    (|n| joined(" | ", (1..=n).map(|i| format!("F G a{i} & G F b{i}"))), |n| n + 1),
    (|n| format!("{} -> G F c", recurs("a", n)), |n| n + 2),
    // A set for each of the b's, as long as there are not too many edges; then one after the other.
    (|n| format!("{} -> {}", recurs("a", n), recurs("b", n)), |n| if n <= 12 { n + 2 } else { 2 * n + 1 }),
    (|n| format!("{} & G !u", recurs("a", n)), |n| if n <= 12 { 1 } else { n }),
];

/// Words in whose cycles propositions hold always, never, or sometimes; for each word and each letter that names begin with, it is drawn which of
/// these occur.
fn words(names: &Propositions, count: usize, rng: &mut Rng) -> Vec<Lasso> {
    let mut word = || {
        let kinds: Vec<usize> = (0..26).map(|_| 1 + rng.below(7)).collect();
        let (prefix, cycle) = (rng.below(3), 1 + rng.below(3));
        let mut letters = vec![Labels::EMPTY; prefix + cycle];
        for (i, name) in names.iter().enumerate() {
            let kinds = kinds[usize::from(name.as_bytes()[0] - b'a')];
            let kind = std::iter::repeat_with(|| rng.below(3)).find(|kind| kinds >> kind & 1 == 1).expect("one of three");
            for (t, sigma) in letters.iter_mut().enumerate() {
                let holds = if kind == 2 || t < prefix { rng.chance(0.5) } else { kind == 1 };
                *sigma = sigma.with(i, holds);
            }
        }
        let cycle = letters.split_off(prefix);
        Lasso { prefix: letters, cycle }
    };
    (0..count).map(|_| word()).collect()
}

#[test]
fn take_as_many_states_as_they_are() {
    let mut rng = Rng::new(7, Purpose::Tool);
    for (k, (rule, states)) in RULES.iter().enumerate() {
        for n in [4, 8, 12, 16] {
            // An automaton with 4096 edges takes long to check in a debug build.
            if cfg!(debug_assertions) && k >= 7 && n == 12 {
                continue;
            }
            let formula = Formula::parse(&rule(n)).unwrap();
            let (automaton, spent) = translate_counting(&formula, &TranslateOptions::default(), &|| false).unwrap();
            let live = automaton.states().filter(|&q| !automaton.is_sink(q)).count();
            assert_eq!(live, states(n), "{formula}");
            assert!(spent.steps < 500_000 && spent.nodes < 250_000, "{formula}: {spent:?}");
            let words = words(automaton.propositions(), 60, &mut rng);
            let evaluator = Evaluator::new(&formula, automaton.propositions()).unwrap();
            let satisfied = words.iter().filter(|word| evaluator.satisfied_by(word)).count();
            assert!((1..words.len()).contains(&satisfied), "{formula}: {satisfied} words satisfy it");
            assert_eq!(difference(&automaton, &formula, words.into_iter()), None, "{formula}");
        }
    }
}

/// `F G` and `G F` of small formulas over a, b, c, joined and nested at random, with opposites among them.
fn mixture(depth: usize, rng: &mut Rng) -> String {
    let literal = |rng: &mut Rng| ["a", "!a", "b", "!b", "c", "!c"][rng.below(6)];
    let (x, y) = (literal(rng), literal(rng));
    if depth == 0 {
        let inner = [x.to_owned(), format!("({x} | {y})"), format!("({x} & {y})"), format!("({x} | X {y})")];
        return format!("{} {}", ["F G", "G F"][rng.below(2)], inner[rng.below(4)]);
    }
    let parts: Vec<String> = (0..1 + rng.below(4)).map(|_| mixture(depth - 1, rng)).collect();
    let joined = parts.join([" & ", " | "][rng.below(2)]);
    match rng.below(8) {
        0 => format!("({joined}) & F {x}"),
        1 => format!("({joined}) | F {x}"),
        2 => format!("({x} U ({joined}))"),
        3 => format!("G ({x} | {joined})"),
        4 => format!("F ({x} & ({joined}))"),
        5 => format!("!({joined})"),
        _ => format!("({joined})"),
    }
}

#[test]
fn mixed_at_random_accept_what_they_should() {
    let mut rng = Rng::new(8, Purpose::Tool);
    for k in 0..if cfg!(debug_assertions) { 120 } else { 2000 } {
        let formula = Formula::parse(&mixture(1 + k % 2, &mut rng)).unwrap();
        let automaton = translate(&formula, &TranslateOptions::default()).unwrap_or_else(|error| panic!("{formula}: {error}"));
        let propositions = automaton.propositions().len();
        let words = all(propositions, if propositions < 3 { 3 } else { 2 }).chain(random(propositions, 40, k as u64));
        assert_eq!(difference(&automaton, &formula, words), None, "{formula}");
    }
}
