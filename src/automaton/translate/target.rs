//! Where an ε-jump leads: a deterministic automaton for the guess that the jump makes.

use super::breakpoint::{Pair, Renewal, breakpoint, obligations};
use super::graph::Graph;
use super::pieces::{product, recurrence};
use super::together::{MOST_EDGES, Piece, beside_one_another, round_robin};
use super::unfold::{Invariants, Unfolding};
use super::work::Stop;
use crate::bdd::Bdd;
use crate::ltl::{Node, NodeId};
use std::collections::HashMap;
use std::rc::Rc;

/// The deterministic automaton behind a jump: what is tracked, and what must happen again and again beside it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Target {
    /// What is tracked. For a safety formula `rej` stays `true`.
    pub main: Pair,
    /// How the obligations of what is tracked are renewed; `None` for a safety formula.
    pub renewal: Option<Renewal>,
    /// Formulas that hold from now on beside it, sorted; each is recognised by an automaton of its own.
    pub beside: Vec<NodeId>,
    /// The whole language, as the unfolding of a formula in which the formulas that the initial component keeps are kept.
    pub language: Bdd,
}

impl Target {
    /// The target that tracks the state `all`, with formulas `beside` it. `same` has the language of `all`, but kept formulas as they are.
    pub fn new(u: &mut Unfolding<'_>, all: Bdd, same: Bdd, beside: Vec<NodeId>, renewal: Renewal) -> Result<Target, Stop> {
        let mut language = same;
        for &formula in &beside {
            let part = u.unfold_with(formula, Invariants::Kept)?;
            language = u.bdd.and(language, part)?;
        }
        let safety = u.atoms(all).iter().all(|id| u.store.traits(*id).is_safety());
        let (rej, renewal) =
            if safety { (Bdd::TRUE, None) } else { (obligations(u, all, all, Renewal::Unfolded)?, Some(renewal)) };
        Ok(Target { main: Pair { all, rej }, renewal, beside, language })
    }
}

/// Leaves out targets whose language is empty or, as can be seen, contained in another one's. Good for MDPs: whoever jumps to the smaller
/// one can as well jump to the larger one, which is deterministic too.
pub(super) fn undominated(u: &mut Unfolding<'_>, mut targets: Vec<Target>) -> Result<Vec<Target>, Stop> {
    targets.retain(|target| target.language != Bdd::FALSE);
    targets.sort_by_key(|target| target.beside.len());
    let mut atoms: Vec<NodeId> = Vec::new();
    for target in &targets {
        atoms.extend(u.atoms(target.language));
    }
    atoms.sort_unstable();
    atoms.dedup();
    let mut kept: Vec<(Bdd, Target)> = Vec::new();
    'next: for target in targets {
        u.work.tick(kept.len() + 1)?;
        let assumed = u.with_implications(target.language, &atoms)?;
        for (_, other) in &kept {
            if u.bdd.implies(assumed, other.language)? {
                continue 'next;
            }
        }
        let mut still = Vec::with_capacity(kept.len() + 1);
        for (other_assumed, other) in kept {
            if !u.bdd.implies(other_assumed, target.language)? {
                still.push((other_assumed, other));
            }
        }
        still.push((assumed, target));
        kept = still;
    }
    Ok(kept.into_iter().map(|(_, target)| target).collect())
}

/// How several recurrences are recognised together.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Together {
    /// All at once, each with its own accepting set.
    Product,
    /// Those that need memory one after the other, with one accepting set for all of them.
    RoundRobin,
}

/// The automata for lists of formulas that stand beside what is tracked, each made once.
#[derive(Default)]
pub(super) struct Besides {
    lists: HashMap<(Vec<NodeId>, Together), usize>,
    graphs: Vec<Rc<Graph>>,
}

impl Besides {
    /// The number of the automaton for the conjunction of `list`.
    pub fn number(
        &mut self,
        u: &mut Unfolding<'_>,
        list: &[NodeId],
        together: Together,
        renewal: Renewal,
    ) -> Result<usize, Stop> {
        if let Some(&known) = self.lists.get(&(list.to_vec(), together)) {
            return Ok(known);
        }
        let graph = conjunction(u, list, together, renewal)?;
        let graph = super::reduce::reduced(u, graph)?;
        self.graphs.push(Rc::new(graph));
        self.lists.insert((list.to_vec(), together), self.graphs.len() - 1);
        Ok(self.graphs.len() - 1)
    }

    /// Whether a list has several recurrences that need memory.
    pub fn has_memory(&self, u: &Unfolding<'_>) -> bool {
        let needs_memory = |formula: &&NodeId| recurring(u, **formula).is_some_and(|chi| !u.store.traits(chi).boolean);
        self.lists.keys().any(|(list, _)| list.iter().filter(needs_memory).count() > 1)
    }

    /// The automaton with that number.
    pub fn graph(&self, number: usize) -> Rc<Graph> {
        self.graphs[number].clone()
    }
}

/// A deterministic automaton for the conjunction of Π₂ formulas.
fn conjunction(u: &mut Unfolding<'_>, list: &[NodeId], together: Together, renewal: Renewal) -> Result<Graph, Stop> {
    let mut pieces = Vec::new();
    let mut in_turn = Vec::new();
    for &formula in list {
        match recurring(u, formula) {
            Some(chi) if together == Together::RoundRobin && !u.store.traits(chi).boolean => in_turn.push(recurrence(u, chi)?),
            Some(chi) => pieces.push(Piece { graph: recurrence(u, chi)?, recurs: true }),
            None => {
                let raw = u.raw(formula)?;
                pieces.push(Piece { graph: breakpoint(u, raw, renewal)?, recurs: false });
            }
        }
    }
    let start = trivial(u)?;
    let mut all = beside_one_another(u, start, &pieces, MOST_EDGES)?;
    if !in_turn.is_empty() {
        let chain = round_robin(u, &in_turn)?;
        all = product(u, &all, &chain)?;
    }
    Ok(all)
}

/// The automaton that accepts every word, with one state and no accepting set.
pub(super) fn trivial(u: &Unfolding<'_>) -> Result<Graph, Stop> {
    use super::graph::{Arrow, State};
    let edge = Arrow { guard: u.letters, target: 0, marks: 0 };
    Ok(Graph { states: vec![State { edges: vec![edge], ..State::default() }], initial: 0, sets: 0 })
}

/// χ, if the formula is `G F χ` with a co-safety χ.
pub(super) fn recurring(u: &Unfolding<'_>, formula: NodeId) -> Option<NodeId> {
    let Node::Globally(inner) = *u.store.node(formula) else { return None };
    let Node::Finally(chi) = *u.store.node(inner) else { return None };
    u.store.traits(chi).is_co_safety().then_some(chi)
}
