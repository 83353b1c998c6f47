//! From acceptance on transitions to acceptance on states: a state for every pair of a state and the marks it is entered with.
//!
//! Marks count where a run can come back. An edge that leaves its strongly connected component is passed once, so it may enter its target with
//! any marks: with those of an edge that enters the target again, if there is one. The same goes for jumps and for the beginning.

use super::graph::{Arrow, Graph, MarkSet, Numbering, State, merge_edges};
use super::reduce::bisimulation_quotient;
use super::unfold::Unfolding;
use super::work::Stop;
use crate::automaton::scc::components;

/// An automaton in which all edges into a state carry the same marks.
pub(super) fn state_based(u: &mut Unfolding<'_>, graph: Graph) -> Result<Graph, Stop> {
    let successors: Vec<Vec<usize>> =
        graph.states.iter().map(|state| state.edges.iter().map(|edge| edge.target).collect()).collect();
    let component = components(&successors).of;
    let entry = entries(&graph, &component);
    let mut numbering = Numbering::new();
    numbering.number((graph.initial, entry[graph.initial]), &mut u.work)?;
    let mut result = Graph { states: Vec::new(), initial: 0, sets: graph.sets };
    while let Some(&(q, _)) = numbering.get(result.states.len()) {
        let state = &graph.states[q];
        let mut edges = Vec::new();
        for edge in &state.edges {
            let marks = if component[edge.target] == component[q] { edge.marks } else { entry[edge.target] };
            let target = numbering.number((edge.target, marks), &mut u.work)?;
            edges.push(Arrow { target, marks, guard: edge.guard });
        }
        let mut jumps = Vec::new();
        for &target in &state.jumps {
            jumps.push(numbering.number((target, entry[target]), &mut u.work)?);
        }
        let edges = merge_edges(&mut u.bdd, edges)?;
        result.states.push(State { edges, jumps, left: state.left.clone() });
    }
    let entered: Vec<MarkSet> = (0..numbering.len()).map(|i| numbering.get(i).expect("numbered").1).collect();
    bisimulation_quotient(u, result, |q| entered[q])
}

/// Per state the fewest marks with which an edge of its own component enters it; none if there is no such edge.
fn entries(graph: &Graph, component: &[usize]) -> Vec<MarkSet> {
    let mut entry: Vec<Option<MarkSet>> = vec![None; graph.states.len()];
    for (q, state) in graph.states.iter().enumerate() {
        for edge in state.edges.iter().filter(|edge| component[edge.target] == component[q]) {
            let known = entry[edge.target].get_or_insert(edge.marks);
            *known = (*known).min(edge.marks);
        }
    }
    entry.into_iter().map(|marks| marks.unwrap_or(0)).collect()
}
