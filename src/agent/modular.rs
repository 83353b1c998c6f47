//! Modular DDPG: Algorithm 2 of [Cai et al. 2021](crate::bib::Cai2021), with options that it does not have.
//!
//! One [`Module`] (actor, critic, targets, replay, noise) per automaton state. Reading order of a training step, by its lines:
//!
//! | Algorithm 2 | here |
//! |---|---|
//! | u_t = π_{q_t}(x) + N_{q_t} | [`Learner::explore`]: the module in charge of (q_t, T) acts, its noise disturbs |
//! | store (x_t, u_t, R', γ(x_{t+1}), x_{t+1}) in B_{q_t} | [`Learner::record`]: through the window of n steps; n = 1 stores at once |
//! | sample N data from B_{q_t}, targets y_i | [`Learner::update`]: values of x_{i+1} by the targets of the module of q_{i+1} |
//! | minimise L, ascend the policy gradient, soft update | [`ActorCritic::update`] |
//!
//! Departures. **\[D3\]** y_i uses γ(x_{i+1}), which is what the stored sample holds, where the print writes γ(x_i).
//! **ε-moves**, about which Algorithm 2 is silent, have no entry in a critic: their value is known by one look ahead,
//! R' + γ·V(s, q_2) = R' + γ·Q_{q_2}(s, π_{q_2}(s)), and is compared with Q(x, π(x)), in acting and in the targets alike. Returns
//! of several steps end at an ε-move, whose value the target's maximum then gives.

use super::bootstrap::{Bootstrap, World};
use super::exploration::Hold;
use super::learner::{Learner, Policy, Situation, Transition, Update};
use super::module::Module;
use super::module_map::{Encoder, Modules, ModulesError};
use super::noise::Noise;
use super::replay::Replay;
use super::settings::{LearnerSettings, UpdatedModule};
use super::trace::Trace;
use crate::automaton::{EmbeddedState, Embedding, Marks};
use crate::nn::{ActorCritic, Batch, Losses, NetworkShape, NetworkTensor, OptimiserSettings};
use crate::product::{Chosen, MoveKind, ProductStep, Reward};
use crate::rng::{Purpose, Rng};
use std::sync::Arc;

/// The most embedded states that counterfactual replay lists; of more it draws at random.
const MAX_LISTED: usize = 1 << 16;

/// What makes the networks of a module: their shape, and the random numbers for their parameters.
pub type Engine = fn(&NetworkShape, &mut Rng) -> Box<dyn ActorCritic>;

/// Modular DDPG and, by its [`ModuleMap`](super::ModuleMap), its relatives.
pub struct ModularDdpg {
    pub(super) embedding: Arc<Embedding>,
    pub(super) reward: Arc<dyn Reward>,
    pub(super) settings: LearnerSettings,
    pub(super) index: Modules,
    pub(super) encoder: Encoder,
    pub(super) modules: Vec<Module>,
    pub(super) trace: Trace,
    pub(super) hold: Hold,
    pub(super) noise_rng: Rng,
    pub(super) replay_rng: Rng,
    sizes: Sizes,
    /// Controls recorded.
    pub(super) steps: u64,
    /// The module that was in charge of x_t, until the updates of that step are done.
    pub(super) current: Option<usize>,
    /// The module that the last look at a situation put in charge.
    chosen: Option<usize>,
    /// Embedded states from which counterfactual samples read their first letter; empty if they are too many to list.
    listed: Vec<EmbeddedState>,
    batch: Bootstrap,
    pub(super) input: Vec<f32>,
}

impl ModularDdpg {
    /// A fresh learner for observations and controls of the given lengths, its parameters drawn from `seed`.
    ///
    /// # Errors
    /// More modules than a learner may have.
    ///
    /// # Panics
    /// If settings are outside the ranges that a task file is checked for.
    pub fn new(
        settings: LearnerSettings,
        embedding: Arc<Embedding>,
        reward: Arc<dyn Reward>,
        sizes: Sizes,
        start: (Engine, u64),
    ) -> Result<ModularDdpg, ModulesError> {
        let (engine, seed) = start;
        let index = Modules::new(settings.modules, &embedding)?;
        let encoder =
            Encoder::new(settings.modules, &embedding, sizes.observation).with_fourier_features(settings.fourier_octaves);
        let shape = NetworkShape {
            critics: settings.critics,
            layer_norm: settings.layer_norm,
            ..NetworkShape::new(encoder.len(), sizes.control, &settings.hidden)
        };
        let mut init = Rng::new(seed, Purpose::Initialisation);
        let module = |_| Module {
            networks: engine(&shape, &mut init),
            replay: Replay::new(settings.replay, sizes.observation, sizes.control),
            noise: Noise::new(settings.exploration.noise, sizes.control),
            updates: 0,
            actor_loss: 0.0,
        };
        let modules = (0..index.len()).map(module).collect();
        let automaton = embedding.automaton().clone();
        let mut listed = vec![];
        if settings.counterfactual.samples > 0 {
            listed = embedding.reachable(MAX_LISTED).unwrap_or_default();
            listed.retain(|at| !automaton.is_sink(at.q));
        }
        Ok(ModularDdpg {
            trace: Trace::new(settings.n_step, sizes.observation, sizes.control),
            hold: Hold::new(sizes.control),
            noise_rng: Rng::new(seed, Purpose::Noise),
            replay_rng: Rng::new(seed, Purpose::Replay),
            sizes,
            steps: 0,
            current: None,
            chosen: None,
            batch: Bootstrap::default(),
            input: vec![],
            listed,
            embedding,
            reward,
            settings,
            index,
            encoder,
            modules,
        })
    }

