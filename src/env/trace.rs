//! A fingerprint of a path, by which native and browser builds are shown to walk bit for bit the same way.

use super::environment::{Environment, Outcome};
use crate::rng::{Purpose, Rng};

/// Folds numbers into 64 bits (FNV-1a over little-endian bytes): equal sequences give equal hashes on every target.
#[derive(Clone, Debug)]
pub struct TraceHasher(u64);

impl TraceHasher {
    /// The hash of nothing.
    pub fn new() -> TraceHasher {
        TraceHasher(0xcbf2_9ce4_8422_2325)
    }

    /// Takes in 64 bits.
    pub fn word(&mut self, word: u64) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    /// Takes in the bits of each number.
    pub fn numbers(&mut self, numbers: &[f32]) {
        for number in numbers {
            self.word(u64::from(number.to_bits()));
        }
    }

    /// The hash of everything taken in so far.
    pub fn finish(&self) -> u64 {
        self.0
    }
}

impl Default for TraceHasher {
    fn default() -> Self {
        TraceHasher::new()
    }
}

/// The fingerprint of `steps` steps under uniform random actions: states, observations, letters and ends, starting over
/// (alternately from [`Environment::reset`] and [`Environment::reset_anywhere`]) whenever the environment terminates and every
/// 100 steps.
pub fn trace_hash(environment: &mut dyn Environment, seed: u64, steps: u32) -> u64 {
    let mut world = Rng::new(seed, Purpose::Environment);
    let mut policy = Rng::new(seed, Purpose::Tool);
    let mut action = vec![0.0; environment.spec().action.len()];
    let mut observation = vec![0.0; environment.spec().observation];
    let mut hasher = TraceHasher::new();
    environment.reset(&mut world);
    for step in 1..=steps {
        action.fill_with(|| policy.uniform_in(-1.0, 1.0));
        let outcome = environment.step(&action, &mut world);
        environment.observe(&mut observation);
        hasher.numbers(environment.state());
        hasher.numbers(&observation);
        hasher.word(environment.labels().0);
        hasher.word(u64::from(outcome == Outcome::Terminated));
        if outcome == Outcome::Terminated || step % 100 == 0 {
            if step % 2 == 0 {
                environment.reset(&mut world);
            } else {
                environment.reset_anywhere(&mut world);
            }
        }
    }
    hasher.finish()
}
