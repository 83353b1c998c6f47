//! Linear temporal logic: syntax, printing, normal form, semantics on lasso words. Knows no automaton.
//!
//! A text becomes a [`Formula`] by [`Formula::parse`], or by [`Formula::read`] together with [`Note`]s on constructs that other tools
//! read in another way. A formula prints ([`Formula::printed`]) as text that parses back to the same tree. [`semantics`] decides
//! whether a [`Lasso`] word satisfies it: the oracle that automata are tested against.

mod ast;
pub mod class;
mod error;
pub mod families;
pub mod implication;
mod lasso;
mod lexer;
pub mod normal_form;
mod paraphrase;
pub mod parse;
mod print;
pub mod semantics;
pub mod simplify;
mod simplify_disjunction;
mod simplify_limit;

pub use ast::{BinaryOperator, Formula, UnaryOperator};
pub use class::Traits;
pub use error::{Note, NoteKind, ParseError, ParseErrorKind, Span};
pub use lasso::Lasso;
pub use normal_form::{Node, NodeId, Store};
pub use parse::Reading;
pub use print::{Parentheses, Printed, Style};
pub use semantics::{Evaluator, UnknownProposition, satisfies};
