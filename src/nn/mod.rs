//! Actor-critic networks and their updates. Knows no logic.
//!
//! [`ActorCritic`] is what a learner asks of one module. [`plain`] answers it as the papers print it and is the oracle. All
//! implementations start from the same [`initial_tensors`], hold the same named tensors and exchange them as a [`Record`].

mod actor_critic;
pub mod fused;
pub mod plain;
mod record;
#[cfg(feature = "burn")]
pub mod reference;
mod tensors;
pub mod workload;

pub use actor_critic::{ActorCritic, Batch, Critics, LayerNorm, Losses, NetworkShape, NetworkTensor, OptimiserSettings};
pub use record::{Record, RecordError};
pub use tensors::{Role, Widths, check_tensors, initial_tensors, tensor_shapes};
