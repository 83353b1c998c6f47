//! The plain actor-critic: DDPG's update written as the papers print it, the oracle of the fast one.

use super::super::actor_critic::{ActorCritic, Batch, Losses, NetworkShape, NetworkTensor, OptimiserSettings};
use super::super::tensors::{Role, check_tensors, initial_tensors};
use super::adam::{Adam, soft_update};
use super::network::{Network, Output, Trace};
use crate::rng::Rng;

/// A network, its target and its optimiser.
#[derive(Clone, Debug)]
struct Trained {
    role: Role,
    network: Network,
    target: Network,
    adam: Adam,
}

/// An actor-critic module with sums in double precision, one number at a time: slow, meant to be read and to test others against.
#[derive(Clone, Debug)]
pub struct Plain {
    shape: NetworkShape,
    actor: Trained,
    critics: Vec<Trained>,
}

impl Plain {
    /// A fresh module with the parameters of [`initial_tensors`].
    ///
    /// # Panics
    /// If [`NetworkShape::check`] refuses the shape.
    pub fn new(shape: &NetworkShape, rng: &mut Rng) -> Plain {
        shape.check().expect("a network shape that was checked");
        let trained = |role: Role| {
            let output = if role == Role::Actor { Output::Tanh } else { Output::Linear };
            let network = Network::new(shape.widths(role), output);
            Trained { role, target: network.clone(), adam: Adam::new(&network), network }
        };
        let (first, rest) = shape.roles().split_first().expect("a module has an actor");
        let critics = rest.iter().map(|&role| trained(role)).collect();
        let mut plain = Plain { shape: shape.clone(), actor: trained(*first), critics };
        plain.load(&initial_tensors(shape, rng)).expect("initial tensors are of the shape they were made for");
        plain
    }

    /// Calls `write` with each row's index and the smallest value of the critics for its observation and action.
    fn smallest_values(&self, which: fn(&Trained) -> &Network, observations: &[f32], actions: &[f64], values: &mut [f32]) {
        let rows = observations.chunks_exact(self.shape.observation).zip(actions.chunks_exact(self.shape.action));
        for ((observation, action), value) in rows.zip(values) {
            let input = joined(observation, action);
            let of = |critic| which(critic).forward(&input).output()[0];
            *value = self.critics.iter().map(of).fold(f64::INFINITY, f64::min) as f32;
        }
    }

    fn actions(&self, network: &Network, observations: &[f32]) -> Vec<f64> {
        let rows = observations.chunks_exact(self.shape.observation);
        rows.flat_map(|observation| network.forward(&wide(observation)).output().to_vec()).collect()
    }

    /// One critic's mean squared error over the batch, and its gradient.
    fn critic_gradient(&self, critic: &Network, batch: Batch<'_>) -> (f64, Vec<Vec<f64>>) {
        let (mut loss, mut gradient) = (0.0, critic.zeros());
        let rows = batch.targets.len() as f64;
        let samples = batch.observations.chunks_exact(self.shape.observation).zip(batch.actions.chunks_exact(self.shape.action));
        for ((observation, action), &target) in samples.zip(batch.targets) {
            let trace = critic.forward(&joined(observation, &wide(action)));
            let error = trace.output()[0] - f64::from(target);
            loss += error * error / rows;
            critic.backward(&trace, &[2.0 * error / rows], &mut gradient);
        }
        (loss, gradient)
    }

    /// Minus the mean value of the actor's own actions by the first critic, and the gradient by the actor's parameters of that and the
    /// penalty on saturation.
    fn actor_gradient(&self, observations: &[f32], penalty: f64) -> (f64, Vec<Vec<f64>>) {
        let (actor, critic) = (&self.actor.network, &self.critics[0].network);
        let (mut loss, mut gradient) = (0.0, actor.zeros());
        let rows = (observations.len() / self.shape.observation) as f64;
        for observation in observations.chunks_exact(self.shape.observation) {
            let acted: Trace = actor.forward(&wide(observation));
            let valued = critic.forward(&joined(observation, acted.output()));
            loss -= valued.output()[0] / rows;
            let by_input = critic.backward(&valued, &[-1.0 / rows], &mut critic.zeros());
            let by_sums: Vec<f64> = acted.sums().iter().map(|z| 2.0 * penalty * z / rows).collect();
            actor.backward_with_sums(&acted, &by_input[self.shape.observation..], &by_sums, &mut gradient);
        }
        (loss, gradient)
    }

    fn check_batch(&self, batch: Batch<'_>) -> usize {
        let rows = batch.targets.len();
        assert_eq!(batch.observations.len(), rows * self.shape.observation, "observations of {rows} rows");
        assert_eq!(batch.actions.len(), rows * self.shape.action, "actions of {rows} rows");
        rows
    }
}

impl ActorCritic for Plain {
    fn shape(&self) -> &NetworkShape {
        &self.shape
    }

