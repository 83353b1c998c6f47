//! What a learner asks of one module's networks: act, value the next states, one DDPG update, the record of parameters.

use serde::{Deserialize, Serialize};

/// The sizes of an actor (observation → hidden … → tanh → action) and a critic (observation ++ action → hidden … → 1).
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NetworkShape {
    /// Numbers in one network input: the environment's observation and the embedded state's code.
    pub observation: usize,
    /// Numbers in one action, each in `[-1, 1]`.
    pub action: usize,
    /// Width of each hidden layer (ReLU), the same for actor and critic; at least one layer.
    pub hidden: Vec<usize>,
    /// One critic, or two whose smaller value counts.
    #[serde(default)]
    pub critics: Critics,
    /// Which networks normalise their hidden layers.
    #[serde(default)]
    pub layer_norm: LayerNorm,
}

impl NetworkShape {
    /// One critic, no layer norm: the networks of DDPG ([Lillicrap et al. 2016](crate::bib::Lillicrap2016)).
    ///
    /// # Panics
    /// If a size is 0 or there is no hidden layer.
    pub fn new(observation: usize, action: usize, hidden: &[usize]) -> NetworkShape {
        let shape = NetworkShape {
            observation,
            action,
            hidden: hidden.to_vec(),
            critics: Critics::default(),
            layer_norm: LayerNorm::default(),
        };
        shape.check().expect("sizes are positive and there is a hidden layer");
        shape
    }

    /// Whether networks of this shape can be built.
    ///
    /// # Errors
    /// A sentence naming the field, if a size is 0 or above 65 536, or there are no or more than 16 hidden layers.
    pub fn check(&self) -> Result<(), String> {
        let size = |name: &str, size: usize| match size {
            1..=65_536 => Ok(()),
            _ => Err(format!("`{name}` is {size}; allowed are 1 to 65536")),
        };
        size("observation", self.observation)?;
        size("action", self.action)?;
        if self.hidden.is_empty() || self.hidden.len() > 16 {
            return Err(format!("`hidden` has {} layers; allowed are 1 to 16", self.hidden.len()));
        }
        self.hidden.iter().try_for_each(|&width| size("hidden", width))
    }
}

/// How many critics a module trains.
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Critics {
    /// One: DDPG.
    #[default]
    One,
    /// Two from different initial parameters, both trained towards the same targets; a value is the smaller of the two (clipped
    /// double Q-learning, [Fujimoto et al. 2018](crate::bib::Fujimoto2018)). The actor climbs the first.
    Twin,
}

/// Where hidden layers are normalised between the affine map and the ReLU ([Ba et al. 2016](crate::bib::Ba2016)).
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LayerNorm {
    /// Nowhere: DDPG.
    #[default]
    None,
    /// In the critics: it bounds their extrapolation ([Ball et al. 2023](crate::bib::Ball2023)).
    Critic,
    /// In actor and critics.
    Both,
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
    /// Adam's ε, added to the square root; positive.
    pub epsilon: f32,
    /// τ of the soft update θ' ← τθ + (1−τ)θ'.
    pub tau: f32,
    /// λ of the actor's loss −Q(x, tanh z) + λ·|z|², which keeps tanh from saturating
    /// ([Andrychowicz et al. 2017](crate::bib::Andrychowicz2017), appendix A); 0 for DDPG.
    pub saturation_penalty: f32,
}

impl Default for OptimiserSettings {
    /// Rates 1e-4 and 1e-3 and τ = 0.001 of [Lillicrap et al. 2016](crate::bib::Lillicrap2016) (its section 7), β₁ = 0.9,
    /// β₂ = 0.999, ε = 1e-8 of [Kingma & Ba 2015](crate::bib::KingmaBa2015) (its algorithm 1).
    fn default() -> OptimiserSettings {
        OptimiserSettings {
            actor_rate: 1e-4,
            critic_rate: 1e-3,
            beta1: 0.9,
            beta2: 0.999,
            epsilon: 1e-8,
            tau: 1e-3,
            saturation_penalty: 0.0,
        }
    }
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
    /// Mean squared error of the critic before its step; of twin critics the mean of both.
    pub critic: f32,
    /// Minus the mean value of the actor's actions before its step, by the (first) critic after the critic's step.
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

/// One module: actor, critic (or twin critics), their targets and optimisers.
///
/// Where rows are counted, the buffer with the fewest numbers a row decides, and the others must match.
///
/// # Panics
/// Every method that takes buffers panics if their lengths do not fit together.
pub trait ActorCritic: Send {
    /// The sizes.
    fn shape(&self) -> &NetworkShape;
    /// π(x) for each row: reads rows × observation, writes rows × action numbers in `[-1, 1]`.
    fn act(&mut self, observations: &[f32], actions: &mut [f32]);
    /// Q(x, π(x)) for each row, by the trained networks: writes rows numbers; of twin critics the smaller.
    fn values(&mut self, observations: &[f32], values: &mut [f32]);
    /// Q'(x, π'(x)) for each row, by the target networks: writes rows numbers; of twin critics the smaller.
    fn target_values(&mut self, observations: &[f32], values: &mut [f32]);
    /// π'(x) for each row, by the target actor; with [`target_action_values`](Self::target_action_values) the two halves of
    /// [`target_values`](Self::target_values), for noise in between (target policy smoothing,
    /// [Fujimoto et al. 2018](crate::bib::Fujimoto2018)).
    fn target_act(&mut self, observations: &[f32], actions: &mut [f32]);
    /// Q'(x, a) for each row, by the target critic: writes rows numbers; of twin critics the smaller.
    fn target_action_values(&mut self, observations: &[f32], actions: &[f32], values: &mut [f32]);
    /// One DDPG update: critic step towards `batch.targets`, actor step along dQ/da of the new critic, soft update of all targets.
    /// The update of a batch without rows changes nothing and measures 0.
    fn update(&mut self, batch: Batch<'_>, settings: &OptimiserSettings) -> Losses;
    /// The critic's half of an update alone: no actor step, no soft update (delayed policy updates,
    /// [Fujimoto et al. 2018](crate::bib::Fujimoto2018)). Returns the critic's loss before the step.
    fn update_critic(&mut self, batch: Batch<'_>, settings: &OptimiserSettings) -> f32;
    /// Everything the module holds, in the order of [`tensor_shapes`](crate::nn::tensor_shapes); with `optimiser` also Adam's
    /// moments and counters.
    fn tensors(&self, optimiser: bool) -> Vec<NetworkTensor>;
    /// Takes over tensors by name; those not named stay as they are.
    ///
    /// # Errors
    /// A sentence naming the tensor, if a name is unknown or a shape differs. Nothing is changed then.
    fn load(&mut self, tensors: &[NetworkTensor]) -> Result<(), String>;
}
