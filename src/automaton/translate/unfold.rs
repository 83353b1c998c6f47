//! Formulas as states: the unfolding of fixpoints, and the formula that is left after a letter, `af`.
//!
//! A formula is a decision diagram over the propositions (what must hold now) and over variables nx(ψ), read "Xψ" (what must hold from the
//! next instant on). The unfolding is unf(Xψ) = N(ψ), unf(Fψ) = unf ψ ∨ nx(Fψ), unf(Gψ) = unf ψ ∧ nx(Gψ), for U and W
//! unf χ ∨ (unf ψ ∧ nx(self)), for R and M unf χ ∧ (unf ψ ∨ nx(self)), where N distributes nx over ∧ and ∨. The successor af(B, σ) of a state
//! is the cofactor of B by the letter σ, a diagram over nx(·) only (the *raw* successor), in which every nx(ψ) is then replaced by unf(ψ).
//! Formulas with the same unfolding are one state.
//!
//! af: definition 2.3 of [Esparza, Křetínský & Sickert](crate::bib::Esparza2020); unfolding: definition 6 of
//! [Sickert et al.](crate::bib::Sickert2016).

use super::invariant;
use super::options::{Construction, Preference};
use super::work::{Stop, Work};
use crate::bdd::{Bdd, Manager, Memo, Substitution, Variable};
use crate::ltl::simplify::Simplifier;
use crate::ltl::{Node, NodeId, Store, Traits};
use std::collections::BTreeMap;
use std::rc::Rc;

/// A letter set and the raw successor under it.
pub(super) type Step = (Bdd, Bdd);

/// What becomes of suffix-invariant formulas when a formula is unfolded.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Invariants {
    /// They are unfolded as all others are.
    Unfolded,
    /// Where [`invariant`](super::invariant) allows it, they are left as they are: no letter changes them.
    Kept,
}

/// What was unfolded already, one way.
#[derive(Default)]
struct Unfolded {
    formulas: Memo<usize, Bdd>,
    replacement: Substitution,
    raw: Memo<Bdd, Bdd>,
}

/// The formulas, their diagrams, and everything remembered about them during one translation.
pub(super) struct Unfolding<'a> {
    pub store: Store,
    pub simplifier: Simplifier,
    pub bdd: Manager,
    pub work: Work<'a>,
    /// The letters that can occur.
    pub letters: Bdd,
    /// Which of several automata is best.
    pub prefer: Preference,
    /// Which constructions are tried.
    pub construction: Construction,
    /// The subformula that is being translated, for error messages.
    pub focus: NodeId,
    /// Groups of propositions of which at most one holds.
    pub exclusive: Vec<Vec<Variable>>,
    /// How many propositions there are; variable i < `propositions` is proposition i, the others are nx(·).
    propositions: Variable,
    /// The ψ of the variables nx(ψ), in the order of the variables.
    atoms: Vec<NodeId>,
    variables: Memo<usize, Variable>,
    raw: Memo<usize, Bdd>,
    /// By [`Invariants`].
    unfolded: [Unfolded; 2],
    steps: Memo<Bdd, Rc<[Step]>>,
    /// Per unfolded diagram, the first raw diagram it came from: the formula that names the state.
    origins: Memo<Bdd, Bdd>,
}

