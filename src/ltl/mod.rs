//! Linear temporal logic: syntax, printing, normal form, semantics on lasso words. Knows no automaton.

mod lasso;

pub use lasso::Lasso;
