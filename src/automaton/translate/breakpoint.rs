//! The breakpoint construction: a deterministic Büchi automaton for any Π₂ formula.
//!
//! A state is a pair (all, rej): `all` is what is left of the formula, `rej` the obligations of co-safety kind that were open at the last
//! breakpoint and are not yet met. When `rej` becomes `true`, the edge is marked, and the obligations open now take its place: what is left,
//! with every atom that is not co-safety replaced by `true`. Finite atoms are replaced too, unless the formula keeps producing them
//! ([`protected`]): `all` looks after them.
//!
//! The idea: section 5 of [Esparza, Křetínský & Sickert](crate::bib::Esparza2020) (fGF and the breakpoint for Π₂); S. Miyano, T. Hayashi:
//! *Alternating Finite Automata on ω-Words*, 1984.

use super::graph::{Arrow, Graph, Numbering, State, merge_edges};
use super::unfold::Unfolding;
use super::work::Stop;
use crate::bdd::Bdd;
use crate::ltl::{Node, NodeId};
use std::collections::BTreeSet;

/// From what the obligations open now are taken.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Renewal {
    /// From the raw successor, before it is unfolded: fewer different sets of obligations.
    Raw,
    /// From the unfolded successor: obligations may be met by the very next letter.
    Unfolded,
}

/// A pair (all, rej).
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct Pair {
    pub all: Bdd,
    pub rej: Bdd,
}

/// The automaton for the formula with the raw diagram `raw`; one accepting set.
pub(super) fn breakpoint(u: &mut Unfolding<'_>, raw: Bdd, renewal: Renewal) -> Result<Graph, Stop> {
    let all = u.unfold_raw(raw)?;
    let rej = obligations(u, raw, all, renewal)?;
    let mut numbering = Numbering::new();
    numbering.number(Pair { all, rej }, &mut u.work)?;
    let mut graph = Graph { states: Vec::new(), initial: 0, sets: 1 };
    while let Some(&pair) = numbering.get(graph.states.len()) {
        let mut edges = Vec::new();
        for (guard, next, marked) in successors(u, pair, renewal)? {
            edges.push(Arrow { guard, target: numbering.number(next, &mut u.work)?, marks: u64::from(marked) });
        }
        let edges = merge_edges(&mut u.bdd, edges)?;
        graph.states.push(State { edges, left: vec![pair.all], ..State::default() });
    }
    Ok(graph)
}

/// The successors of a pair: letters, next pair, and whether this is a breakpoint.
pub(super) fn successors(u: &mut Unfolding<'_>, pair: Pair, renewal: Renewal) -> Result<Vec<(Bdd, Pair, bool)>, Stop> {
    let mut found = Vec::new();
    for &(guard, raw) in u.steps(pair.all)?.iter() {
        let all = u.unfold_raw(raw)?;
        if all == Bdd::FALSE {
            continue;
        }
        for &(part, raw_rej) in u.steps(pair.rej)?.iter() {
            let guard = u.bdd.and(guard, part)?;
            if guard == Bdd::FALSE {
                continue;
            }
            let rej = u.unfold_raw(raw_rej)?;
            let met = rej == Bdd::TRUE;
            let rej = if met { obligations(u, raw, all, renewal)? } else { rej };
            found.push((guard, Pair { all, rej }, met));
        }
    }
    Ok(found)
}

/// The co-safety obligations of what is left.
pub(super) fn obligations(u: &mut Unfolding<'_>, raw: Bdd, all: Bdd, renewal: Renewal) -> Result<Bdd, Stop> {
    let from = match renewal {
        Renewal::Raw => raw,
        Renewal::Unfolded => all,
    };
    let atoms = u.atoms(from);
    let pending = |id: NodeId, u: &Unfolding<'_>| u.store.traits(id).is_co_safety() && !u.store.traits(id).is_finite();
    if !atoms.iter().any(|id| pending(*id, u)) {
        return Ok(Bdd::TRUE);
    }
    let kept = protected(u, &atoms);
    let open = u.replace(from, |u, id| {
        let stays = pending(id, u) || u.store.traits(id).is_finite() && kept.contains(&id);
        if stays { u.raw(id) } else { Ok(Bdd::TRUE) }
    })?;
    match renewal {
        Renewal::Raw => u.unfold_raw(open),
        Renewal::Unfolded => Ok(open),
    }
}

/// The finite formulas that stand under X inside a fixpoint among `atoms`, so that they come back for ever.
pub(super) fn protected(u: &Unfolding<'_>, atoms: &[NodeId]) -> BTreeSet<NodeId> {
    let mut found = BTreeSet::new();
    let mut seen = BTreeSet::new();
    let mut open: Vec<NodeId> = atoms.iter().copied().filter(|id| !u.store.traits(*id).is_finite()).collect();
    while let Some(id) = open.pop() {
        if !seen.insert(id) {
            continue;
        }
        let node = u.store.node(id);
        if let Node::Next(a) = node {
            leaves(u, *a, &mut found);
        }
        open.extend(node.operands());
    }
    found
}

/// The finite atoms of N(ψ).
fn leaves(u: &Unfolding<'_>, id: NodeId, found: &mut BTreeSet<NodeId>) {
    match u.store.node(id) {
        Node::And(list) | Node::Or(list) => list.iter().for_each(|part| leaves(u, *part, found)),
        _ if u.store.traits(id).is_finite() => {
            found.insert(id);
        }
        _ => {}
    }
}
