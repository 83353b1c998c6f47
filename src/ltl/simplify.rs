//! Equivalences that make a formula smaller, or bring it into the shape that translates best.
//!
//! Rules are written for `|`, `F`, `U` and `W`; `&`, `G`, `R` and `M` are simplified through their negation, so that every rule has its
//! dual. The shape aimed at: `F` distributed over `|` and `G` over `&`, but recurrence collected (`G F a | G F b` is `G F (a | b)`);
//! `X` outside; formulas that forget every prefix pulled out of other operators.
//!
//! The rules are those of K. Etessami, G. Holzmann: *Optimizing Büchi Automata*, CONCUR 2000, of F. Somenzi, R. Bloem: *Efficient Büchi
//! Automata from LTL Formulae*, CAV 2000, and of T. Babiak, M. Křetínský, V. Řehák, J. Strejček: *LTL to Büchi Automata Translation: Fast and
//! More Deterministic*, TACAS 2012; every one of them is checked on random words by the tests.

use super::implication::Implications;
use super::normal_form::{Node, NodeId, Store};
use std::collections::HashMap;

/// Rewrites formulas of one store, and remembers the results.
#[derive(Default)]
pub struct Simplifier {
    implications: Implications,
    once: HashMap<NodeId, NodeId>,
    pub(super) limits: HashMap<NodeId, NodeId>,
}

/// How often a formula is rewritten from the bottom up before it is taken as it is.
const ROUNDS: usize = 6;

/// Stores with more nodes are left as they are: the pairwise rules take quadratic time.
const LARGE: usize = 4000;

impl Simplifier {
    /// A formula equivalent to `id`, usually smaller.
    pub fn simplify(&mut self, store: &mut Store, id: NodeId) -> NodeId {
        let mut now = id;
        for _ in 0..ROUNDS {
            let next = self.once(store, now);
            if next == now {
                break;
            }
            now = next;
        }
        now
    }

    /// Whether the rules show that `a` implies `b`; `false` means nothing.
    pub fn implies(&mut self, store: &Store, a: NodeId, b: NodeId) -> bool {
        self.implications.shows(store, a, b)
    }

    /// One pass from the operands up.
    fn once(&mut self, store: &mut Store, id: NodeId) -> NodeId {
        if let Some(&known) = self.once.get(&id) {
            return known;
        }
        if store.len() > LARGE {
            return id;
        }
        let result = match store.node(id).clone() {
            Node::False | Node::True | Node::Literal { .. } => id,
            Node::Next(a) => {
                let a = self.once(store, a);
                self.next(store, a)
            }
            Node::Finally(a) => {
                let a = self.once(store, a);
                self.finally(store, a)
            }
            Node::Or(list) => {
                let list: Vec<_> = list.iter().map(|a| self.once(store, *a)).collect();
                self.or(store, list)
            }
            Node::Until(a, b) => {
                let (a, b) = (self.once(store, a), self.once(store, b));
                self.until(store, a, b)
            }
            Node::WeakUntil(a, b) => {
                let (a, b) = (self.once(store, a), self.once(store, b));
                self.weak_until(store, a, b)
            }
            Node::And(_) | Node::Globally(_) | Node::Release(..) | Node::StrongRelease(..) => {
                let negation = store.not(id);
                let simple = self.once(store, negation);
                store.not(simple)
            }
        };
        self.once.insert(id, result);
        result
    }

    pub(super) fn next(&mut self, store: &mut Store, a: NodeId) -> NodeId {
        match store.node(a).clone() {
            // X (s & b) = s & X b, X (s | b) = s | X b for s that forgets prefixes.
            Node::And(list) if list.iter().any(|x| store.traits(*x).is_suffix_invariant()) => {
                let list: Vec<_> = list.iter().map(|x| store.next(*x)).collect();
                store.and(list)
            }
            Node::Or(list) if list.iter().any(|x| store.traits(*x).is_suffix_invariant()) => {
                let list: Vec<_> = list.iter().map(|x| store.next(*x)).collect();
                store.or(list)
            }
            _ => store.next(a),
        }
    }

    pub(super) fn finally(&mut self, store: &mut Store, a: NodeId) -> NodeId {
        match store.node(a).clone() {
            Node::Or(list) => {
                let list: Vec<_> = list.iter().map(|x| self.finally(store, *x)).collect();
                store.or(list)
            }
            Node::Next(b) => {
                let inner = self.finally(store, b);
                store.next(inner)
            }
            // F (a U b) = F b; F (a M b) = F (a & b); F (a W b) = F b | F G a.
            Node::Until(_, b) => self.finally(store, b),
            Node::StrongRelease(b, c) => {
                let both = store.and([b, c]);
                self.finally(store, both)
            }
            Node::WeakUntil(b, c) => {
                let always = store.globally(b);
                let (left, right) = (self.finally(store, always), self.finally(store, c));
                store.or([left, right])
            }
            Node::And(list) => {
                let (invariant, rest) = split(store, &list);
                if invariant.is_empty() {
                    return store.finally(a);
                }
                let rest = store.and(rest);
                let rest = self.finally(store, rest);
                store.and(invariant.into_iter().chain([rest]))
            }
            Node::Globally(b) => self.finally_globally(store, b),
            _ => store.finally(a),
        }
    }

