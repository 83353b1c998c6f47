//! Simplification of disjunctions, and through negation of conjunctions: absorption, union of operators, common factors.

use super::normal_form::{Node, NodeId, Store};
use super::simplify::Simplifier;

impl Simplifier {
    pub(super) fn or(&mut self, store: &mut Store, list: Vec<NodeId>) -> NodeId {
        let joined = store.or(list);
        let joined = self.collect_recurrence(store, joined);
        let Node::Or(list) = store.node(joined).clone() else { return joined };
        let mut list = self.absorbed(store, list.to_vec());
        if list.contains(&NodeId::TRUE) {
            return NodeId::TRUE;
        }
        'again: loop {
            for i in 0..list.len() {
                for j in 0..list.len() {
                    if i != j
                        && let Some(one) = self.united(store, list[i], list[j])
                    {
                        list[i] = one;
                        list.remove(j);
                        continue 'again;
                    }
                }
            }
            break;
        }
        self.without_common_factor(store, &list)
    }

    /// `list` without disjuncts that imply another one, `[true]` if two of them cover everything, and disjuncts `x & y` shortened to `x`
    /// where another disjunct covers the negation of `y`.
    fn absorbed(&mut self, store: &mut Store, list: Vec<NodeId>) -> Vec<NodeId> {
        let mut kept: Vec<NodeId> = Vec::new();
        for (i, &x) in list.iter().enumerate() {
            let covered = kept.iter().chain(&list[i + 1..]).any(|y| self.implies(store, x, *y));
            if !covered {
                kept.push(x);
            }
        }
        for i in 0..kept.len() {
            let not = store.not(kept[i]);
            if kept.iter().enumerate().any(|(j, y)| i != j && self.implies(store, not, *y)) {
                return vec![NodeId::TRUE];
            }
            if let Node::And(parts) = store.node(kept[i]).clone() {
                let needed: Vec<_> = parts
                    .iter()
                    .copied()
                    .filter(|part| {
                        let not = store.not(*part);
                        !kept.iter().enumerate().any(|(j, y)| i != j && self.implies(store, not, *y))
                    })
                    .collect();
                kept[i] = store.and(needed);
            }
        }
        kept
    }

    /// One formula equivalent to `x | y`, if a rule knows it.
    fn united(&mut self, store: &mut Store, x: NodeId, y: NodeId) -> Option<NodeId> {
        let is_always = |this: &mut Simplifier, store: &mut Store, candidate: NodeId, a: NodeId| {
            let not = store.not(a);
            let dual = this.finally(store, not);
            candidate == store.not(dual)
        };
        match (store.node(x).clone(), store.node(y).clone()) {
            // (a U b) | G a = a W b; (a M b) | G b = a R b.
            (Node::Until(a, b), _) if is_always(self, store, y, a) => Some(self.weak_until(store, a, b)),
            (Node::StrongRelease(a, b), _) if is_always(self, store, y, b) => Some(store.release(a, b)),
            (Node::Until(a, b), Node::Until(c, d)) if a == c => {
                let either = store.or([b, d]);
                Some(self.until(store, a, either))
            }
            (Node::WeakUntil(a, b), Node::WeakUntil(c, d) | Node::Until(c, d)) if a == c => {
                let either = store.or([b, d]);
                Some(self.weak_until(store, a, either))
            }
            (Node::Release(a, b), Node::Release(c, d) | Node::StrongRelease(c, d)) if b == d => {
                let either = store.or([a, c]);
                Some(store.release(either, b))
            }
            (Node::StrongRelease(a, b), Node::StrongRelease(c, d)) if b == d => {
                let either = store.or([a, c]);
                Some(store.strong_release(either, b))
            }
            _ => None,
        }
    }

    /// In a disjunction, G F a | G F b becomes G F (a | b).
    pub(super) fn collect_recurrence(&mut self, store: &mut Store, id: NodeId) -> NodeId {
        let Node::Or(list) = store.node(id).clone() else { return id };
        let (mut recurring, mut rest) = (Vec::new(), Vec::new());
        for &x in list.iter() {
            match *store.node(x) {
                Node::Globally(f) => match *store.node(f) {
                    Node::Finally(a) => recurring.push(a),
                    _ => rest.push(x),
                },
                _ => rest.push(x),
            }
        }
        if recurring.len() < 2 {
            return id;
        }
        let any = store.or(recurring);
        let once = store.finally(any);
        let always = store.globally(once);
        store.or(rest.into_iter().chain([always]))
    }

    /// The disjunction of `list`, with conjuncts that all of them have in common pulled out: (a & b) | (a & c) = a & (b | c).
    fn without_common_factor(&mut self, store: &mut Store, list: &[NodeId]) -> NodeId {
        let parts = |store: &Store, id: NodeId| match store.node(id) {
            Node::And(parts) => parts.to_vec(),
            _ => vec![id],
        };
        let Some((&first, others)) = list.split_first() else { return NodeId::FALSE };
        let mut common = parts(store, first);
        for &other in others {
            let other = parts(store, other);
            common.retain(|x| other.contains(x));
        }
        if common.is_empty() || others.is_empty() {
            return store.or(list.iter().copied());
        }
        let rests: Vec<_> = list
            .iter()
            .map(|x| {
                let rest: Vec<_> = parts(store, *x).into_iter().filter(|part| !common.contains(part)).collect();
                store.and(rest)
            })
            .collect();
        let rest = store.or(rests);
        store.and(common.into_iter().chain([rest]))
    }
}
