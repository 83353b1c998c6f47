//! Reduced ordered binary decision diagrams with one shared, hash-consed table of nodes.
//!
//! Equal functions are equal indices, so comparing two functions costs nothing. The order of the variables is that of their numbers; new
//! variables may be used at any time. Nothing is ever freed: a [`Manager`] lives as long as one translation, and a limit on its nodes bounds
//! both its space and its time.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// A function of Boolean variables, as an index into its [`Manager`]. Two functions of one manager are equal exactly if the indices are.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Bdd(u32);

impl Bdd {
    /// The function that is never true.
    pub const FALSE: Bdd = Bdd(0);
    /// The function that is always true.
    pub const TRUE: Bdd = Bdd(1);

    /// Whether this is [`Bdd::FALSE`] or [`Bdd::TRUE`].
    pub fn is_constant(self) -> bool {
        self.0 < 2
    }

    /// The index of the node in its manager; a dense number, smaller than [`Manager::len`].
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// The number of a variable; smaller numbers are asked first.
pub type Variable = u32;

/// The table of nodes is full.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[error("a decision diagram needs more than the {limit} nodes allowed")]
pub struct NodeLimit {
    /// How many nodes were allowed.
    pub limit: usize,
}

/// A node: if `variable` then `high` else `low`.
#[derive(Clone, Copy)]
struct Node {
    variable: Variable,
    low: Bdd,
    high: Bdd,
}

/// The variable of the two constants: behind all others.
const NONE: Variable = Variable::MAX;

/// The owner of all nodes.
pub struct Manager {
    nodes: Vec<Node>,
    /// Open addressing: a node's index stands at the first free place behind its hash; 0 = free.
    unique: Vec<u32>,
    /// Results of if-then-else, by their arguments; a new result overwrites an old one of the same hash.
    cache: Vec<(Bdd, Bdd, Bdd, Bdd)>,
    limit: usize,
}

impl Manager {
    /// A manager for at most `limit` nodes.
    pub fn new(limit: usize) -> Manager {
        let constant = |this| Node { variable: NONE, low: this, high: this };
        let nothing = (Bdd::FALSE, Bdd::FALSE, Bdd::FALSE, Bdd::FALSE);
        Manager {
            nodes: vec![constant(Bdd::FALSE), constant(Bdd::TRUE)],
            unique: vec![0; 1 << 8],
            cache: vec![nothing; 1 << 10],
            limit,
        }
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Never: the constants are always there.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// The function that is true when `variable` is.
    ///
    /// # Errors
    /// [`NodeLimit`], as for every function that may make nodes.
    pub fn variable(&mut self, variable: Variable) -> Result<Bdd, NodeLimit> {
        self.node(variable, Bdd::FALSE, Bdd::TRUE)
    }

    /// The function that is true when `variable` has the value `value`.
    ///
    /// # Errors
    /// [`NodeLimit`].
    pub fn literal(&mut self, variable: Variable, value: bool) -> Result<Bdd, NodeLimit> {
        if value { self.variable(variable) } else { self.node(variable, Bdd::TRUE, Bdd::FALSE) }
    }

    /// The variable asked first, if `f` is not constant.
    pub fn top(&self, f: Bdd) -> Option<Variable> {
        (!f.is_constant()).then(|| self.nodes[f.index()].variable)
    }

    /// What is left of `f` when its first variable is false, and when it is true; `f` itself twice if it is constant.
    pub fn branches(&self, f: Bdd) -> (Bdd, Bdd) {
        let node = self.nodes[f.index()];
        (node.low, node.high)
    }

    /// The conjunction.
    ///
    /// # Errors
    /// [`NodeLimit`].
    pub fn and(&mut self, f: Bdd, g: Bdd) -> Result<Bdd, NodeLimit> {
        self.if_then_else(f.min(g), f.max(g), Bdd::FALSE)
    }

    /// The disjunction.
    ///
    /// # Errors
    /// [`NodeLimit`].
    pub fn or(&mut self, f: Bdd, g: Bdd) -> Result<Bdd, NodeLimit> {
        self.if_then_else(f.min(g), Bdd::TRUE, f.max(g))
    }

    /// The negation.
    ///
    /// # Errors
    /// [`NodeLimit`].
    pub fn not(&mut self, f: Bdd) -> Result<Bdd, NodeLimit> {
        self.if_then_else(f, Bdd::FALSE, Bdd::TRUE)
    }

    /// Whether `g` is true wherever `f` is.
    ///
    /// # Errors
    /// [`NodeLimit`].
    pub fn implies(&mut self, f: Bdd, g: Bdd) -> Result<bool, NodeLimit> {
        Ok(self.if_then_else(f, g, Bdd::TRUE)? == Bdd::TRUE)
    }

    /// `g` where `f` is true, `h` where it is not.
    ///
    /// # Errors
    /// [`NodeLimit`].
    pub fn if_then_else(&mut self, f: Bdd, mut g: Bdd, mut h: Bdd) -> Result<Bdd, NodeLimit> {
        if g == f {
            g = Bdd::TRUE;
        }
        if h == f {
            h = Bdd::FALSE;
        }
        if f == Bdd::TRUE || g == h {
            return Ok(g);
        }
        if f == Bdd::FALSE {
            return Ok(h);
        }
        if (g, h) == (Bdd::TRUE, Bdd::FALSE) {
            return Ok(f);
        }
        let place = hash(f.0, g.0, h.0) as usize & (self.cache.len() - 1);
        let (a, b, c, known) = self.cache[place];
        // The first argument of a stored result is never constant, so the initial entries match nothing.
        if (a, b, c) == (f, g, h) {
            return Ok(known);
        }
        let top = [f, g, h].map(|x| self.nodes[x.index()].variable).into_iter().min().expect("three arguments");
        let [(f0, f1), (g0, g1), (h0, h1)] = [f, g, h].map(|x| self.split(x, top));
        let low = self.if_then_else(f0, g0, h0)?;
        let high = self.if_then_else(f1, g1, h1)?;
        let result = self.node(top, low, high)?;
        let place = hash(f.0, g.0, h.0) as usize & (self.cache.len() - 1);
        self.cache[place] = (f, g, h, result);
        Ok(result)
    }

    /// `f` with every variable that `substitution` knows replaced by the function it gives.
    ///
    /// # Errors
    /// [`NodeLimit`].
    pub fn substitute(&mut self, f: Bdd, substitution: &mut Substitution) -> Result<Bdd, NodeLimit> {
        if f.is_constant() {
            return Ok(f);
        }
        if let Some(&known) = substitution.memo.get(&f) {
            return Ok(known);
        }
        let Node { variable, low, high } = self.nodes[f.index()];
        let low = self.substitute(low, substitution)?;
        let high = self.substitute(high, substitution)?;
        let condition = match substitution.values.get(&variable) {
            Some(&value) => value,
            None => self.variable(variable)?,
        };
        let result = self.if_then_else(condition, high, low)?;
        substitution.memo.insert(f, result);
        Ok(result)
    }

    /// The variables on which `f` depends, in order.
    pub fn support(&self, f: Bdd) -> Vec<Variable> {
        let mut seen: Memo<Bdd, ()> = Memo::default();
        let mut variables = Vec::new();
        let mut open = vec![f];
        while let Some(g) = open.pop() {
            if g.is_constant() || seen.insert(g, ()).is_some() {
                continue;
            }
            let node = self.nodes[g.index()];
            variables.push(node.variable);
            open.extend([node.low, node.high]);
        }
        variables.sort_unstable();
        variables.dedup();
        variables
    }

    /// The value of `f` when exactly the variables with `holds` are true.
    pub fn evaluate(&self, mut f: Bdd, holds: impl Fn(Variable) -> bool) -> bool {
        while !f.is_constant() {
            let node = self.nodes[f.index()];
            f = if holds(node.variable) { node.high } else { node.low };
        }
        f == Bdd::TRUE
    }

    fn split(&self, f: Bdd, variable: Variable) -> (Bdd, Bdd) {
        let node = self.nodes[f.index()];
        if node.variable == variable { (node.low, node.high) } else { (f, f) }
    }

    fn node(&mut self, variable: Variable, low: Bdd, high: Bdd) -> Result<Bdd, NodeLimit> {
        if low == high {
            return Ok(low);
        }
        let mask = self.unique.len() - 1;
        let mut place = hash(variable, low.0, high.0) as usize & mask;
        while self.unique[place] != 0 {
            let known = self.nodes[self.unique[place] as usize];
            if (known.variable, known.low, known.high) == (variable, low, high) {
                return Ok(Bdd(self.unique[place]));
            }
            place = (place + 1) & mask;
        }
        if self.nodes.len() >= self.limit {
            return Err(NodeLimit { limit: self.limit });
        }
        let index = self.nodes.len() as u32;
        self.nodes.push(Node { variable, low, high });
        self.unique[place] = index;
        if self.nodes.len() * 2 > self.unique.len() {
            self.grow();
        }
        Ok(Bdd(index))
    }

    /// Makes room for twice as many nodes.
    fn grow(&mut self) {
        let size = self.unique.len() * 2;
        self.unique = vec![0; size];
        for (index, node) in self.nodes.iter().enumerate().skip(2) {
            let mut place = hash(node.variable, node.low.0, node.high.0) as usize & (size - 1);
            while self.unique[place] != 0 {
                place = (place + 1) & (size - 1);
            }
            self.unique[place] = index as u32;
        }
        if self.cache.len() < size * 2 {
            self.cache = vec![(Bdd::FALSE, Bdd::FALSE, Bdd::FALSE, Bdd::FALSE); size * 2];
        }
    }
}

/// What to put in the places of variables, for [`Manager::substitute`]. Remembers what it was applied to, so keep one that is used often.
#[derive(Clone, Default)]
pub struct Substitution {
    values: Memo<Variable, Bdd>,
    memo: Memo<Bdd, Bdd>,
}

impl Substitution {
    /// From now on `variable` is replaced by `value`. Set it before a function that depends on it is substituted.
    pub fn set(&mut self, variable: Variable, value: Bdd) {
        if self.values.insert(variable, value).is_some_and(|old| old != value) {
            self.memo.clear();
        }
    }

