//! Does an automaton accept the words that satisfy a formula, and no others? A check on words u·v^ω: all short ones, random longer
//! ones, and words along the edges of the automaton.

use super::ldgba::{Ldgba, StateId};
use crate::labels::{Labels, Propositions, PropositionsError};
use crate::ltl::{Evaluator, Formula, Lasso};
use crate::rng::{Purpose, Rng};
use std::collections::HashSet;
use std::fmt;

/// How many words are tried. The same numbers and seed try the same words.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct WordBudget {
    /// At most this many words are tried in order of length: all lassos up to the longest length that fits.
    pub exhaustive: usize,
    /// This many random words, half of them along edges of the automaton.
    pub random: usize,
    /// The seed of the random words.
    pub seed: u64,
}

impl Default for WordBudget {
    /// 20 000 short words and 4 000 random ones.
    fn default() -> WordBudget {
        WordBudget { exhaustive: 20_000, random: 4_000, seed: 0 }
    }
}

/// All words up to a length are tried up to this length only.
const MAX_LENGTH: usize = 16;

/// What was checked without finding a difference.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Matched {
    /// The number of words tried.
    pub words: usize,
    /// All words u·v^ω with |u| + |v| up to this were tried.
    pub length: usize,
}

/// A word on which automaton and formula differ.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct CounterExample {
    /// The word; no letter of it, and no proposition in a letter, can be left out.
    pub word: Lasso,
    /// Whose letters it consists of.
    pub propositions: Propositions,
    /// Whether the automaton accepts it, and the formula is false on it; or the other way round.
    pub accepted: bool,
}

impl CounterExample {
    /// The word, readable: `{r1}; {}; cycle{{r2}; {}}`, in the notation of Spot but for the letters, which list what holds.
    pub fn text(&self) -> String {
        let letter = |sigma: &Labels| {
            let names = (0..self.propositions.len()).filter(|i| sigma.holds(*i)).map(|i| self.propositions.name(i));
            format!("{{{}}}", names.collect::<Vec<_>>().join(", "))
        };
        let list = |letters: &[Labels]| letters.iter().map(letter).collect::<Vec<_>>().join("; ");
        let prefix = if self.word.prefix.is_empty() { String::new() } else { list(&self.word.prefix) + "; " };
        format!("{prefix}cycle{{{}}}", list(&self.word.cycle))
    }
}

impl fmt::Display for CounterExample {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (automaton, formula) = if self.accepted { ("accepts", "false") } else { ("rejects", "true") };
        write!(f, "the automaton {automaton} the word {}, on which the formula is {formula}", self.text())
    }
}

/// Why an automaton does not match a formula.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Mismatch {
    /// They differ on a word.
    #[error("{0}")]
    Word(Box<CounterExample>),
    /// Automaton and formula together have more propositions than an alphabet may have.
    #[error("automaton and formula together: {0}")]
    Propositions(PropositionsError),
}

/// Checks `automaton` against `formula`. Propositions that only one of them has are no error: they are part of the words.
///
/// # Errors
/// [`Mismatch::Word`] with a shortest word among those tried (shortened further if it was found at random).
pub fn matches(automaton: &Ldgba, formula: &Formula, budget: WordBudget) -> Result<Matched, Mismatch> {
    matches_where(automaton, formula, budget, &[])
}

/// As [`matches()`], on words in which at most one proposition of each of the groups `exclusive` holds at a time, such as regions that do not
/// overlap. A group may have names that neither automaton nor formula has; groups do not share a name.
///
/// # Errors
/// As [`matches()`].
pub fn matches_where(
    automaton: &Ldgba,
    formula: &Formula,
    budget: WordBudget,
    exclusive: &[Vec<String>],
) -> Result<Matched, Mismatch> {
    let mut names: Vec<String> = automaton.propositions().iter().map(str::to_owned).collect();
    names.extend(formula.propositions().into_iter().filter(|name| automaton.propositions().index(name).is_none()));
    let propositions = Propositions::new(names).map_err(Mismatch::Propositions)?;
    let evaluator = Evaluator::new(formula, &propositions).expect("the alphabet has all names of the formula");
    let differs = |word: &Lasso| automaton.accepts(word) != evaluator.satisfied_by(word);
    let found = |word: Lasso| {
        let word = shortened(word, &differs);
        let accepted = automaton.accepts(&word);
        Mismatch::Word(Box::new(CounterExample { word, propositions: propositions.clone(), accepted }))
    };

    let alphabet = Alphabet::new(&propositions, exclusive);
    let (mut words, mut length) = (0, 0);
    while let Some(more) = alphabet.count(length + 1).filter(|more| *more <= budget.exhaustive - words && length < MAX_LENGTH) {
        length += 1;
        words += more;
        for prefix in 0..length {
            if let Some(word) = alphabet.lassos(prefix, length - prefix).find(|word| differs(word)) {
                return Err(found(word));
            }
        }
    }
    let walker = Walker::new(automaton);
    let mut rng = Rng::new(budget.seed, Purpose::Tool);
    for i in 0..budget.random {
        let word = if i % 2 == 0 { alphabet.random_word(&mut rng) } else { walker.word(&alphabet, &mut rng) };
        if differs(&word) {
            return Err(found(word));
        }
        words += 1;
    }
    Ok(Matched { words, length })
}

