//! Negation normal form: formulas in which only propositions are negated, as shared nodes of one [`Store`].
//!
//! A store holds every subformula once, so that equal formulas are equal indices, and a formula with nested equivalences, whose tree would
//! be exponential, stays small. The constructors apply the laws that need no look below the operands (`true U a` is `F a`, `F F a` is `F a`,
//! `a & !a` is `false`, …); deeper ones are in `simplify`.
//!
//! Positive normal form: section 5.1.5 of [Baier & Katoen](crate::bib::BaierKatoen2008).

use super::ast::{BinaryOperator, Formula, UnaryOperator};
use super::class::Traits;
use std::collections::HashMap;
use std::rc::Rc;

/// A formula in negation normal form, as an index into its [`Store`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct NodeId(u32);

impl NodeId {
    /// `false`, in every store.
    pub const FALSE: NodeId = NodeId(0);
    /// `true`, in every store.
    pub const TRUE: NodeId = NodeId(1);

    /// The position in the store; a dense number.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// What stands on top of a formula in negation normal form.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Node {
    /// `false`.
    False,
    /// `true`.
    True,
    /// A proposition, by its index, or its negation.
    Literal {
        /// The index of the proposition in the store's list of names.
        proposition: usize,
        /// Whether it is not negated.
        positive: bool,
    },
    /// A conjunction of at least two, sorted, none of them a conjunction.
    And(Rc<[NodeId]>),
    /// A disjunction of at least two, sorted, none of them a disjunction.
    Or(Rc<[NodeId]>),
    /// `X a`.
    Next(NodeId),
    /// `F a`.
    Finally(NodeId),
    /// `G a`.
    Globally(NodeId),
    /// `a U b`.
    Until(NodeId, NodeId),
    /// `a R b`.
    Release(NodeId, NodeId),
    /// `a W b`.
    WeakUntil(NodeId, NodeId),
    /// `a M b`.
    StrongRelease(NodeId, NodeId),
}

/// All nodes, each once.
#[derive(Default)]
pub struct Store {
    names: Vec<String>,
    nodes: Vec<Node>,
    traits: Vec<Traits>,
    index: HashMap<Node, NodeId>,
    negations: HashMap<NodeId, NodeId>,
}

impl Store {
    /// A store for formulas over the propositions `names`, in this order.
    pub fn new(names: Vec<String>) -> Store {
        let mut store = Store { names, ..Store::default() };
        store.intern(Node::False);
        store.intern(Node::True);
        store
    }

