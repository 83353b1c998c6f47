//! The work that benchmarks time: full updates of one module from a replay, their arithmetic, and the processor's bound for it.
//! It reads no clock; shells do.
#![allow(unsafe_code)]

use super::actor_critic::{ActorCritic, Batch, Critics, Losses, NetworkShape, OptimiserSettings};
use super::fused::{Kernel, Lanes, Work};
use crate::rng::{Purpose, Rng};

/// Samples in the replay: enough that they do not stay in the first cache.
const REPLAY: usize = 10_000;

/// One module and a replay of random samples to learn from.
pub struct Workload {
    module: Box<dyn ActorCritic>,
    rows: usize,
    rng: Rng,
    /// Samples: observation, action, reward, next observation.
    replay: Vec<f32>,
    observations: Vec<f32>,
    actions: Vec<f32>,
    targets: Vec<f32>,
    next: Vec<f32>,
}

impl Workload {
    /// Batches of `rows` for `module`; equal seeds draw equal samples.
    pub fn new(module: Box<dyn ActorCritic>, rows: usize, seed: u64) -> Workload {
        let NetworkShape { observation, action, .. } = *module.shape();
        let mut rng = Rng::new(seed, Purpose::Replay);
        let replay = (0..REPLAY * (2 * observation + action + 1)).map(|_| rng.uniform_in(-1.0, 1.0)).collect();
        let numbers = |count: usize| vec![0.0; rows * count];
        Workload {
            rows,
            rng,
            replay,
            observations: numbers(observation),
            actions: numbers(action),
            targets: numbers(1),
            next: numbers(observation),
            module,
        }
    }

    /// One full update: draws a batch, asks the targets for its values, updates everything.
    pub fn update(&mut self) -> Losses {
        let NetworkShape { observation, action, .. } = *self.module.shape();
        let size = 2 * observation + action + 1;
        let mut rewards = [0.0; 1024];
        let rewards = &mut rewards[..self.rows];
        for (row, reward) in rewards.iter_mut().enumerate() {
            let sample = &self.replay[self.rng.below(REPLAY) * size..][..size];
            self.observations[row * observation..][..observation].copy_from_slice(&sample[..observation]);
            self.actions[row * action..][..action].copy_from_slice(&sample[observation..][..action]);
            *reward = sample[observation + action];
            self.next[row * observation..][..observation].copy_from_slice(&sample[observation + action + 1..]);
        }
        self.module.target_values(&self.next, &mut self.targets);
        self.targets.iter_mut().zip(rewards).for_each(|(value, reward)| *value = *reward + 0.99 * *value);
        let batch = Batch { observations: &self.observations, actions: &self.actions, targets: &self.targets };
        self.module.update(batch, &OptimiserSettings::default())
    }

    /// One action for one observation, as an environment step asks for it.
    pub fn act(&mut self) -> f32 {
        let NetworkShape { observation, action, .. } = *self.module.shape();
        self.module.act(&self.observations[..observation], &mut self.actions[..action]);
        self.actions[0]
    }
}

/// Floating-point operations of the matrix products in one full update of `rows` rows (a multiplication and an addition each): the
/// least that any implementation without approximations computes.
pub fn operations(shape: &NetworkShape, rows: usize) -> f64 {
    let count = |input: usize, output: usize| {
        let layers = [&[input], shape.hidden.as_slice(), &[output]].concat();
        let products: usize = layers.windows(2).map(|pair| pair[0] * pair[1]).sum();
        (products, products - layers[0] * layers[1])
    };
    let (actor, actor_inner) = count(shape.observation, shape.action);
    let (critic, critic_inner) = count(shape.observation + shape.action, 1);
    let critics = if shape.critics == Critics::Twin { 2 } else { 1 };
    // Target forward, forward, by the weights, by the inputs; then for the first critic forward and back once more.
    let by_action = shape.hidden[0] * shape.action;
    let products = 3 * actor + actor_inner + critics * (3 * critic + critic_inner) + critic + critic_inner + by_action;
    2.0 * (products * rows) as f64
}

/// Chained multiply-adds that nothing but the arithmetic units limits.
struct Peak(usize);

/// Vectors that [`Peak`] adds to in turn.
const CHAINS: usize = 6;

impl Work for Peak {
    type Output = (f64, f32);

    #[inline(always)]
    unsafe fn run<L: Lanes>(self) -> (f64, f32) {
        // SAFETY: no memory is touched; the caller vouches for `L`.
        unsafe {
            let mut sums = [L::splat(0.5); CHAINS];
            let (a, b) = (L::splat(std::hint::black_box(0.999)), L::splat(std::hint::black_box(1e-3)));
            for _ in 0..self.0 {
                for sum in &mut sums {
                    *sum = sum.plus_product(a, b);
                }
            }
            let total = sums.into_iter().fold(L::splat(0.0), |total, sum| total.plus(sum)).sum();
            (2.0 * (self.0 * CHAINS * super::fused::LANES) as f64, total)
        }
    }
}

/// Does nothing but multiply-adds with `kernel`, `count` rounds of them; returns the floating-point operations done. Timed, they are
/// the processor's bound.
pub fn peak(kernel: Kernel, count: usize) -> f64 {
    let (operations, total) = kernel.run(Peak(count));
    std::hint::black_box(total);
    operations
}

#[cfg(test)]
mod tests {
    use super::super::fused::Fused;
    use super::super::plain::Plain;
    use super::*;

    #[test]
    fn operations_of_the_usual_sizes() {
        assert_eq!(operations(&NetworkShape::new(8, 2, &[64, 64]), 64), 2.0 * 64.0 * 46080.0);
    }

    #[test]
    fn implementations_do_the_same_work() {
        let shape = NetworkShape::new(3, 1, &[8, 8]);
        let rng = || Rng::new(1, Purpose::Initialisation);
        let mut fused = Workload::new(Box::new(Fused::new(&shape, &mut rng())), 16, 2);
        let mut plain = Workload::new(Box::new(Plain::new(&shape, &mut rng())), 16, 2);
        for _ in 0..20 {
            let (a, b) = (fused.update(), plain.update());
            assert!((a.critic / b.critic - 1.0).abs() < 1e-4 && (a.actor - b.actor).abs() < 1e-6, "{a:?} {b:?}");
        }
        assert!((fused.act() - plain.act()).abs() < 1e-5);
    }
}
