//! From loose parts to a valid automaton: every invariant of [`Ldgba`] is checked, or established, here and nowhere else.

use super::cover::fill;
use super::guard::{Effort, Guard, TooComplex};
use super::ldgba::{Edge, Ldgba, Marks, StateId};
use super::ldgba_error::LdgbaError;
use super::scc::{can_reach, components};
use crate::labels::Propositions;

/// The largest number of accepting sets.
pub const MAX_SETS: usize = 32;
/// The largest number of states.
pub const MAX_STATES: usize = StateId::MAX as usize;
/// The name of the state that completion adds.
pub const SINK_NAME: &str = "sink";

/// What [`Ldgba::new`] makes an automaton of. Edges may come in any order, several per target; empty guards are ignored.
#[derive(Clone, PartialEq, Debug)]
pub struct LdgbaParts {
    /// The atomic propositions that guards speak of.
    pub propositions: Propositions,
    /// q0.
    pub initial: StateId,
    /// f, the number of accepting sets; 0 = every infinite run is accepting.
    pub sets: usize,
    /// Per state: its guarded edges.
    pub edges: Vec<Vec<(Guard, Edge)>>,
    /// Per state: the targets of its ε-jumps; may be shorter than the list of states.
    pub epsilon: Vec<Vec<StateId>>,
    /// Per state: a name for views; may be shorter than the list of states.
    pub names: Vec<String>,
}

/// What to do about letters for which a state has no edge.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Gaps {
    /// They are an error.
    Refuse,
    /// They lead to a state of the name [`SINK_NAME`], added as the last one if there is such a letter, from which nothing is
    /// accepted.
    Sink,
}

impl Ldgba {
    /// Checks `parts` and completes what may be completed: edges of a state with the same target and marks become one; ε-jumps are
    /// sorted and kept once; acceptance without sets becomes one set to which every given edge belongs; sinks (Definition 3) and Q_D
    /// are computed.
    ///
    /// # Errors
    /// [`LdgbaError`] names the first invariant that does not hold, and where.
    pub fn new(parts: LdgbaParts, gaps: Gaps) -> Result<Ldgba, LdgbaError> {
        let LdgbaParts { propositions, initial, sets, edges, mut epsilon, mut names } = parts;
        let count = edges.len();
        check_numbers(count, sets, initial, &epsilon, &names)?;
        epsilon.resize(count, Vec::new());
        names.resize(count, String::new());
        for targets in &mut epsilon {
            targets.sort_unstable();
            targets.dedup();
        }

        let effort = &mut Effort::default();
        let mut lists = Vec::with_capacity(count + 1);
        let mut holes = Vec::new();
        for (q, list) in edges.into_iter().enumerate() {
            let state = q as StateId;
            check_edges(state, &list, count, sets, propositions.len())?;
            let complex = |cause| LdgbaError::Complex { state, cause };
            let list = merge(list, sets, effort).map_err(complex)?;
            let all = Guard(list.iter().flat_map(|(guard, _)| guard.0.iter().copied()).collect());
            let missing = all.missing(effort).map_err(complex)?;
            let rest = if missing.is_some() { all.complement(effort).map_err(complex)? } else { Guard::never() };
            if !fill(&[&all.0, &rest.0], propositions.len()) {
                check_disjoint(state, &list, effort)?;
            }
            if let Some(letter) = missing {
                match gaps {
                    Gaps::Refuse => return Err(LdgbaError::Incomplete { state, letter }),
                    Gaps::Sink => holes.push((q, rest)),
                }
            }
            lists.push(list);
        }
        if !holes.is_empty() {
            let sink = Edge { target: count as StateId, marks: Marks::NONE };
            for (q, guard) in holes {
                lists[q].push((guard, sink));
            }
            lists.push(vec![(Guard::any(), sink)]);
            epsilon.push(Vec::new());
            names.push(SINK_NAME.into());
        }
        if lists.len() > MAX_STATES {
            return Err(LdgbaError::TooManyStates { found: lists.len() });
        }
        let (sinks, deterministic) = (Vec::new(), Vec::new());
        let mut automaton =
            Ldgba { propositions, initial, sets: sets.max(1), edges: lists, epsilon, sinks, deterministic, names };
        automaton.analyse()?;
        Ok(automaton)
    }