    /// The names of the propositions.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Never: the constants are always there.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// What stands on top of `id`.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.index()]
    }

    /// The syntactic properties of `id`.
    pub fn traits(&self, id: NodeId) -> Traits {
        self.traits[id.index()]
    }

    /// The negation normal form of `formula`. A name that is not yet in the list is added to it.
    pub fn insert(&mut self, formula: &Formula) -> NodeId {
        match formula {
            Formula::True => NodeId::TRUE,
            Formula::False => NodeId::FALSE,
            Formula::Proposition(name) => {
                let proposition = self.names.iter().position(|known| known == name).unwrap_or_else(|| {
                    self.names.push(name.clone());
                    self.names.len() - 1
                });
                self.literal(proposition, true)
            }
            Formula::Unary(operator, operand) => {
                let operand = self.insert(operand);
                match operator {
                    UnaryOperator::Not => self.not(operand),
                    UnaryOperator::Next => self.next(operand),
                    UnaryOperator::Finally => self.finally(operand),
                    UnaryOperator::Globally => self.globally(operand),
                }
            }
            Formula::Binary(operator, left, right) => {
                let (a, b) = (self.insert(left), self.insert(right));
                match operator {
                    BinaryOperator::And => self.and([a, b]),
                    BinaryOperator::Or => self.or([a, b]),
                    BinaryOperator::Implies => {
                        let not = self.not(a);
                        self.or([not, b])
                    }
                    BinaryOperator::Iff => self.iff(a, b),
                    BinaryOperator::Xor => {
                        let not = self.not(b);
                        self.iff(a, not)
                    }
                    BinaryOperator::Until => self.until(a, b),
                    BinaryOperator::Release => self.release(a, b),
                    BinaryOperator::WeakUntil => self.weak_until(a, b),
                    BinaryOperator::StrongRelease => self.strong_release(a, b),
                }
            }
        }
    }

    /// The formula `id` as a tree; `None` if the tree would have more than `limit` nodes.
    pub fn formula(&self, id: NodeId, limit: usize) -> Option<Formula> {
        let mut left = limit;
        self.tree(id, &mut left)
    }

    fn tree(&self, id: NodeId, left: &mut usize) -> Option<Formula> {
        *left = left.checked_sub(1)?;
        let mut unary = |operator, a| Some(Formula::unary(operator, self.tree(a, left)?));
        let (operator, list): (_, &[NodeId]) = match self.node(id) {
            Node::False => return Some(Formula::False),
            Node::True => return Some(Formula::True),
            Node::Literal { proposition, positive } => {
                let atom = Formula::proposition(&self.names[*proposition]);
                return Some(if *positive { atom } else { Formula::unary(UnaryOperator::Not, atom) });
            }
            Node::Next(a) => return unary(UnaryOperator::Next, *a),
            Node::Finally(a) => return unary(UnaryOperator::Finally, *a),
            Node::Globally(a) => return unary(UnaryOperator::Globally, *a),
            Node::And(list) => (BinaryOperator::And, list),
            Node::Or(list) => (BinaryOperator::Or, list),
            Node::Until(a, b) => (BinaryOperator::Until, &[*a, *b]),
            Node::Release(a, b) => (BinaryOperator::Release, &[*a, *b]),
            Node::WeakUntil(a, b) => (BinaryOperator::WeakUntil, &[*a, *b]),
            Node::StrongRelease(a, b) => (BinaryOperator::StrongRelease, &[*a, *b]),
        };
        let mut parts = list.iter();
        let mut formula = self.tree(*parts.next().expect("at least two operands"), left)?;
        for part in parts {
            *left = left.checked_sub(1)?;
            formula = Formula::binary(operator, formula, self.tree(*part, left)?);
        }
        Some(formula)
    }

    /// The literal of `proposition`.
    pub fn literal(&mut self, proposition: usize, positive: bool) -> NodeId {
        self.intern(Node::Literal { proposition, positive })
    }

    /// The negation, with the negation sign driven down to the literals.
    pub fn not(&mut self, id: NodeId) -> NodeId {
        if let Some(&known) = self.negations.get(&id) {
            return known;
        }
        let negation = match self.node(id).clone() {
            Node::False => NodeId::TRUE,
            Node::True => NodeId::FALSE,
            Node::Literal { proposition, positive } => self.literal(proposition, !positive),
            Node::And(list) => {
                let list: Vec<_> = list.iter().map(|a| self.not(*a)).collect();
                self.or(list)
            }
            Node::Or(list) => {
                let list: Vec<_> = list.iter().map(|a| self.not(*a)).collect();
                self.and(list)
            }
            Node::Next(a) => {
                let a = self.not(a);
                self.next(a)
            }
            Node::Finally(a) => {
                let a = self.not(a);
                self.globally(a)
            }
            Node::Globally(a) => {
                let a = self.not(a);
                self.finally(a)
            }
            Node::Until(a, b) => self.dual(a, b, Store::release),
            Node::Release(a, b) => self.dual(a, b, Store::until),
            Node::WeakUntil(a, b) => self.dual(a, b, Store::strong_release),
            Node::StrongRelease(a, b) => self.dual(a, b, Store::weak_until),
        };
        // Not the other way round: the negation may be simpler than the dual of `id`, and its own negation simpler than `id`.
        self.negations.insert(id, negation);
        negation
    }

    fn dual(&mut self, a: NodeId, b: NodeId, make: fn(&mut Store, NodeId, NodeId) -> NodeId) -> NodeId {
        let (a, b) = (self.not(a), self.not(b));
        make(self, a, b)
    }

    /// The equivalence `a <-> b`, as `(a & b) | (!a & !b)`.
    pub fn iff(&mut self, a: NodeId, b: NodeId) -> NodeId {
        let (not_a, not_b) = (self.not(a), self.not(b));
        let (both, neither) = (self.and([a, b]), self.and([not_a, not_b]));
        self.or([both, neither])
    }

    /// The conjunction of any number of formulas.
    pub fn and(&mut self, list: impl IntoIterator<Item = NodeId>) -> NodeId {
        let mut flat = Vec::new();
        for id in list {
            match self.node(id) {
                Node::And(inner) => flat.extend_from_slice(inner),
                _ => flat.push(id),
            }
        }
        flat.sort_unstable();
        flat.dedup();
        flat.retain(|id| *id != NodeId::TRUE);
        match flat[..] {
            [] => NodeId::TRUE,
            [only] => only,
            _ if flat[0] == NodeId::FALSE || self.has_opposites(&flat) => NodeId::FALSE,
            _ => self.intern(Node::And(flat.into())),
        }
    }

    /// The disjunction of any number of formulas.
    pub fn or(&mut self, list: impl IntoIterator<Item = NodeId>) -> NodeId {
        let mut flat = Vec::new();
        for id in list {
            match self.node(id) {
                Node::Or(inner) => flat.extend_from_slice(inner),
                _ => flat.push(id),
            }
        }
        flat.sort_unstable();
        flat.dedup();
        flat.retain(|id| *id != NodeId::FALSE);
        match flat[..] {
            [] => NodeId::FALSE,
            [only] => only,
            _ if flat[0] == NodeId::TRUE || self.has_opposites(&flat) => NodeId::TRUE,
            _ => self.intern(Node::Or(flat.into())),
        }
    }

    /// Whether a formula and its (already known) negation are in the sorted `list`.
    fn has_opposites(&mut self, list: &[NodeId]) -> bool {
        list.iter().any(|id| {
            let negation = match *self.node(*id) {
                Node::Literal { proposition, positive } => Some(self.literal(proposition, !positive)),
                _ => self.negations.get(id).copied(),
            };
            negation.is_some_and(|negation| list.binary_search(&negation).is_ok())
        })
    }

    /// `X a`.
    pub fn next(&mut self, a: NodeId) -> NodeId {
        if self.traits(a).is_suffix_invariant() { a } else { self.intern(Node::Next(a)) }
    }

    /// `F a`.
    pub fn finally(&mut self, a: NodeId) -> NodeId {
        if self.traits(a).eventual { a } else { self.intern(Node::Finally(a)) }
    }

    /// `G a`.
    pub fn globally(&mut self, a: NodeId) -> NodeId {
        if self.traits(a).universal { a } else { self.intern(Node::Globally(a)) }
    }

    /// `a U b`.
    pub fn until(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if a == NodeId::TRUE {
            return self.finally(b);
        }
        if a == NodeId::FALSE || a == b || self.traits(b).eventual {
            return b;
        }
        self.intern(Node::Until(a, b))
    }

    /// `a R b`.
    pub fn release(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if a == NodeId::FALSE {
            return self.globally(b);
        }
        if a == NodeId::TRUE || a == b || self.traits(b).universal {
            return b;
        }
        self.intern(Node::Release(a, b))
    }

    /// `a W b`.
    pub fn weak_until(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if b == NodeId::FALSE {
            return self.globally(a);
        }
        if a == NodeId::TRUE || b == NodeId::TRUE {
            return NodeId::TRUE;
        }
        if a == NodeId::FALSE || a == b {
            return b;
        }
        self.intern(Node::WeakUntil(a, b))
    }

    /// `a M b`.
    pub fn strong_release(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if b == NodeId::TRUE {
            return self.finally(a);
        }
        if a == NodeId::FALSE || b == NodeId::FALSE {
            return NodeId::FALSE;
        }
        if a == NodeId::TRUE || a == b {
            return b;
        }
        self.intern(Node::StrongRelease(a, b))
    }

    fn intern(&mut self, node: Node) -> NodeId {
        if let Some(&known) = self.index.get(&node) {
            return known;
        }
        let id = NodeId(u32::try_from(self.nodes.len()).expect("callers bound the number of nodes far below 2^32"));
        let traits = Traits::of(&node, |operand| self.traits[operand.index()]);
        self.nodes.push(node.clone());
        self.traits.push(traits);
        self.index.insert(node, id);
        id
    }
}

impl Node {
    /// The operands, from left to right.
    pub fn operands(&self) -> Vec<NodeId> {
        match self {
            Node::False | Node::True | Node::Literal { .. } => Vec::new(),
            Node::And(list) | Node::Or(list) => list.to_vec(),
            Node::Next(a) | Node::Finally(a) | Node::Globally(a) => vec![*a],
            Node::Until(a, b) | Node::Release(a, b) | Node::WeakUntil(a, b) | Node::StrongRelease(a, b) => vec![*a, *b],
        }
    }
}