    /// The lengths of observations and controls.
    pub(super) fn sizes(&self) -> Sizes {
        self.sizes
    }

    /// What was chosen about this learner.
    pub fn settings(&self) -> &LearnerSettings {
        &self.settings
    }

    /// The modules and what they are in charge of.
    pub fn modules(&self) -> &Modules {
        &self.index
    }

    /// Updates performed by all modules.
    pub fn updates(&self) -> u64 {
        self.modules.iter().map(|m| m.updates).sum()
    }

    /// Samples in all replays.
    pub fn samples(&self) -> usize {
        self.modules.iter().map(|m| m.replay.len()).sum()
    }

    /// Samples in the replay of `module`.
    pub fn samples_of(&self, module: usize) -> usize {
        self.modules[module].replay.len()
    }

    /// The networks of each module, without optimisers.
    pub fn policy(&self) -> Vec<Vec<NetworkTensor>> {
        self.modules.iter().map(|m| m.networks.tensors(false)).collect()
    }

    /// Takes over networks that [`ModularDdpg::policy`] gave.
    ///
    /// # Errors
    /// A sentence naming what does not fit. Modules before it are changed then.
    pub fn load_policy(&mut self, policy: &[Vec<NetworkTensor>]) -> Result<(), String> {
        if policy.len() != self.modules.len() {
            return Err(format!("the policy has {} modules, the learner {}", policy.len(), self.modules.len()));
        }
        self.modules.iter_mut().zip(policy).try_for_each(|(module, tensors)| module.networks.load(tensors))
    }

    /// The module that chose last; `None` before the first choice.
    pub fn acting(&self) -> Option<usize> {
        self.chosen
    }

    /// The rates of the optimisers at this step of their schedules.
    fn optimiser(&self) -> OptimiserSettings {
        OptimiserSettings {
            actor_rate: self.settings.actor_rate.at(self.steps),
            critic_rate: self.settings.critic_rate.at(self.steps),
            tau: self.settings.tau,
            saturation_penalty: self.settings.saturation_penalty,
            ..OptimiserSettings::default()
        }
    }

    /// Makes the oldest waiting transition a sample, with its counterfactuals.
    fn store_oldest(&mut self) {
        let (at, labels) = (self.trace.at(), self.trace.labels());
        self.store(at);
        for _ in 0..self.settings.counterfactual.samples {
            // Any embedded state that is left by reading L(s): whatever came before, s itself is as it was.
            let before = self.any_embedded();
            let other = self.embedding.read(before, labels).to;
            if other != at {
                self.store(other);
            }
        }
        self.trace.pop();
    }

    /// Stores the oldest waiting transition as if it had begun in `at`. A sink, where nothing is learned, is passed over; of several
    /// modules that compete for `at`, one drawn uniformly learns from it.
    fn store(&mut self, at: EmbeddedState) {
        let count = self.index.candidates(at).count();
        let pick = if count > 1 { self.replay_rng.below(count) } else { 0 };
        if let Some((module, at)) = self.index.candidates(at).nth(pick) {
            let sample = self.trace.sample(at, &self.embedding, self.reward.as_ref(), self.settings.reward_scale);
            self.modules[module].replay.push(&sample);
        }
    }

    /// An embedded state outside the sinks, uniformly from the reachable ones, or from all where they are too many to list.
    fn any_embedded(&mut self) -> EmbeddedState {
        if !self.listed.is_empty() {
            return self.listed[self.replay_rng.below(self.listed.len())];
        }
        let automaton = self.embedding.automaton();
        let all = automaton.all_sets();
        let q = self.replay_rng.below(automaton.len()) as u16;
        let drawn = Marks(self.replay_rng.bits() as u32 & all.0);
        let frontier = if drawn.0 == 0 { all } else { drawn };
        EmbeddedState { q, frontier, unvisited: self.embedding.start().unvisited.without(q) }
    }

