//! The door: from a formula and options to an automaton.

use super::graph::Graph;
use super::options::{Acceptance, Spent, TranslateError, TranslateErrorKind, TranslateOptions};
use super::unfold::Unfolding;
use super::work::{Stop, Work};
use super::{exclusive, finish, portfolio, state_based};
use crate::automaton::ldgba::Ldgba;
use crate::labels::Propositions;
use crate::ltl::{Formula, Store};

/// Translates `formula` to a limit-deterministic generalised Büchi automaton that accepts exactly the words that satisfy it and is good for
/// MDPs.
///
/// The same formula and options give the same automaton on every target.
///
/// # Errors
/// [`TranslateError`] when the budget is used up, or an option does not fit the formula.
pub fn translate(formula: &Formula, options: &TranslateOptions) -> Result<Ldgba, TranslateError> {
    translate_unless(formula, options, &|| false)
}

/// As [`translate`], but asks `cancelled` every few microseconds and stops when it says so: a shell's clock, or the next key in a page.
///
/// # Errors
/// As [`translate`], and [`TranslateErrorKind::Cancelled`].
pub fn translate_unless(
    formula: &Formula,
    options: &TranslateOptions,
    cancelled: &dyn Fn() -> bool,
) -> Result<Ldgba, TranslateError> {
    translate_counting(formula, options, cancelled).map(|(automaton, _)| automaton)
}

/// As [`translate_unless`], and tells how much of the budget was spent.
///
/// # Errors
/// As [`translate_unless`].
pub fn translate_counting(
    formula: &Formula,
    options: &TranslateOptions,
    cancelled: &dyn Fn() -> bool,
) -> Result<(Ldgba, Spent), TranslateError> {
    let (names, mut u) = prepared(formula, options, cancelled)?;
    let root = u.store.insert(formula);
    let root = u.simplifier.simplify(&mut u.store, root);
    let attempt = portfolio::smallest(&mut u, root).and_then(|graph| state_based_if_wanted(&mut u, graph, options.acceptance));
    let graph = match attempt {
        Ok(graph) => graph,
        Err(Stop::Cancelled) => return Err(explained(Stop::Cancelled, options)),
        Err(stop) => return Err(explained(stop, options).at(u.focused())),
    };
    let automaton = finish::automaton(&mut u, graph, names)?;
    Ok((automaton, Spent { states: u.work.states(), nodes: u.bdd.len(), steps: u.bdd.steps_taken() }))
}

fn state_based_if_wanted(u: &mut Unfolding<'_>, graph: Graph, acceptance: Acceptance) -> Result<Graph, Stop> {
    match acceptance {
        Acceptance::Transition => Ok(graph),
        Acceptance::State => state_based::state_based(u, graph),
    }
}

/// The alphabet, and an empty unfolding over it that knows which letters can occur.
fn prepared<'a>(
    formula: &Formula,
    options: &TranslateOptions,
    cancelled: &'a dyn Fn() -> bool,
) -> Result<(Propositions, Unfolding<'a>), TranslateError> {
    let mut names = options.propositions.clone();
    for name in formula.propositions() {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let alphabet =
        Propositions::new(names.clone()).map_err(|error| TranslateError::new(TranslateErrorKind::Propositions(error)))?;
    let groups = exclusive::groups(&alphabet, &options.exclusive)?;
    let mut u = Unfolding::new(Store::new(names), Work::new(options.budget, cancelled));
    u.letters = exclusive::letters(&mut u.bdd, &groups).map_err(|stop| explained(stop.into(), options))?;
    u.exclusive = groups;
    u.prefer = options.prefer;
    u.construction = options.construction;
    Ok((alphabet, u))
}

fn explained(stop: Stop, options: &TranslateOptions) -> TranslateError {
    let budget = options.budget;
    TranslateError::new(match stop {
        Stop::States => TranslateErrorKind::States { limit: budget.states },
        Stop::Nodes => TranslateErrorKind::Nodes { limit: budget.nodes },
        Stop::Steps => TranslateErrorKind::Steps { limit: budget.steps },
        Stop::Guesses(found) => TranslateErrorKind::Guesses { found, limit: budget.guesses },
        Stop::Sets(found) => TranslateErrorKind::Sets { found },
        Stop::Cancelled => TranslateErrorKind::Cancelled,
    })
}
