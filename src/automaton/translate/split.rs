//! The symmetric guess cut into pieces: one jump for every choice of what is guessed to hold for ever.
//!
//! What the symmetric construction tracks is a monotone combination of atoms nx(ψ). A jump that guesses which of them hold tracks less at a
//! time, at the price of more jumps: `F G a | F G b` needs {G a}, {G b}, but not {G a, G b, G a | G b}. The union of the pieces is the whole.
//!
//! Only *universal* atoms are guessed, those that hold of every suffix of a word of which they hold, such as `G a`. Whether `a W b` or `c W d`
//! comes true may hang on a later chance, and one who must say which may lose. What is universal, however, is certain where it matters, so that
//! the automaton is good for MDPs. Inside an end component that a policy does not leave, the states that a finite-memory policy visits for ever
//! form an irreducible chain. There the event "ψ holds of some suffix" is invariant under shifts, so its probability is 0 or 1. The events "ψ
//! holds from instant t on" grow with t and, started in the stationary distribution, all have the same probability: it is 0 or 1 too, and the
//! same in each of these states. If the whole holds with probability 1, then so does it with the universal atoms of probability 1 set to `true`
//! and the others to `false`: that is one of the pieces. For the same reason the suffix-invariant atoms of the state itself are guessed first, so that
//! fixpoints inside those that do not hold need no guess: n formulas `F G a & G F b` give n jumps, not 2ⁿ. `tests/good_for_mdps` checks this construction by itself.

use super::breakpoint::Renewal;
use super::guess::{Guesses, Scope};
use super::invariant::recalled;
use super::symmetric::{keys, one};
use super::target::{Target, undominated};
use super::unfold::{Invariants, Unfolding};
use super::work::Stop;
use super::worthwhile::worthwhile;
use crate::bdd::{Bdd, Variable};
use crate::ltl::Traits;

/// The largest number of pieces of one jump.
const MOST: usize = 64;

/// The jumps from state `b`.
pub(super) fn targets(u: &mut Unfolding<'_>, guesses: &mut Guesses, b: Bdd) -> Result<Vec<Target>, Stop> {
    let mut found = Vec::new();
    let invariant = u.variables_with(b, Traits::is_suffix_invariant);
    for part in pieces(u, b, &invariant)? {
        let part = recalled(u, part)?;
        let keys = keys(u, guesses, part, Scope::Alternating)?;
        for guess in worthwhile(u, guesses, part, keys)? {
            let Some((all, beside)) = one(u, guesses, part, guess)? else { continue };
            let universal = u.variables_with(all, |traits| traits.universal);
            for piece in pieces(u, all, &universal)? {
                found.push(Target::new(u, piece, piece, beside.clone(), Renewal::Raw)?);
            }
        }
    }
    undominated(u, found)
}

/// `all` as a disjunction, one disjunct for every set of the universal `atoms` that is worth guessing; `all` itself if there are too many.
fn pieces(u: &mut Unfolding<'_>, all: Bdd, atoms: &[Variable]) -> Result<Vec<Bdd>, Stop> {
    // The atoms guessed to hold, and what is left of `all` with them set to `true` and the other universal ones to `false`.
    let mut guesses: Vec<(Vec<Variable>, Bdd)> = vec![(Vec::new(), all)];
    for &atom in atoms {
        let mut next: Vec<(Vec<Variable>, Bdd)> = Vec::new();
        for (set, rest) in guesses {
            let without = u.bdd.replace(rest, &[(atom, Bdd::FALSE)])?;
            let with = u.bdd.replace(rest, &[(atom, Bdd::TRUE)])?;
            let more = [&set[..], &[atom]].concat();
            next.push((set, without));
            if with != without {
                next.push((more, with));
            }
        }
        guesses = telling(u, next)?;
        if guesses.len() > MOST {
            return Ok(vec![all]);
        }
    }
    let mut found = Vec::new();
    for (set, rest) in guesses {
        let mut piece = rest;
        for atom in set {
            let literal = u.bdd.variable(atom)?;
            piece = u.bdd.and(piece, literal)?;
        }
        found.push(piece);
    }
    Ok(found)
}

/// Leaves out guesses that cannot come true, and those that say no more than a smaller one where all their atoms ψ are certain: there ψ holds
/// for the next letter as well as after it.
fn telling(u: &mut Unfolding<'_>, mut guesses: Vec<(Vec<Variable>, Bdd)>) -> Result<Vec<(Vec<Variable>, Bdd)>, Stop> {
    guesses.retain(|(_, rest)| *rest != Bdd::FALSE);
    guesses.sort_by_key(|(set, _)| set.len());
    let mut kept: Vec<(Vec<Variable>, Bdd)> = Vec::new();
    'next: for (set, rest) in guesses {
        let mut certain = rest;
        for &atom in &set {
            let (now, later) = (u.unfolded(atom, Invariants::Kept)?, u.bdd.variable(atom)?);
            let both = u.bdd.and(now, later)?;
            certain = u.bdd.and(certain, both)?;
        }
        u.work.tick(kept.len() + 1)?;
        for (smaller, its_rest) in &kept {
            if smaller.iter().all(|atom| set.contains(atom)) && u.bdd.implies(certain, *its_rest)? {
                continue 'next;
            }
        }
        kept.push((set, rest));
    }
    Ok(kept)
}
