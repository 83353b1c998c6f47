//! What a learner asks of one module's networks: act, value the next states, one DDPG update, the record of parameters.

use serde::{Deserialize, Serialize};

/// The sizes of an actor (observation → hidden … → tanh → action) and a critic (observation ++ action → hidden … → 1).
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct NetworkShape {
    /// Numbers in one network input: the environment's observation and the embedded state's code.
    pub observation: usize,
    /// Numbers in one action, each in `[-1, 1]`.
    pub action: usize,
    /// Width of each hidden layer (ReLU), the same for actor and critic.
    pub hidden: Vec<usize>,
}

/// The numbers of one update: Adam ([Kingma & Ba 2015](crate::bib::KingmaBa2015)) and the soft update of the targets.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct OptimiserSettings {
    /// Learning rate of the actor.
    pub actor_rate: f32,
    /// Learning rate of the critic.
    pub critic_rate: f32,
    /// Adam's β₁.
    pub beta1: f32,
    /// Adam's β₂.
    pub beta2: f32,
    /// Adam's ε, added to the square root.
    pub epsilon: f32,
    /// τ of the soft update θ' ← τθ + (1−τ)θ'.
    pub tau: f32,
}

/// A batch of samples, row-major; `rows` is given by `targets.len()`.
#[derive(Clone, Copy, Debug)]
pub struct Batch<'a> {
    /// rows × observation.
    pub observations: &'a [f32],
    /// rows × action.
    pub actions: &'a [f32],
    /// rows: y, the targets of the critic.
    pub targets: &'a [f32],
}

/// What an update measured before it changed the parameters.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Losses {
    /// Mean squared error of the critic.
    pub critic: f32,
    /// Minus the mean value of the actor's actions.
    pub actor: f32,
}

/// A named tensor of a module's record, row-major.
#[derive(Clone, PartialEq, Debug)]
pub struct NetworkTensor {
    /// `actor.0.weight`, `critic_target.2.bias`, `actor.adam.m.0.weight` …
    pub name: String,
    /// `[in, out]` for weights, `[out]` for biases, `[1]` for counters.
    pub shape: Vec<usize>,
    /// Values, row-major.
    pub values: Vec<f32>,
}

/// One module: actor, critic, their targets and optimisers.
pub trait ActorCritic: Send {
    /// The sizes.
    fn shape(&self) -> &NetworkShape;
    /// π(x) for each row: writes rows × action numbers in `[-1, 1]`.
    fn act(&mut self, observations: &[f32], actions: &mut [f32]);
    /// Q(x, π(x)) for each row, by the trained networks: writes rows numbers.
    fn values(&mut self, observations: &[f32], values: &mut [f32]);
    /// Q'(x, π'(x)) for each row, by the target networks: writes rows numbers.
    fn target_values(&mut self, observations: &[f32], values: &mut [f32]);
    /// One DDPG update: critic step towards `batch.targets`, actor step along dQ/da, soft update of both targets.
    fn update(&mut self, batch: Batch<'_>, settings: &OptimiserSettings) -> Losses;
    /// Everything the module holds, in a fixed order; with `optimiser` also Adam's moments and counters.
    fn tensors(&self, optimiser: bool) -> Vec<NetworkTensor>;
    /// Takes over tensors by name; those not named stay as they are.
    ///
    /// # Errors
    /// A sentence naming the tensor, if a name is unknown or a shape differs. Nothing is changed then.
    fn load(&mut self, tensors: &[NetworkTensor]) -> Result<(), String>;
}
