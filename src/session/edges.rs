//! Which edge of the drawn automaton a move took.

use crate::automaton::{Ldgba, StateId};
use crate::labels::Labels;
use std::sync::Arc;

/// Positions in the `edges` of [`Ldgba::graph`](crate::automaton::Ldgba::graph): by source, letters before ε-jumps.
#[derive(Clone, Debug)]
pub struct EdgeIndex {
    automaton: Arc<Ldgba>,
    /// Per state, the position of its first edge.
    first: Vec<usize>,
}

impl EdgeIndex {
    /// The positions for `automaton`.
    pub fn new(automaton: Arc<Ldgba>) -> EdgeIndex {
        let mut first = vec![];
        let mut next = 0;
        for q in automaton.states() {
            first.push(next);
            next += automaton.edges(q).len() + automaton.epsilon(q).len();
        }
        EdgeIndex { automaton, first }
    }

    /// The edge that `sigma` takes from `q`.
    pub fn letter(&self, q: StateId, sigma: Labels) -> Option<usize> {
        let position = self.automaton.edges(q).iter().position(|(guard, _)| guard.contains(sigma))?;
        Some(self.first[usize::from(q)] + position)
    }

    /// The ε-jump from `from` to `to`; `None` for a choice of the first moment, which is a jump and a letter in one.
    pub fn jump(&self, from: StateId, to: StateId) -> Option<usize> {
        let position = self.automaton.epsilon(from).iter().position(|&target| target == to)?;
        Some(self.first[usize::from(from)] + self.automaton.edges(from).len() + position)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::automaton::{GraphEdgeKind, hoa};

    #[test]
    fn positions_are_those_of_the_drawing() {
        let text = "HOA: v1 States: 3 Start: 0 AP: 1 \"a\" Acceptance: 1 Inf(0) --BODY--
            State: 0 [t] 0 1 2 State: 1 [0] 1 {0} State: 2 [!0] 2 {0} --END--";
        let automaton = Arc::new(hoa::read(text).unwrap().automaton);
        let index = EdgeIndex::new(automaton.clone());
        let graph = automaton.graph();
        let mut met = vec![false; graph.edges.len()];
        for q in automaton.states() {
            for sigma in [Labels(0), Labels(1)] {
                let at = index.letter(q, sigma).unwrap();
                let edge = &graph.edges[at];
                assert_eq!((edge.from, edge.to, edge.kind), (q, automaton.edge(q, sigma).target, GraphEdgeKind::Letter));
                met[at] = true;
            }
            for &to in automaton.epsilon(q) {
                let at = index.jump(q, to).unwrap();
                assert_eq!((graph.edges[at].from, graph.edges[at].to, graph.edges[at].kind), (q, to, GraphEdgeKind::Epsilon));
                met[at] = true;
            }
            assert_eq!(index.jump(q, 99), None);
        }
        assert!(met.into_iter().all(|m| m), "every drawn edge can be taken");
    }
}
