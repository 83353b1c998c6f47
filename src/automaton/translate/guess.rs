//! Guessing the truth in the limit: keys of fixpoints, and the rewritings [M]ν and [N]μ.
//!
//! The key of a least fixpoint says that it is met again and again: `F χ` for `ψ U χ`, `F ψ` for `ψ M χ`; the key of a greatest fixpoint
//! that it holds from some instant on: `G ψ` for `ψ W χ`, `G χ` for `ψ R χ`. Given a set M of keys of least fixpoints, φ[M]ν is the safety
//! formula equivalent to φ when exactly those of M are met again and again; given a set N of keys of greatest fixpoints, φ[N]μ is the
//! co-safety formula for the case that those of N hold from now on.
//!
//! Definitions 4.1 and 4.2 and the Master Theorem of [Esparza, Křetínský & Sickert](crate::bib::Esparza2020).

use super::unfold::Unfolding;
use super::work::Stop;
use crate::bdd::Memo;
use crate::ltl::{Node, NodeId};

/// A set of keys, bit i for key i of the [`Guesses`].
pub(super) type KeySet = u64;

/// What a key says.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Key {
    /// `G F body`: a least fixpoint is met again and again.
    Recurring(NodeId),
    /// `F G body`: a greatest fixpoint holds from some instant on.
    Lasting(NodeId),
}

/// Which fixpoints have to be guessed about.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Scope {
    /// Those inside a least fixpoint that stands inside a greatest one, for the symmetric construction.
    Alternating,
    /// All greatest fixpoints, for the asymmetric construction.
    Greatest,
}

/// The keys met so far, and remembered rewritings.
#[derive(Default)]
pub(super) struct Guesses {
    keys: Vec<Key>,
    of: Memo<(Scope, NodeId), KeySet>,
    rewritten: Memo<(bool, KeySet, NodeId), NodeId>,
}

impl Guesses {
    /// The keys of a set that say [`Key::Recurring`], and those that say [`Key::Lasting`].
    pub fn bodies(&self, set: KeySet) -> (Vec<NodeId>, Vec<NodeId>) {
        let (mut recurring, mut lasting) = (Vec::new(), Vec::new());
        for i in members(set) {
            match self.keys[i] {
                Key::Recurring(body) => recurring.push(body),
                Key::Lasting(body) => lasting.push(body),
            }
        }
        (recurring, lasting)
    }

    /// The keys of a set that say [`Key::Recurring`].
    pub fn recurring(&self, set: KeySet) -> KeySet {
        members(set).filter(|i| matches!(self.keys[*i], Key::Recurring(_))).fold(0, |found, i| found | 1 << i)
    }

    /// The keys that have to be guessed about for `id`.
    pub fn of(&mut self, u: &mut Unfolding<'_>, id: NodeId, scope: Scope) -> Result<KeySet, Stop> {
        if let Some(&known) = self.of.get(&(scope, id)) {
            return Ok(known);
        }
        let mut set = 0;
        let mut seen = std::collections::HashSet::new();
        let mut open = vec![(id, false, false)];
        // Per subformula: whether a greatest fixpoint is around it, and whether a least one that is inside a greatest one is.
        while let Some((id, in_greatest, alternating)) = open.pop() {
            if u.store.traits(id).is_finite() || !seen.insert((id, in_greatest, alternating)) {
                continue;
            }
            let node = u.store.node(id).clone();
            let (mut inner_greatest, mut inner_alternating) = (in_greatest, alternating);
            match key(&node) {
                Some(Key::Recurring(body)) => {
                    inner_alternating |= in_greatest;
                    if inner_alternating && scope == Scope::Alternating {
                        set |= self.number(Key::Recurring(body))?;
                    }
                }
                Some(Key::Lasting(body)) => {
                    inner_greatest = true;
                    if alternating || scope == Scope::Greatest {
                        set |= self.number(Key::Lasting(body))?;
                    }
                }
                None => {}
            }
            open.extend(node.operands().into_iter().map(|a| (a, inner_greatest, inner_alternating)));
        }
        self.of.insert((scope, id), set);
        Ok(set)
    }