    pub(super) fn until(&mut self, store: &mut Store, a: NodeId, b: NodeId) -> NodeId {
        let not_b = store.not(b);
        if self.implies(store, a, b) {
            return b;
        }
        if self.implies(store, not_b, a) {
            return self.finally(store, b);
        }
        if let (Node::Next(x), Node::Next(y)) = (store.node(a), store.node(b)) {
            let (x, y) = (*x, *y);
            let inner = self.until(store, x, y);
            return store.next(inner);
        }
        if let Node::Until(c, _) = *store.node(b)
            && self.implies(store, a, c)
        {
            return b;
        }
        // a U b = b | (a & F b) for universal a.
        if store.traits(a).universal {
            let later = self.finally(store, b);
            let kept = store.and([a, later]);
            return store.or([b, kept]);
        }
        // Formulas that forget prefixes come out: a U (b & s) = (a U b) & s, a U (b | s) = (a U b) | s,
        // (a & s) U b = ((a U b) & s) | b, (a | s) U b = (a U b) | (s & F b).
        if let Some((conjunction, invariant, rest)) = pull(store, b) {
            let inner = self.until(store, a, rest);
            return if conjunction { store.and([inner, invariant]) } else { store.or([inner, invariant]) };
        }
        if let Some((conjunction, invariant, rest)) = pull(store, a) {
            let inner = self.until(store, rest, b);
            if conjunction {
                let both = store.and([inner, invariant]);
                return store.or([both, b]);
            }
            let later = self.finally(store, b);
            let both = store.and([invariant, later]);
            return store.or([inner, both]);
        }
        // (b | c) U b = c U b.
        if let Node::Or(list) = store.node(a).clone()
            && list.contains(&b)
        {
            let rest = store.or(list.iter().copied().filter(|x| *x != b));
            return store.until(rest, b);
        }
        store.until(a, b)
    }

    pub(super) fn weak_until(&mut self, store: &mut Store, a: NodeId, b: NodeId) -> NodeId {
        let not_b = store.not(b);
        if self.implies(store, a, b) {
            return b;
        }
        if self.implies(store, not_b, a) {
            return NodeId::TRUE;
        }
        // a W b = a | b for universal a; a W b = G a | b for eventual b.
        if store.traits(a).universal {
            return store.or([a, b]);
        }
        let always = |this: &mut Simplifier, store: &mut Store, a| {
            let not = store.not(a);
            let dual = this.finally(store, not);
            store.not(dual)
        };
        if store.traits(b).eventual {
            let always = always(self, store, a);
            return store.or([always, b]);
        }
        if let (Node::Next(x), Node::Next(y)) = (store.node(a), store.node(b)) {
            let (x, y) = (*x, *y);
            let inner = self.weak_until(store, x, y);
            return store.next(inner);
        }
        // a W (b | s) = (a W b) | s, a W (b & s) = G a | ((a U b) & s), (a & s) W b = ((a W b) & s) | b, (a | s) W b = (a W b) | s.
        if let Some((conjunction, invariant, rest)) = pull(store, b) {
            if conjunction {
                let (always, until) = (always(self, store, a), self.until(store, a, rest));
                let both = store.and([until, invariant]);
                return store.or([always, both]);
            }
            let inner = self.weak_until(store, a, rest);
            return store.or([inner, invariant]);
        }
        if let Some((conjunction, invariant, rest)) = pull(store, a) {
            let inner = self.weak_until(store, rest, b);
            if conjunction {
                let both = store.and([inner, invariant]);
                return store.or([both, b]);
            }
            return store.or([inner, invariant]);
        }
        if let Node::Or(list) = store.node(a).clone()
            && list.contains(&b)
        {
            let rest = store.or(list.iter().copied().filter(|x| *x != b));
            return store.weak_until(rest, b);
        }
        store.weak_until(a, b)
    }
}

/// The operands that forget every prefix, and the others.
pub(super) fn split(store: &Store, list: &[NodeId]) -> (Vec<NodeId>, Vec<NodeId>) {
    list.iter().partition(|id| store.traits(**id).is_suffix_invariant())
}

/// If `id` is a conjunction (true) or disjunction (false) in which some operands forget every prefix: those, and the others.
fn pull(store: &mut Store, id: NodeId) -> Option<(bool, NodeId, NodeId)> {
    match store.node(id).clone() {
        _ if store.traits(id).is_suffix_invariant() => None,
        Node::And(list) => {
            let (invariant, rest) = split(store, &list);
            (!invariant.is_empty()).then(|| (true, store.and(invariant), store.and(rest)))
        }
        Node::Or(list) => {
            let (invariant, rest) = split(store, &list);
            (!invariant.is_empty()).then(|| (false, store.or(invariant), store.or(rest)))
        }
        _ => None,
    }
}
