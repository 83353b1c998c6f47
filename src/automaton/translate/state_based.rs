//! From acceptance on transitions to acceptance on states: a state for every pair of a state and the marks it is entered with.

use super::graph::{Arrow, Graph, MarkSet, Numbering, State, merge_edges};
use super::reduce::bisimulation_quotient;
use super::unfold::Unfolding;
use super::work::Stop;

/// An automaton in which all edges into a state carry the same marks. What the initial state is entered with does not matter, so it is the copy of
/// its state that some edge enters, if there is one.
pub(super) fn state_based(u: &mut Unfolding<'_>, graph: Graph) -> Result<Graph, Stop> {
    let initial = start(&graph);
    let mut numbering = Numbering::new();
    numbering.number(initial, &mut u.work)?;
    let mut result = Graph { states: Vec::new(), initial: 0, sets: graph.sets };
    while let Some(&(q, _)) = numbering.get(result.states.len()) {
        let state = &graph.states[q];
        let mut edges = Vec::new();
        for edge in &state.edges {
            let target = numbering.number((edge.target, edge.marks), &mut u.work)?;
            edges.push(Arrow { target, ..*edge });
        }
        let mut jumps = Vec::new();
        for &target in &state.jumps {
            // A jump reads no letter and enters with no marks of its own: it may lead to any copy.
            let copy = copies(&graph, target).into_iter().next().unwrap_or((target, 0));
            jumps.push(numbering.number(copy, &mut u.work)?);
        }
        let edges = merge_edges(&mut u.bdd, edges)?;
        result.states.push(State { edges, jumps, left: state.left.clone() });
    }
    let entered: Vec<MarkSet> = (0..numbering.len()).map(|i| numbering.get(i).expect("numbered").1).collect();
    bisimulation_quotient(u, result, |q| entered[q])
}

/// The pairs of `state` and the marks with which edges enter it, fewest marks first.
fn copies(graph: &Graph, state: usize) -> Vec<(usize, MarkSet)> {
    let mut marks: Vec<MarkSet> =
        graph.states.iter().flat_map(|from| &from.edges).filter(|edge| edge.target == state).map(|edge| edge.marks).collect();
    marks.sort_unstable();
    marks.dedup();
    marks.into_iter().map(|marks| (state, marks)).collect()
}

fn start(graph: &Graph) -> (usize, MarkSet) {
    copies(graph, graph.initial).into_iter().next().unwrap_or((graph.initial, 0))
}
