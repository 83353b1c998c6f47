//! The fast actor-critic: DDPG's update by hand on flat buffers.

use super::super::actor_critic::{ActorCritic, Batch, Losses, NetworkShape, NetworkTensor, OptimiserSettings};
use super::super::tensors::{Role, check_tensors, initial_tensors, tensor_shapes};
use super::buffer::Buffer;
use super::lanes::Kernel;
use super::layout::{Layout, panels, stride};
use super::pass::{Slopes, Target, Trace, Trained, pack};
use crate::rng::Rng;

/// An actor-critic module that computes with the processor's vectors and allocates nothing once it has seen its largest batch.
///
/// Sums are taken in a fixed order that depends neither on the number of rows nor on the time, so that equal seeds give equal bits
/// on one target and [`Kernel`].
#[derive(Clone, Debug)]
pub struct Fused {
    shape: NetworkShape,
    kernel: Kernel,
    actor: Trained,
    critics: Vec<Trained>,
    workspace: Workspace,
}

/// Scratch for batches of up to `rows` rows.
#[derive(Clone, Debug, Default)]
struct Workspace {
    rows: usize,
    /// Activations: observation and action of each row. The actor reads the columns of the observation only.
    input: Buffer,
    actor: Trace,
    critic: Trace,
    slopes: Slopes,
    gradient: Buffer,
    /// rows: derivatives by the critic's output.
    by_value: Vec<f32>,
    /// rows × action: derivatives by the actions.
    by_action: Vec<f32>,
    /// rows × action: what the actor's tanh was taken of.
    sums: Vec<f32>,
}

/// Which parameters of a module to use.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Which {
    Network,
    Target,
}

fn of(trained: &Trained, which: Which) -> &[f32] {
    match which {
        Which::Network => &trained.parameters,
        Which::Target => &trained.target,
    }
}

impl Fused {
    /// A fresh module with the parameters of [`initial_tensors`], for this processor's fastest [`Kernel`].
    ///
    /// # Panics
    /// If [`NetworkShape::check`] refuses the shape.
    pub fn new(shape: &NetworkShape, rng: &mut Rng) -> Fused {
        Fused::with_kernel(shape, rng, Kernel::fastest())
    }

    /// The same for a chosen kernel.
    ///
    /// # Panics
    /// If [`NetworkShape::check`] refuses the shape.
    pub fn with_kernel(shape: &NetworkShape, rng: &mut Rng, kernel: Kernel) -> Fused {
        shape.check().expect("a network shape that was checked");
        let trained = |role: &Role| Trained::new(Layout::new(&shape.widths(*role)));
        let (actor, critics) = shape.roles().split_first().expect("a module has an actor");
        let mut fused = Fused {
            shape: shape.clone(),
            kernel,
            actor: trained(actor),
            critics: critics.iter().map(trained).collect(),
            workspace: Workspace::default(),
        };
        fused.load(&initial_tensors(shape, rng)).expect("initial tensors are of the shape they were made for");
        fused
    }

    /// The kernel it computes with.
    pub fn kernel(&self) -> Kernel {
        self.kernel
    }

    fn reserve(&mut self, rows: usize) {
        if rows <= self.workspace.rows {
            return;
        }
        let (actor, critic) = (&self.actor.layout, &self.critics[0].layout);
        self.workspace = Workspace {
            rows,
            input: Buffer::zeros(panels(self.shape.observation + self.shape.action) * stride(rows)),
            actor: Trace::new(actor, rows),
            critic: Trace::new(critic, rows),
            slopes: Slopes::new(&[actor, critic], rows),
            gradient: Buffer::zeros(actor.len().max(critic.len())),
            by_value: vec![0.0; rows],
            by_action: vec![0.0; rows * self.shape.action],
            sums: vec![0.0; rows * self.shape.action],
        };
    }

    /// π of the packed observations, in the actor's trace.
    fn run_actor(&mut self, which: Which, rows: usize) {
        let Workspace { input, actor, sums, .. } = &mut self.workspace;
        actor.forward(self.kernel, &self.actor.layout, of(&self.actor, which), input, rows);
        let sums = &mut sums[..rows * self.shape.action];
        sums.copy_from_slice(&actor.output[..sums.len()]);
        actor.output.iter_mut().zip(sums).for_each(|(action, sum)| *action = libm::tanhf(*sum));
    }

