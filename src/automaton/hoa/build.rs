//! From a checked, partitioned automaton to the limit-deterministic one that the rest of the program uses.

use super::super::construct::{Gaps, LdgbaParts, SINK_NAME};
use super::super::guard::Guard;
use super::super::ldgba::{Edge, Ldgba, Marks, StateId};
use super::super::ldgba_error::LdgbaError;
use super::check::{Notes, check};
use super::error::{Fault, HoaErrorKind};
use super::jumps::{Node, Resolved, resolve};
use super::label::too_complex;
use super::limit::{Partition, partition};
use super::nba::Nba;
use super::syntax::Document;

/// Checks `document` and makes an automaton of it.
pub(super) fn build(document: &Document, notes: &mut Notes) -> Result<Ldgba, Fault> {
    let (nba, mut labeller) = check(document, notes)?;
    let part = partition(&nba, document, &mut labeller, notes)?;
    let parts = match nba.starts[..] {
        [] => empty_language(nba),
        [start] if part.deterministic[start] && part.deterministic.iter().all(|d| *d) => as_given(nba, part, start),
        _ => {
            let resolved = resolve(&part, &nba.starts, &mut labeller.effort)
                .map_err(|cause| too_complex(document.span)(cause).hint("resolving the non-determinism takes too many states"))?;
            notes.extend(remark(document, &nba, &part, &resolved));
            from_nodes(nba, resolved)
        }
    };
    Ldgba::new(parts, Gaps::Sink).map_err(|error| refused(document, error))
}

/// The automaton of no word: one sink. The states of the file cannot be reached.
fn empty_language(nba: Nba) -> LdgbaParts {
    LdgbaParts {
        propositions: nba.propositions,
        initial: 0,
        sets: nba.sets,
        edges: vec![vec![(Guard::any(), Edge { target: 0, marks: Marks::NONE })]],
        epsilon: vec![],
        names: vec![SINK_NAME.into()],
    }
}

/// A deterministic automaton keeps its states and their numbers.
fn as_given(nba: Nba, part: Partition, start: usize) -> LdgbaParts {
    let edge = |target: usize, marks| Edge { target: target as StateId, marks };
    let edges = part
        .classes
        .into_iter()
        .map(|list| list.into_iter().map(|class| (class.guard, edge(class.targets[0].0, class.targets[0].1))).collect())
        .collect();
    LdgbaParts {
        propositions: nba.propositions,
        initial: start as StateId,
        sets: nba.sets,
        edges,
        epsilon: vec![],
        names: nba.states.into_iter().map(|state| state.name).collect(),
    }
}

/// States of the file come first, in their order; sets and split states follow in the order of discovery.
fn from_nodes(nba: Nba, resolved: Resolved) -> LdgbaParts {
    let Resolved { nodes, start, edges, epsilon, .. } = resolved;
    let original = |node: &Node| match (&node.0[..], &node.1[..]) {
        ([state], []) | ([], [state]) => Some(*state),
        _ => None,
    };
    let mut order: Vec<usize> = (0..nodes.len()).collect();
    order.sort_by_key(|i| (original(&nodes[*i]).unwrap_or(usize::MAX), *i));
    let mut number = vec![0 as StateId; nodes.len()];
    for (position, node) in order.iter().enumerate() {
        number[*node] = position as StateId;
    }
    let target = |node: usize, marks| Edge { target: number[node], marks };
    let mut lists: Vec<_> = edges.into_iter().map(Some).collect();
    LdgbaParts {
        propositions: nba.propositions.clone(),
        initial: number[start],
        sets: nba.sets,
        edges: order
            .iter()
            .map(|i| {
                let list = lists[*i].take().expect("every node stands once in the order");
                list.into_iter().map(|(guard, node, marks)| (guard, target(node, marks))).collect()
            })
            .collect(),
        epsilon: order.iter().map(|i| epsilon[*i].iter().map(|node| number[*node]).collect()).collect(),
        names: order.iter().map(|i| name(&nba, &nodes[*i])).collect(),
    }
}

/// A state of the file keeps its name; a set, or a state with offers, is named after its parts.
fn name(nba: &Nba, node: &Node) -> String {
    let of = |q: &usize| if nba.states[*q].name.is_empty() { q.to_string() } else { nba.states[*q].name.clone() };
    let list = |states: &[usize]| states.iter().map(of).collect::<Vec<_>>().join(", ");
    match (&node.0[..], &node.1[..]) {
        ([state], []) | ([], [state]) => nba.states[*state].name.clone(),
        (set, []) => format!("{{{}}}", list(set)),
        (set, offered) => format!("{{{}}} or {}", list(set), offered.iter().map(of).collect::<Vec<_>>().join(" or ")),
    }
}

/// How the non-determinism was read.
fn remark(document: &Document, nba: &Nba, part: &Partition, resolved: &Resolved) -> Notes {
    let mut notes = Notes::new();
    let choices = part.deterministic.iter().filter(|d| !**d).count();
    let mut text = match choices {
        0 => "several initial states are read as ε-jumps".to_owned(),
        _ => format!("not deterministic: {choices} of {} states have or lead to choices, read as ε-jumps", nba.states.len()),
    };
    let made = resolved.nodes.iter().filter(|(set, offered)| set.len() + offered.len() > 1).count();
    if made > 0 {
        text += &format!("; {made} more states remember which jumps the last letter offered");
    }
    text += "; unless the automaton was made for Markov decision processes, it may lose probability";
    notes.push((document.span, text));
    if let Some(&n) = resolved.early.first() {
        let text = format!("the jumps of state {n} are taken before the letter that they belong to");
        notes.push((nba.states[n].span, text));
    }
    notes
}

fn refused(document: &Document, error: LdgbaError) -> Fault {
    let kind = match error {
        LdgbaError::TooManyStates { .. } | LdgbaError::TooManySets { .. } => HoaErrorKind::Limit,
        LdgbaError::Complex { .. } => HoaErrorKind::TooComplex,
        _ => HoaErrorKind::NotLimitDeterministic,
    };
    Fault::new(kind, document.span, error.to_string())
}
