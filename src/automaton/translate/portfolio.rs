//! Several constructions for one formula, of which the smallest result is kept.
//!
//! Smallest: fewest states, then fewest jumps, then fewest accepting sets, then fewest edges; on request, any without jumps before any with. In
//! case of a tie the earlier attempt wins, so the result does not depend on anything but the formula.

use super::asymmetric::Layout;
use super::breakpoint::{Renewal, breakpoint};
use super::graph::Graph;
use super::limit::{Guess, limit_deterministic};
use super::options::{Construction, Preference};
use super::pieces::{co_safety, product, recurrence, safety};
use super::reduce::reduced;
use super::target::{Together, recurring, trivial};
use super::together::{MOST_EDGES, Piece, beside_one_another};
use super::unfold::Unfolding;
use super::work::Stop;
use crate::bdd::Bdd;
use crate::ltl::{Node, NodeId, Traits};

/// What is compared.
fn size(graph: &Graph, prefer: Preference) -> (bool, usize, usize, usize, usize) {
    let guesses = prefer == Preference::Deterministic && graph.jumps() > 0;
    (guesses, graph.states.len(), graph.jumps(), graph.sets, graph.edges())
}

/// The best attempt so far, and why others failed.
struct Best {
    graph: Option<Graph>,
    /// The first failure, and the subformula it happened at.
    stop: Option<(Stop, NodeId)>,
}

impl Best {
    /// Takes the result of one attempt. Only cancellation is passed on: a budget that ran out may not matter.
    fn offer(&mut self, u: &mut Unfolding<'_>, attempt: Result<Graph, Stop>) -> Result<(), Stop> {
        let attempt = attempt.and_then(|graph| reduced(u, graph));
        match attempt {
            Err(Stop::Cancelled) => return Err(Stop::Cancelled),
            Err(stop) => {
                self.stop.get_or_insert((stop, u.focus));
            }
            Ok(graph) => {
                if self.graph.as_ref().is_none_or(|best| size(&graph, u.prefer) < size(best, u.prefer)) {
                    self.graph = Some(graph);
                }
            }
        }
        Ok(())
    }

    /// Whether nothing can be smaller.
    fn is_minimal(&self) -> bool {
        self.graph.as_ref().is_some_and(|graph| graph.states.len() == 1 && graph.jumps() == 0)
    }

    fn result(self, u: &mut Unfolding<'_>) -> Result<Graph, Stop> {
        self.graph.ok_or_else(|| match self.stop {
            Some((stop, focus)) => {
                u.focus = focus;
                stop
            }
            None => unreachable!("every attempt either succeeds or fails"),
        })
    }
}

/// About how many fixpoints an attempt may guess that competes with a result: each doubles the work, and rarely pays beyond this.
const GUESSES_TO_COMPETE: usize = 7;
/// How many steps on diagrams an attempt may take that competes with a result, and how many all of them together.
const STEPS_TO_COMPETE: u64 = 80_000;
const STEPS_OF_COMPETITION: u64 = 120_000;
/// How many it may take while there is no result: more would be longer than the reader of a page likes to wait.
const STEPS_TO_START: u64 = 120_000;

/// From how many suffix-invariant subformulas on pieces are tried before the whole.
const MANY_INVARIANTS: usize = 6;

/// How many states an attempt may make that competes with a result of `best` states.
fn allowance(u: &Unfolding<'_>, best: &Best) -> usize {
    let limit = u.work.budget().states;
    best.graph.as_ref().map_or(limit, |graph| limit.min(60 + 12 * graph.states.len()))
}