    /// Packs the actor's actions beside the observations.
    fn join_actions(&mut self, rows: usize) {
        let Workspace { input, actor, .. } = &mut self.workspace;
        pack(input, rows, self.shape.observation, &actor.output[..rows * self.shape.action]);
    }

    /// The smallest value of the critics for each packed row.
    fn smallest_values(&mut self, which: Which, values: &mut [f32]) {
        values.fill(f32::INFINITY);
        for critic in &self.critics {
            let Workspace { input, critic: trace, .. } = &mut self.workspace;
            trace.forward(self.kernel, &critic.layout, of(critic, which), input, values.len());
            values.iter_mut().zip(&trace.output).for_each(|(value, &q)| *value = if q < *value { q } else { *value });
        }
    }

    fn pack_observations(&mut self, observations: &[f32], rows: usize) {
        assert_eq!(observations.len(), rows * self.shape.observation, "observations of {rows} rows");
        self.reserve(rows);
        pack(&mut self.workspace.input, rows, 0, observations);
    }

    fn pack_batch(&mut self, observations: &[f32], actions: &[f32], rows: usize) {
        assert_eq!(actions.len(), rows * self.shape.action, "actions of {rows} rows");
        self.pack_observations(observations, rows);
        pack(&mut self.workspace.input, rows, self.shape.observation, actions);
    }

    fn rows_of(&self, actions: &[f32]) -> usize {
        assert!(actions.len().is_multiple_of(self.shape.action), "whole rows of actions");
        actions.len() / self.shape.action
    }

    fn act_by(&mut self, which: Which, observations: &[f32], actions: &mut [f32]) {
        let rows = self.rows_of(actions);
        if rows == 0 {
            return assert!(observations.is_empty(), "observations of 0 rows");
        }
        self.pack_observations(observations, rows);
        self.run_actor(which, rows);
        actions.copy_from_slice(&self.workspace.actor.output[..actions.len()]);
    }

    fn values_by(&mut self, which: Which, observations: &[f32], values: &mut [f32]) {
        if values.is_empty() {
            return assert!(observations.is_empty(), "observations of 0 rows");
        }
        self.pack_observations(observations, values.len());
        self.run_actor(which, values.len());
        self.join_actions(values.len());
        self.smallest_values(which, values);
    }

    /// The critics' steps; their traces and slopes are left in the workspace.
    fn step_critics(&mut self, batch: Batch<'_>, settings: &OptimiserSettings, target: Target) -> f32 {
        let rows = batch.targets.len();
        self.pack_batch(batch.observations, batch.actions, rows);
        let mut loss = 0.0;
        for critic in &mut self.critics {
            let Workspace { input, critic: trace, slopes, gradient, by_value, .. } = &mut self.workspace;
            trace.forward(self.kernel, &critic.layout, &critic.parameters, input, rows);
            let mut squares = 0.0;
            for ((by_value, q), y) in by_value.iter_mut().zip(&trace.output[..rows]).zip(batch.targets) {
                let error = q - y;
                squares += f64::from(error) * f64::from(error);
                *by_value = error * (2.0 / rows as f32);
            }
            loss += squares / rows as f64;
            let network = (&critic.layout, &*critic.parameters);
            slopes.backward(self.kernel, network, (trace, input), &by_value[..rows], gradient);
            critic.descend(self.kernel, gradient, settings.critic_rate, settings, target);
        }
        (loss / self.critics.len() as f64) as f32
    }

    /// The actor's step up the first critic, for the observations that the critics' step packed.
    fn step_actor(&mut self, rows: usize, settings: &OptimiserSettings) -> f32 {
        self.run_actor(Which::Network, rows);
        self.join_actions(rows);
        let critic = &self.critics[0];
        let Workspace { input, actor: trace, critic: valued, slopes, gradient, by_value, by_action, sums, .. } =
            &mut self.workspace;
        let network = (&critic.layout, &*critic.parameters);
        valued.forward(self.kernel, network.0, network.1, input, rows);
        let loss = -valued.output[..rows].iter().map(|&q| f64::from(q)).sum::<f64>() / rows as f64;
        by_value[..rows].fill(-1.0 / rows as f32);
        slopes.backward(self.kernel, network, (valued, input), &by_value[..rows], &mut []);
        let by_action = &mut by_action[..rows * self.shape.action];
        slopes.by_input(self.kernel, network, self.shape.observation, rows, by_action);
        let penalty = settings.saturation_penalty * 2.0 / rows as f32;
        for ((slope, action), sum) in by_action.iter_mut().zip(&trace.output).zip(&*sums) {
            *slope = *slope * (1.0 - action * action) + penalty * sum;
        }
        let network = (&self.actor.layout, &*self.actor.parameters);
        slopes.backward(self.kernel, network, (trace, input), by_action, gradient);
        self.actor.descend(self.kernel, gradient, settings.actor_rate, settings, Target::Follows);
        loss as f32
    }