    /// Whether `variable` is replaced.
    pub fn has(&self, variable: Variable) -> bool {
        self.values.contains_key(&variable)
    }
}

fn hash(a: u32, b: u32, c: u32) -> u32 {
    let mixed = (u64::from(a) ^ u64::from(b).rotate_left(21) ^ u64::from(c).rotate_left(42)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    (mixed >> 32) as u32
}

/// A map from small numbers with a fast hash that is the same on every target and in every run.
pub type Memo<K, V> = HashMap<K, V, BuildHasherDefault<WordHasher>>;

/// Multiplies and rotates: good enough for indices, and without a random key.
#[derive(Clone, Copy, Default)]
pub struct WordHasher(u64);

impl Hasher for WordHasher {
    fn finish(&self) -> u64 {
        self.0 ^ self.0 >> 29
    }

    fn write(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.write_u64(u64::from(*byte));
        }
    }

    fn write_u32(&mut self, word: u32) {
        self.write_u64(u64::from(word));
    }

    fn write_u64(&mut self, word: u64) {
        self.0 = (self.0.rotate_left(5) ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    }

    fn write_usize(&mut self, word: usize) {
        self.write_u64(word as u64);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A function of four variables as its table of 16 values, and the same as a diagram.
    fn diagram(manager: &mut Manager, table: u16) -> Bdd {
        let mut f = Bdd::FALSE;
        for row in (0..16u32).filter(|row| table >> row & 1 == 1) {
            let mut term = Bdd::TRUE;
            for v in 0..4 {
                let literal = manager.literal(v, row >> v & 1 == 1).unwrap();
                term = manager.and(term, literal).unwrap();
            }
            f = manager.or(f, term).unwrap();
        }
        f
    }

    fn table(manager: &Manager, f: Bdd) -> u16 {
        (0..16u16).fold(0, |all, row| all | u16::from(manager.evaluate(f, |v| row >> v & 1 == 1)) << row)
    }

    proptest! {
        #[test]
        fn operations_are_those_of_truth_tables(a: u16, b: u16, c: u16) {
            let manager = &mut Manager::new(10_000);
            let [f, g, h] = [a, b, c].map(|t| diagram(manager, t));
            prop_assert_eq!(table(manager, f), a);
            let and = manager.and(f, g).unwrap();
            let or = manager.or(f, g).unwrap();
            let not = manager.not(f).unwrap();
            let ite = manager.if_then_else(f, g, h).unwrap();
            prop_assert_eq!([and, or, not, ite].map(|x| table(manager, x)), [a & b, a | b, !a, a & b | !a & c]);
            prop_assert_eq!(manager.implies(f, g).unwrap(), a & !b == 0);
            prop_assert_eq!(f == g, a == b, "equal functions are equal indices");
            let mut exchange = Substitution::default();
            exchange.set(1, g);
            let composed = manager.substitute(f, &mut exchange).unwrap();
            let expected = (0..16u16).fold(0, |all, row| {
                let moved = row & !2 | (b >> row & 1) << 1;
                all | (a >> moved & 1) << row
            });
            prop_assert_eq!(table(manager, composed), expected);
            for v in manager.support(f) {
                prop_assert!((0..16u16).any(|row| a >> row & 1 != a >> (row ^ 1 << v) & 1));
            }
        }
    }

    #[test]
    fn the_limit_is_kept() {
        let manager = &mut Manager::new(20);
        let mut parity = Bdd::FALSE;
        let error = (0..100).find_map(|v| {
            let x = manager.variable(v).and_then(|x| {
                let not = manager.not(parity)?;
                manager.if_then_else(x, not, parity)
            });
            x.map(|x| parity = x).err()
        });
        assert_eq!(error, Some(NodeLimit { limit: 20 }));
        assert!(manager.len() <= 20);
    }
}