    /// The set with only that key.
    fn number(&mut self, key: Key) -> Result<KeySet, Stop> {
        let i = match self.keys.iter().position(|known| *known == key) {
            Some(i) => i,
            None => {
                self.keys.push(key);
                self.keys.len() - 1
            }
        };
        if i < 64 { Ok(1 << i) } else { Err(Stop::Guesses(i + 1)) }
    }

    fn has(&self, set: KeySet, key: Key) -> bool {
        self.keys.iter().take(64).position(|known| *known == key).is_some_and(|i| set >> i & 1 == 1)
    }

    /// φ[M]ν: `id` as a safety formula, if exactly the guessed least fixpoints recur.
    pub fn as_safety(&mut self, u: &mut Unfolding<'_>, id: NodeId, guess: KeySet) -> NodeId {
        self.rewrite(u, id, guess, true)
    }

    /// φ[N]μ: `id` as a co-safety formula, if the guessed greatest fixpoints hold from now on.
    pub fn as_co_safety(&mut self, u: &mut Unfolding<'_>, id: NodeId, guess: KeySet) -> NodeId {
        self.rewrite(u, id, guess, false)
    }

    fn rewrite(&mut self, u: &mut Unfolding<'_>, id: NodeId, guess: KeySet, safety: bool) -> NodeId {
        if u.store.traits(id).is_finite() {
            return id;
        }
        if let Some(&known) = self.rewritten.get(&(safety, guess, id)) {
            return known;
        }
        let node = u.store.node(id).clone();
        let result = match (key(&node), safety) {
            (Some(Key::Recurring(body)), true) if !self.has(guess, Key::Recurring(body)) => NodeId::FALSE,
            (Some(Key::Lasting(body)), false) if self.has(guess, Key::Lasting(body)) => NodeId::TRUE,
            _ => {
                let parts: Vec<_> = node.operands().into_iter().map(|part| self.rewrite(u, part, guess, safety)).collect();
                let store = &mut u.store;
                match (&node, safety) {
                    (Node::And(_), _) => store.and(parts),
                    (Node::Or(_), _) => store.or(parts),
                    (Node::Next(_), _) => store.next(parts[0]),
                    (Node::Finally(_), true) => NodeId::TRUE,
                    (Node::Finally(_), false) => store.finally(parts[0]),
                    (Node::Globally(_), true) => store.globally(parts[0]),
                    (Node::Globally(_), false) => NodeId::FALSE,
                    (Node::WeakUntil(..), true) | (Node::Until(..), true) => store.weak_until(parts[0], parts[1]),
                    (Node::WeakUntil(..), false) | (Node::Until(..), false) => store.until(parts[0], parts[1]),
                    (Node::Release(..), true) | (Node::StrongRelease(..), true) => store.release(parts[0], parts[1]),
                    (Node::Release(..), false) | (Node::StrongRelease(..), false) => store.strong_release(parts[0], parts[1]),
                    (Node::False | Node::True | Node::Literal { .. }, _) => id,
                }
            }
        };
        self.rewritten.insert((safety, guess, id), result);
        result
    }
}

/// The key of a fixpoint.
fn key(node: &Node) -> Option<Key> {
    match *node {
        Node::Finally(a) | Node::Until(_, a) | Node::StrongRelease(a, _) => Some(Key::Recurring(a)),
        Node::Globally(a) | Node::WeakUntil(a, _) | Node::Release(_, a) => Some(Key::Lasting(a)),
        _ => None,
    }
}

/// The numbers in a set, in order.
pub(super) fn members(set: KeySet) -> impl Iterator<Item = usize> {
    (0..64).filter(move |i| set >> i & 1 == 1)
}
