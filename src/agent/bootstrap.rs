//! The critic's targets y = R + Γ·max(V'(x'), max over ε-moves of their look-ahead), computed in a few dense calls. Where several
//! modules compete for x', V'(x') is the greatest of their values.

use super::module::Module;
use super::module_map::{Encoder, Modules};
use super::settings::TargetSmoothing;
use crate::automaton::Embedding;
use crate::labels::Labels;
use crate::product::{ProductStep, Reward};
use crate::rng::Rng;

/// What targets depend on besides networks and samples.
#[derive(Clone, Copy)]
pub(super) struct World<'a> {
    pub embedding: &'a Embedding,
    pub reward: &'a dyn Reward,
    pub modules: &'a Modules,
    pub encoder: &'a Encoder,
    /// What rewards are multiplied by.
    pub scale: f32,
    pub smoothing: TargetSmoothing,
}

/// One value that is asked of a module's target networks: for `row`, `reward + discount·V'(s', to)`.
struct Query {
    module: usize,
    row: usize,
    reward: f32,
    discount: f32,
    /// Where in the replay the observation of s' stands.
    place: usize,
    to: crate::automaton::EmbeddedState,
}

/// A batch and its targets, in buffers that are kept from update to update.
#[derive(Default)]
pub(super) struct Bootstrap {
    /// rows × network input: x.
    pub inputs: Vec<f32>,
    /// rows × action: u.
    pub controls: Vec<f32>,
    /// rows: y.
    pub targets: Vec<f32>,
    queries: Vec<Query>,
    discounts: Vec<f32>,
    best: Vec<f32>,
    rows: Vec<f32>,
    actions: Vec<f32>,
    values: Vec<f32>,
}

impl Bootstrap {
    /// Draws `rows` samples (with replacement) from the replay of `modules[charge]` and computes their targets. The values of x'
    /// are asked of the modules in charge of x', one dense call for each of them.
    pub fn draw(&mut self, charge: usize, rows: usize, modules: &mut [Module], world: World<'_>, rng: &mut Rng) {
        self.gather(charge, rows, modules, world, rng);
        // By module, rows in order: the grouping does not depend on anything but the batch.
        self.queries.sort_unstable_by_key(|q| (q.module, q.row, q.to));
        let mut from = 0;
        while from < self.queries.len() {
            let module = self.queries[from].module;
            let to = from + self.queries[from..].iter().take_while(|q| q.module == module).count();
            self.rows.clear();
            for query in &self.queries[from..to] {
                world.encoder.push(modules[charge].replay.get(query.place).next, query.to, &mut self.rows);
            }
            self.values.resize(to - from, 0.0);
            self.values(&mut modules[module], world.smoothing, rng);
            for (query, value) in self.queries[from..to].iter().zip(&self.values) {
                let best = &mut self.best[query.row];
                *best = best.max(query.reward + query.discount * value);
            }
            from = to;
        }
        for ((y, discount), best) in self.targets.iter_mut().zip(&self.discounts).zip(&self.best) {
            if *discount > 0.0 {
                *y += discount * best;
            }
        }
    }

    /// Draws the batch, and lists what must be asked about each x'.
    fn gather(&mut self, charge: usize, rows: usize, modules: &[Module], world: World<'_>, rng: &mut Rng) {
        let replay = &modules[charge].replay;
        let automaton = world.embedding.automaton();
        self.inputs.clear();
        self.controls.clear();
        self.targets.clear();
        self.discounts.clear();
        self.queries.clear();
        self.best.clear();
        self.best.resize(rows, f32::NEG_INFINITY);
        for row in 0..rows {
            let place = rng.below(replay.len());
            let sample = replay.get(place);
            world.encoder.push(sample.observation, sample.at, &mut self.inputs);
            self.controls.extend_from_slice(sample.control);
            self.targets.push(sample.reward);
            self.discounts.push(sample.discount);
            if sample.discount == 0.0 {
                continue;
            }
            let to = sample.next_at;
            // Only sinks have no module, and into a sink the discount is 0.
            for (module, to) in world.modules.candidates(to) {
                self.queries.push(Query { module, row, reward: 0.0, discount: 1.0, place, to });
            }
            for &target in automaton.epsilon(to.q) {
                let step = ProductStep::jump(world.embedding, to, target, Labels::EMPTY);
                let payoff = world.reward.payoff(&step);
                let (reward, discount) = (world.scale * payoff.reward, payoff.discount);
                if discount == 0.0 {
                    self.best[row] = self.best[row].max(reward);
                    continue;
                }
                for (module, to) in world.modules.candidates(step.to) {
                    self.queries.push(Query { module, row, reward, discount, place, to });
                }
            }
        }
    }

    /// V'(x') of the gathered rows by one module's target networks, with target smoothing if it is on.
    fn values(&mut self, module: &mut Module, smoothing: TargetSmoothing, rng: &mut Rng) {
        if smoothing.sigma <= 0.0 {
            return module.networks.target_values(&self.rows, &mut self.values);
        }
        self.actions.resize(self.values.len() * module.networks.shape().action, 0.0);
        module.networks.target_act(&self.rows, &mut self.actions);
        for u in &mut self.actions {
            let noise = (smoothing.sigma * rng.normal()).clamp(-smoothing.clip, smoothing.clip);
            *u = (*u + noise).clamp(-1.0, 1.0);
        }
        module.networks.target_action_values(&self.rows, &self.actions, &mut self.values);
    }
}