/// The smallest automaton that any of the constructions gives for `formula`.
pub(super) fn smallest(u: &mut Unfolding<'_>, formula: NodeId) -> Result<Graph, Stop> {
    let mut best = Best { graph: None, stop: None };
    u.focus = formula;
    let parts = conjuncts(u, formula);
    let (easy, hard): (Vec<NodeId>, Vec<NodeId>) = parts.iter().partition(|id| u.store.traits(**id).pi <= 2);
    if u.construction != Construction::All {
        // Nothing but jumps.
    } else if hard.is_empty() {
        u.work.start_attempt(u.work.budget().states, u.work.budget().guesses);
        let attempt = deterministic(u, &parts, MOST_EDGES);
        best.offer(u, attempt)?;
        if best.is_minimal() {
            return best.result(u);
        }
        for renewal in [Renewal::Raw, Renewal::Unfolded] {
            u.work.start_attempt(allowance(u, &best), 0);
            u.bdd.allow_steps(if best.graph.is_some() { STEPS_TO_COMPETE } else { u64::MAX });
            let attempt = u.raw(formula).and_then(|raw| breakpoint(u, raw, renewal));
            best.offer(u, attempt)?;
            u.bdd.allow_steps(u64::MAX);
        }
    } else if !easy.is_empty() {
        let rest = u.store.and(hard);
        let attempt = smallest(u, rest).and_then(|rest| {
            u.work.start_attempt(u.work.budget().states, u.work.budget().guesses);
            let beside = deterministic(u, &easy, MOST_EDGES)?;
            let mut beside = reduced(u, beside)?;
            if beside.edges() * rest.edges() > 8 * MOST_EDGES {
                let fewer = deterministic(u, &easy, 0)?;
                beside = reduced(u, fewer)?;
            }
            product(u, &beside, &rest)
        });
        best.offer(u, attempt)?;
        u.focus = formula;
    }
    if best.is_minimal() {
        return best.result(u);
    }
    let raw = u.raw(formula)?;
    // Whether several recurrences that need memory stand beside one another: only then can a round robin be smaller.
    let mut has_memory = false;
    let mut order = GUESSES;
    if u.variables_with(raw, Traits::is_suffix_invariant).len() >= MANY_INVARIANTS {
        order.swap(0, 1);
    }
    // At first every attempt gets little; if none of them comes to an end with that, as much as there is.
    for patience in [STEPS_TO_START, 8 * STEPS_TO_START, u64::MAX] {
        best.stop = None;
        let mut competition = STEPS_OF_COMPETITION;
        for (guess, together) in order {
            if !guess.is_of(u.construction) || together == Together::RoundRobin && !has_memory {
                continue;
            }
            u.work.start_attempt(
                allowance(u, &best),
                if best.graph.is_none() { u.work.budget().guesses } else { GUESSES_TO_COMPETE },
            );
            let before = u.bdd.steps_taken();
            let competes = best.graph.is_some();
            u.bdd.allow_steps(match &best.graph {
                Some(_) => STEPS_TO_COMPETE.min(competition),
                None => patience,
            });
            let attempt = limit_deterministic(u, raw, guess, together);
            let attempt = attempt.map(|(graph, memory)| {
                has_memory |= memory;
                graph
            });
            best.offer(u, attempt)?;
            u.bdd.allow_steps(u64::MAX);
            if competes {
                competition = competition.saturating_sub(u.bdd.steps_taken() - before);
            }
        }
        if best.graph.is_some() {
            break;
        }
    }
    best.result(u)
}

/// The ways to guess, in the order in which they are tried.
///
/// With many suffix-invariant subformulas the second goes first: the safety automaton of a symmetric guess tracks all combinations of them.
const GUESSES: [(Guess, Together); 8] = [
    (Guess::Symmetric, Together::Product),
    (Guess::Split, Together::Product),
    (Guess::Symmetric, Together::RoundRobin),
    (Guess::Split, Together::RoundRobin),
    (Guess::Asymmetric(Layout::Joint, Renewal::Raw), Together::Product),
    (Guess::Asymmetric(Layout::Joint, Renewal::Unfolded), Together::Product),
    (Guess::Asymmetric(Layout::Pieces, Renewal::Raw), Together::Product),
    (Guess::Asymmetric(Layout::Pieces, Renewal::Unfolded), Together::Product),
];

fn conjuncts(u: &Unfolding<'_>, formula: NodeId) -> Vec<NodeId> {
    match u.store.node(formula) {
        Node::And(list) => list.to_vec(),
        _ => vec![formula],
    }
}

/// A deterministic automaton for a conjunction of Π₂ formulas: the safety conjuncts tracked together, each `G F` and each other conjunct by an
/// automaton of its own; recurrences one after the other if it had more edges than `most_edges` otherwise.
fn deterministic(u: &mut Unfolding<'_>, parts: &[NodeId], most_edges: usize) -> Result<Graph, Stop> {
    let mut safe = Bdd::TRUE;
    let mut pieces = Vec::new();
    for &part in parts {
        u.focus = part;
        let raw = u.raw(part)?;
        let traits = u.store.traits(part);
        if traits.is_safety() {
            safe = u.bdd.and(safe, raw)?;
        } else if traits.is_co_safety() {
            pieces.push((co_safety(u, raw)?, false));
        } else if let Some(chi) = recurring(u, part) {
            pieces.push((recurrence(u, chi)?, true));
        } else {
            let mut best = Best { graph: None, stop: None };
            for renewal in [Renewal::Raw, Renewal::Unfolded] {
                let attempt = breakpoint(u, raw, renewal);
                best.offer(u, attempt)?;
            }
            pieces.push((best.result(u)?, false));
        }
    }
    let safe = if safe == Bdd::TRUE { trivial(u)? } else { safety(u, safe)? };
    let mut small = Vec::new();
    for (graph, recurs) in pieces {
        small.push(Piece { graph: reduced(u, graph)?, recurs });
    }
    beside_one_another(u, safe, &small, most_edges)
}