    fn trained(&self) -> impl Iterator<Item = (&'static str, &Trained)> {
        self.shape.roles().iter().map(|role| role.name()).zip([&self.actor].into_iter().chain(&self.critics))
    }
}

impl ActorCritic for Fused {
    fn shape(&self) -> &NetworkShape {
        &self.shape
    }

    fn act(&mut self, observations: &[f32], actions: &mut [f32]) {
        self.act_by(Which::Network, observations, actions);
    }

    fn values(&mut self, observations: &[f32], values: &mut [f32]) {
        self.values_by(Which::Network, observations, values);
    }

    fn target_values(&mut self, observations: &[f32], values: &mut [f32]) {
        self.values_by(Which::Target, observations, values);
    }

    fn target_act(&mut self, observations: &[f32], actions: &mut [f32]) {
        self.act_by(Which::Target, observations, actions);
    }

    fn target_action_values(&mut self, observations: &[f32], actions: &[f32], values: &mut [f32]) {
        if values.is_empty() {
            return assert!(observations.is_empty() && actions.is_empty(), "observations and actions of 0 rows");
        }
        self.pack_batch(observations, actions, values.len());
        self.smallest_values(Which::Target, values);
    }

    fn update(&mut self, batch: Batch<'_>, settings: &OptimiserSettings) -> Losses {
        if batch.targets.is_empty() {
            return Losses::default();
        }
        let critic = self.step_critics(batch, settings, Target::Follows);
        let actor = self.step_actor(batch.targets.len(), settings);
        Losses { critic, actor }
    }

    fn update_critic(&mut self, batch: Batch<'_>, settings: &OptimiserSettings) -> f32 {
        if batch.targets.is_empty() {
            return 0.0;
        }
        self.step_critics(batch, settings, Target::Stays)
    }

    fn tensors(&self, optimiser: bool) -> Vec<NetworkTensor> {
        let mut all = Vec::new();
        let mut shapes = tensor_shapes(&self.shape, optimiser).into_iter();
        for (_, trained) in self.trained() {
            let own = 2 + trained.layout.hidden.len() * if trained.layout.hidden[0].normalised { 4 } else { 2 };
            let moments = [&trained.m, &trained.v];
            let buffers =
                [&trained.parameters, &trained.target].into_iter().chain(moments.into_iter().take(2 * usize::from(optimiser)));
            for buffer in buffers {
                for (tensor, (name, shape)) in shapes.by_ref().take(own).enumerate() {
                    let mut values = Vec::new();
                    trained.layout.places(tensor, |at| values.push(buffer[at]));
                    all.push(NetworkTensor { name, shape, values });
                }
            }
            if optimiser {
                let (name, shape) = shapes.next().expect("the count follows the moments");
                all.push(NetworkTensor { name, shape, values: vec![trained.steps as f32] });
            }
        }
        all
    }

    fn load(&mut self, tensors: &[NetworkTensor]) -> Result<(), String> {
        check_tensors(&self.shape, tensors)?;
        let roles = self.shape.roles().iter();
        for (role, trained) in roles.zip([&mut self.actor].into_iter().chain(&mut self.critics)) {
            let names = self.shape.widths(*role).tensors();
            for tensor in tensors {
                let Some(rest) = tensor.name.strip_prefix(role.name()) else { continue };
                if rest == ".adam.steps" {
                    trained.steps = tensor.values[0] as u32;
                }
                for (prefix, buffer) in [
                    ("_target.", &mut trained.target),
                    (".adam.m.", &mut trained.m),
                    (".adam.v.", &mut trained.v),
                    (".", &mut trained.parameters),
                ] {
                    let position = rest.strip_prefix(prefix).and_then(|name| names.iter().position(|(own, _)| own == name));
                    if let Some(position) = position {
                        let mut values = tensor.values.iter();
                        trained.layout.places(position, |at| buffer[at] = *values.next().expect("shapes were checked"));
                        break;
                    }
                }
            }
        }
        Ok(())
    }
}
