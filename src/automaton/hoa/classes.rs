//! The letters of a state cut into classes, each with the one or several edges that may be taken.

use super::super::cover::tiles;
use super::super::guard::{Cube, Effort, Guard, TooComplex};
use super::super::ldgba::Marks;
use super::super::symbolic::Symbolic;
use super::nba::NbaEdge;

/// Letters that a state treats alike: no two edges of the class lead to the same state.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Class {
    pub guard: Guard,
    pub targets: Vec<(usize, Marks)>,
}

impl Class {
    /// Adds an edge. Two edges with a letter and a target in common become one with the marks of both: a run that passes them
    /// infinitely often may take either in turn, and one visit more or less does not matter.
    fn add(&mut self, target: usize, marks: Marks) {
        match self.targets.iter_mut().find(|(t, _)| *t == target) {
            Some((_, known)) => *known = known.union(marks),
            None => self.targets.push((target, marks)),
        }
    }
}

/// The classes of a state with these edges; letters without an edge are in none.
pub(super) fn classes(edges: &[NbaEdge], propositions: usize, effort: &mut Effort) -> Result<Vec<Class>, TooComplex> {
    let merged = merged(edges);
    let cubes: Vec<Cube> = merged.iter().flat_map(|(guard, _)| guard.0.iter().copied()).collect();
    if tiles(&cubes, propositions, effort)? || disjoint(&merged, effort)? {
        return Ok(merged.into_iter().map(|(guard, target)| Class { guard, targets: vec![target] }).collect());
    }
    let edges = merged.into_iter().map(|(guard, target)| Class { guard, targets: vec![target] }).collect();
    refine(edges, effort)
}

/// Cuts overlapping classes into disjoint ones, each with the targets of all that had its letters.
pub(super) fn refine(overlapping: Vec<Class>, effort: &mut Effort) -> Result<Vec<Class>, TooComplex> {
    let mut symbolic = Symbolic::new();
    let sets = overlapping.iter().map(|class| symbolic.letters(&class.guard)).collect::<Result<Vec<_>, _>>()?;
    let mut refined = Vec::new();
    for (letters, members) in symbolic.classes(&sets, effort)? {
        let mut class = Class { guard: symbolic.guard(letters, effort)?, targets: Vec::new() };
        for (target, marks) in members.iter().flat_map(|member| &overlapping[*member].targets) {
            class.add(*target, *marks);
        }
        refined.push(class);
    }
    Ok(refined)
}

/// One guard per target and marks, in the order of first appearance.
pub(super) fn merged(edges: &[NbaEdge]) -> Vec<(Guard, (usize, Marks))> {
    let mut merged: Vec<(Guard, (usize, Marks))> = Vec::new();
    let mut index = std::collections::HashMap::new();
    for edge in edges {
        let target = (edge.target, edge.marks);
        let position = *index.entry(target).or_insert_with(|| {
            merged.push((Guard::never(), target));
            merged.len() - 1
        });
        let cubes: &mut Vec<Cube> = &mut merged[position].0.0;
        cubes.extend(edge.guard.0.iter().copied());
    }
    merged
}

fn disjoint(edges: &[(Guard, (usize, Marks))], effort: &mut Effort) -> Result<bool, TooComplex> {
    for (i, (guard, _)) in edges.iter().enumerate() {
        for (other, _) in &edges[..i] {
            if guard.overlap(other, effort)?.is_some() {
                return Ok(false);
            }
        }
    }
    Ok(true)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::labels::Labels;
    use crate::ltl::Span;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_letter_keeps_its_targets(edges in proptest::collection::vec((0u64..8, 0u64..8, 0usize..4, 0u32..4), 0..6)) {
            let span = Span { start: 0, end: 0 };
            let edges: Vec<NbaEdge> = edges
                .into_iter()
                .map(|(p, n, target, marks)| {
                    NbaEdge { guard: Guard(vec![Cube { positive: p, negative: n & !p }]), target, marks: Marks(marks), span }
                })
                .collect();
            let found = classes(&edges, 3, &mut Effort::default()).unwrap();
            for sigma in (0..8).map(Labels) {
                let mut expected: Vec<(usize, u32)> = Vec::new();
                for edge in edges.iter().filter(|edge| edge.guard.contains(sigma)) {
                    match expected.iter_mut().find(|(t, _)| *t == edge.target) {
                        Some((_, marks)) => *marks |= edge.marks.0,
                        None => expected.push((edge.target, edge.marks.0)),
                    }
                }
                let mut here = found.iter().filter(|class| class.guard.contains(sigma));
                let mut actual: Vec<(usize, u32)> =
                    here.next().map(|class| class.targets.iter().map(|(t, m)| (*t, m.0)).collect()).unwrap_or_default();
                prop_assert!(here.next().is_none());
                expected.sort();
                actual.sort();
                prop_assert_eq!(actual, expected);
            }
        }
    }
}
