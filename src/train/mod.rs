//! The training loop, one step at a time, and the metrics folded over it.

mod settings;
mod trainer;

pub use settings::{EmbeddedStart, Stop, TrainingSettings};
pub use trainer::{End, Tick, Trainer};
