//! Reduced ordered binary decision diagrams with one shared, hash-consed table of nodes.
//!
//! Equal functions are equal indices, so comparing two functions costs nothing. The order of the variables is that of their numbers; new
//! variables may be used at any time. Nothing is ever freed: a [`Manager`] lives as long as one translation, and limits on its nodes and on its
//! steps bound its space and its time.

mod memo;
mod substitution;

pub use memo::{Memo, WordHasher};
pub use substitution::Substitution;

use std::cell::RefCell;
use std::rc::Rc;

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

/// The work allowed was not enough.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Exhausted {
    /// The table of nodes is full.
    #[error("a decision diagram needs more than the {limit} nodes allowed")]
    Nodes {
        /// How many nodes were allowed.
        limit: usize,
    },
    /// There were too many steps of recursion.
    #[error("decision diagrams need more than the {limit} steps allowed")]
    Steps {
        /// How many steps were allowed.
        limit: u64,
    },
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
    /// Steps of recursion that are left, and were allowed.
    steps: u64,
    max_steps: u64,
    /// Steps below which the present part of the work ends.
    floor: u64,
    /// Supports already found.
    supports: RefCell<Supports>,
    /// Results of the present replacement: per node, the replacement's number and the result.
    replaced: Vec<(u32, Bdd)>,
    replacement: u32,
}

/// The supports of functions, and a place to mark nodes that were seen: per node the number of the last search.
#[derive(Default)]
struct Supports {
    known: Memo<Bdd, Rc<[Variable]>>,
    seen: Vec<u32>,
    search: u32,
}

impl Manager {
    /// A manager for at most `limit` nodes, and as many steps as may be.
    pub fn new(limit: usize) -> Manager {
        Manager::with_limits(limit, u64::MAX)
    }

    /// A manager for at most `limit` nodes (about 40 bytes each) and `max_steps` steps of recursion (some 20 million a second natively).
    pub fn with_limits(limit: usize, max_steps: u64) -> Manager {
        let constant = |this| Node { variable: NONE, low: this, high: this };
        let nothing = (Bdd::FALSE, Bdd::FALSE, Bdd::FALSE, Bdd::FALSE);
        Manager {
            nodes: vec![constant(Bdd::FALSE), constant(Bdd::TRUE)],
            unique: vec![0; 1 << 8],
            cache: vec![nothing; 1 << 10],
            limit,
            steps: max_steps,
            max_steps,
            floor: 0,
            supports: RefCell::default(),
            replaced: Vec::new(),
            replacement: 0,
        }
    }

    fn step(&mut self) -> Result<(), Exhausted> {
        if self.steps <= self.floor {
            return Err(Exhausted::Steps { limit: self.max_steps });
        }
        self.steps -= 1;
        Ok(())
    }

    /// Allows the work that follows, until this is called again, at most `steps` steps of those that are left.
    pub fn allow_steps(&mut self, steps: u64) {
        self.floor = self.steps.saturating_sub(steps);
    }

