//! Propositions of which at most one holds at a time, such as disjoint regions of a map.
//!
//! The translation then considers only the letters that can occur. In the finished automaton, a letter that cannot occur is read as the one in
//! which only the first of the group holds: every guard is composed with "the proposition holds and none before it in its group does".

use super::options::{TranslateError, TranslateErrorKind};
use crate::bdd::{Bdd, Exhausted, Manager, Substitution, Variable};
use crate::labels::Propositions;

/// The groups as lists of variables, each in the order of the alphabet. Names that the alphabet does not have are left out.
pub(super) fn groups(alphabet: &Propositions, named: &[Vec<String>]) -> Result<Vec<Vec<Variable>>, TranslateError> {
    let mut seen: Vec<&str> = Vec::new();
    let mut groups = Vec::new();
    for names in named {
        let mut group = Vec::new();
        for name in names {
            if seen.contains(&name.as_str()) {
                return Err(TranslateError::new(TranslateErrorKind::Exclusive { name: name.clone() }));
            }
            seen.push(name);
            group.extend(alphabet.index(name).map(|index| index as Variable));
        }
        if group.len() > 1 {
            groups.push(group);
        }
    }
    Ok(groups)
}

/// The letters in which at most one of each group holds.
pub(super) fn letters(bdd: &mut Manager, groups: &[Vec<Variable>]) -> Result<Bdd, Exhausted> {
    let mut all = Bdd::TRUE;
    for group in groups {
        let mut sorted = group.clone();
        sorted.sort_unstable_by(|a, b| b.cmp(a));
        // From the last variable up: none of those behind holds, at most one of them holds.
        let (mut none, mut at_most_one) = (Bdd::TRUE, Bdd::TRUE);
        for variable in sorted {
            let literal = bdd.variable(variable)?;
            at_most_one = bdd.if_then_else(literal, none, at_most_one)?;
            none = bdd.if_then_else(literal, Bdd::FALSE, none)?;
        }
        all = bdd.and(all, at_most_one)?;
    }
    Ok(all)
}

/// What guards are composed with: each proposition of a group holds if it does and none before it in the group does.
pub(super) fn first_holds(bdd: &mut Manager, groups: &[Vec<Variable>]) -> Result<Substitution, Exhausted> {
    let mut substitution = Substitution::default();
    for group in groups {
        let mut none_before = Bdd::TRUE;
        for &variable in group {
            let literal = bdd.variable(variable)?;
            let first = bdd.and(none_before, literal)?;
            substitution.set(variable, first);
            none_before = bdd.if_then_else(literal, Bdd::FALSE, none_before)?;
        }
    }
    Ok(substitution)
}
