//! What kind of property a formula is: its class in the hierarchy of safety and progress, and whether it can be satisfied or violated at all.
//!
//! Decided on the automata of the formula and of its negation, not on the syntax. A property is a *safety* property if it equals its safety
//! closure, a *guarantee* if its complement is a safety property. It is a *recurrence* property if a deterministic (generalised) Büchi automaton
//! recognises it, a *persistence* property if one recognises its complement, an *obligation* if it is both, which such an automaton shows by
//! having no component with both accepting and rejecting cycles. Everything in LTL is a *reactivity* property.
//!
//! Z. Manna, A. Pnueli: *A Hierarchy of Temporal Properties*, PODC 1990; deterministic automata: L. H. Landweber: *Decision Problems for
//! ω-Automata*, Mathematical Systems Theory 3, 1969.

use super::intersection::{IntersectionError, Runs, common_word_of};
use super::ldgba::Ldgba;
use super::scc::components;
use super::translate::{Preference, TranslateError, TranslateOptions, translate_unless};
use crate::ltl::Formula;
use serde::Serialize;

/// A class of the hierarchy, the smaller ones first.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Class {
    /// Nothing bad happens: every violation shows after finitely many steps.
    Safety,
    /// Something good happens: every satisfaction shows after finitely many steps. Also called co-safety.
    Guarantee,
    /// A Boolean combination of safety and guarantee properties.
    Obligation,
    /// Something good happens again and again.
    Recurrence,
    /// From some time on nothing bad happens.
    Persistence,
    /// A Boolean combination of recurrence and persistence properties.
    Reactivity,
}

impl Class {
    /// The name of the class.
    pub fn name(self) -> &'static str {
        match self {
            Class::Safety => "safety",
            Class::Guarantee => "guarantee",
            Class::Obligation => "obligation",
            Class::Recurrence => "recurrence",
            Class::Persistence => "persistence",
            Class::Reactivity => "reactivity",
        }
    }

    /// The class in a sentence.
    pub fn meaning(self) -> &'static str {
        match self {
            Class::Safety => "a violation shows after finitely many steps",
            Class::Guarantee => "a satisfaction shows after finitely many steps",
            Class::Obligation => "a combination of things that must never and that must some time happen",
            Class::Recurrence => "something must happen again and again",
            Class::Persistence => "something must hold from some time on",
            Class::Reactivity => "a combination of things that recur and things that persist",
        }
    }
}

/// What is known of a formula.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Classification {
    /// The smallest class the formula was found to be in.
    pub class: Class,
    /// Whether it is certain that no smaller class has it.
    pub exact: bool,
    /// All classes the formula was found to be in.
    pub classes: Vec<Class>,
    /// Whether some word satisfies it.
    pub satisfiable: bool,
    /// Whether every word satisfies it.
    pub valid: bool,
}

/// Why a formula was not classified.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ClassifyError {
    /// The formula, or its negation, was not translated.
    #[error(transparent)]
    Translation(#[from] TranslateError),
    /// The automata could not be compared.
    #[error(transparent)]
    Comparison(#[from] IntersectionError),
}

/// Classifies `formula`. Of the options, budget, exclusive propositions and alphabet matter. `cancelled` is asked as in
/// [`translate_unless`].
///
/// # Errors
/// [`ClassifyError`] when a budget is used up or the caller cancels.
pub fn classify(
    formula: &Formula,
    options: &TranslateOptions,
    cancelled: &dyn Fn() -> bool,
) -> Result<Classification, ClassifyError> {
    let mut options = TranslateOptions { prefer: Preference::Deterministic, ..options.clone() };
    options.propositions.extend(formula.propositions());
    let mut seen = std::collections::HashSet::new();
    options.propositions.retain(|name| seen.insert(name.clone()));

    let positive = translate_unless(formula, &options, cancelled)?;
    let negative = translate_unless(&formula.negated(), &options, cancelled)?;
    let no_common = |left, right| Ok::<bool, IntersectionError>(common_word_of(left, right)?.is_none());
    let safety = no_common((&positive, Runs::Unfailing), (&negative, Runs::Accepting))?;
    let guarantee = no_common((&negative, Runs::Unfailing), (&positive, Runs::Accepting))?;

    let (deterministic, co_deterministic) = (is_deterministic(&positive), is_deterministic(&negative));
    let weak = deterministic && is_weak(&positive) || co_deterministic && is_weak(&negative);
    let recurrence = safety || guarantee || deterministic || weak;
    let persistence = safety || guarantee || co_deterministic || weak;
    let obligation = recurrence && persistence;
    let classes: Vec<Class> = [
        (Class::Safety, safety),
        (Class::Guarantee, guarantee),
        (Class::Obligation, obligation),
        (Class::Recurrence, recurrence),
        (Class::Persistence, persistence),
        (Class::Reactivity, true),
    ]
    .into_iter()
    .filter_map(|(class, is)| is.then_some(class))
    .collect();
    Ok(Classification {
        class: classes[0],
        // A deterministic automaton decides everything; without one, only the smallest classes are certain.
        exact: safety || guarantee || deterministic || co_deterministic,
        classes,
        satisfiable: !positive.is_sink(positive.initial()),
        valid: negative.is_sink(negative.initial()),
    })
}

fn is_deterministic(automaton: &Ldgba) -> bool {
    automaton.states().all(|q| automaton.epsilon(q).is_empty())
}

/// Whether no component of a deterministic automaton has both an accepting and a rejecting cycle.
fn is_weak(automaton: &Ldgba) -> bool {
    let edges = |misses: Option<usize>| -> Vec<Vec<usize>> {
        let keeps = |marks: super::ldgba::Marks| misses.is_none_or(|set| !marks.has(set));
        automaton
            .states()
            .map(|q| automaton.edges(q).iter().filter(|(_, e)| keeps(e.marks)).map(|(_, e)| usize::from(e.target)).collect())
            .collect()
    };
    let whole = components(&edges(None));
    let mut visited = vec![super::ldgba::Marks::NONE; whole.count];
    for q in automaton.states() {
        let component = whole.of[usize::from(q)];
        for (_, edge) in automaton.edges(q).iter().filter(|(_, edge)| whole.of[usize::from(edge.target)] == component) {
            visited[component] = visited[component].union(edge.marks);
        }
    }
    let accepting = |q: usize| visited[whole.of[q]] == automaton.all_sets();
    (0..automaton.sets()).all(|set| {
        let rest = edges(Some(set));
        let found = components(&rest);
        let mut sizes = vec![0; found.count];
        found.of.iter().for_each(|component| sizes[*component] += 1);
        (0..rest.len()).all(|q| !(accepting(q) && (sizes[found.of[q]] > 1 || rest[q].contains(&q))))
    })
}
