//! The guesses worth making: those that no smaller guess makes superfluous, found without looking at all subsets of the keys.
//!
//! Let I be the keys that are guessed already and U those still open. If, for the keys of least fixpoints, B\[·\]ν and every ψ\[·\]ν with `G ψ` in I
//! are the same diagram for I as for I ∪ U, and every ψ\[·\]μ with `F ψ` in I the same formula, then they are so for all guesses between, as
//! all of them grow with the guess. Such a guess only adds conjuncts to the target of I, and I alone is worth making. So a conjunction of n recurring formulas
//! costs n + 1 guesses, not 2ⁿ.

use super::guess::{Guesses, KeySet};
use super::unfold::Unfolding;
use super::work::Stop;
use crate::bdd::{Bdd, Memo};

/// The guesses about `keys` in state `b` that are worth making, in the order of their numbers.
pub(super) fn worthwhile(u: &mut Unfolding<'_>, guesses: &mut Guesses, b: Bdd, keys: KeySet) -> Result<Vec<KeySet>, Stop> {
    let most = 1usize.checked_shl(u.work.guesses() as u32).unwrap_or(usize::MAX);
    let mut found = Vec::new();
    let mut known = Memo::default();
    let mut open = vec![(0, keys)];
    while let Some((guess, free)) = open.pop() {
        u.work.tick(16)?;
        if free == 0 || is_settled(u, guesses, b, guess, guess | free, &mut known)? {
            found.push(guess);
            if found.len() > most {
                return Err(Stop::Guesses(keys.count_ones() as usize));
            }
            continue;
        }
        let one = free & free.wrapping_neg();
        open.push((guess | one, free ^ one));
        open.push((guess, free ^ one));
    }
    found.sort_unstable();
    Ok(found)
}

/// Whether no guess between `least` and `most` says more than `least`.
fn is_settled(
    u: &mut Unfolding<'_>,
    guesses: &mut Guesses,
    b: Bdd,
    least: KeySet,
    most: KeySet,
    known: &mut Memo<KeySet, Bdd>,
) -> Result<bool, Stop> {
    let (recurring, lasting) = guesses.bodies(least);
    if recurring.iter().any(|body| guesses.as_co_safety(u, *body, least) != guesses.as_co_safety(u, *body, most))
        || lasting.iter().any(|body| guesses.as_safety(u, *body, least) != guesses.as_safety(u, *body, most))
    {
        return Ok(false);
    }
    let mut sides = [Bdd::FALSE; 2];
    for (side, guess) in sides.iter_mut().zip([least, most]) {
        let guess = guesses.recurring(guess);
        *side = match known.get(&guess) {
            Some(&diagram) => diagram,
            None => {
                let diagram = u.replace(b, |u, id| {
                    let id = guesses.as_safety(u, id, guess);
                    u.raw(id)
                })?;
                known.insert(guess, diagram);
                diagram
            }
        };
    }
    Ok(sides[0] == sides[1])
}
