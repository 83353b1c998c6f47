//! The actor-critic on burn's tensors: DDPG's update with burn's autodiff and Adam.

use burn::module::Module;
use burn::optim::AdamConfig;
use burn::tensor::activation::tanh;
use burn::tensor::{Device, Gradients, Tensor, TensorData};

use super::super::actor_critic::{ActorCritic, Batch, Losses, NetworkShape, NetworkTensor, OptimiserSettings};
use super::super::tensors::{Role, check_tensors, initial_tensors, tensor_shapes};
use super::network::{Descend, Memory, Network, Output, memory, numbers};
use crate::rng::Rng;

/// One of burn's backends that compute on the processor.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Backend {
    /// burn-flex.
    Flex,
    /// burn-ndarray, its predecessor.
    NdArray,
}

impl Backend {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Backend::Flex => "burn-flex",
            Backend::NdArray => "burn-ndarray",
        }
    }

    fn device(self) -> Device {
        match self {
            Backend::Flex => Device::flex(),
            // burn means to drop this backend one day; the reference keeps it as long as it is there.
            #[allow(deprecated)]
            Backend::NdArray => Device::ndarray(),
        }
    }
}

struct Trained {
    role: Role,
    output: Output,
    network: Network,
    target: Network,
    memory: Memory,
}

/// An actor-critic module on one of burn's backends.
pub struct Reference {
    shape: NetworkShape,
    device: Device,
    actor: Trained,
    critics: Vec<Trained>,
}

impl Reference {
    /// A fresh module with the parameters of [`initial_tensors`].
    ///
    /// # Panics
    /// If [`NetworkShape::check`] refuses the shape.
    pub fn new(shape: &NetworkShape, rng: &mut Rng, backend: Backend) -> Reference {
        shape.check().expect("a network shape that was checked");
        let device = backend.device();
        let trained = |&role: &Role| {
            let widths = shape.widths(role);
            let network = Network::new(&widths, &device.clone().autodiff());
            let output = if role == Role::Actor { Output::Tanh } else { Output::Linear };
            Trained { role, output, target: network.valid(), memory: vec![None; widths.tensors().len()], network }
        };
        let (actor, critics) = shape.roles().split_first().expect("a module has an actor");
        let (actor, critics) = (trained(actor), critics.iter().map(trained).collect());
        let mut reference = Reference { shape: shape.clone(), device, actor, critics };
        reference.load(&initial_tensors(shape, rng)).expect("initial tensors are of the shape they were made for");
        reference
    }

    fn tensor(&self, numbers: &[f32], columns: usize) -> Tensor<2> {
        assert!(numbers.len().is_multiple_of(columns), "whole rows of {columns}");
        Tensor::from_data(TensorData::new(numbers.to_vec(), [numbers.len() / columns, columns]), &self.device)
    }

    fn observations(&self, numbers: &[f32]) -> Tensor<2> {
        self.tensor(numbers, self.shape.observation)
    }

    /// The smallest value of the critics, by networks that record nothing.
    fn smallest(&self, which: fn(&Trained) -> Network, observations: Tensor<2>, actions: Tensor<2>) -> Vec<f32> {
        let input = Tensor::cat(vec![observations, actions], 1);
        let values = self.critics.iter().map(|critic| which(critic).forward(input.clone(), critic.output));
        numbers(values.reduce(Tensor::min_pair).expect("a module has a critic"))
    }

    fn run(&self, which: fn(&Trained) -> Network, observations: &[f32]) -> (Tensor<2>, Tensor<2>) {
        let observations = self.observations(observations);
        let actions = which(&self.actor).forward(observations.clone(), Output::Tanh);
        (observations, actions)
    }
}

fn network(trained: &Trained) -> Network {
    trained.network.valid()
}

fn target(trained: &Trained) -> Network {
    trained.target.clone()
}

/// One step of Adam; returns the network that took it.
fn descend(trained: &mut Trained, gradients: &Gradients, rate: f32, settings: &OptimiserSettings) {
    let adam = AdamConfig::new().with_beta_1(settings.beta1).with_beta_2(settings.beta2).with_epsilon(settings.epsilon);
    let (rate, memory) = (f64::from(rate), trained.memory.iter_mut());
    let mut step = Descend { adam: adam.build(), rate, gradients, memory };
    trained.network = trained.network.clone().map(&mut step);
}

impl ActorCritic for Reference {
    fn shape(&self) -> &NetworkShape {
        &self.shape
    }

    fn act(&mut self, observations: &[f32], actions: &mut [f32]) {
        actions.copy_from_slice(&numbers(self.run(network, observations).1));
    }

    fn values(&mut self, observations: &[f32], values: &mut [f32]) {
        let (observations, actions) = self.run(network, observations);
        values.copy_from_slice(&self.smallest(network, observations, actions));
    }

