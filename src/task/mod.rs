//! Task files: a formula, an environment and recipes become a checked [`Setup`], and that a fresh trainer.
//!
//! [`Task::parse`] checks a file, [`Setup`] joins it with an automaton and one recipe. Everything that can be wrong is found by then.

mod automaton;
mod check;
mod error;
mod file;
mod parse;
mod parts;
mod preset;
mod setup;

pub use automaton::{exclusive, options};
pub use error::TaskError;
pub use file::{EnvironmentSection, EvaluationSection, SpecificationSection, TaskFile};
pub use parse::{MAX_TEXT, Override, Task};
pub use parts::ENVIRONMENTS;
pub use preset::{Preset, ProductSection};
pub use setup::Setup;
