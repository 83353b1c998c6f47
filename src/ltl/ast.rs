//! The syntax tree of an LTL formula.

use std::collections::BTreeSet;

/// A unary operator.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum UnaryOperator {
    /// `!`, negation.
    Not,
    /// `X`, next.
    Next,
    /// `F`, eventually.
    Finally,
    /// `G`, always.
    Globally,
}

/// A binary operator.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum BinaryOperator {
    /// `&`, conjunction.
    And,
    /// `|`, disjunction.
    Or,
    /// `^`, exclusive or.
    Xor,
    /// `->`, implication.
    Implies,
    /// `<->`, equivalence.
    Iff,
    /// `U`, until: the right side holds at some instant and the left side at all instants before it.
    Until,
    /// `R`, release: the right side holds up to and including the first instant at which the left side holds, if any, else for ever.
    Release,
    /// `W`, weak until: `a U b`, or `a` for ever.
    WeakUntil,
    /// `M`, strong release: `a R b`, and `a` holds at some instant.
    StrongRelease,
}

impl BinaryOperator {
    /// Whether the operator speaks about other instants than the present one (`U`, `R`, `W`, `M`).
    pub fn is_temporal(self) -> bool {
        use BinaryOperator::{Release, StrongRelease, Until, WeakUntil};
        matches!(self, Until | Release | WeakUntil | StrongRelease)
    }
}

/// A formula of linear temporal logic, as a tree: what was written, before any rewriting.
///
/// A tree that comes from [`Formula::parse`] is at most [`MAX_HEIGHT`](super::parse::MAX_HEIGHT) high, so that recursion over it, its
/// comparison and its destruction need little stack.
///
/// Syntax and semantics: chapter 5 of [Baier & Katoen](crate::bib::BaierKatoen2008); `R`, `W` and `M` as in section 5.1.5 and as Spot has
/// them.
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Formula {
    /// `true`.
    True,
    /// `false`.
    False,
    /// An atomic proposition, by its name (never empty).
    Proposition(String),
    /// An operator and its operand.
    Unary(UnaryOperator, Box<Formula>),
    /// An operator between its left and its right operand.
    Binary(BinaryOperator, Box<Formula>, Box<Formula>),
}

impl Formula {
    /// The atomic proposition called `name`.
    pub fn proposition(name: impl Into<String>) -> Formula {
        Formula::Proposition(name.into())
    }

    /// `operator operand`.
    pub fn unary(operator: UnaryOperator, operand: Formula) -> Formula {
        Formula::Unary(operator, Box::new(operand))
    }

    /// `left operator right`.
    pub fn binary(operator: BinaryOperator, left: Formula, right: Formula) -> Formula {
        Formula::Binary(operator, Box::new(left), Box::new(right))
    }

    /// The negation, as a tree with `!` on top.
    #[must_use]
    pub fn negated(&self) -> Formula {
        Formula::unary(UnaryOperator::Not, self.clone())
    }

    /// The names of the atomic propositions that occur, each once, in the order in which they first occur from left to right.
    pub fn propositions(&self) -> Vec<String> {
        let mut seen = BTreeSet::new();
        let mut names = Vec::new();
        self.visit(&mut |formula| {
            if let Formula::Proposition(name) = formula
                && seen.insert(name.as_str())
            {
                names.push(name.clone());
            }
        });
        names
    }

    /// The number of nodes of the tree: operators, propositions and constants.
    pub fn size(&self) -> usize {
        let mut size = 0;
        self.visit(&mut |_| size += 1);
        size
    }

    /// The height of the tree: 1 for a proposition or a constant.
    pub fn height(&self) -> usize {
        1 + match self {
            Formula::True | Formula::False | Formula::Proposition(_) => 0,
            Formula::Unary(_, operand) => operand.height(),
            Formula::Binary(_, left, right) => left.height().max(right.height()),
        }
    }

    /// Calls `see` for every node, a node before its operands, left before right.
    fn visit<'a>(&'a self, see: &mut impl FnMut(&'a Formula)) {
        see(self);
        match self {
            Formula::True | Formula::False | Formula::Proposition(_) => {}
            Formula::Unary(_, operand) => operand.visit(see),
            Formula::Binary(_, left, right) => {
                left.visit(see);
                right.visit(see);
            }
        }
    }
}
