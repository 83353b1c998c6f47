//! Actor-critic networks and their updates. Knows no logic.

mod actor_critic;

pub use actor_critic::{ActorCritic, Batch, Losses, NetworkShape, NetworkTensor, OptimiserSettings};
