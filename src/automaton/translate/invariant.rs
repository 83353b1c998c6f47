//! Suffix-invariant formulas in the initial component: `F G ψ` and `G F ψ` are never unfolded there, since no letter changes them.
//!
//! Unfolded, `F G ψ` leaves behind `F G ψ` or `F G ψ | G ψ`, as the letter wills, and `G F ψ` leaves `G F ψ` or `G F ψ & F ψ`. The language is
//! the same, but n such formulas have 2ⁿ forms and diagrams, which ask all propositions before all atoms, as many nodes. So the initial
//! component tracks another formula than af: nx(τ) stays nx(τ) for every *kept* τ, that is `F ψ` where ψ is made of formulas `G χ` by ∧ and ∨,
//! and `G ψ` where ψ is eventual. Of two raw diagrams that differ only by `G χ` ⇒ `F G χ` or `G F χ` ⇒ `F χ`, one is chosen (`settled`).
//! Before a jump, every kept `F ψ` of the state is unfolded after all ([`recalled`]).
//!
//! Why that is right. Let X be af(φ, w₀…wₜ₋₁) and Y what is tracked instead, both as raw diagrams; ⊨ is implication between diagrams.
//!
//! 1. Y has the language of X, as τ ≡ Xτ for a kept τ, and so has the recalled state. The soundness half of the theorem that a guess rests on
//!    holds for any formula, so what is accepted behind a jump from the recalled state is right.
//! 2. X ⊨ Y⁺, where Y⁺ is Y with `F ψ` ∨ ψ for every kept `F ψ`. Diagrams are monotone in the atoms, and af and ⁺ replace atoms, so it is enough
//!    to see that af(α) ⊨ af'(α)⁺ for one atom α, where af' is the step of the tracked formula. For kept ones: af(`G ψ`) ⊨ `G ψ`; and
//!    af(`F ψ` ∨ ψ) = `F ψ` ∨ af(ψ) ⊨ `F ψ` ∨ ψ, as af(`G χ`) ⊨ `G χ` for every `G χ` of ψ. For the others by induction on what is unfolded, as
//!    α ⊨ α⁺. Settling only enlarges a diagram, or takes `G χ` for false where `F G χ` is false, and ⁺ undoes that.
//! 3. Hence unf(X) ⊨ unf(Y⁺) ⊨ the recalled state. The rewritings \[M\]ν and \[N\]μ replace atoms of monotone diagrams too and keep ⊨. So whatever
//!    guess comes true of X does so of the recalled state, and no word is lost.
//! 4. A jump can be put off as with af: a guess that is right at t is right, by the theorem's lemma, for af of the recalled state at t + 1, which ⊨
//!    the recalled state at t + 1, as in 2. Hence the automaton is as good for MDPs as the one over af.

use super::unfold::{Invariants, Unfolding};
use super::work::Stop;
use crate::bdd::Bdd;
use crate::ltl::{Node, NodeId, Store};

/// Whether the initial component keeps `id` as it is.
pub(super) fn is_kept(store: &Store, id: NodeId) -> bool {
    match store.node(id) {
        Node::Finally(inner) => is_made_of_globally(store, *inner),
        Node::Globally(inner) => store.traits(*inner).eventual,
        _ => false,
    }
}

fn is_made_of_globally(store: &Store, id: NodeId) -> bool {
    match store.node(id) {
        Node::And(list) | Node::Or(list) => list.iter().all(|part| is_made_of_globally(store, *part)),
        Node::Globally(_) => true,
        _ => false,
    }
}

/// The state of the initial component for a raw successor.
pub(super) fn tracked(u: &mut Unfolding<'_>, raw: Bdd) -> Result<Bdd, Stop> {
    let raw = settled(u, raw)?;
    u.unfold_raw_with(raw, Invariants::Kept)
}

/// One diagram for all that differ by what `F G χ` and `G F χ` say of `G χ` and `F χ`.
///
/// Where nx(`F G χ`) is false, nx(`G χ`) is set to `false`; where nx(`G F χ`) is true, nx(`F χ`) is set to `true`.
fn settled(u: &mut Unfolding<'_>, raw: Bdd) -> Result<Bdd, Stop> {
    let atoms = u.atoms(raw);
    let mut settled = raw;
    for &atom in &atoms {
        let inner = match *u.store.node(atom) {
            Node::Finally(inner) | Node::Globally(inner) if is_kept(&u.store, atom) && atoms.contains(&inner) => inner,
            _ => continue,
        };
        let least = matches!(u.store.node(atom), Node::Finally(_));
        let known = |one: Bdd, other: Bdd| {
            move |u: &mut Unfolding<'_>, id: NodeId| match id {
                _ if id == atom => Ok(one),
                _ if id == inner && least == (one == Bdd::FALSE) => Ok(other),
                _ => u.raw(id),
            }
        };
        let with = u.replace(settled, known(Bdd::TRUE, Bdd::TRUE))?;
        let without = u.replace(settled, known(Bdd::FALSE, Bdd::FALSE))?;
        let condition = u.raw(atom)?;
        settled = u.bdd.if_then_else(condition, with, without)?;
    }
    Ok(settled)
}

/// `b` with every kept `F ψ` unfolded: what the guesses are made about.
pub(super) fn recalled(u: &mut Unfolding<'_>, b: Bdd) -> Result<Bdd, Stop> {
    u.replace(b, |u, id| {
        let is_least = matches!(u.store.node(id), Node::Finally(_));
        if is_least && is_kept(&u.store, id) { u.unfold(id) } else { u.raw(id) }
    })
}