    /// One update of `module`, whose replay holds a batch.
    fn update_module(&mut self, module: usize) -> Update {
        let world = World {
            embedding: &self.embedding,
            reward: self.reward.as_ref(),
            modules: &self.index,
            encoder: &self.encoder,
            scale: self.settings.reward_scale,
            smoothing: self.settings.target_smoothing,
        };
        self.batch.draw(module, self.settings.batch, &mut self.modules, world, &mut self.replay_rng);
        let optimiser = self.optimiser();
        let batch = Batch { observations: &self.batch.inputs, actions: &self.batch.controls, targets: &self.batch.targets };
        let changed = &mut self.modules[module];
        changed.updates += 1;
        if changed.updates.is_multiple_of(u64::from(self.settings.policy_delay)) {
            let losses = changed.networks.update(batch, &optimiser);
            changed.actor_loss = losses.actor;
            return Update { module, losses };
        }
        let critic = changed.networks.update_critic(batch, &optimiser);
        Update { module, losses: Losses { critic, actor: changed.actor_loss } }
    }

    /// The module to update now, if one with a whole batch is due.
    fn due(&mut self, current: usize) -> Option<usize> {
        let ready = |m: &Module| m.replay.len() >= self.settings.batch;
        match self.settings.updated_module {
            UpdatedModule::Current => ready(&self.modules[current]).then_some(current),
            UpdatedModule::Random => {
                let count = self.modules.iter().filter(|m| ready(m)).count();
                if count == 0 {
                    return None;
                }
                let pick = self.replay_rng.below(count);
                (0..self.modules.len()).filter(|&m| ready(&self.modules[m])).nth(pick)
            }
        }
    }
}

/// The lengths of an environment's observations and controls.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Sizes {
    /// Numbers in an observation.
    pub observation: usize,
    /// Numbers in a control.
    pub control: usize,
}

impl Policy for ModularDdpg {
    /// The greedy move: π of the module in charge, or the ε-move that promises more.
    fn act(&mut self, now: &Situation<'_>, control: &mut [f32]) -> Chosen {
        let mut best = f32::NEG_INFINITY;
        control.fill(0.0);
        self.chosen = self.in_charge(now.observation, now.at);
        if let Some(module) = self.chosen {
            self.control_of(module, now.observation, now.at, control);
            if !now.jumps.is_empty() {
                best = self.value(now.observation, now.at).unwrap_or(best);
            }
        }
        let mut chosen = Chosen::Control;
        for jump in now.jumps {
            let value = self.jump_value(now.observation, jump);
            if value > best {
                (best, chosen) = (value, Chosen::Epsilon(jump.to.q));
            }
        }
        chosen
    }
}

impl ModularDdpg {
    /// What an ε-move promises: R' + γ·V(s, q_2), in units of unscaled rewards.
    fn jump_value(&mut self, observation: &[f32], jump: &ProductStep) -> f32 {
        let payoff = self.reward.payoff(jump);
        let after = if payoff.discount > 0.0 { self.value(observation, jump.to) } else { None };
        payoff.reward + payoff.discount * after.unwrap_or(0.0)
    }
}

impl Learner for ModularDdpg {
    fn explore(&mut self, now: &Situation<'_>, control: &mut [f32]) -> Chosen {
        let exploration = self.settings.exploration;
        if !now.jumps.is_empty() && self.noise_rng.chance(exploration.jump_probability) {
            let pick = self.noise_rng.below(now.jumps.len() + 1);
            if pick < now.jumps.len() {
                return Chosen::Epsilon(now.jumps[pick].to.q);
            }
            self.act(&Situation { jumps: &[], ..*now }, control);
        } else if let Chosen::Epsilon(target) = self.act(now, control) {
            return Chosen::Epsilon(target);
        }
        if self.hold.take(&exploration, self.steps, control, &mut self.noise_rng) {
            return Chosen::Control;
        }
        if self.steps < exploration.warm_up {
            control.fill_with(|| self.noise_rng.uniform_in(-1.0, 1.0));
        } else if let Some(module) = self.chosen {
            self.modules[module].noise.disturb(control, self.steps, &mut self.noise_rng);
        }
        Chosen::Control
    }

    fn record(&mut self, transition: &Transition<'_>) {
        if transition.step.kind == MoveKind::Epsilon {
            self.drain();
            return;
        }
        self.steps += 1;
        self.current = self.index.of(transition.step.from).or(self.chosen);
        self.trace.push(transition);
        if transition.step.ends() {
            self.drain();
        } else if self.trace.is_full() {
            self.store_oldest();
        }
    }

    fn finish_episode(&mut self) {
        self.drain();
        self.hold.reset();
        self.modules.iter_mut().for_each(|m| m.noise.reset());
    }

    fn update(&mut self) -> Option<Update> {
        let current = self.current.take()?;
        let on =
            self.steps > self.settings.exploration.warm_up && self.steps.is_multiple_of(u64::from(self.settings.update_every));
        let updates = if on { self.settings.updates_per_step } else { 0 };
        let mut last = None;
        for _ in 0..updates {
            if let Some(module) = self.due(current) {
                last = Some(self.update_module(module));
            }
        }
        last
    }
}

impl ModularDdpg {
    /// Makes samples of all waiting transitions, with the steps there are.
    fn drain(&mut self) {
        while !self.trace.is_empty() {
            self.store_oldest();
        }
    }
}
