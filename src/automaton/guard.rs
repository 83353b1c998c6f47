//! Sets of letters as disjunctions of cubes: intersection, complement, cover and overlap checks, short readable text.

use super::cover::{absorbed, complement, covers, minimise, missing};
use crate::labels::{Labels, Propositions};
use serde::{Deserialize, Serialize};

/// A conjunction of literals: the propositions of `positive` hold, those of `negative` do not (disjoint bit masks).
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Debug, Serialize, Deserialize)]
pub struct Cube {
    /// Propositions that must hold.
    pub positive: u64,
    /// Propositions that must not hold.
    pub negative: u64,
}

impl Cube {
    /// The cube without literals: every letter.
    pub const ANY: Cube = Cube { positive: 0, negative: 0 };

    /// The cube of one literal: proposition `index` (below 64) has the truth value `value`.
    pub fn literal(index: usize, value: bool) -> Cube {
        if value { Cube { positive: 1 << index, negative: 0 } } else { Cube { positive: 0, negative: 1 << index } }
    }

    /// The cube of the single letter `sigma` over `count` (at most 64) propositions.
    pub fn letter(sigma: Labels, count: usize) -> Cube {
        let mask = if count >= 64 { u64::MAX } else { (1 << count) - 1 };
        Cube { positive: sigma.0 & mask, negative: !sigma.0 & mask }
    }

    /// Whether `sigma` satisfies every literal.
    pub fn contains(self, sigma: Labels) -> bool {
        sigma.0 & self.positive == self.positive && sigma.0 & self.negative == 0
    }

    /// Whether no letter satisfies it: a proposition must both hold and not hold.
    pub fn is_empty(self) -> bool {
        self.positive & self.negative != 0
    }

    /// The letters of both; `None` when there is none.
    #[must_use]
    pub fn and(self, other: Cube) -> Option<Cube> {
        let both = Cube { positive: self.positive | other.positive, negative: self.negative | other.negative };
        (!both.is_empty()).then_some(both)
    }

    /// Whether every letter of `other` is one of its letters.
    pub fn includes(self, other: Cube) -> bool {
        other.positive & self.positive == self.positive && other.negative & self.negative == self.negative
    }

    /// The propositions it speaks of.
    pub fn support(self) -> u64 {
        self.positive | self.negative
    }

    /// Without the literal on proposition `index`.
    #[must_use]
    pub(super) fn without(self, index: u32) -> Cube {
        Cube { positive: self.positive & !(1 << index), negative: self.negative & !(1 << index) }
    }
}

/// A set of letters, as a disjunction of cubes; empty = no letter, one empty cube = every letter.
#[derive(Clone, PartialEq, Eq, Hash, Default, Debug, Serialize, Deserialize)]
pub struct Guard(pub Vec<Cube>);

/// How much work is left for operations whose cost may grow exponentially with the propositions, in cubes looked at.
///
/// One effort is shared by all operations on one automaton, so that no input can keep the library busy without end.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Effort(u64);

/// The work allowed ran out, or a set of letters needs more than [`Guard::MAX_CUBES`] cubes.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[error("the labels are too complex: more than {} cubes, or too much work to compare them", Guard::MAX_CUBES)]
pub struct TooComplex;

impl Default for Effort {
    /// 100 million cubes: about half a second.
    fn default() -> Effort {
        Effort(100_000_000)
    }
}

impl Effort {
    /// An effort of `cubes` cubes looked at.
    pub fn new(cubes: u64) -> Effort {
        Effort(cubes)
    }

    /// Takes `cubes` off what is left.
    ///
    /// # Errors
    /// When less than that is left.
    pub fn spend(&mut self, cubes: usize) -> Result<(), TooComplex> {
        self.0 = self.0.checked_sub(cubes as u64).ok_or(TooComplex)?;
        Ok(())
    }
}

impl Guard {
    /// The largest number of cubes an operation may produce.
    pub const MAX_CUBES: usize = 1 << 16;

    /// Every letter.
    pub fn any() -> Guard {
        Guard(vec![Cube::ANY])
    }

    /// No letter.
    pub fn never() -> Guard {
        Guard(Vec::new())
    }

    /// Whether `sigma` is one of the letters.
    pub fn contains(&self, sigma: Labels) -> bool {
        self.0.iter().any(|cube| cube.contains(sigma))
    }

    /// Whether it has no letter.
    pub fn is_empty(&self) -> bool {
        self.0.iter().all(|cube| cube.is_empty())
    }

    /// The propositions it speaks of, as a bit mask.
    pub fn support(&self) -> u64 {
        self.0.iter().fold(0, |all, cube| all | cube.support())
    }

    /// One of its letters; `None` if it has none.
    pub fn witness(&self) -> Option<Labels> {
        self.0.iter().find(|cube| !cube.is_empty()).map(|cube| Labels(cube.positive))
    }

    /// The letters of this or `other`.
    ///
    /// # Errors
    /// [`TooComplex`].
    pub fn or(&self, other: &Guard, effort: &mut Effort) -> Result<Guard, TooComplex> {
        absorbed(self.0.iter().chain(&other.0).copied().collect(), effort)
    }

    /// The letters of both.
    ///
    /// # Errors
    /// [`TooComplex`].
    pub fn and(&self, other: &Guard, effort: &mut Effort) -> Result<Guard, TooComplex> {
        effort.spend(self.0.len() * other.0.len())?;
        absorbed(self.0.iter().flat_map(|a| other.0.iter().filter_map(|b| a.and(*b))).collect(), effort)
    }

    /// All other letters.
    ///
    /// # Errors
    /// [`TooComplex`].
    pub fn complement(&self, effort: &mut Effort) -> Result<Guard, TooComplex> {
        let cubes: Vec<Cube> = self.0.iter().copied().filter(|cube| !cube.is_empty()).collect();
        absorbed(complement(&cubes, effort)?, effort)
    }

