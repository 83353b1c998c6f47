//! From label expressions to sets of letters: aliases, negation normal form, disjunctive normal form within limits.

use super::super::guard::{Cube, Effort, Guard, TooComplex};
use super::error::{Fault, HoaErrorKind};
use super::syntax::{At, Label};
use crate::ltl::Span;
use std::collections::HashMap;

/// What labels of one automaton refer to.
pub(super) struct Labeller {
    /// How many propositions there are.
    propositions: usize,
    aliases: HashMap<String, Guard>,
    pub effort: Effort,
}

/// The fault that a label is too complex.
pub(super) fn too_complex(span: Span) -> impl FnOnce(TooComplex) -> Fault {
    move |cause| Fault::new(HoaErrorKind::TooComplex, span, cause.to_string())
}

impl Labeller {
    pub fn new(propositions: usize) -> Labeller {
        Labeller { propositions, aliases: HashMap::new(), effort: Effort::default() }
    }

    /// How many propositions there are.
    pub fn propositions(&self) -> usize {
        self.propositions
    }

    /// Defines an alias.
    pub fn define(&mut self, name: &At<String>, label: &At<Label>) -> Result<(), Fault> {
        if self.aliases.contains_key(&name.value) {
            let message = format!("the alias `@{}` is defined a second time", name.value);
            return Err(Fault::new(HoaErrorKind::DuplicateAlias, name.span, message));
        }
        let guard = self.guard(label)?;
        self.aliases.insert(name.value.clone(), guard);
        Ok(())
    }

    /// The letters that satisfy `label`.
    pub fn guard(&mut self, label: &At<Label>) -> Result<Guard, Fault> {
        self.convert(label, true)
    }

    /// The letters that satisfy `label`, or, if `positive` is false, those that do not.
    fn convert(&mut self, label: &At<Label>, positive: bool) -> Result<Guard, Fault> {
        match &label.value {
            Label::Constant(value) => Ok(if *value == positive { Guard::any() } else { Guard::never() }),
            Label::Proposition(index) => {
                let index = *index as usize;
                if index >= self.propositions {
                    let message = format!("proposition {index} is used, but `AP:` announces {}", self.propositions);
                    return Err(Fault::new(HoaErrorKind::OutOfRange, label.span, message));
                }
                Ok(Guard(vec![Cube::literal(index, positive)]))
            }
            Label::Alias(name) => {
                let Some(guard) = self.aliases.get(name) else {
                    let message = format!("the alias `@{name}` is not defined before this place");
                    return Err(Fault::new(HoaErrorKind::UnknownAlias, label.span, message));
                };
                if positive { Ok(guard.clone()) } else { guard.complement(&mut self.effort).map_err(too_complex(label.span)) }
            }
            Label::Not(inner) => self.convert(inner, !positive),
            Label::And(parts) if positive => self.conjunction(parts, positive, label.span),
            Label::Or(parts) if !positive => self.conjunction(parts, positive, label.span),
            Label::And(parts) | Label::Or(parts) => {
                let mut cubes = Vec::new();
                for part in parts {
                    cubes.extend(self.convert(part, positive)?.0);
                }
                Guard(cubes).or(&Guard::never(), &mut self.effort).map_err(too_complex(label.span))
            }
        }
    }

    fn conjunction(&mut self, parts: &[At<Label>], positive: bool, span: Span) -> Result<Guard, Fault> {
        let mut guard = Guard::any();
        for part in parts {
            let factor = self.convert(part, positive)?;
            guard = guard.and(&factor, &mut self.effort).map_err(too_complex(span))?;
        }
        Ok(guard)
    }
}

/// The set of the given letters over `count` propositions, by few cubes: cubes that differ in one proposition only are joined.
pub(super) fn guard_of_letters(letters: &[u64], count: usize) -> Guard {
    let mask = (1u64 << count) - 1;
    let mut cubes: Vec<Cube> = letters.iter().map(|l| Cube { positive: *l, negative: !l & mask }).collect();
    for index in 0..count {
        let bit = 1u64 << index;
        cubes.sort_unstable_by_key(|c| (c.support(), c.positive & !bit));
        let mut joined: Vec<Cube> = Vec::with_capacity(cubes.len());
        for cube in cubes {
            match joined.last_mut() {
                Some(last)
                    if cube.support() & bit != 0
                        && last.support() == cube.support()
                        && last.positive & !bit == cube.positive & !bit
                        && last.positive != cube.positive =>
                {
                    *last = Cube { positive: cube.positive & !bit, negative: cube.negative & !bit };
                }
                _ => joined.push(cube),
            }
        }
        cubes = joined;
    }
    Guard(cubes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::labels::Labels;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn joining_letters_keeps_them(chosen in proptest::collection::vec(any::<bool>(), 16)) {
            let letters: Vec<u64> = (0..16).filter(|i| chosen[*i as usize]).collect();
            let guard = guard_of_letters(&letters, 4);
            for sigma in 0..16 {
                prop_assert_eq!(guard.contains(Labels(sigma)), chosen[sigma as usize]);
            }
            prop_assert!(guard.0.len() <= 8);
        }
    }
}
