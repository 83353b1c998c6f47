//! One module of a modular learner: networks, replay and noise of the embedded states it is in charge of.

use super::noise::Noise;
use super::replay::Replay;
use crate::nn::ActorCritic;

/// Actor and critic with their targets and optimisers, the replay B_q and the noise process N_q of Algorithm 2.
pub(super) struct Module {
    pub networks: Box<dyn ActorCritic>,
    pub replay: Replay,
    pub noise: Noise,
    /// Updates performed.
    pub updates: u64,
    /// The actor's loss at its last update: with delayed policies not every update has one.
    pub actor_loss: f32,
}