    /// A letter of both; `None` if they are disjoint.
    ///
    /// # Errors
    /// [`TooComplex`].
    pub fn overlap(&self, other: &Guard, effort: &mut Effort) -> Result<Option<Labels>, TooComplex> {
        effort.spend(self.0.len() * other.0.len())?;
        let common = self.0.iter().find_map(|a| other.0.iter().find_map(|b| a.and(*b)));
        Ok(common.map(|cube| Labels(cube.positive)))
    }

    /// A letter it does not have; `None` if it has all.
    ///
    /// # Errors
    /// [`TooComplex`].
    pub fn missing(&self, effort: &mut Effort) -> Result<Option<Labels>, TooComplex> {
        let cubes: Vec<Cube> = self.0.iter().copied().filter(|cube| !cube.is_empty()).collect();
        missing(&cubes, effort).map(|cube| cube.map(|c| Labels(c.positive)))
    }

    /// Whether all letters of `other` are among its own.
    ///
    /// # Errors
    /// [`TooComplex`].
    pub fn includes(&self, other: &Guard, effort: &mut Effort) -> Result<bool, TooComplex> {
        covers(&self.0, &other.0, effort)
    }

    /// Whether both have the same letters.
    ///
    /// # Errors
    /// [`TooComplex`].
    pub fn same(&self, other: &Guard, effort: &mut Effort) -> Result<bool, TooComplex> {
        Ok(self.0 == other.0 || (covers(&self.0, &other.0, effort)? && covers(&other.0, &self.0, effort)?))
    }

    /// The same letters by few and short cubes: no literal and no cube can be left out. Falls back to itself when that is too
    /// much work.
    #[must_use]
    pub fn minimised(&self) -> Guard {
        minimise(self, &mut Effort::new(2_000_000)).unwrap_or_else(|TooComplex| self.clone())
    }

    /// Readable text in the names of `propositions`: `r1 & !r2`, `a | b & !c`, `true`, `false`. Minimises first.
    ///
    /// # Panics
    /// If a literal's index is not below the number of propositions.
    pub fn text(&self, propositions: &Propositions) -> String {
        let literal = |cube: &Cube, index: usize| {
            format!("{}{}", if cube.negative >> index & 1 == 1 { "!" } else { "" }, propositions.name(index))
        };
        let conjunction = |cube: &Cube| {
            let literals: Vec<String> = (0..64).filter(|i| cube.support() >> i & 1 == 1).map(|i| literal(cube, i)).collect();
            if literals.is_empty() { "true".into() } else { literals.join(" & ") }
        };
        let cubes: Vec<String> = self.minimised().0.iter().map(conjunction).collect();
        if cubes.is_empty() { "false".into() } else { cubes.join(" | ") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn guards(count: usize) -> impl Strategy<Value = Guard> {
        let mask = (1u64 << count) - 1;
        let cube = (0..=mask, 0..=mask).prop_map(|(p, n)| Cube { positive: p, negative: n & !p });
        proptest::collection::vec(cube, 0..6).prop_map(Guard)
    }

    fn letters(guard: &Guard) -> Vec<bool> {
        (0..32).map(|sigma| guard.contains(Labels(sigma))).collect()
    }

    proptest! {
        #[test]
        fn operations_are_those_of_sets_of_letters(a in guards(5), b in guards(5)) {
            let effort = &mut Effort::default();
            let (la, lb) = (letters(&a), letters(&b));
            let zip = |f: fn(bool, bool) -> bool| la.iter().zip(&lb).map(|(x, y)| f(*x, *y)).collect::<Vec<_>>();
            prop_assert_eq!(letters(&a.and(&b, effort).unwrap()), zip(|x, y| x && y));
            prop_assert_eq!(letters(&a.or(&b, effort).unwrap()), zip(|x, y| x || y));
            prop_assert_eq!(letters(&a.complement(effort).unwrap()), zip(|x, _| !x));
            prop_assert_eq!(letters(&a.minimised()), la.clone());
            prop_assert_eq!(a.same(&b, effort).unwrap(), la == lb);
            prop_assert_eq!(a.includes(&b, effort).unwrap(), !zip(|x, y| y && !x).contains(&true));
            let overlap = a.overlap(&b, effort).unwrap();
            prop_assert_eq!(overlap.is_some(), zip(|x, y| x && y).contains(&true));
            prop_assert!(overlap.is_none_or(|sigma| a.contains(sigma) && b.contains(sigma)));
            let gap = a.missing(effort).unwrap();
            prop_assert_eq!(gap.is_some(), la.contains(&false));
            prop_assert!(gap.is_none_or(|sigma| !a.contains(sigma)));
        }
    }

    #[test]
    fn text_is_short() {
        let ap = Propositions::new(["r1", "r2", "r3"]).unwrap();
        let letter = |sigma| Cube::letter(Labels(sigma), 3);
        assert_eq!(Guard((0..8).map(letter).collect()).text(&ap), "true");
        assert_eq!(Guard(vec![letter(1), letter(5)]).text(&ap), "r1 & !r2");
        assert_eq!(Guard((1..8).map(letter).collect()).text(&ap), "r1 | r2 | r3");
        assert_eq!(Guard::never().text(&ap), "false");
    }

    #[test]
    fn work_is_limited() {
        // (x0 & x1) | (x2 & x3) | …: the complement has 2^32 cubes.
        let hard = Guard((0..32).map(|i| Cube { positive: 0b11 << (2 * i), negative: 0 }).collect());
        assert_eq!(hard.complement(&mut Effort::new(1_000_000)), Err(TooComplex));
    }
}
