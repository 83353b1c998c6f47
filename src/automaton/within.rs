//! What an automaton accepts of the words over a few letters only, such as those that an environment can show.

use super::ldgba::{Ldgba, Marks};
use super::scc::{can_reach, components};
use crate::labels::Labels;

impl Ldgba {
    /// Per state, whether some word over `letters` is accepted from it.
    pub fn hopeful(&self, letters: &[Labels]) -> Vec<bool> {
        let successors: Vec<Vec<usize>> = self
            .states()
            .map(|q| {
                let read = letters.iter().map(|sigma| self.edge(q, *sigma).target);
                let mut targets: Vec<usize> = read.chain(self.epsilon(q).iter().copied()).map(usize::from).collect();
                targets.sort_unstable();
                targets.dedup();
                targets
            })
            .collect();
        let found = components(&successors);
        let mut marks = vec![Marks::NONE; found.count];
        for q in self.states() {
            let own = found.of[usize::from(q)];
            for edge in letters.iter().map(|sigma| self.edge(q, *sigma)) {
                if found.of[usize::from(edge.target)] == own {
                    marks[own] = marks[own].union(edge.marks);
                }
            }
        }
        let accepting: Vec<bool> = found.of.iter().map(|component| marks[*component] == self.all_sets()).collect();
        can_reach(&successors, &accepting)
    }

    /// Whether a word that begins with `letter` may be accepted, where `hopeful` tells from which states something is.
    pub fn may_begin_with(&self, letter: Labels, hopeful: &[bool]) -> bool {
        let starts = std::iter::once(self.initial()).chain(self.epsilon(self.initial()).iter().copied());
        starts.into_iter().any(|q| hopeful[usize::from(self.edge(q, letter).target)])
    }
}

#[cfg(test)]
mod tests {
    use super::super::translate::{TranslateOptions, translate};
    use super::*;
    use crate::ltl::Formula;

    #[test]
    fn with_few_letters_less_is_accepted() {
        let propositions = vec!["a".to_owned(), "b".to_owned()];
        let options = TranslateOptions { propositions, ..TranslateOptions::default() };
        for (text, letters, begin, hopeful) in [
            ("G F a & G F b", vec![0, 1], vec![], false),
            ("G F a & G F b", vec![0, 1, 2], vec![0, 1, 2, 3], true),
            ("F G a | F G b", vec![0, 2], vec![0, 1, 2, 3], true),
            ("F G a | F G b", vec![0], vec![], false),
            ("a & X (F G a | F G b)", vec![0, 1], vec![1, 3], true),
            ("G (a & b)", vec![1, 2], vec![], false),
        ] {
            let automaton = translate(&Formula::parse(text).unwrap(), &options).unwrap();
            let letters: Vec<Labels> = letters.into_iter().map(Labels).collect();
            let found = automaton.hopeful(&letters);
            assert_eq!(found[usize::from(automaton.initial())], hopeful, "{text}");
            let may: Vec<u64> = (0..4).filter(|sigma| automaton.may_begin_with(Labels(*sigma), &found)).collect();
            assert_eq!(may, begin, "{text}");
        }
    }
}
