//! The tensors of a module by name and shape, their initial values, and the check of a record against them.

use super::actor_critic::{Critics, LayerNorm, NetworkShape, NetworkTensor};
use crate::rng::Rng;

/// The half width of the uniform distribution of the output layers' initial parameters
/// ([Lillicrap et al. 2016](crate::bib::Lillicrap2016), section 7: 3·10⁻³), which keeps first actions and values near 0.
const OUTPUT_INITIAL: f32 = 3e-3;

/// Added to a variance before the square root of layer norm.
pub const NORM_EPSILON: f64 = 1e-5;

/// Which network of a module.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Role {
    /// π.
    Actor,
    /// Q, or the first of the twins.
    Critic,
    /// The second of the twins.
    SecondCritic,
}

impl Role {
    /// The name that the network's tensors begin with.
    pub fn name(self) -> &'static str {
        match self {
            Role::Actor => "actor",
            Role::Critic => "critic",
            Role::SecondCritic => "critic2",
        }
    }
}

/// The width of every layer of one network, from the input to the output, and whether its hidden layers are normalised.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Widths {
    /// At least three: input, hidden …, output.
    pub layers: Vec<usize>,
    /// Layer norm between affine map and ReLU of each hidden layer.
    pub normalised: bool,
}

impl NetworkShape {
    /// The trained networks of the module, in the order of its record.
    pub fn roles(&self) -> &'static [Role] {
        match self.critics {
            Critics::One => &[Role::Actor, Role::Critic],
            Critics::Twin => &[Role::Actor, Role::Critic, Role::SecondCritic],
        }
    }

    /// The layers of one of its networks.
    pub fn widths(&self, role: Role) -> Widths {
        let (input, output, normalised) = match role {
            Role::Actor => (self.observation, self.action, self.layer_norm == LayerNorm::Both),
            Role::Critic | Role::SecondCritic => (self.observation + self.action, 1, self.layer_norm != LayerNorm::None),
        };
        Widths { layers: [&[input], self.hidden.as_slice(), &[output]].concat(), normalised }
    }
}

impl Widths {
    /// The tensors of such a network: `0.weight` `[in, out]`, `0.bias` `[out]`, where normalised `0.gain` and `0.shift` `[out]`,
    /// `1.weight` and so on.
    pub fn tensors(&self) -> Vec<(String, Vec<usize>)> {
        let mut tensors = Vec::new();
        for (layer, pair) in self.layers.windows(2).enumerate() {
            tensors.push((format!("{layer}.weight"), vec![pair[0], pair[1]]));
            tensors.push((format!("{layer}.bias"), vec![pair[1]]));
            if self.normalised && layer + 2 < self.layers.len() {
                tensors.push((format!("{layer}.gain"), vec![pair[1]]));
                tensors.push((format!("{layer}.shift"), vec![pair[1]]));
            }
        }
        tensors
    }
}

/// Names and shapes of everything a module of this shape holds, in the order of [`ActorCritic::tensors`].
///
/// For each trained network (`actor`, `critic`, with twins `critic2`): `actor.0.weight` …, then its target `actor_target.0.weight` …,
/// and with `optimiser` Adam's moments `actor.adam.m.0.weight` …, `actor.adam.v.0.weight` … and the count `actor.adam.steps` `[1]`.
///
/// [`ActorCritic::tensors`]: super::ActorCritic::tensors
pub fn tensor_shapes(shape: &NetworkShape, optimiser: bool) -> Vec<(String, Vec<usize>)> {
    let mut all = Vec::new();
    for &role in shape.roles() {
        let own = shape.widths(role).tensors();
        let name = role.name();
        let mut add =
            |prefix: String| all.extend(own.iter().map(|(tensor, shape)| (format!("{prefix}.{tensor}"), shape.clone())));
        add(name.to_string());
        add(format!("{name}_target"));
        if optimiser {
            add(format!("{name}.adam.m"));
            add(format!("{name}.adam.v"));
            all.push((format!("{name}.adam.steps"), vec![1]));
        }
    }
    all
}

/// The parameters a fresh module starts from: hidden layers uniform in ±1/√fan-in, weights and biases alike, output layers in
/// ±0.003 ([Lillicrap et al. 2016](crate::bib::Lillicrap2016), section 7); gains 1, shifts 0; each target equal to its network.
pub fn initial_tensors(shape: &NetworkShape, rng: &mut Rng) -> Vec<NetworkTensor> {
    let mut all = Vec::new();
    for &role in shape.roles() {
        let widths = shape.widths(role);
        let last = widths.layers.len() - 2;
        let start = all.len();
        for (tensor, tensor_shape) in widths.tensors() {
            let layer: usize = tensor.split('.').next().and_then(|n| n.parse().ok()).expect("tensors are named by their layer");
            let bound = if layer == last { OUTPUT_INITIAL } else { 1.0 / libm::sqrtf(widths.layers[layer] as f32) };
            let count = tensor_shape.iter().product();
            let values = match tensor.rsplit('.').next() {
                Some("gain") => vec![1.0; count],
                Some("shift") => vec![0.0; count],
                _ => (0..count).map(|_| rng.uniform_in(-bound, bound)).collect(),
            };
            all.push(NetworkTensor { name: format!("{}.{tensor}", role.name()), shape: tensor_shape, values });
        }
        let targets: Vec<NetworkTensor> = all[start..].iter().map(target_of).collect();
        all.extend(targets);
    }
    all
}

/// The tensor of a target network that is equal to `own`, one of a trained network.
pub fn target_of(own: &NetworkTensor) -> NetworkTensor {
    NetworkTensor { name: own.name.replacen('.', "_target.", 1), ..own.clone() }
}

/// Whether every tensor is one of a module of this shape.
///
/// # Errors
/// A sentence naming the first tensor whose name is unknown or whose shape differs, with what is allowed.
pub fn check_tensors(shape: &NetworkShape, tensors: &[NetworkTensor]) -> Result<(), String> {
    let known = tensor_shapes(shape, true);
    for tensor in tensors {
        let Some((_, expected)) = known.iter().find(|(name, _)| *name == tensor.name) else {
            return Err(format!("tensor `{}` is not one of this module's networks", tensor.name));
        };
        if *expected != tensor.shape {
            return Err(format!("tensor `{}` has shape {:?}; this module's has {expected:?}", tensor.name, tensor.shape));
        }
        if tensor.values.len() != tensor.shape.iter().product::<usize>() {
            return Err(format!("tensor `{}` has {} values for shape {expected:?}", tensor.name, tensor.values.len()));
        }
    }
    Ok(())
}
