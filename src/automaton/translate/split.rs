//! The symmetric guess cut into pieces: one jump for every minimal set of obligations that suffices.
//!
//! What the symmetric construction tracks is a monotone combination of atoms nx(ψ). A jump into one of its minimal clauses tracks less at a
//! time, at the price of more jumps: `F G a | F G b` needs {G a}, {G b}, but not {G a, G b, G a | G b}. The union of the pieces is the whole, and
//! one who jumps has seen as much as before.

use super::breakpoint::Renewal;
use super::guess::{Guesses, Scope};
use super::symmetric::{keys, one, subsets};
use super::target::{Target, undominated};
use super::unfold::Unfolding;
use super::work::Stop;
use crate::bdd::{Bdd, Variable};
use std::collections::BTreeSet;

/// The largest number of pieces of one jump.
const MOST: usize = 64;

/// The jumps from state `b`.
pub(super) fn targets(u: &mut Unfolding<'_>, guesses: &mut Guesses, b: Bdd) -> Result<Vec<Target>, Stop> {
    let keys = keys(u, guesses, b, Scope::Alternating)?;
    let mut found = Vec::new();
    for guess in subsets(keys) {
        u.work.tick(16)?;
        let Some((all, beside)) = one(u, guesses, b, guess)? else { continue };
        for piece in pieces(u, all)? {
            found.push(Target::new(u, piece, beside.clone(), Renewal::Raw)?);
        }
    }
    undominated(u, found)
}

/// `all` as a disjunction, one disjunct for every minimal clause; `all` itself if there are too many.
fn pieces(u: &mut Unfolding<'_>, all: Bdd) -> Result<Vec<Bdd>, Stop> {
    let mut clauses: BTreeSet<Vec<Variable>> = BTreeSet::new();
    for &(_, leaf) in u.steps(all)?.iter() {
        match u.minimal_clauses(leaf, MOST) {
            Some(list) => clauses.extend(list),
            None => return Ok(vec![all]),
        }
    }
    if clauses.len() > MOST {
        return Ok(vec![all]);
    }
    let atoms: Vec<Variable> = u.bdd.support(all).iter().copied().filter(|v| !u.is_proposition(*v)).collect();
    let mut found = Vec::new();
    for clause in clauses {
        let mut chosen = Vec::new();
        let mut piece = Bdd::TRUE;
        for &atom in &atoms {
            let is_chosen = clause.contains(&atom);
            chosen.push((atom, if is_chosen { Bdd::TRUE } else { Bdd::FALSE }));
            if is_chosen {
                let literal = u.bdd.variable(atom)?;
                piece = u.bdd.and(piece, literal)?;
            }
        }
        let now = u.bdd.replace(all, &chosen)?;
        found.push(u.bdd.and(now, piece)?);
    }
    Ok(found)
}