    /// Computes the sinks and Q_D, and checks limit-determinism.
    fn analyse(&mut self) -> Result<(), LdgbaError> {
        let successors = self.successors();
        let jumps: Vec<bool> = self.states().map(|q| !self.epsilon(q).is_empty()).collect();
        self.deterministic = can_reach(&successors, &jumps).into_iter().map(|reaches| !reaches).collect();
        for from in self.states() {
            if let Some(&to) = self.epsilon(from).iter().find(|to| !self.is_deterministic(**to)) {
                return Err(LdgbaError::EpsilonOutsideDeterministicPart { from, to });
            }
        }
        let accepting = self.in_accepting_component(&successors);
        if let Some(state) = self.states().find(|q| accepting[*q as usize] && !self.is_deterministic(*q)) {
            return Err(LdgbaError::NotLimitDeterministic { state });
        }
        self.sinks = can_reach(&successors, &accepting).into_iter().map(|reaches| !reaches).collect();
        Ok(())
    }

    /// Per state, where its edges and ε-jumps lead.
    pub(super) fn successors(&self) -> Vec<Vec<usize>> {
        let targets = |q: StateId| self.edges(q).iter().map(|(_, edge)| edge.target).chain(self.epsilon(q).iter().copied());
        self.states().map(|q| targets(q).map(usize::from).collect()).collect()
    }

    /// Per state, whether it lies in a strongly connected component whose inner edges together belong to all accepting sets.
    fn in_accepting_component(&self, successors: &[Vec<usize>]) -> Vec<bool> {
        let found = components(successors);
        let mut marks = vec![Marks::NONE; found.count];
        for q in self.states() {
            let own = found.of[q as usize];
            for (_, edge) in self.edges(q) {
                if found.of[edge.target as usize] == own {
                    marks[own] = marks[own].union(edge.marks);
                }
            }
        }
        found.of.iter().map(|component| marks[*component] == self.all_sets()).collect()
    }
}

fn check_numbers(
    count: usize,
    sets: usize,
    initial: StateId,
    epsilon: &[Vec<StateId>],
    names: &[String],
) -> Result<(), LdgbaError> {
    if count == 0 {
        return Err(LdgbaError::NoStates);
    }
    if count > MAX_STATES {
        return Err(LdgbaError::TooManyStates { found: count });
    }
    if sets > MAX_SETS {
        return Err(LdgbaError::TooManySets { found: sets });
    }
    let lists = [epsilon.len(), names.len()].into_iter().map(|len| len.saturating_sub(1));
    let targets = epsilon.iter().flatten().map(|q| usize::from(*q));
    match lists.chain(targets).chain([usize::from(initial)]).find(|q| *q >= count) {
        Some(state) => Err(LdgbaError::NoSuchState { state, count }),
        None => Ok(()),
    }
}

fn check_edges(
    state: StateId,
    edges: &[(Guard, Edge)],
    count: usize,
    sets: usize,
    propositions: usize,
) -> Result<(), LdgbaError> {
    for (guard, edge) in edges {
        let last = |bits: u64| 63 - bits.leading_zeros() as usize;
        if usize::from(edge.target) >= count {
            return Err(LdgbaError::NoSuchState { state: edge.target.into(), count });
        }
        if edge.marks.0 != 0 && last(edge.marks.0.into()) >= sets {
            return Err(LdgbaError::NoSuchSet { state, set: last(edge.marks.0.into()), count: sets });
        }
        if guard.support() != 0 && last(guard.support()) >= propositions {
            return Err(LdgbaError::NoSuchProposition { state, proposition: last(guard.support()), count: propositions });
        }
    }
    Ok(())
}

/// One guard per target and marks, in the order of first appearance; the marks of acceptance without sets are put on.
fn merge(list: Vec<(Guard, Edge)>, sets: usize, effort: &mut Effort) -> Result<Vec<(Guard, Edge)>, TooComplex> {
    let mut order: Vec<Edge> = Vec::new();
    let mut cubes: std::collections::HashMap<Edge, Vec<_>> = std::collections::HashMap::new();
    for (guard, mut edge) in list {
        if sets == 0 {
            edge.marks = Marks(1);
        }
        if guard.is_empty() {
            continue;
        }
        let entry = cubes.entry(edge).or_default();
        if entry.is_empty() {
            order.push(edge);
        }
        entry.extend(guard.0);
    }
    let mut merged = Vec::with_capacity(order.len());
    for edge in order {
        let guard = Guard(cubes.remove(&edge).expect("every edge in `order` has an entry"));
        merged.push((guard.or(&Guard::never(), effort)?, edge));
    }
    Ok(merged)
}

