//! Limit-deterministic generalised Büchi automata: the core type, the HOA format, DOT, language checks.

mod ldgba;

pub use ldgba::{Cube, Edge, Guard, Ldgba, Marks, StateId};
