//! The asymmetric guess: which greatest fixpoints hold from now on.
//!
//! For a state B and a set N of keys of greatest fixpoints: jump to the deterministic automaton of the Π₂ formula
//! B\[N\]μ ∧ ⋀_{Gψ ∈ N} G(ψ\[N\]μ). This is the construction of [Sickert et al.](crate::bib::Sickert2016), section 4, in the words of
//! [Esparza, Křetínský & Sickert](crate::bib::Esparza2020), section 6.

use super::breakpoint::Renewal;
use super::guess::{Guesses, KeySet, Scope};
use super::symmetric::keys;
use super::target::{Target, undominated};
use super::unfold::{Invariants, Unfolding};
use super::work::Stop;
use crate::bdd::Bdd;
use crate::ltl::{Node, NodeId};

/// How the Π₂ formula is recognised.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Layout {
    /// All of it by one breakpoint construction, with one accepting set.
    Joint,
    /// Every `G` that is not a safety formula by an automaton of its own.
    Pieces,
}

/// The jumps from state `b`. Nothing has to be [recalled](super::invariant::recalled): the rewriting makes every kept `F ψ` true or false, and
/// unfolded it would be the same.
pub(super) fn targets(
    u: &mut Unfolding<'_>,
    guesses: &mut Guesses,
    b: Bdd,
    layout: Layout,
    renewal: Renewal,
) -> Result<Vec<Target>, Stop> {
    let keys = keys(u, guesses, b, Scope::Greatest)?;
    let count = keys.count_ones() as usize;
    if count > u.work.guesses() {
        return Err(Stop::Guesses(count));
    }
    let mut found = Vec::new();
    for guess in subsets(keys) {
        u.work.tick(16)?;
        let mut all = u.replace(b, |u, id| {
            let id = guesses.as_co_safety(u, id, guess);
            u.raw(id)
        })?;
        if all == Bdd::FALSE {
            continue;
        }
        let mut same = all;
        let mut beside: Vec<NodeId> = Vec::new();
        for body in guesses.bodies(guess).1 {
            let body = guesses.as_co_safety(u, body, guess);
            let lasting = u.store.globally(body);
            // Simplified, it may have left Π₂, which the breakpoint needs: `F a` becomes `G F a` within `G F`.
            let simple = u.simplifier.simplify(&mut u.store, lasting);
            let lasting = if u.store.traits(simple).pi <= 2 { simple } else { lasting };
            let parts = match u.store.node(lasting) {
                Node::And(list) => list.to_vec(),
                _ => vec![lasting],
            };
            for part in parts {
                if layout == Layout::Joint || u.store.traits(part).is_safety() {
                    let (unfolded, kept) = (u.unfold(part)?, u.unfold_with(part, Invariants::Kept)?);
                    all = u.bdd.and(all, unfolded)?;
                    same = u.bdd.and(same, kept)?;
                } else {
                    beside.push(part);
                }
            }
        }
        beside.sort_unstable();
        beside.dedup();
        if all != Bdd::FALSE {
            found.push(Target::new(u, all, same, beside, renewal)?);
        }
    }
    undominated(u, found)
}

/// The subsets of a set, the empty one first.
fn subsets(set: KeySet) -> impl Iterator<Item = KeySet> {
    let mut next = Some(0);
    std::iter::from_fn(move || {
        let now = next?;
        // Counting in the bits of `set` only.
        next = (now != set).then(|| (now | !set).wrapping_add(1) & set);
        Some(now)
    })
}
