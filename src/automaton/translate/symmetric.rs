//! The symmetric guess: which fixpoints are met again and again, and which hold from some instant on.
//!
//! For a state B, a set M of keys of least and a set N of keys of greatest fixpoints: jump to the safety automaton of
//! B\[M\]ν ∧ ⋀_{Gψ ∈ N} G(ψ\[M\]ν) beside automata for G F ψ\[N\]μ, one for every Fψ ∈ M.
//!
//! Finite atoms nx(ψ) of B\[M\]ν, which the next letters decide anyway, are replaced by `false`: the jump waits until they are decided. Not so
//! those that stand under X inside a fixpoint of B or of the rewritten formula, since they never cease.
//!
//! Theorem on limit-deterministic automata, section 6 of [Esparza, Křetínský & Sickert](crate::bib::Esparza2020).

use super::breakpoint::{Renewal, protected};
use super::guess::{Guesses, KeySet, Scope};
use super::target::{Target, undominated};
use super::unfold::Unfolding;
use super::work::Stop;
use super::worthwhile::worthwhile;
use crate::bdd::Bdd;
use crate::ltl::{Node, NodeId};

/// The keys that have to be guessed about in state `b`.
pub(super) fn keys(u: &mut Unfolding<'_>, guesses: &mut Guesses, b: Bdd, scope: Scope) -> Result<KeySet, Stop> {
    let mut all = 0;
    for atom in u.atoms(b) {
        all |= guesses.of(u, atom, scope)?;
    }
    Ok(all)
}

/// The jumps from state `b`.
pub(super) fn targets(u: &mut Unfolding<'_>, guesses: &mut Guesses, b: Bdd) -> Result<Vec<Target>, Stop> {
    let keys = keys(u, guesses, b, Scope::Alternating)?;
    let mut found = Vec::new();
    for guess in worthwhile(u, guesses, b, keys)? {
        if let Some((all, beside)) = one(u, guesses, b, guess)? {
            found.push(Target::new(u, all, all, beside, Renewal::Raw)?);
        }
    }
    undominated(u, found)
}

/// The safety part and the recurring part of one guess; `None` if it cannot come true.
pub(super) fn one(
    u: &mut Unfolding<'_>,
    guesses: &mut Guesses,
    b: Bdd,
    guess: KeySet,
) -> Result<Option<(Bdd, Vec<NodeId>)>, Stop> {
    let (recurring, lasting) = guesses.bodies(guess);
    let mut beside = Vec::new();
    for body in recurring {
        let body = guesses.as_co_safety(u, body, guess);
        match recurrences(u, body) {
            Some(formulas) => beside.extend(formulas),
            None => return Ok(None),
        }
    }
    beside.sort_unstable();
    beside.dedup();

    let atoms = u.atoms(b);
    let mut for_ever: Vec<NodeId> = atoms.iter().copied().filter(|id| !u.store.traits(*id).is_finite()).collect();
    for atom in for_ever.clone() {
        for_ever.push(guesses.as_safety(u, atom, guess));
    }
    let mut from_now_on = Vec::new();
    for body in lasting {
        let body = guesses.as_safety(u, body, guess);
        from_now_on.push(u.store.globally(body));
    }
    for_ever.extend(&from_now_on);
    let kept = protected(u, &for_ever);

    let rewritten = u.replace(b, |u, id| {
        let id = guesses.as_safety(u, id, guess);
        u.raw(id)
    })?;
    let mut all = u.replace(rewritten, |u, id| {
        let waits = u.store.traits(id).is_finite() && !kept.contains(&id);
        if waits { Ok(Bdd::FALSE) } else { u.raw(id) }
    })?;
    for formula in from_now_on {
        let part = u.unfold(formula)?;
        all = u.bdd.and(all, part)?;
    }
    Ok((all != Bdd::FALSE).then_some((all, beside)))
}

/// `G F body` as a list of formulas of the form `G F χ`; `None` if it is `false`.
fn recurrences(u: &mut Unfolding<'_>, body: NodeId) -> Option<Vec<NodeId>> {
    let once = u.store.finally(body);
    let again = u.store.globally(once);
    let simple = u.simplifier.simplify(&mut u.store, again);
    let parts = match u.store.node(simple) {
        Node::False => return None,
        Node::True => return Some(Vec::new()),
        Node::And(list) => list.to_vec(),
        _ => vec![simple],
    };
    let usable = parts.iter().all(|part| super::target::recurring(u, *part).is_some());
    Some(if usable { parts } else { vec![again] })
}