/// The letters of words.
struct Alphabet {
    propositions: usize,
    /// The propositions, in groups of which at most one holds; most groups have one member.
    groups: Vec<Vec<usize>>,
}

impl Alphabet {
    fn new(propositions: &Propositions, exclusive: &[Vec<String>]) -> Alphabet {
        let indices = |group: &Vec<String>| group.iter().filter_map(|name| propositions.index(name)).collect::<Vec<_>>();
        let mut groups: Vec<Vec<usize>> = exclusive.iter().map(indices).collect();
        let alone: Vec<usize> = (0..propositions.len()).filter(|i| !groups.iter().flatten().any(|j| i == j)).collect();
        groups.extend(alone.into_iter().map(|i| vec![i]));
        Alphabet { propositions: propositions.len(), groups }
    }

    /// How many letters there are, if that fits 32 bits.
    fn size(&self) -> Option<u32> {
        self.groups.iter().try_fold(1u32, |size, group| size.checked_mul(u32::try_from(group.len() + 1).ok()?))
    }

    fn letter(&self, mut number: u64) -> Labels {
        let mut letter = Labels::EMPTY;
        for group in &self.groups {
            let choices = group.len() as u64 + 1;
            if let Some(held) = (number % choices).checked_sub(1) {
                letter = letter.with(group[held as usize], true);
            }
            number /= choices;
        }
        letter
    }

    /// `sigma`, with one proposition left of every group of which several hold.
    fn fitted(&self, sigma: Labels, rng: &mut Rng) -> Labels {
        let mut fitted = sigma;
        for group in self.groups.iter().filter(|group| group.len() > 1) {
            let held: Vec<usize> = group.iter().copied().filter(|i| sigma.holds(*i)).collect();
            if held.len() > 1 {
                let kept = held[rng.below(held.len())];
                fitted = held.into_iter().fold(fitted, |letter, i| letter.with(i, i == kept));
            }
        }
        fitted
    }

    /// The number of lassos with |u| + |v| = `length`, if it fits 32 bits.
    fn count(&self, length: usize) -> Option<usize> {
        let length = u32::try_from(length).ok()?;
        self.size()?.checked_pow(length)?.checked_mul(length).map(|n| n as usize)
    }

    /// All lassos with |u| = `prefix` and |v| = `cycle`, whose number fits 32 bits.
    fn lassos(&self, prefix: usize, cycle: usize) -> impl Iterator<Item = Lasso> {
        let size = u64::from(self.size().expect("only alphabets whose lassos can be counted are enumerated"));
        (0..size.pow((prefix + cycle) as u32)).map(move |number| {
            let word: Vec<Labels> = (0..prefix + cycle).map(|i| self.letter(number / size.pow(i as u32) % size)).collect();
            Lasso { prefix: word[..prefix].to_vec(), cycle: word[prefix..].to_vec() }
        })
    }

    /// Up to 8 + 8 letters; how likely propositions hold is drawn first, so that rare and frequent letters both occur.
    fn random_word(&self, rng: &mut Rng) -> Lasso {
        let density = [0.1, 0.3, 0.5, 0.9][rng.below(4)];
        let letters: Vec<Labels> = (0..16)
            .map(|_| {
                let sigma = (0..self.propositions).fold(Labels::EMPTY, |sigma, i| sigma.with(i, rng.chance(density)));
                self.fitted(sigma, rng)
            })
            .collect();
        let (prefix, cycle) = (rng.below(9), 1 + rng.below(8));
        Lasso { prefix: letters[..prefix].to_vec(), cycle: letters[8..8 + cycle].to_vec() }
    }
}

/// Words along the edges of an automaton.
struct Walker<'a> {
    automaton: &'a Ldgba,
    /// The reachable states, nearest first, each with the position of the one before it and the letter between them, if any.
    access: Vec<(StateId, usize, Option<Labels>)>,
}

