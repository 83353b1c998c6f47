//! The training loop, one step at a time, and the metrics folded over it.
//!
//! [`Trainer::step`] makes one transition and its updates. [`Run`] adds evaluations in between and keeps the best policy;
//! [`Metrics`] folds ticks into what plots and logs show.

mod checkpoint;
mod metrics;
mod run;
mod settings;
mod trainer;

pub use checkpoint::{Checkpoint, CheckpointError, Extent, FORMAT, Origin};
pub use metrics::{EpisodeSummary, Metrics};
pub use run::{Best, PolicyTensors, Progress, Run};
pub use settings::{EmbeddedStart, ShortEpisodes, Stop, TrainingSettings};
pub use trainer::{End, Tick, Trainer};
