//! State-based acceptance: every state split by the accepting sets of the edges that enter it.

use super::construct::{Gaps, LdgbaParts, MAX_STATES};
use super::guard::Guard;
use super::ldgba::{Edge, Ldgba, Marks, StateId};
use super::ldgba_error::LdgbaError;
use crate::labels::Labels;
use std::collections::HashMap;

/// Which letters may occur.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Letters {
    /// All of 2^AP.
    All,
    /// Those in which at most one proposition holds: the propositions are regions that do not overlap.
    Exclusive,
}

/// A state of the result: a state and the accepting sets of the edges that enter it.
type Split = (StateId, Marks);

impl Ldgba {
    /// Whether acceptance is state-based: all edges into a state belong to the same accepting sets.
    pub fn is_state_based(&self) -> bool {
        let mut into: Vec<Option<Marks>> = vec![None; self.len()];
        let edges = self.states().flat_map(|q| self.edges(q));
        edges.into_iter().all(|(_, edge)| *into[usize::from(edge.target)].get_or_insert(edge.marks) == edge.marks)
    }

    /// The same language, with state-based acceptance: the states are the pairs (state, accepting sets of an edge into it) that
    /// can be reached by `letters`. Letters that cannot occur lead where no state is needed.
    ///
    /// The initial state, and the target of an ε-jump, are entered by no edge; any of their pairs will do, for one visit more or
    /// less does not matter. With exclusive propositions `GF r1 & GF r2` takes 3 states instead of 4, the form of
    /// [Cai et al. 2021](crate::bib::Cai2021).
    ///
    /// # Errors
    /// When there would be too many states.
    pub fn state_based(&self, letters: Letters) -> Result<Ldgba, LdgbaError> {
        let allowed = match letters {
            Letters::All => None,
            Letters::Exclusive => Some(exclusive(self.propositions().len())),
        };
        let occurs = |guard: &Guard| allowed.as_ref().is_none_or(|list| list.iter().any(|sigma| guard.contains(*sigma)));

        // Which marks enter which reachable state.
        let mut entered: Vec<Vec<Marks>> = vec![Vec::new(); self.len()];
        let mut seen = vec![false; self.len()];
        let mut open = vec![self.initial()];
        while let Some(q) = open.pop() {
            if std::mem::replace(&mut seen[usize::from(q)], true) {
                continue;
            }
            for (_, edge) in self.edges(q).iter().filter(|(guard, _)| occurs(guard)) {
                let marks = &mut entered[usize::from(edge.target)];
                if !marks.contains(&edge.marks) {
                    marks.push(edge.marks);
                }
                open.push(edge.target);
            }
            open.extend(self.epsilon(q));
        }
        let mut splits: Vec<Split> = Vec::new();
        for q in self.states().filter(|q| seen[usize::from(*q)]) {
            let marks = &mut entered[usize::from(q)];
            if marks.is_empty() {
                marks.push(Marks::NONE);
            }
            marks.sort_unstable_by_key(|marks| (marks.0.count_ones(), marks.0));
            splits.extend(marks.iter().map(|marks| (q, *marks)));
        }
        if splits.len() > MAX_STATES {
            return Err(LdgbaError::TooManyStates { found: splits.len() });
        }
        let index: HashMap<Split, StateId> = splits.iter().enumerate().map(|(i, split)| (*split, i as StateId)).collect();
        let any = |q: StateId| index[&(q, entered[usize::from(q)][0])];
        let parts = LdgbaParts {
            propositions: self.propositions().clone(),
            initial: any(self.initial()),
            sets: self.sets(),
            edges: splits.iter().map(|split| self.split_edges(*split, &index, &entered, &occurs)).collect(),
            epsilon: splits.iter().map(|(q, _)| self.epsilon(*q).iter().map(|d| any(*d)).collect()).collect(),
            names: splits.iter().map(|(q, _)| self.name(*q).to_owned()).collect(),
        };
        Ldgba::new(parts, Gaps::Refuse)
    }

    fn split_edges(
        &self,
        split: Split,
        index: &HashMap<Split, StateId>,
        entered: &[Vec<Marks>],
        occurs: &dyn Fn(&Guard) -> bool,
    ) -> Vec<(Guard, Edge)> {
        let target = |guard: &Guard, edge: &Edge| {
            if occurs(guard) {
                return (edge.target, edge.marks);
            }
            // Letters that cannot occur: a pair of the same target that needs no more marks, or else stay.
            let fits = entered[usize::from(edge.target)].iter().rev().find(|marks| marks.0 & !edge.marks.0 == 0);
            fits.map_or(split, |marks| (edge.target, *marks))
        };
        self.edges(split.0)
            .iter()
            .map(|(guard, edge)| {
                let to = target(guard, edge);
                (guard.clone(), Edge { target: index[&to], marks: to.1 })
            })
            .collect()
    }
}

/// The letters in which at most one of `count` propositions holds.
fn exclusive(count: usize) -> Vec<Labels> {
    std::iter::once(Labels::EMPTY).chain((0..count).map(Labels::only)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::hoa;
    use super::*;

    fn visits(count: usize) -> Ldgba {
        let names: String = (0..count).map(|i| format!(" \"r{i}\"")).collect();
        let sets: Vec<String> = (0..count).map(|i| format!("Inf({i})")).collect();
        let edges: String = (0..1u32 << count)
            .map(|l| {
                let marks: Vec<String> = (0..count).filter(|i| l >> i & 1 == 1).map(|i| i.to_string()).collect();
                format!("0 {{{}}} ", marks.join(" "))
            })
            .collect();
        let source = format!(
            "HOA: v1 States: 1 Start: 0 AP: {count}{names} Acceptance: {count} {} --BODY-- State: 0 {edges} --END--",
            sets.join(" & ")
        );
        hoa::read(&source).unwrap().automaton
    }

    #[test]
    fn regions_that_do_not_overlap_need_one_state_each() {
        let automaton = visits(2);
        assert!(!automaton.is_state_based());
        let (all, exclusive) = (automaton.state_based(Letters::All).unwrap(), automaton.state_based(Letters::Exclusive).unwrap());
        assert_eq!((automaton.len(), all.len(), exclusive.len()), (1, 4, 3));
        assert!(all.is_state_based() && exclusive.is_state_based());
        assert_eq!(visits(7).state_based(Letters::Exclusive).unwrap().len(), 8);
    }
}
