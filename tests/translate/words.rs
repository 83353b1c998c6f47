//! Words to compare automata and formulas on.

use ltl_rover::automaton::Ldgba;
use ltl_rover::labels::Labels;
use ltl_rover::ltl::{Evaluator, Formula, Lasso};
use ltl_rover::rng::{Purpose, Rng};

/// The length of words up to which all are tried; debug builds are slow.
pub const LENGTH: usize = if cfg!(debug_assertions) { 3 } else { 5 };

/// All words over `propositions` propositions with |u| + |v| ≤ `length`.
pub fn all(propositions: usize, length: usize) -> impl Iterator<Item = Lasso> {
    let letters = 1u64 << propositions;
    (1..=length).flat_map(move |total| {
        (1..=total).flat_map(move |cycle| {
            (0..letters.pow(total as u32)).map(move |mut code| {
                let mut word: Vec<Labels> = Vec::with_capacity(total);
                for _ in 0..total {
                    word.push(Labels(code % letters));
                    code /= letters;
                }
                let cycle = word.split_off(total - cycle);
                Lasso { prefix: word, cycle }
            })
        })
    })
}

/// `count` random words with |u| ≤ 4 and |v| ≤ 4; each has its own probability for a proposition to hold.
pub fn random(propositions: usize, count: usize, seed: u64) -> impl Iterator<Item = Lasso> {
    let mut rng = Rng::new(seed, Purpose::Tool);
    (0..count).map(move |_| {
        let (prefix, cycle, density) = (rng.below(5), 1 + rng.below(4), rng.uniform());
        let mut letter = || (0..propositions).fold(Labels::EMPTY, |sigma, i| sigma.with(i, rng.chance(density)));
        Lasso { prefix: (0..prefix).map(|_| letter()).collect(), cycle: (0..cycle).map(|_| letter()).collect() }
    })
}

/// The first of `words` on which the automaton and the formula differ.
pub fn difference(automaton: &Ldgba, formula: &Formula, words: impl Iterator<Item = Lasso>) -> Option<Lasso> {
    let evaluator = Evaluator::new(formula, automaton.propositions()).unwrap();
    let mut words = words;
    words.find(|word| automaton.accepts(word) != evaluator.satisfied_by(word))
}
