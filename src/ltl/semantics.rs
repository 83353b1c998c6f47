//! The truth of a formula on an ultimately periodic word, by fixpoints on its finitely many suffixes.

use super::ast::{BinaryOperator, Formula, UnaryOperator};
use super::lasso::Lasso;
use crate::labels::Propositions;

/// A formula that speaks of a proposition the alphabet does not have.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("the formula's proposition `{name}` is none of the alphabet's: {}", .known.join(", "))]
pub struct UnknownProposition {
    /// The name that is missing.
    pub name: String,
    /// The names there are.
    pub known: Vec<String>,
}

/// Whether `word` satisfies `formula`, letters being read with the names of `propositions`.
///
/// Takes time and space proportional to the size of the formula times |u| + |v|; to ask many words, make an [`Evaluator`] once.
///
/// Semantics over words: definition 5.6 of [Baier & Katoen](crate::bib::BaierKatoen2008).
///
/// # Errors
/// A proposition of the formula that is not in `propositions`.
///
/// # Panics
/// If the cycle of `word` is empty.
pub fn satisfies(formula: &Formula, propositions: &Propositions, word: &Lasso) -> Result<bool, UnknownProposition> {
    Ok(Evaluator::new(formula, propositions)?.satisfied_by(word))
}

/// A formula made ready to be asked on many words: its subformulas in an order in which operands come first.
#[derive(Clone, Debug)]
pub struct Evaluator {
    steps: Vec<Step>,
}

/// One subformula; operands are named by their position.
#[derive(Clone, Copy, Debug)]
enum Step {
    Constant(bool),
    Letter(usize),
    Unary(UnaryOperator, usize),
    Binary(BinaryOperator, usize, usize),
}

impl Evaluator {
    /// Looks the names of `formula` up in `propositions`.
    ///
    /// # Errors
    /// A proposition of the formula that is not in `propositions`.
    pub fn new(formula: &Formula, propositions: &Propositions) -> Result<Evaluator, UnknownProposition> {
        let mut steps = Vec::new();
        push(formula, propositions, &mut steps)?;
        Ok(Evaluator { steps })
    }

    /// Whether `word` satisfies the formula.
    ///
    /// # Panics
    /// If the cycle of `word` is empty.
    pub fn satisfied_by(&self, word: &Lasso) -> bool {
        self.suffixes(word)[0]
    }

    /// For each position 0 ≤ i < |u| + |v| whether the suffix of the word from there on satisfies the formula.
    ///
    /// # Panics
    /// If the cycle of `word` is empty.
    pub fn suffixes(&self, word: &Lasso) -> Vec<bool> {
        assert!(!word.cycle.is_empty(), "a lasso word has a cycle");
        let letters: Vec<_> = word.prefix.iter().chain(&word.cycle).copied().collect();
        let shape = Shape { length: letters.len(), back: word.prefix.len() };
        let mut rows: Vec<Vec<bool>> = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            let row = match *step {
                Step::Constant(value) => vec![value; shape.length],
                Step::Letter(index) => letters.iter().map(|sigma| sigma.holds(index)).collect(),
                Step::Unary(operator, operand) => shape.unary(operator, &rows[operand]),
                Step::Binary(operator, left, right) => shape.binary(operator, &rows[left], &rows[right]),
            };
            rows.push(row);
        }
        rows.pop().expect("the formula itself is the last step")
    }
}

/// Appends the steps of `formula`; returns the position of the last, which is the formula itself.
fn push(formula: &Formula, propositions: &Propositions, steps: &mut Vec<Step>) -> Result<usize, UnknownProposition> {
    let step =
        match formula {
            Formula::True => Step::Constant(true),
            Formula::False => Step::Constant(false),
            Formula::Proposition(name) => Step::Letter(propositions.index(name).ok_or_else(|| UnknownProposition {
                name: name.clone(),
                known: propositions.iter().map(str::to_owned).collect(),
            })?),
            Formula::Unary(operator, operand) => Step::Unary(*operator, push(operand, propositions, steps)?),
            Formula::Binary(operator, left, right) => {
                let left = push(left, propositions, steps)?;
                Step::Binary(*operator, left, push(right, propositions, steps)?)
            }
        };
    steps.push(step);
    Ok(steps.len() - 1)
}

/// The positions of a lasso: 0 … length − 1, the successor of the last being `back`.
#[derive(Clone, Copy)]
struct Shape {
    length: usize,
    back: usize,
}

impl Shape {
    fn unary(self, operator: UnaryOperator, a: &[bool]) -> Vec<bool> {
        match operator {
            UnaryOperator::Not => a.iter().map(|a| !a).collect(),
            UnaryOperator::Next => (0..self.length).map(|i| a[self.successor(i)]).collect(),
            UnaryOperator::Finally => self.fixpoint(false, |i, next| a[i] || next),
            UnaryOperator::Globally => self.fixpoint(true, |i, next| a[i] && next),
        }
    }

    fn binary(self, operator: BinaryOperator, a: &[bool], b: &[bool]) -> Vec<bool> {
        let pointwise = |f: fn(bool, bool) -> bool| a.iter().zip(b).map(|(a, b)| f(*a, *b)).collect();
        match operator {
            BinaryOperator::And => pointwise(|a, b| a && b),
            BinaryOperator::Or => pointwise(|a, b| a || b),
            BinaryOperator::Xor => pointwise(|a, b| a != b),
            BinaryOperator::Implies => pointwise(|a, b| !a || b),
            BinaryOperator::Iff => pointwise(|a, b| a == b),
            BinaryOperator::Until => self.fixpoint(false, |i, next| b[i] || a[i] && next),
            BinaryOperator::WeakUntil => self.fixpoint(true, |i, next| b[i] || a[i] && next),
            BinaryOperator::Release => self.fixpoint(true, |i, next| b[i] && (a[i] || next)),
            BinaryOperator::StrongRelease => self.fixpoint(false, |i, next| b[i] && (a[i] || next)),
        }
    }

    fn successor(self, i: usize) -> usize {
        if i + 1 == self.length { self.back } else { i + 1 }
    }

    /// The solution of x(i) = `local`(i, x(i + 1)) that is least (`start` false) or greatest (`start` true).
    ///
    /// Going backwards, the first pass assumes `start` behind the end. If that assumption is wrong at `back`, then x(back) does not
    /// depend on what stands behind the end, so the second pass is right everywhere.
    fn fixpoint(self, start: bool, local: impl Fn(usize, bool) -> bool) -> Vec<bool> {
        let mut x = vec![start; self.length];
        let mut next = start;
        for _ in 0..2 {
            for i in (0..self.length).rev() {
                x[i] = local(i, next);
                next = x[i];
            }
            next = x[self.back];
        }
        x
    }
}
