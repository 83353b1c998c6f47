//! From the automaton under construction to a checked [`Ldgba`].

use super::exclusive::first_holds;
use super::graph::Graph;
use super::options::{TranslateError, TranslateErrorKind};
use super::unfold::Unfolding;
use crate::automaton::construct::{Gaps, LdgbaParts, MAX_SETS};
use crate::automaton::guard::{Cube, Guard};
use crate::automaton::ldgba::{Edge, Ldgba, Marks, StateId};
use crate::bdd::{Bdd, Exhausted, Manager, Substitution};
use crate::labels::Propositions;

/// The checked automaton. Letters without an edge lead to a sink.
pub(super) fn automaton(u: &mut Unfolding<'_>, graph: Graph, propositions: Propositions) -> Result<Ldgba, TranslateError> {
    if graph.sets > MAX_SETS {
        return Err(TranslateError::new(TranslateErrorKind::Sets { found: graph.sets }));
    }
    let exhausted = |error| {
        TranslateError::new(match error {
            Exhausted::Nodes { limit } => TranslateErrorKind::Nodes { limit },
            Exhausted::Steps { limit } => TranslateErrorKind::Steps { limit },
        })
    };
    let mut widened = first_holds(&mut u.bdd, &u.exclusive).map_err(exhausted)?;
    let mut edges = Vec::new();
    for state in &graph.states {
        let mut list = Vec::new();
        for edge in &state.edges {
            let guard = guard(&mut u.bdd, edge.guard, &mut widened).map_err(exhausted)?;
            list.push((guard, Edge { target: edge.target as StateId, marks: Marks(edge.marks as u32) }));
        }
        edges.push(list);
    }
    let parts = LdgbaParts {
        propositions,
        initial: graph.initial as StateId,
        sets: graph.sets,
        edges,
        epsilon: graph.states.iter().map(|state| state.jumps.iter().map(|q| *q as StateId).collect()).collect(),
        names: graph.states.iter().map(|state| u.name(&state.left)).collect(),
    };
    Ldgba::new(parts, Gaps::Sink).map_err(|error| TranslateError::new(TranslateErrorKind::Automaton(error)))
}

/// A diagram over propositions as disjoint cubes, one for every path to `true`.
fn guard(bdd: &mut Manager, f: Bdd, widened: &mut Substitution) -> Result<Guard, Exhausted> {
    let f = if widened.is_empty() { f } else { bdd.substitute(f, widened)? };
    let mut cubes = Vec::new();
    let mut open = vec![(f, Cube::ANY)];
    while let Some((g, cube)) = open.pop() {
        let Some(variable) = bdd.top(g) else {
            if g == Bdd::TRUE {
                cubes.push(cube);
            }
            continue;
        };
        let (low, high) = bdd.branches(g);
        let bit = 1u64 << variable;
        open.push((low, Cube { negative: cube.negative | bit, ..cube }));
        open.push((high, Cube { positive: cube.positive | bit, ..cube }));
    }
    Ok(Guard(cubes))
}