fn check_disjoint(state: StateId, list: &[(Guard, Edge)], effort: &mut Effort) -> Result<(), LdgbaError> {
    for (i, (guard, edge)) in list.iter().enumerate() {
        for (other_guard, other) in &list[..i] {
            let overlap = guard.overlap(other_guard, effort).map_err(|cause| LdgbaError::Complex { state, cause })?;
            if let Some(letter) = overlap {
                return Err(LdgbaError::Overlap { state, letter, first: other.target, second: edge.target });
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::guard::Cube;
    use super::*;
    use crate::labels::Labels;
    use crate::ltl::Lasso;

    fn edge(target: StateId, marks: u32) -> Edge {
        Edge { target, marks: Marks(marks) }
    }

    fn literal(index: usize, value: bool) -> Guard {
        Guard(vec![Cube::literal(index, value)])
    }

    /// F G a by one jump: state 0 waits, state 1 needs `a` for ever.
    fn eventually_always() -> LdgbaParts {
        LdgbaParts {
            propositions: Propositions::new(["a"]).unwrap(),
            initial: 0,
            sets: 1,
            edges: vec![vec![(Guard::any(), edge(0, 0))], vec![(literal(0, true), edge(1, 1))]],
            epsilon: vec![vec![1]],
            names: vec![],
        }
    }

    #[test]
    fn missing_edges_lead_to_a_sink() {
        let automaton = Ldgba::new(eventually_always(), Gaps::Sink).unwrap();
        assert_eq!(automaton.len(), 3);
        assert_eq!(automaton.edge(1, Labels(0)), edge(2, 0));
        assert_eq!(automaton.edge(1, Labels(1)), edge(1, 1));
        assert_eq!(automaton.name(2), SINK_NAME);
        assert_eq!(automaton.states().map(|q| automaton.is_sink(q)).collect::<Vec<_>>(), [false, false, true]);
        assert_eq!(automaton.states().map(|q| automaton.is_deterministic(q)).collect::<Vec<_>>(), [false, true, true]);
        let refused = Ldgba::new(eventually_always(), Gaps::Refuse);
        assert_eq!(refused, Err(LdgbaError::Incomplete { state: 1, letter: Labels(0) }));
    }

    #[test]
    fn jumps_are_taken_when_that_helps() {
        let automaton = Ldgba::new(eventually_always(), Gaps::Sink).unwrap();
        let word = |prefix: &[u64], cycle: &[u64]| Lasso {
            prefix: prefix.iter().map(|l| Labels(*l)).collect(),
            cycle: cycle.iter().map(|l| Labels(*l)).collect(),
        };
        assert!(automaton.accepts(&word(&[0, 1, 0], &[1])));
        assert!(automaton.accepts(&word(&[], &[1, 1])));
        assert!(!automaton.accepts(&word(&[1, 1], &[0])));
        assert!(!automaton.accepts(&word(&[1], &[1, 0])));
    }

    #[test]
    fn what_is_no_limit_deterministic_automaton_is_refused() {
        let mut overlap = eventually_always();
        overlap.edges[1].push((Guard::any(), edge(0, 0)));
        assert!(matches!(Ldgba::new(overlap, Gaps::Sink), Err(LdgbaError::Overlap { state: 1, .. })));

        let mut chain = eventually_always();
        chain.epsilon = vec![vec![1], vec![0]];
        let refused = Ldgba::new(chain, Gaps::Sink);
        assert!(matches!(refused, Err(LdgbaError::EpsilonOutsideDeterministicPart { from: 0, to: 1 })), "{refused:?}");

        let mut early = eventually_always();
        early.edges[0][0].1.marks = Marks(1);
        assert_eq!(Ldgba::new(early, Gaps::Sink), Err(LdgbaError::NotLimitDeterministic { state: 0 }));

        let mut set = eventually_always();
        set.edges[1][0].1.marks = Marks(4);
        assert_eq!(Ldgba::new(set, Gaps::Sink), Err(LdgbaError::NoSuchSet { state: 1, set: 2, count: 1 }));

        let mut target = eventually_always();
        target.epsilon = vec![vec![7]];
        assert_eq!(Ldgba::new(target, Gaps::Sink), Err(LdgbaError::NoSuchState { state: 7, count: 2 }));

        let mut proposition = eventually_always();
        proposition.edges[1][0].0 = literal(3, true);
        let refused = Ldgba::new(proposition, Gaps::Sink);
        assert_eq!(refused, Err(LdgbaError::NoSuchProposition { state: 1, proposition: 3, count: 1 }));
    }

    #[test]
    fn acceptance_without_sets_becomes_one_set_on_every_given_edge() {
        let mut safety = eventually_always();
        (safety.sets, safety.initial, safety.epsilon) = (0, 1, vec![]);
        safety.edges[1][0].1.marks = Marks(0);
        let automaton = Ldgba::new(safety, Gaps::Sink).unwrap();
        assert_eq!((automaton.sets(), automaton.edge(1, Labels(1)).marks), (1, Marks(1)));
        assert_eq!(automaton.edge(1, Labels(0)).marks, Marks(0));
        assert!(automaton.is_sink(2) && !automaton.is_sink(0));
    }
}