impl Walker<'_> {
    fn new(automaton: &Ldgba) -> Walker<'_> {
        let mut access = vec![(automaton.initial(), 0, None)];
        let mut seen: HashSet<StateId> = HashSet::from([automaton.initial()]);
        let mut next = 0;
        while next < access.len() {
            let q = access[next].0;
            let letters = automaton.edges(q).iter().map(|(guard, edge)| (edge.target, guard.witness()));
            for (target, letter) in letters.chain(automaton.epsilon(q).iter().map(|d| (*d, None))) {
                if seen.insert(target) {
                    access.push((target, next, letter));
                }
            }
            next += 1;
        }
        Walker { automaton, access }
    }

    /// A shortest way to the state at a position.
    fn way(&self, position: usize) -> Vec<Labels> {
        let (mut word, mut at) = (Vec::new(), position);
        while at > 0 {
            word.extend(self.access[at].2);
            at = self.access[at].1;
        }
        word.reverse();
        word
    }

    /// The shortest way to a random state, a random edge of it, and then along edges that lead to no sink where that can be helped;
    /// the cycle starts where the last state was met before, if it was.
    fn word(&self, alphabet: &Alphabet, rng: &mut Rng) -> Lasso {
        let position = rng.below(self.access.len());
        let (mut q, way) = (self.access[position].0, self.way(position));
        let mut word: Vec<Labels> = way.into_iter().map(|sigma| alphabet.fitted(sigma, rng)).collect();
        let mut visited = vec![(q, word.len())];
        let limit = 1 + rng.below(2 + 2 * self.automaton.len().min(30));
        for step in 0..limit {
            let jumps = self.automaton.epsilon(q);
            if !jumps.is_empty() && rng.chance(0.3) {
                q = jumps[rng.below(jumps.len())];
            }
            let edges = self.automaton.edges(q);
            let live: Vec<_> = edges.iter().filter(|(_, edge)| !self.automaton.is_sink(edge.target)).collect();
            let (guard, edge) = match live.len() {
                n if n > 0 && step > 0 => live[rng.below(n)],
                _ => &edges[rng.below(edges.len())],
            };
            let cube = guard.0[rng.below(guard.0.len())];
            let free = !cube.support() & rng.bits() & rng.bits();
            let mask = 1u64.checked_shl(self.automaton.propositions().len() as u32).map_or(u64::MAX, |bit| bit - 1);
            let sigma = alphabet.fitted(Labels((cube.positive | free) & mask), rng);
            word.push(sigma);
            q = if guard.contains(sigma) { edge.target } else { self.automaton.edge(q, sigma).target };
            visited.push((q, word.len()));
        }
        let starts: Vec<usize> = visited.iter().filter(|(p, at)| *p == q && *at < word.len()).map(|(_, at)| *at).collect();
        let start = if starts.is_empty() { rng.below(word.len()) } else { starts[rng.below(starts.len())] };
        let cycle = word.split_off(start);
        Lasso { prefix: word, cycle }
    }
}

/// Leaves out letters, and propositions of letters, as long as automaton and formula still differ.
fn shortened(mut word: Lasso, differs: &dyn Fn(&Lasso) -> bool) -> Lasso {
    loop {
        let mut candidates = Vec::new();
        for i in 0..word.prefix.len() {
            let mut shorter = word.clone();
            shorter.prefix.remove(i);
            candidates.push(shorter);
        }
        for i in (0..word.cycle.len()).filter(|_| word.cycle.len() > 1) {
            let mut shorter = word.clone();
            shorter.cycle.remove(i);
            candidates.push(shorter);
        }
        for (i, letter) in word.prefix.iter().chain(&word.cycle).enumerate() {
            for p in (0..64).filter(|p| letter.holds(*p)) {
                let mut simpler = word.clone();
                let count = simpler.prefix.len();
                let place = if i < count { &mut simpler.prefix[i] } else { &mut simpler.cycle[i - count] };
                *place = place.with(p, false);
                candidates.push(simpler);
            }
        }
        match candidates.into_iter().find(|candidate| differs(candidate)) {
            Some(candidate) => word = candidate,
            None => return word,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::hoa;
    use super::*;

    fn both(source: &str, formula: &str) -> Result<Matched, Mismatch> {
        let automaton = hoa::read(source).unwrap().automaton;
        matches(&automaton, &Formula::parse(formula).unwrap(), WordBudget { random: 400, ..WordBudget::default() })
    }

    const UNTIL: &str = "HOA: v1 States: 2 Start: 0 AP: 2 \"a\" \"b\" Acceptance: 1 Inf(0)
        --BODY-- State: 0 [1] 1 [0&!1] 0 State: 1 [t] 1 {0} --END--";

    #[test]
    fn the_right_formula_matches() {
        assert_eq!(both(UNTIL, "a U b").unwrap().length, 5);
    }

    #[test]
    fn a_counter_example_is_short_and_readable() {
        let Err(Mismatch::Word(found)) = both(UNTIL, "a W b") else { panic!("a W b allows a for ever") };
        assert_eq!(found.text(), "cycle{{a}}");
        assert!(!found.accepted);
        let Err(Mismatch::Word(found)) = both(UNTIL, "a U (b & X c)") else { panic!("c is not in the automaton") };
        assert_eq!(found.to_string(), "the automaton accepts the word cycle{{b}}, on which the formula is false");
    }

    #[test]
    fn deep_differences_are_found_along_the_edges() {
        // Eleven times `a` in a row, after which `b` must come: too long for all words.
        let states: String = (0..11).map(|i| format!("State: {i} [0] {} [!0] 12 ", i + 1)).collect();
        let source = format!(
            "HOA: v1 States: 13 Start: 0 AP: 2 \"a\" \"b\" Acceptance: 1 Inf(0) --BODY-- {states}
             State: 11 [0|1] 12 State: 12 [t] 12 {{0}} --END--"
        );
        let Err(Mismatch::Word(found)) = both(&source, "true") else { panic!("a^11 !b is rejected") };
        assert_eq!((found.word.prefix.len() + found.word.cycle.len(), found.accepted), (12, false));
    }
}
