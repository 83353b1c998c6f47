//! Does an automaton accept a word u·v^ω? The ε-jumps are resolved by whoever wants acceptance.

use super::ldgba::{Ldgba, Marks, StateId};
use super::scc::components;
use crate::ltl::Lasso;
use std::collections::HashMap;

impl Ldgba {
    /// Whether a run over `word` (letters in the order of [`Ldgba::propositions`]) is accepting, for some choice of ε-jumps.
    ///
    /// Builds the reachable part of automaton × positions of the lasso and looks for a component whose edges belong to all
    /// accepting sets ([Baier & Katoen 2008](crate::bib::BaierKatoen2008), section 4.3).
    ///
    /// # Panics
    /// If the cycle of the lasso is empty.
    pub fn accepts(&self, word: &Lasso) -> bool {
        assert!(!word.cycle.is_empty(), "an infinite word repeats a non-empty cycle");
        let letters: Vec<_> = word.prefix.iter().chain(&word.cycle).copied().collect();
        let after = |position: usize| if position + 1 == letters.len() { word.prefix.len() } else { position + 1 };
        let mut index: HashMap<(StateId, usize), usize> = HashMap::new();
        let mut nodes = vec![(self.initial(), 0)];
        index.insert(nodes[0], 0);
        let mut successors: Vec<Vec<usize>> = Vec::new();
        let mut marks: Vec<Marks> = Vec::new();
        while successors.len() < nodes.len() {
            let (q, position) = nodes[successors.len()];
            let edge = self.edge(q, letters[position]);
            let jumps = self.epsilon(q).iter().map(|to| (*to, position));
            let mut targets = Vec::new();
            for node in std::iter::once((edge.target, after(position))).chain(jumps) {
                let next = nodes.len();
                targets.push(*index.entry(node).or_insert_with(|| {
                    nodes.push(node);
                    next
                }));
            }
            successors.push(targets);
            marks.push(edge.marks);
        }
        let found = components(&successors);
        let mut visited = vec![Marks::NONE; found.count];
        for (v, targets) in successors.iter().enumerate() {
            // The letter's edge comes first; a jump never lies inside a component, for it leads into Q_D.
            if found.of[targets[0]] == found.of[v] {
                visited[found.of[v]] = visited[found.of[v]].union(marks[v]);
            }
        }
        visited.contains(&self.all_sets())
    }
}
