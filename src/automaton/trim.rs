//! Smaller automata of the same language: without states that cannot be reached, with one sink only.

use super::construct::{Gaps, LdgbaParts};
use super::ldgba::{Edge, Ldgba, Marks, StateId};
use super::scc::can_reach;

impl Ldgba {
    /// Per state, whether it can be reached from the initial one by edges and ε-jumps.
    pub fn reachable(&self) -> Vec<bool> {
        let mut predecessors = vec![Vec::new(); self.len()];
        for (q, targets) in self.successors().into_iter().enumerate() {
            for target in targets {
                predecessors[target].push(q);
            }
        }
        let start: Vec<bool> = self.states().map(|q| q == self.initial()).collect();
        can_reach(&predecessors, &start)
    }

    /// The same automaton without the states that cannot be reached, and with all sinks joined into the first of them. States keep
    /// their order and names.
    #[must_use]
    pub fn trimmed(&self) -> Ldgba {
        let reachable = self.reachable();
        let sink = self.states().find(|q| reachable[usize::from(*q)] && self.is_sink(*q));
        let represented = |q: StateId| if self.is_sink(q) { sink.unwrap_or(q) } else { q };
        let kept: Vec<StateId> = self.states().filter(|q| reachable[usize::from(*q)] && represented(*q) == *q).collect();
        let mut number = vec![0; self.len()];
        for (new, old) in kept.iter().enumerate() {
            number[usize::from(*old)] = new as StateId;
        }
        let renamed = |q: StateId| number[usize::from(represented(q))];
        // Cycles of several sinks become one loop, which must not collect the marks of them all.
        let marks = |edge: &Edge| if self.is_sink(edge.target) { Marks::NONE } else { edge.marks };
        let edge = |edge: &Edge| Edge { target: renamed(edge.target), marks: marks(edge) };
        let parts = LdgbaParts {
            propositions: self.propositions().clone(),
            initial: renamed(self.initial()),
            sets: self.sets(),
            edges: kept.iter().map(|q| self.edges(*q).iter().map(|(guard, e)| (guard.clone(), edge(e))).collect()).collect(),
            // A jump into a sink is of no use.
            epsilon: kept
                .iter()
                .map(|q| self.epsilon(*q).iter().filter(|d| !self.is_sink(**d)).map(|d| renamed(*d)).collect())
                .collect(),
            names: kept.iter().map(|q| self.name(*q).to_owned()).collect(),
        };
        Ldgba::new(parts, Gaps::Refuse).expect("leaving out states and joining sinks keeps the invariants")
    }
}
