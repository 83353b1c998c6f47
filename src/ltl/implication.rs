//! Syntactic implication: a cheap, sound and incomplete test of whether one formula implies another.
//!
//! The rules follow F. Somenzi, R. Bloem: *Efficient Büchi Automata from LTL Formulae*, CAV 2000, section 3, extended to `W`, `M` and to
//! eventual and universal formulas.

use super::normal_form::{Node, NodeId, Store};
use crate::bdd::Memo;

/// Remembers what was asked.
#[derive(Default)]
pub struct Implications {
    known: Memo<(NodeId, NodeId), bool>,
}

impl Implications {
    /// Whether the rules show that `a` implies `b`. `false` means nothing.
    pub fn shows(&mut self, store: &Store, a: NodeId, b: NodeId) -> bool {
        if a == b || a == NodeId::FALSE || b == NodeId::TRUE {
            return true;
        }
        if a == NodeId::TRUE || b == NodeId::FALSE {
            return false;
        }
        if let Some(&known) = self.known.get(&(a, b)) {
            return known;
        }
        // Every rule asks about operands of `a` or of `b`, so this ends.
        let found = self.by_left(store, a, b) || self.by_right(store, a, b) || self.by_pairs(store, a, b);
        self.known.insert((a, b), found);
        found
    }

    /// Rules that take `a` apart.
    fn by_left(&mut self, store: &Store, a: NodeId, b: NodeId) -> bool {
        let eventual = store.traits(b).eventual;
        match store.node(a) {
            Node::Or(list) => list.iter().all(|p| self.shows(store, *p, b)),
            Node::And(list) => list.iter().any(|p| self.shows(store, *p, b)),
            Node::Globally(p) => self.shows(store, *p, b),
            Node::Release(_, s) => self.shows(store, *s, b),
            Node::StrongRelease(p, s) => self.shows(store, *s, b) || eventual && self.shows(store, *p, b),
            Node::Until(p, s) => self.shows(store, *s, b) && (eventual || self.shows(store, *p, b)),
            Node::WeakUntil(p, s) => self.shows(store, *p, b) && self.shows(store, *s, b),
            Node::Finally(p) | Node::Next(p) => eventual && self.shows(store, *p, b),
            _ => false,
        }
    }

    /// Rules that take `b` apart.
    fn by_right(&mut self, store: &Store, a: NodeId, b: NodeId) -> bool {
        let universal = store.traits(a).universal;
        match store.node(b) {
            Node::And(list) => list.iter().all(|q| self.shows(store, a, *q)),
            Node::Or(list) => list.iter().any(|q| self.shows(store, a, *q)),
            Node::Finally(q) => self.shows(store, a, *q),
            Node::Until(_, r) => self.shows(store, a, *r),
            Node::WeakUntil(q, r) => self.shows(store, a, *r) || universal && self.shows(store, a, *q),
            Node::Release(q, r) => self.shows(store, a, *r) && (universal || self.shows(store, a, *q)),
            Node::StrongRelease(q, r) => self.shows(store, a, *q) && self.shows(store, a, *r),
            Node::Globally(q) | Node::Next(q) => universal && self.shows(store, a, *q),
            _ => false,
        }
    }

    /// Rules that take both apart.
    fn by_pairs(&mut self, store: &Store, a: NodeId, b: NodeId) -> bool {
        use Node::{Globally, Next, Release, StrongRelease, Until, WeakUntil};
        match (store.node(a), store.node(b)) {
            (Next(p), Next(q)) => self.shows(store, *p, *q),
            (Globally(p), WeakUntil(q, _)) => self.shows(store, *p, *q),
            (Globally(p), Release(_, r)) => self.shows(store, *p, *r),
            (Until(p, s), Until(q, _)) | (Until(p, s) | WeakUntil(p, s), WeakUntil(q, _)) => {
                self.shows(store, *p, *q) && self.shows(store, *s, b)
            }
            (Until(p, s) | WeakUntil(p, s), Release(_, r)) | (Until(p, s), StrongRelease(_, r)) => {
                self.shows(store, *p, *r) && self.shows(store, *s, b)
            }
            (Release(p, s) | StrongRelease(p, s), Release(q, r)) | (StrongRelease(p, s), StrongRelease(q, r)) => {
                self.shows(store, *s, *r) && self.shows(store, *p, *q)
            }
            (Release(p, s) | StrongRelease(p, s), WeakUntil(q, _)) | (StrongRelease(p, s), Until(q, _)) => {
                self.shows(store, *s, *q) && self.shows(store, *p, b)
            }
            _ => false,
        }
    }
}
