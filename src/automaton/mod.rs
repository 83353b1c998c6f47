//! Limit-deterministic generalised Büchi automata: the core type, the HOA format, DOT, language checks.

mod construct;
mod cover;
mod embed;
mod guard;
pub mod hoa;
mod ldgba;
mod ldgba_error;
mod scc;
mod word;

pub use construct::{Gaps, LdgbaParts, MAX_SETS, MAX_STATES, SINK_NAME};
pub use embed::{EmbeddedState, Embedding, EmbeddingError, FrontierRule, StateSet, StateTracking, Succession};
pub use guard::{Cube, Effort, Guard, TooComplex};
pub use ldgba::{Edge, Ldgba, Marks, StateId};
pub use ldgba_error::LdgbaError;
pub use scc::{Components, can_reach, components};