    fn act(&mut self, observations: &[f32], actions: &mut [f32]) {
        assert_eq!(observations.len() * self.shape.action, actions.len() * self.shape.observation, "rows of actions");
        narrow(&self.actions(&self.actor.network, observations), actions);
    }

    fn values(&mut self, observations: &[f32], values: &mut [f32]) {
        assert_eq!(observations.len(), values.len() * self.shape.observation, "observations of {} rows", values.len());
        let actions = self.actions(&self.actor.network, observations);
        self.smallest_values(|critic| &critic.network, observations, &actions, values);
    }

    fn target_values(&mut self, observations: &[f32], values: &mut [f32]) {
        assert_eq!(observations.len(), values.len() * self.shape.observation, "observations of {} rows", values.len());
        let actions = self.actions(&self.actor.target, observations);
        self.smallest_values(|critic| &critic.target, observations, &actions, values);
    }

    fn target_act(&mut self, observations: &[f32], actions: &mut [f32]) {
        assert_eq!(observations.len() * self.shape.action, actions.len() * self.shape.observation, "rows of actions");
        narrow(&self.actions(&self.actor.target, observations), actions);
    }

    fn target_action_values(&mut self, observations: &[f32], actions: &[f32], values: &mut [f32]) {
        self.check_batch(Batch { observations, actions, targets: values });
        self.smallest_values(|critic| &critic.target, observations, &wide(actions), values);
    }

    fn update(&mut self, batch: Batch<'_>, settings: &OptimiserSettings) -> Losses {
        if self.check_batch(batch) == 0 {
            return Losses::default();
        }
        let critic = self.update_critic(batch, settings);
        let (actor, gradient) = self.actor_gradient(batch.observations, f64::from(settings.saturation_penalty));
        self.actor.adam.step(&mut self.actor.network, &gradient, settings.actor_rate, settings);
        for trained in [&mut self.actor].into_iter().chain(&mut self.critics) {
            soft_update(&mut trained.target, &trained.network, settings.tau);
        }
        Losses { critic, actor: actor as f32 }
    }

    fn update_critic(&mut self, batch: Batch<'_>, settings: &OptimiserSettings) -> f32 {
        if self.check_batch(batch) == 0 {
            return 0.0;
        }
        let mut sum = 0.0;
        for i in 0..self.critics.len() {
            let (loss, gradient) = self.critic_gradient(&self.critics[i].network, batch);
            sum += loss;
            let Trained { network, adam, .. } = &mut self.critics[i];
            adam.step(network, &gradient, settings.critic_rate, settings);
        }
        (sum / self.critics.len() as f64) as f32
    }

    fn tensors(&self, optimiser: bool) -> Vec<NetworkTensor> {
        let mut all = Vec::new();
        for Trained { role, network, target, adam } in [&self.actor].into_iter().chain(&self.critics) {
            let name = role.name();
            all.extend(network.named(name, &network.tensors));
            all.extend(network.named(&format!("{name}_target"), &target.tensors));
            if optimiser {
                all.extend(network.named(&format!("{name}.adam.m"), &adam.m));
                all.extend(network.named(&format!("{name}.adam.v"), &adam.v));
                let name = format!("{name}.adam.steps");
                all.push(NetworkTensor { name, shape: vec![1], values: vec![adam.steps as f32] });
            }
        }
        all
    }

    fn load(&mut self, tensors: &[NetworkTensor]) -> Result<(), String> {
        check_tensors(&self.shape, tensors)?;
        for tensor in tensors {
            for Trained { role, network, target, adam } in [&mut self.actor].into_iter().chain(&mut self.critics) {
                let name = role.name();
                let inside = |prefix: &str| network.position(tensor.name.strip_prefix(prefix)?.strip_prefix('.')?);
                if tensor.name == format!("{name}.adam.steps") {
                    adam.steps = tensor.values[0] as u32;
                } else if let Some(i) = inside(&format!("{name}.adam.m")) {
                    adam.m[i].clone_from(&tensor.values);
                } else if let Some(i) = inside(&format!("{name}.adam.v")) {
                    adam.v[i].clone_from(&tensor.values);
                } else if let Some(i) = inside(&format!("{name}_target")) {
                    target.tensors[i].clone_from(&tensor.values);
                } else if let Some(i) = inside(name) {
                    network.tensors[i].clone_from(&tensor.values);
                }
            }
        }
        Ok(())
    }
}

fn wide(numbers: &[f32]) -> Vec<f64> {
    numbers.iter().map(|&number| f64::from(number)).collect()
}

fn narrow(numbers: &[f64], to: &mut [f32]) {
    to.iter_mut().zip(numbers).for_each(|(to, &number)| *to = number as f32);
}

fn joined(observation: &[f32], action: &[f64]) -> Vec<f64> {
    observation.iter().map(|&number| f64::from(number)).chain(action.iter().copied()).collect()
}

#[cfg(test)]
#[path = "learner_tests.rs"]
mod tests;
