//! Simplification in the limit: what may be said of `F G` and `G F`, where every finite prefix is forgotten.
//!
//! T. Babiak, M. Křetínský, V. Řehák, J. Strejček: *LTL to Büchi Automata Translation: Fast and More Deterministic*, TACAS 2012, section 3.

use super::normal_form::{Node, NodeId, Store};
use super::simplify::{Simplifier, split};

impl Simplifier {
    /// F G a.
    pub(super) fn finally_globally(&mut self, store: &mut Store, a: NodeId) -> NodeId {
        let a = self.in_the_limit(store, a);
        let again = |store: &mut Store, a| {
            let inner = store.globally(a);
            store.finally(inner)
        };
        match store.node(a).clone() {
            Node::Next(b) => self.finally_globally(store, b),
            // F G (b U c) = F G (b | c) & G F c; F G (b W c) = F G (b | c); F G (b R c) = F G c; F G (b M c) = F G c & G F b.
            Node::Until(b, c) => {
                let either = store.or([b, c]);
                let (left, right) = (self.finally_globally(store, either), self.globally_finally(store, c));
                store.and([left, right])
            }
            Node::WeakUntil(b, c) => {
                let either = store.or([b, c]);
                self.finally_globally(store, either)
            }
            Node::Release(_, c) => self.finally_globally(store, c),
            Node::StrongRelease(b, c) => {
                let (left, right) = (self.finally_globally(store, c), self.globally_finally(store, b));
                store.and([left, right])
            }
            // F G distributes over &; what stays of the form F G b is collected into one.
            Node::And(list) => {
                let parts: Vec<_> = list.iter().map(|x| self.finally_globally(store, *x)).collect();
                let all = store.and(parts);
                let not = store.not(all);
                let collected = self.collect_recurrence(store, not);
                store.not(collected)
            }
            Node::Or(list) => {
                let (invariant, rest) = split(store, &list);
                let rest = store.or(rest);
                if invariant.is_empty() {
                    return again(store, rest);
                }
                let rest = self.finally_globally(store, rest);
                store.or(invariant.into_iter().chain([rest]))
            }
            _ => again(store, a),
        }
    }

    fn globally_finally(&mut self, store: &mut Store, a: NodeId) -> NodeId {
        let negation = store.not(a);
        let dual = self.finally_globally(store, negation);
        store.not(dual)
    }

    /// A formula that agrees with `a` on all but finitely many suffixes of every word: behind the last instant of `b`, if there is one,
    /// `F b` is false for ever, and otherwise true, so `F b` may be written `G F b`; dually `G b` may be written `F G b`.
    fn in_the_limit(&mut self, store: &mut Store, a: NodeId) -> NodeId {
        if let Some(&known) = self.limits.get(&a) {
            return known;
        }
        let result = match store.node(a).clone() {
            _ if store.traits(a).is_suffix_invariant() || store.traits(a).is_finite() => a,
            Node::And(list) => {
                let list: Vec<_> = list.iter().map(|x| self.in_the_limit(store, *x)).collect();
                store.and(list)
            }
            Node::Or(list) => {
                let list: Vec<_> = list.iter().map(|x| self.in_the_limit(store, *x)).collect();
                store.or(list)
            }
            Node::Next(b) => {
                let b = self.in_the_limit(store, b);
                self.next(store, b)
            }
            Node::Finally(b) => self.globally_finally(store, b),
            Node::Globally(b) => self.finally_globally(store, b),
            Node::Until(b, c) => {
                let (b, c) = (self.in_the_limit(store, b), self.in_the_limit(store, c));
                self.until(store, b, c)
            }
            Node::WeakUntil(b, c) => {
                let (b, c) = (self.in_the_limit(store, b), self.in_the_limit(store, c));
                self.weak_until(store, b, c)
            }
            Node::Release(b, c) => {
                let (b, c) = (self.in_the_limit(store, b), self.in_the_limit(store, c));
                let (b, c) = (store.not(b), store.not(c));
                let dual = self.until(store, b, c);
                store.not(dual)
            }
            Node::StrongRelease(b, c) => {
                let (b, c) = (self.in_the_limit(store, b), self.in_the_limit(store, c));
                let (b, c) = (store.not(b), store.not(c));
                let dual = self.weak_until(store, b, c);
                store.not(dual)
            }
            Node::False | Node::True | Node::Literal { .. } => a,
        };
        self.limits.insert(a, result);
        result
    }
}
