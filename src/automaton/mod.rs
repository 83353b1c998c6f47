//! Limit-deterministic generalised Büchi automata: the core type, the HOA format, DOT, language checks.
//!
//! An [`Ldgba`] is made by [`Ldgba::new`] from [`LdgbaParts`], which checks every invariant, by [`hoa::read`], or by a translation.
//! [`Ldgba::accepts`] decides words u·v^ω, [`matches()`] compares an automaton with a formula, [`Ldgba::trimmed`] and
//! [`Ldgba::state_based`] give other forms of the same language, [`hoa::write()`], [`Ldgba::dot`] and [`Ldgba::graph`] show it.

mod classify;
mod construct;
mod cover;
mod dot;
mod embed;
mod graph;
mod guard;
pub mod hoa;
mod intersection;
mod ldgba;
mod ldgba_error;
mod matches;
mod scc;
mod state_based;
mod statistics;
mod symbolic;
pub mod translate;
mod trim;
mod within;
mod word;

pub use classify::{Class, Classification, ClassifyError, classify};
pub use construct::{Gaps, LdgbaParts, MAX_SETS, MAX_STATES, SINK_NAME};
pub use embed::{EmbeddedState, Embedding, EmbeddingError, FrontierRule, StateSet, StateTracking, Succession};
pub use graph::{Graph, GraphEdge, GraphEdgeKind, GraphState};
pub use guard::{Cube, Effort, Guard, TooComplex};
pub use intersection::{IntersectionError, MAX_PAIRS, Runs, common_word, common_word_of};
pub use ldgba::{Edge, Ldgba, Marks, StateId};
pub use ldgba_error::LdgbaError;
pub use matches::{CounterExample, Matched, Mismatch, WordBudget, matches, matches_where};
pub use scc::{Components, can_reach, components};
pub use state_based::Letters;
pub use statistics::Statistics;
