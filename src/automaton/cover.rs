//! Algorithms on covers, lists of cubes read as their union: complement, gaps, inclusion, minimisation.

use super::guard::{Cube, Effort, Guard, TooComplex};
use std::collections::HashSet;

/// Without empty cubes and cubes that another one includes.
pub(super) fn absorbed(mut cubes: Vec<Cube>, effort: &mut Effort) -> Result<Guard, TooComplex> {
    cubes.retain(|cube| !cube.is_empty());
    let size = |cube: &Cube| cube.support().count_ones();
    cubes.sort_by_key(size);
    let mut kept: Vec<Cube> = Vec::new();
    // A cube can only be included in one with fewer literals, or in itself.
    let mut seen = HashSet::new();
    let mut shorter = 0;
    for cube in cubes {
        if !seen.insert(cube) {
            continue;
        }
        if kept.last().is_some_and(|last| size(last) < size(&cube)) {
            shorter = kept.len();
        }
        effort.spend(shorter + 16)?;
        if !kept[..shorter].iter().any(|k| k.includes(cube)) {
            kept.push(cube);
        }
    }
    if kept.len() > Guard::MAX_CUBES { Err(TooComplex) } else { Ok(Guard(kept)) }
}

/// The cubes given that proposition `index` has the truth value `value`.
fn cofactor(cubes: &[Cube], index: u32, value: bool) -> Vec<Cube> {
    let conflicts = |cube: &Cube| if value { cube.negative } else { cube.positive } >> index & 1 == 1;
    cubes.iter().filter(|cube| !conflicts(cube)).map(|cube| cube.without(index)).collect()
}

/// Whether `cubes` cut the letters over `propositions` propositions into pieces: every letter is in exactly one of them. Much cheaper than
/// comparing all pairs.
pub(super) fn tiles(cubes: &[Cube], propositions: usize, effort: &mut Effort) -> Result<bool, TooComplex> {
    Ok(fill(&[cubes], propositions) && missing(cubes, effort)?.is_none())
}

/// Whether the sizes of the cubes add up to that of the alphabet. If they cover all letters, they are then disjoint.
pub(super) fn fill(lists: &[&[Cube]], propositions: usize) -> bool {
    let size = |cube: &Cube| 1u128 << propositions.saturating_sub(cube.support().count_ones() as usize);
    lists.iter().flat_map(|cubes| cubes.iter()).map(size).sum::<u128>() == 1 << propositions
}

/// The proposition to split on, and whether any occurs with both signs: one that all cubes speak of, or else the one that most do, those of
/// both signs first.
fn split_index(cubes: &[Cube]) -> Option<(u32, bool)> {
    let none = Cube { positive: 0, negative: 0 };
    let union =
        cubes.iter().fold(none, |all, c| Cube { positive: all.positive | c.positive, negative: all.negative | c.negative });
    let everywhere = cubes.iter().fold(u64::MAX, |all, cube| all & cube.support()) & union.support();
    let both = everywhere & union.positive & union.negative;
    if everywhere != 0 {
        let index = if both != 0 { both } else { everywhere }.trailing_zeros();
        return Some((index, union.positive & union.negative != 0));
    }
    let mut counts = [(0u32, 0u32); 64];
    let bits = |mut mask: u64| {
        std::iter::from_fn(move || {
            let index = mask.trailing_zeros();
            mask &= mask.wrapping_sub(1);
            (index < 64).then_some(index as usize)
        })
    };
    for cube in cubes {
        bits(cube.positive).for_each(|i| counts[i].0 += 1);
        bits(cube.negative).for_each(|i| counts[i].1 += 1);
    }
    let (index, (p, n)) = counts.into_iter().enumerate().max_by_key(|(_, (p, n))| ((*p).min(*n) > 0, p + n))?;
    (p + n > 0).then_some((index as u32, p > 0 && n > 0))
}