    fn target_values(&mut self, observations: &[f32], values: &mut [f32]) {
        let (observations, actions) = self.run(target, observations);
        values.copy_from_slice(&self.smallest(target, observations, actions));
    }

    fn target_act(&mut self, observations: &[f32], actions: &mut [f32]) {
        actions.copy_from_slice(&numbers(self.run(target, observations).1));
    }

    fn target_action_values(&mut self, observations: &[f32], actions: &[f32], values: &mut [f32]) {
        let (observations, actions) = (self.observations(observations), self.tensor(actions, self.shape.action));
        values.copy_from_slice(&self.smallest(target, observations, actions));
    }

    fn update(&mut self, batch: Batch<'_>, settings: &OptimiserSettings) -> Losses {
        if batch.targets.is_empty() {
            return Losses::default();
        }
        let critic = self.update_critic(batch, settings);

        let observations = self.observations(batch.observations);
        let sums = self.actor.network.forward(observations.clone(), Output::Linear);
        let penalty = sums.clone().square().sum() * (settings.saturation_penalty / batch.targets.len() as f32);
        let actions = tanh(sums);
        // The critic is a constant here: gradients reach the actor through its input alone.
        let input = Tensor::cat(vec![observations.autodiff(), actions], 1);
        let loss = network(&self.critics[0]).forward(input, Output::Linear).mean().neg();
        descend(&mut self.actor, &(loss.clone() + penalty).backward(), settings.actor_rate, settings);
        for trained in [&mut self.actor].into_iter().chain(&mut self.critics) {
            trained.target = trained.target.clone().moved(&trained.network, settings.tau);
        }
        Losses { critic, actor: loss.into_scalar() }
    }

    fn update_critic(&mut self, batch: Batch<'_>, settings: &OptimiserSettings) -> f32 {
        if batch.targets.is_empty() {
            return 0.0;
        }
        let inputs = vec![self.observations(batch.observations), self.tensor(batch.actions, self.shape.action)];
        let (input, targets) = (Tensor::cat(inputs, 1), self.tensor(batch.targets, 1));
        let mut sum = 0.0;
        for critic in &mut self.critics {
            let error = critic.network.forward(input.clone(), Output::Linear) - targets.clone();
            let loss = error.square().mean();
            descend(critic, &loss.backward(), settings.critic_rate, settings);
            sum += loss.into_scalar::<f32>();
        }
        sum / self.critics.len() as f32
    }

    fn tensors(&self, optimiser: bool) -> Vec<NetworkTensor> {
        let mut values = Vec::new();
        for trained in [&self.actor].into_iter().chain(&self.critics) {
            let own = trained.network.numbers();
            let zeros: Vec<Vec<f32>> = own.iter().map(|tensor| vec![0.0; tensor.len()]).collect();
            values.extend(own);
            values.extend(trained.target.numbers());
            if optimiser {
                let states: Option<Vec<_>> = trained.memory.iter().map(|state| Some(state.clone()?.momentum)).collect();
                let states = states.unwrap_or_default();
                let moments = |moment: fn(&_) -> Tensor<2>| states.iter().map(|state| numbers(moment(state))).collect::<Vec<_>>();
                let (m, v) = match states.is_empty() {
                    true => (zeros.clone(), zeros),
                    false => (moments(|state| state.moment_1.clone()), moments(|state| state.moment_2.clone())),
                };
                values.extend(m);
                values.extend(v);
                values.push(vec![states.first().map_or(0, |state| state.time) as f32]);
            }
        }
        let named = tensor_shapes(&self.shape, optimiser).into_iter().zip(values);
        named.map(|((name, shape), values)| NetworkTensor { name, shape, values }).collect()
    }

    fn load(&mut self, tensors: &[NetworkTensor]) -> Result<(), String> {
        check_tensors(&self.shape, tensors)?;
        // Everything the module holds, with the loaded tensors in place of its own.
        let mut all = self.tensors(true);
        for tensor in tensors {
            let own = all.iter_mut().find(|own| own.name == tensor.name).expect("names were checked");
            own.values.clone_from(&tensor.values);
        }
        let mut values = all.into_iter().map(|tensor| tensor.values);
        for trained in [&mut self.actor].into_iter().chain(&mut self.critics) {
            let count = self.shape.widths(trained.role).tensors().len();
            let mut next = || values.by_ref().take(count).collect::<Vec<_>>();
            let [own, target, m, v] = [next(), next(), next(), next()];
            let steps = values.next().expect("the count follows the moments")[0] as u32;
            trained.network = trained.network.clone().with_numbers(&own);
            trained.target = trained.target.clone().with_numbers(&target);
            trained.memory = memory(steps, &m, &v, &self.device);
        }
        Ok(())
    }
}
