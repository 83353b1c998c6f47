//! An automaton of one's own held against a formula: equal on all words that were tried, or a word on which they differ.

use super::check::formula_refusal;
use super::open::read_hoa;
use super::refusal::Refusal;
use super::translation::Translator;
use super::word::Word;
use crate::automaton::{Ldgba, Mismatch, WordBudget, matches_where};
use crate::labels::{Labels, Propositions};
use crate::ltl::{Formula, Lasso};
use serde::Serialize;

/// How an automaton and a formula compare.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct ComparisonFacts {
    /// Whether no word was found on which they differ.
    pub equal: bool,
    /// Words that were tried without finding a difference.
    pub words: usize,
    /// All words with |u| + |v| up to this are among them.
    pub length: usize,
    /// Where they differ, a shortest word on which they do.
    pub word: Option<Word>,
    /// Whether the automaton accepts that word, on which the formula is false; or the other way round.
    pub accepted: bool,
    /// The outcome in a sentence.
    pub sentence: String,
}

impl Translator {
    /// Holds the automaton in the text `hoa` against the formula in `formula`. Words that the environment cannot give do not count.
    ///
    /// # Errors
    /// A text that is no formula, or gives no automaton.
    pub fn compare(&self, formula: &str, hoa: &str) -> Result<ComparisonFacts, Refusal> {
        let parsed = Formula::parse(formula).map_err(|error| formula_refusal(formula, &error))?;
        let automaton = read_hoa(hoa)?.automaton;
        let mut names: Vec<String> = automaton.propositions().iter().map(str::to_owned).collect();
        names.extend(parsed.propositions());
        Ok(compared(&automaton, &parsed, &self.exclusive(&names)))
    }
}

/// Half of what the command line tries: this is answered while one looks on.
const WORDS: WordBudget = WordBudget { exhaustive: 10_000, random: 2_000, seed: 0 };

fn compared(automaton: &Ldgba, formula: &Formula, exclusive: &[Vec<String>]) -> ComparisonFacts {
    let facts = ComparisonFacts { equal: false, words: 0, length: 0, word: None, accepted: false, sentence: String::new() };
    match matches_where(automaton, formula, WORDS, exclusive) {
        Ok(matched) => ComparisonFacts {
            equal: true,
            words: matched.words,
            length: matched.length,
            sentence: format!("automaton and formula agree on all {} words that were tried", matched.words),
            ..facts
        },
        Err(Mismatch::Word(example)) => ComparisonFacts {
            word: Some(word_of(&example.word, &example.propositions)),
            accepted: example.accepted,
            sentence: example.to_string(),
            ..facts
        },
        Err(mismatch) => ComparisonFacts { sentence: mismatch.to_string(), ..facts },
    }
}

fn word_of(lasso: &Lasso, propositions: &Propositions) -> Word {
    let letter =
        |sigma: &Labels| (0..propositions.len()).filter(|&i| sigma.holds(i)).map(|i| propositions.name(i).to_owned()).collect();
    Word { letters: lasso.prefix.iter().chain(&lasso.cycle).map(letter).collect(), back: lasso.prefix.len(), jumps: vec![] }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EVENTUALLY_A: &str = "HOA: v1 States: 2 Start: 0 AP: 1 \"a\" acc-name: Buchi Acceptance: 1 Inf(0) --BODY--
        State: 0 [!0] 0 [0] 1 State: 1 [t] 1 {0} --END--";

    #[test]
    fn an_automaton_agrees_with_its_formula_and_differs_from_another_by_a_word() {
        let free = Translator::free();
        let same = free.compare("F a", EVENTUALLY_A).unwrap();
        assert!(same.equal && same.words > 100 && same.word.is_none(), "{same:?}");
        let other = free.compare("G F a", EVENTUALLY_A).unwrap();
        let word = other.word.expect("they differ on a word");
        assert!(!other.equal && other.accepted, "a once, and never again");
        assert_eq!((word.letters, word.back), (vec![vec!["a".to_owned()], vec![]], 1));
    }

    #[test]
    fn words_that_cannot_occur_do_not_count() {
        // Both at once is all that tells the two apart.
        let either =
            "HOA: v1 States: 1 Start: 0 AP: 2 \"r1\" \"r2\" acc-name: all Acceptance: 0 t --BODY-- State: 0 [!0 | !1] 0 --END--";
        assert!(!Translator::free().compare("true", either).unwrap().equal);
        assert!(
            Translator::of_task("ball_pass_b1", None).unwrap().compare("true", either).unwrap().equal,
            "the regions do not overlap"
        );
    }

    #[test]
    fn what_is_no_formula_or_no_automaton_is_refused() {
        use super::super::refusal::Subject;
        let free = Translator::free();
        assert_eq!(free.compare("G &", EVENTUALLY_A).unwrap_err().subject, Subject::Formula);
        assert_eq!(free.compare("G a", "HOA: v2").unwrap_err().subject, Subject::Hoa);
    }
}
