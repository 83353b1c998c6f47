//! Actor-critic networks and their updates. Knows no logic.
//!
//! [`ActorCritic`] is what a learner asks of one module. Three implementations answer it:
//!
//! - [`plain`], as the papers print it, in double precision: the oracle, itself tested against finite differences;
//! - [`fused`], the fast one, which learners use;
//! - `reference`, on burn's layers, autodiff and Adam (feature `burn`).
//!
//! All start from the same [`initial_tensors`], hold the same named tensors and exchange them as a [`Record`], so that what one
//! has trained another goes on with; `tests/kernels.rs` compares them in pairs. [`workload`] is what `ltl-rover bench` times.

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
pub use tensors::{Role, Widths, check_tensors, initial_tensors, target_of, tensor_shapes};