    /// How many steps of recursion were taken.
    pub fn steps_taken(&self) -> u64 {
        self.max_steps - self.steps
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
    /// [`Exhausted`], as for every function that may make nodes.
    pub fn variable(&mut self, variable: Variable) -> Result<Bdd, Exhausted> {
        self.node(variable, Bdd::FALSE, Bdd::TRUE)
    }

    /// The function that is true when `variable` has the value `value`.
    ///
    /// # Errors
    /// [`Exhausted`].
    pub fn literal(&mut self, variable: Variable, value: bool) -> Result<Bdd, Exhausted> {
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
    /// [`Exhausted`].
    pub fn and(&mut self, f: Bdd, g: Bdd) -> Result<Bdd, Exhausted> {
        self.if_then_else(f.min(g), f.max(g), Bdd::FALSE)
    }

    /// The disjunction.
    ///
    /// # Errors
    /// [`Exhausted`].
    pub fn or(&mut self, f: Bdd, g: Bdd) -> Result<Bdd, Exhausted> {
        self.if_then_else(f.min(g), Bdd::TRUE, f.max(g))
    }

    /// The negation.
    ///
    /// # Errors
    /// [`Exhausted`].
    pub fn not(&mut self, f: Bdd) -> Result<Bdd, Exhausted> {
        self.if_then_else(f, Bdd::FALSE, Bdd::TRUE)
    }

    /// Whether `g` is true wherever `f` is.
    ///
    /// # Errors
    /// [`Exhausted`].
    pub fn implies(&mut self, f: Bdd, g: Bdd) -> Result<bool, Exhausted> {
        Ok(self.if_then_else(f, g, Bdd::TRUE)? == Bdd::TRUE)
    }

    /// `g` where `f` is true, `h` where it is not.
    ///
    /// # Errors
    /// [`Exhausted`].
    pub fn if_then_else(&mut self, f: Bdd, mut g: Bdd, mut h: Bdd) -> Result<Bdd, Exhausted> {
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
        self.step()?;
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
    /// [`Exhausted`].
    pub fn substitute(&mut self, f: Bdd, substitution: &mut Substitution) -> Result<Bdd, Exhausted> {
        if f.is_constant() {
            return Ok(f);
        }
        if let Some(&known) = substitution.memo.get(&f) {
            return Ok(known);
        }
        self.step()?;
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

    /// `f` with the variables of `values`, which are sorted, replaced by the functions beside them. As [`Manager::substitute`], for what is
    /// asked once.
    ///
    /// # Errors
    /// [`Exhausted`].
    pub fn replace(&mut self, f: Bdd, values: &[(Variable, Bdd)]) -> Result<Bdd, Exhausted> {
        if values.is_empty() {
            return Ok(f);
        }
        self.replacement += 1;
        self.replaced.resize(self.nodes.len(), (0, Bdd::FALSE));
        self.replace_below(f, values)
    }

    fn replace_below(&mut self, f: Bdd, values: &[(Variable, Bdd)]) -> Result<Bdd, Exhausted> {
        let Node { variable, low, high } = self.nodes[f.index()];
        if values.last().is_none_or(|(last, _)| variable > *last) {
            return Ok(f);
        }
        let (number, known) = self.replaced[f.index()];
        if number == self.replacement {
            return Ok(known);
        }
        self.step()?;
        let low = self.replace_below(low, values)?;
        let high = self.replace_below(high, values)?;
        let condition = match values.binary_search_by_key(&variable, |(v, _)| *v) {
            Ok(i) => values[i].1,
            Err(_) => self.variable(variable)?,
        };
        let result = self.if_then_else(condition, high, low)?;
        // Only nodes that were there before are replaced, so the place exists.
        self.replaced[f.index()] = (self.replacement, result);
        Ok(result)
    }

    /// The variables on which `f` depends, in order.
    pub fn support(&self, f: Bdd) -> Rc<[Variable]> {
        let mut supports = self.supports.borrow_mut();
        let Supports { known, seen, search } = &mut *supports;
        if let Some(variables) = known.get(&f) {
            return variables.clone();
        }
        *search += 1;
        seen.resize(self.nodes.len(), 0);
        let mut variables = Vec::new();
        let mut open = vec![f];
        while let Some(g) = open.pop() {
            if g.is_constant() || std::mem::replace(&mut seen[g.index()], *search) == *search {
                continue;
            }
            let node = self.nodes[g.index()];
            variables.push(node.variable);
            open.extend([node.low, node.high]);
        }
        variables.sort_unstable();
        variables.dedup();
        let variables: Rc<[Variable]> = variables.into();
        known.insert(f, variables.clone());
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

    fn node(&mut self, variable: Variable, low: Bdd, high: Bdd) -> Result<Bdd, Exhausted> {
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
            return Err(Exhausted::Nodes { limit: self.limit });
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
        // More places would help little and cost time: they are all written when they are made.
        if self.cache.len() < size / 2 {
            self.cache = vec![(Bdd::FALSE, Bdd::FALSE, Bdd::FALSE, Bdd::FALSE); size / 2];
        }
    }
}

fn hash(a: u32, b: u32, c: u32) -> u32 {
    let mixed = (u64::from(a) ^ u64::from(b).rotate_left(21) ^ u64::from(c).rotate_left(42)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    (mixed >> 32) as u32
}

#[cfg(test)]
mod tests;
