//! The Hanoi omega-automata format, version 1 ([HOA2015](crate::bib::HOA2015)), and what of version 1.1 does not change meaning.
//!
//! [`read`] takes the text of one automaton, [`read_stream`] of several. Text → tokens (`lexer`) → tree (`parser`, `header`,
//! `body`, `syntax`) → non-deterministic automaton with marks on edges (`check`, `acceptance`, `label`, `property`) → letters in
//! classes and Q_D (`classes`, `limit`) → ε-jumps (`jumps`) → [`Ldgba`](super::Ldgba) (`build`).
//!
//! - Accepted are `t` and conjunctions of `Inf(j)` and `Inf(!j)`; the condition counts, not `acc-name:`. Every other condition is
//!   refused with its place, as are alternation and non-determinism that an accepting run meets infinitely often.
//! - Marks of a state go on the edges that enter it, marks of edges stay. The number of states is that of the file, but for an
//!   explicit sink where letters are missing, and for states that must remember offered jumps.
//! - An edge without label beside edges with one is an ε-jump, as Rabinizer 4 and CSRL write them; choices between edges become
//!   ε-jumps into the deterministic part.
//! - Beyond the letter of the format: what `properties:` claims must be true where it can be checked, and text after `--END--`
//!   must be another automaton.

mod acceptance;
mod body;
mod build;
mod check;
mod classes;
mod error;
mod header;
mod jumps;
mod label;
mod lexer;
mod limit;
mod nba;
mod parser;
mod property;
mod read;
mod syntax;
mod write;

pub use body::MAX_EDGES;
pub use error::{HoaError, HoaErrorKind, HoaNote, Place};
pub use jumps::MAX_NODES;
pub use read::{MAX_AUTOMATA, MAX_LENGTH, Reading, StreamItem, read, read_stream};
pub use write::{AcceptanceForm, EpsilonForm, WriteOptions, write};