/// A cube of letters that none of `cubes` has; `None` if they cover all letters. Shannon expansion; a cover whose propositions
/// all occur with one sign only covers everything just when one of its cubes has no literal.
pub(super) fn missing(cubes: &[Cube], effort: &mut Effort) -> Result<Option<Cube>, TooComplex> {
    effort.spend(cubes.len() + 1)?;
    if cubes.contains(&Cube::ANY) {
        return Ok(None);
    }
    let Some((index, both_signs)) = split_index(cubes) else { return Ok(Some(Cube::ANY)) };
    if !both_signs {
        // Every proposition against its only sign.
        return Ok(Some(
            cubes
                .iter()
                .fold(Cube::ANY, |all, c| Cube { positive: all.positive | c.negative, negative: all.negative | c.positive }),
        ));
    }
    for value in [false, true] {
        if let Some(cube) = missing(&cofactor(cubes, index, value), effort)? {
            return Ok(cube.and(Cube::literal(index as usize, value)));
        }
    }
    Ok(None)
}

/// The letters that none of `cubes` has.
pub(super) fn complement(cubes: &[Cube], effort: &mut Effort) -> Result<Vec<Cube>, TooComplex> {
    effort.spend(cubes.len() + 1)?;
    if cubes.contains(&Cube::ANY) {
        return Ok(Vec::new());
    }
    let Some((index, _)) = split_index(cubes) else { return Ok(vec![Cube::ANY]) };
    let low = complement(&cofactor(cubes, index, false), effort)?;
    let high = complement(&cofactor(cubes, index, true), effort)?;
    effort.spend(low.len() * high.len() / 8 + low.len() + high.len())?;
    let mut result = Vec::with_capacity(low.len() + high.len());
    for (side, other, value) in [(&low, &high, false), (&high, &low, true)] {
        for cube in side {
            if !other.contains(cube) {
                result.extend(cube.and(Cube::literal(index as usize, value)));
            } else if !value {
                result.push(*cube);
            }
        }
    }
    if result.len() > Guard::MAX_CUBES { Err(TooComplex) } else { Ok(result) }
}

/// Whether every letter of `inner` is one of `outer`.
pub(super) fn covers(outer: &[Cube], inner: &[Cube], effort: &mut Effort) -> Result<bool, TooComplex> {
    for cube in inner {
        if !cube.is_empty() && !covers_cube(outer, *cube, effort)? {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Whether every letter of `cube` is one of `outer`.
fn covers_cube(outer: &[Cube], cube: Cube, effort: &mut Effort) -> Result<bool, TooComplex> {
    effort.spend(outer.len())?;
    let inside: Vec<Cube> = outer
        .iter()
        .filter(|o| o.and(cube).is_some())
        .map(|o| Cube { positive: o.positive & !cube.support(), negative: o.negative & !cube.support() })
        .collect();
    Ok(missing(&inside, effort)?.is_none())
}

/// Expand every cube while it stays inside the set, then drop the cubes that the rest covers.
pub(super) fn minimise(guard: &Guard, effort: &mut Effort) -> Result<Guard, TooComplex> {
    let mut cubes = absorbed(guard.0.clone(), effort)?.0;
    for i in 0..cubes.len() {
        for index in 0..64 {
            if cubes[i].support() >> index & 1 == 1 {
                let wider = cubes[i].without(index);
                if covers_cube(&cubes, wider, effort)? {
                    cubes[i] = wider;
                }
            }
        }
    }
    let mut cubes = absorbed(cubes, effort)?.0;
    let mut i = cubes.len();
    while i > 0 {
        i -= 1;
        let cube = cubes.remove(i);
        if !covers_cube(&cubes, cube, effort)? {
            cubes.insert(i, cube);
        }
    }
    // Propositions in their order, positive before negative, for a stable text.
    cubes.sort_by_key(|cube| (cube.support().reverse_bits(), cube.negative.reverse_bits()));
    cubes.reverse();
    Ok(Guard(cubes))
}
