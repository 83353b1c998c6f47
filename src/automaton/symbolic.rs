//! Sets of letters as decision diagrams, for work on many overlapping labels: cubes go in, few disjoint cubes come out.

use super::guard::{Cube, Effort, Guard, TooComplex};
use crate::bdd::{Bdd, Exhausted, Manager};

/// The largest number of nodes.
const MAX_DIAGRAMS: usize = 1 << 20;
/// The largest number of steps of recursion: about half a second.
const MAX_STEPS: u64 = 10_000_000;

/// What an operation on diagrams costs, in cubes looked at.
const COST: usize = 32;

impl From<Exhausted> for TooComplex {
    fn from(_: Exhausted) -> TooComplex {
        TooComplex
    }
}

/// Diagrams over the propositions of an alphabet; variable i is proposition i.
pub(super) struct Symbolic {
    bdd: Manager,
}

impl Symbolic {
    pub fn new() -> Symbolic {
        Symbolic { bdd: Manager::with_limits(MAX_DIAGRAMS, MAX_STEPS) }
    }

    /// The letters of a guard.
    pub fn letters(&mut self, guard: &Guard) -> Result<Bdd, TooComplex> {
        let mut all = Bdd::FALSE;
        for cube in &guard.0 {
            let cube = self.cube(*cube)?;
            all = self.bdd.or(all, cube)?;
        }
        Ok(all)
    }

    fn cube(&mut self, cube: Cube) -> Result<Bdd, TooComplex> {
        if cube.is_empty() {
            return Ok(Bdd::FALSE);
        }
        let mut all = Bdd::TRUE;
        for index in (0..64).rev().filter(|i| cube.support() >> i & 1 == 1) {
            let literal = self.bdd.literal(index, cube.positive >> index & 1 == 1)?;
            all = self.bdd.and(literal, all)?;
        }
        Ok(all)
    }

    pub fn and(&mut self, a: Bdd, b: Bdd) -> Result<Bdd, TooComplex> {
        Ok(self.bdd.and(a, b)?)
    }

    pub fn or(&mut self, a: Bdd, b: Bdd) -> Result<Bdd, TooComplex> {
        Ok(self.bdd.or(a, b)?)
    }

    /// The letters of `a` that are not of `b`.
    pub fn without(&mut self, a: Bdd, b: Bdd) -> Result<Bdd, TooComplex> {
        Ok(self.bdd.if_then_else(b, Bdd::FALSE, a)?)
    }

    /// The letters as disjoint cubes.
    pub fn guard(&self, letters: Bdd, effort: &mut Effort) -> Result<Guard, TooComplex> {
        let mut cubes = Vec::new();
        let mut open = vec![(letters, Cube::ANY)];
        while let Some((f, cube)) = open.pop() {
            let Some(variable) = self.bdd.top(f) else {
                if f == Bdd::TRUE {
                    effort.spend(1)?;
                    cubes.push(cube);
                }
                continue;
            };
            let (low, high) = self.bdd.branches(f);
            let bit = 1u64 << variable;
            open.push((high, Cube { positive: cube.positive | bit, ..cube }));
            open.push((low, Cube { negative: cube.negative | bit, ..cube }));
        }
        if cubes.len() > Guard::MAX_CUBES { Err(TooComplex) } else { Ok(Guard(cubes)) }
    }

    /// Cuts letters into classes that are treated alike: `sets` lists sets of letters; the result, disjoint sets, each with the numbers of those
    /// that have its letters. Letters that are in no set are in no class.
    pub fn classes(&mut self, sets: &[Bdd], effort: &mut Effort) -> Result<Vec<(Bdd, Vec<usize>)>, TooComplex> {
        let mut found = Vec::new();
        // A tree of choices: inside set 0 or outside, inside set 1 or outside, …
        let mut open = vec![(Bdd::TRUE, 0, Vec::new())];
        while let Some((letters, next, members)) = open.pop() {
            effort.spend(COST)?;
            if letters == Bdd::FALSE {
                continue;
            }
            let Some(set) = sets.get(next) else {
                if !members.is_empty() {
                    found.push((letters, members));
                }
                continue;
            };
            let (inside, outside) = (self.and(letters, *set)?, self.without(letters, *set)?);
            open.push((outside, next + 1, members.clone()));
            let mut members = members;
            members.push(next);
            open.push((inside, next + 1, members));
            if found.len() > Guard::MAX_CUBES {
                return Err(TooComplex);
            }
        }
        Ok(found)
    }
}
