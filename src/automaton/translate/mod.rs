//! From a formula to a small limit-deterministic automaton that is good for MDPs.
//!
//! A formula is simplified and then tried with several constructions, of which the smallest result is kept: products of deterministic pieces,
//! breakpoints, and limit-deterministic automata whose jumps guess symmetrically, asymmetrically, or piece by piece. States are unfolded
//! formulas, shared decision diagrams over propositions and "next" variables.
//!
//! Sources: [Sickert, Esparza, Jaax & Křetínský](crate::bib::Sickert2016); [Esparza, Křetínský & Sickert](crate::bib::Esparza2020); good for MDPs:
//! [Hahn et al.](crate::bib::Hahn2020).

mod asymmetric;
mod breakpoint;
mod exclusive;
mod finish;
mod graph;
mod guess;
mod invariant;
mod limit;
mod naming;
mod options;
mod pieces;
mod portfolio;
mod reduce;
mod split;
mod state_based;
mod symmetric;
mod target;
mod together;
mod translator;
mod unfold;
mod work;
mod worthwhile;

pub use options::{Acceptance, Budget, Construction, Preference, Spent, TranslateError, TranslateErrorKind, TranslateOptions};
pub use translator::{translate, translate_counting, translate_unless};
