//! Deterministic automata for simple formulas: safety, co-safety, recurrence; and their product.

use super::graph::{Arrow, Graph, MarkSet, Numbering, State, merge_edges};
use super::unfold::Unfolding;
use super::work::Stop;
use crate::bdd::Bdd;
use crate::ltl::NodeId;

/// A safety formula, given by its raw diagram: track it; every run that never becomes `false` is accepting (no accepting set).
///
/// Section 4 of [Esparza, Křetínský & Sickert](crate::bib::Esparza2020), theorem on νLTL.
pub(super) fn safety(u: &mut Unfolding<'_>, raw: Bdd) -> Result<Graph, Stop> {
    track(u, raw, 0)
}

/// A co-safety formula, given by its raw diagram: track it; once it is `true`, everything is accepted (one accepting set).
///
/// Section 4 of [Esparza, Křetínský & Sickert](crate::bib::Esparza2020), theorem on μLTL.
pub(super) fn co_safety(u: &mut Unfolding<'_>, raw: Bdd) -> Result<Graph, Stop> {
    track(u, raw, 1)
}

fn track(u: &mut Unfolding<'_>, raw: Bdd, sets: usize) -> Result<Graph, Stop> {
    let initial = u.unfold_raw(raw)?;
    let mut numbering = Numbering::new();
    numbering.number(initial, &mut u.work)?;
    let mut graph = Graph { states: Vec::new(), initial: 0, sets };
    while let Some(&state) = numbering.get(graph.states.len()) {
        let mut edges = Vec::new();
        for &(guard, raw) in u.steps(state)?.iter() {
            let next = u.unfold_raw(raw)?;
            if next != Bdd::FALSE {
                let marks = if next == Bdd::TRUE { MarkSet::from(sets == 1) } else { 0 };
                edges.push(Arrow { guard, target: numbering.number(next, &mut u.work)?, marks });
            }
        }
        let edges = merge_edges(&mut u.bdd, edges)?;
        graph.states.push(State { edges, left: vec![state], ..State::default() });
    }
    Ok(graph)
}

/// `G F χ` for a co-safety χ: run F χ; when it becomes `true`, mark the edge and start again, with the letter just read if that is enough
/// to begin with, else with the next one (one accepting set).
///
/// Section 4 of [Esparza, Křetínský & Sickert](crate::bib::Esparza2020), theorem on GF(μLTL).
pub(super) fn recurrence(u: &mut Unfolding<'_>, chi: NodeId) -> Result<Graph, Stop> {
    let goal = u.store.finally(chi);
    let start = u.unfold(goal)?;
    let again = u.store.globally(goal);
    let again = u.raw(again)?;
    let again = u.unfold_raw(again)?;
    let mut numbering = Numbering::new();
    numbering.number(start, &mut u.work)?;
    let mut graph = Graph { states: Vec::new(), initial: 0, sets: 1 };
    while let Some(&state) = numbering.get(graph.states.len()) {
        let mut edges = Vec::new();
        for &(guard, raw) in u.steps(state)?.iter() {
            let next = u.unfold_raw(raw)?;
            if next != Bdd::TRUE {
                edges.push(Arrow { guard, target: numbering.number(next, &mut u.work)?, marks: 0 });
                continue;
            }
            // The letter that completes one round may already begin the next.
            for &(again, raw) in u.steps(start)?.iter() {
                let guard = u.bdd.and(guard, again)?;
                if guard != Bdd::FALSE {
                    let next = u.unfold_raw(raw)?;
                    let next = if next == Bdd::TRUE { start } else { next };
                    edges.push(Arrow { guard, target: numbering.number(next, &mut u.work)?, marks: 1 });
                }
            }
        }
        let edges = merge_edges(&mut u.bdd, edges)?;
        let left = if state == start { vec![again] } else { vec![again, state] };
        graph.states.push(State { edges, left, ..State::default() });
    }
    Ok(graph)
}

/// The intersection of two automata of which at most one has ε-jumps: pairs of states; the sets of `right` come behind those of `left`.
///
/// A jump of one side leaves the other where it is. Where a jump is still to come, marks say nothing and are dropped.
pub(super) fn product(u: &mut Unfolding<'_>, left: &Graph, right: &Graph) -> Result<Graph, Stop> {
    let sets = left.sets + right.sets;
    if sets > 60 {
        return Err(Stop::Sets(sets));
    }
    let waits = [before_a_jump(left), before_a_jump(right)];
    let mut numbering = Numbering::new();
    numbering.number((left.initial, right.initial), &mut u.work)?;
    let mut graph = Graph { states: Vec::new(), initial: 0, sets };
    while let Some(&(p, q)) = numbering.get(graph.states.len()) {
        let (a, b) = (&left.states[p], &right.states[q]);
        let mut edges = Vec::new();
        for one in &a.edges {
            for two in &b.edges {
                let guard = u.bdd.and(one.guard, two.guard)?;
                if guard == Bdd::FALSE {
                    continue;
                }
                let marks = if waits[0][p] || waits[1][q] { 0 } else { one.marks | two.marks << left.sets };
                edges.push(Arrow { guard, target: numbering.number((one.target, two.target), &mut u.work)?, marks });
            }
        }
        let edges = merge_edges(&mut u.bdd, edges)?;
        let mut jumps = Vec::new();
        for &target in &a.jumps {
            jumps.push(numbering.number((target, q), &mut u.work)?);
        }
        for &target in &b.jumps {
            jumps.push(numbering.number((p, target), &mut u.work)?);
        }
        graph.states.push(State { edges, jumps, left: [&a.left[..], &b.left[..]].concat() });
    }
    Ok(graph)
}

/// Per state whether a state with ε-jumps can be reached from it.
pub(super) fn before_a_jump(graph: &Graph) -> Vec<bool> {
    let goal: Vec<bool> = graph.states.iter().map(|state| !state.jumps.is_empty()).collect();
    let successors: Vec<Vec<usize>> =
        graph.states.iter().map(|state| state.edges.iter().map(|edge| edge.target).collect()).collect();
    crate::automaton::scc::can_reach(&successors, &goal)
}
