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
    limits: HashMap<NodeId, NodeId>,
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

    fn next(&mut self, store: &mut Store, a: NodeId) -> NodeId {
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

    fn finally(&mut self, store: &mut Store, a: NodeId) -> NodeId {
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

    /// F G a.
    fn finally_globally(&mut self, store: &mut Store, a: NodeId) -> NodeId {
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

    fn until(&mut self, store: &mut Store, a: NodeId, b: NodeId) -> NodeId {
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

    fn weak_until(&mut self, store: &mut Store, a: NodeId, b: NodeId) -> NodeId {
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

    fn or(&mut self, store: &mut Store, list: Vec<NodeId>) -> NodeId {
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
    fn collect_recurrence(&mut self, store: &mut Store, id: NodeId) -> NodeId {
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

/// The operands that forget every prefix, and the others.
fn split(store: &Store, list: &[NodeId]) -> (Vec<NodeId>, Vec<NodeId>) {
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