impl<'a> Unfolding<'a> {
    /// For formulas of `store`, whose list of names is complete.
    pub fn new(store: Store, work: Work<'a>) -> Unfolding<'a> {
        let propositions = store.names().len() as Variable;
        let bdd = Manager::with_limits(work.budget().nodes, work.budget().steps);
        Unfolding {
            store,
            simplifier: Simplifier::default(),
            bdd,
            work,
            letters: Bdd::TRUE,
            prefer: Preference::default(),
            construction: Construction::default(),
            focus: NodeId::TRUE,
            exclusive: Vec::new(),
            propositions,
            atoms: Vec::new(),
            variables: Memo::default(),
            raw: Memo::default(),
            unfolded: <[Unfolded; 2]>::default(),
            steps: Memo::default(),
            origins: Memo::default(),
        }
    }

    /// N(ψ): `id` from the next instant on, as a diagram over nx(·).
    pub fn raw(&mut self, id: NodeId) -> Result<Bdd, Stop> {
        if let Some(&known) = self.raw.get(&id.index()) {
            return Ok(known);
        }
        let result = match self.store.node(id).clone() {
            Node::True => Bdd::TRUE,
            Node::False => Bdd::FALSE,
            Node::And(list) => {
                let mut all = Bdd::TRUE;
                for part in list.iter() {
                    let part = self.raw(*part)?;
                    all = self.bdd.and(all, part)?;
                }
                all
            }
            Node::Or(list) => {
                let mut any = Bdd::FALSE;
                for part in list.iter() {
                    let part = self.raw(*part)?;
                    any = self.bdd.or(any, part)?;
                }
                any
            }
            _ => {
                let variable = self.variable(id);
                self.bdd.variable(variable)?
            }
        };
        self.raw.insert(id.index(), result);
        Ok(result)
    }

    fn variable(&mut self, atom: NodeId) -> Variable {
        let next = self.propositions + self.atoms.len() as Variable;
        let variable = *self.variables.entry(atom.index()).or_insert(next);
        if variable == next {
            self.atoms.push(atom);
        }
        variable
    }

    /// unf(ψ).
    pub fn unfold(&mut self, id: NodeId) -> Result<Bdd, Stop> {
        self.unfold_with(id, Invariants::Unfolded)
    }

    /// unf(ψ), or the same with nx(τ) for suffix-invariant τ.
    pub fn unfold_with(&mut self, id: NodeId, invariants: Invariants) -> Result<Bdd, Stop> {
        if let Some(&known) = self.unfolded[invariants as usize].formulas.get(&id.index()) {
            return Ok(known);
        }
        if invariants == Invariants::Kept && invariant::is_kept(&self.store, id) {
            return self.raw(id);
        }
        let result = match self.store.node(id).clone() {
            Node::True => Bdd::TRUE,
            Node::False => Bdd::FALSE,
            Node::Literal { proposition, positive } => self.bdd.literal(proposition as Variable, positive)?,
            Node::And(list) => {
                let mut all = Bdd::TRUE;
                for part in list.iter() {
                    let part = self.unfold_with(*part, invariants)?;
                    all = self.bdd.and(all, part)?;
                }
                all
            }
            Node::Or(list) => {
                let mut any = Bdd::FALSE;
                for part in list.iter() {
                    let part = self.unfold_with(*part, invariants)?;
                    any = self.bdd.or(any, part)?;
                }
                any
            }
            Node::Next(a) => self.raw(a)?,
            Node::Finally(a) => {
                let (now, later) = (self.unfold_with(a, invariants)?, self.raw(id)?);
                self.bdd.or(now, later)?
            }
            Node::Globally(a) => {
                let (now, later) = (self.unfold_with(a, invariants)?, self.raw(id)?);
                self.bdd.and(now, later)?
            }
            Node::Until(a, b) | Node::WeakUntil(a, b) => {
                let (a, b, later) = (self.unfold_with(a, invariants)?, self.unfold_with(b, invariants)?, self.raw(id)?);
                let kept = self.bdd.and(a, later)?;
                self.bdd.or(b, kept)?
            }
            Node::Release(a, b) | Node::StrongRelease(a, b) => {
                let (a, b, later) = (self.unfold_with(a, invariants)?, self.unfold_with(b, invariants)?, self.raw(id)?);
                let kept = self.bdd.or(a, later)?;
                self.bdd.and(b, kept)?
            }
        };
        self.unfolded[invariants as usize].formulas.insert(id.index(), result);
        Ok(result)
    }

    /// `f` with every nx(ψ) replaced by unf(ψ).
    pub fn unfold_raw(&mut self, f: Bdd) -> Result<Bdd, Stop> {
        self.unfold_raw_with(f, Invariants::Unfolded)
    }

    /// `f` with every nx(ψ) replaced as [`Unfolding::unfold_with`] says.
    pub fn unfold_raw_with(&mut self, f: Bdd, invariants: Invariants) -> Result<Bdd, Stop> {
        if let Some(&known) = self.unfolded[invariants as usize].raw.get(&f) {
            return Ok(known);
        }
        for &variable in self.bdd.support(f).iter() {
            if variable >= self.propositions && !self.unfolded[invariants as usize].replacement.has(variable) {
                let value = self.unfold_with(self.atom(variable), invariants)?;
                self.unfolded[invariants as usize].replacement.set(variable, value);
            }
        }
        let done = &mut self.unfolded[invariants as usize];
        let unfolded = self.bdd.substitute(f, &mut done.replacement)?;
        done.raw.insert(f, unfolded);
        self.origins.entry(unfolded).or_insert(f);
        Ok(unfolded)
    }

    /// The raw diagram that the unfolded diagram `state` first came from.
    pub fn origin(&self, state: Bdd) -> Option<Bdd> {
        self.origins.get(&state).copied()
    }

    /// The ψ of the variable nx(ψ).
    pub fn atom(&self, variable: Variable) -> NodeId {
        self.atoms[(variable - self.propositions) as usize]
    }

    /// The ψ of all nx(ψ) on which `f` depends, in the order of the variables.
    pub fn atoms(&self, f: Bdd) -> Vec<NodeId> {
        self.bdd.support(f).iter().filter(|v| **v >= self.propositions).map(|v| self.atom(*v)).collect()
    }

    /// `f` with every nx(ψ) replaced by the diagram that `value` gives for ψ.
    pub fn replace(&mut self, f: Bdd, mut value: impl FnMut(&mut Self, NodeId) -> Result<Bdd, Stop>) -> Result<Bdd, Stop> {
        let mut values = Vec::new();
        for &variable in self.bdd.support(f).iter() {
            if variable >= self.propositions {
                values.push((variable, value(self, self.atom(variable))?));
            }
        }
        Ok(self.bdd.replace(f, &values)?)
    }

    /// The raw successors of the state `f`, each with the letters that lead there; letters that lead to `false` or cannot occur are left out.
    /// The letter sets are disjoint and the order is the same in every run.
    pub fn steps(&mut self, f: Bdd) -> Result<Rc<[Step]>, Stop> {
        if let Some(known) = self.steps.get(&f) {
            return Ok(known.clone());
        }
        let mut leaves = Memo::default();
        let all = self.leaves(f, &mut leaves)?;
        let mut steps = Vec::new();
        for &(raw, guard) in all.iter() {
            let guard = self.bdd.and(guard, self.letters)?;
            if raw != Bdd::FALSE && guard != Bdd::FALSE {
                steps.push((guard, raw));
            }
        }
        let steps: Rc<[Step]> = steps.into();
        self.steps.insert(f, steps.clone());
        Ok(steps)
    }

    /// The diagrams over nx(·) that `f` ends in, each with the letters that lead there.
    fn leaves(&mut self, f: Bdd, known: &mut Memo<Bdd, Rc<[Step]>>) -> Result<Rc<[Step]>, Stop> {
        let Some(variable) = self.bdd.top(f).filter(|v| *v < self.propositions) else {
            return Ok([(f, Bdd::TRUE)].into());
        };
        if let Some(leaves) = known.get(&f) {
            return Ok(leaves.clone());
        }
        let (low, high) = self.bdd.branches(f);
        let mut guards: BTreeMap<Bdd, (Bdd, Bdd)> = BTreeMap::new();
        for &(leaf, guard) in self.leaves(low, known)?.iter() {
            guards.insert(leaf, (guard, Bdd::FALSE));
        }
        for &(leaf, guard) in self.leaves(high, known)?.iter() {
            guards.entry(leaf).or_insert((Bdd::FALSE, Bdd::FALSE)).1 = guard;
        }
        let condition = self.bdd.variable(variable)?;
        let mut leaves = Vec::with_capacity(guards.len());
        for (leaf, (low, high)) in guards {
            leaves.push((leaf, self.bdd.if_then_else(condition, high, low)?));
        }
        self.work.tick(leaves.len())?;
        let leaves: Rc<[Step]> = leaves.into();
        known.insert(f, leaves.clone());
        Ok(leaves)
    }

    /// `f`, conjoined with what its atoms are seen to imply about `atoms`. It has the same words as `f`, and if it implies `g` as a diagram, then
    /// every word that satisfies `f` satisfies `g`.
    pub fn with_implications(&mut self, f: Bdd, atoms: &[NodeId]) -> Result<Bdd, Stop> {
        let mut assumed = f;
        for a in self.atoms(f) {
            for &b in atoms {
                if a != b && self.simplifier.implies(&self.store, a, b) {
                    let (a, b) = (self.raw(a)?, self.raw(b)?);
                    let rule = self.bdd.if_then_else(a, b, Bdd::TRUE)?;
                    assumed = self.bdd.and(assumed, rule)?;
                }
            }
        }
        Ok(assumed)
    }

    /// unf(ψ) for the variable nx(ψ).
    pub fn unfolded(&mut self, variable: Variable, invariants: Invariants) -> Result<Bdd, Stop> {
        let atom = self.atom(variable);
        self.unfold_with(atom, invariants)
    }

    /// The variables nx(ψ) of `f` with a ψ of such traits.
    pub fn variables_with(&self, f: Bdd, wanted: impl Fn(Traits) -> bool) -> Vec<Variable> {
        let wanted = |v: &Variable| *v >= self.propositions && wanted(self.store.traits(self.atom(*v)));
        self.bdd.support(f).iter().copied().filter(wanted).collect()
    }
}
