//! Seeded random numbers: one named generator, one stream per purpose, its state part of every checkpoint.

use rand::{Rng as _, RngExt as _, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

/// What a stream of random numbers is for. Streams of one seed are independent, so that drawing more numbers for one purpose
/// never changes another.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Purpose {
    /// The environment's resets and transitions while training.
    Environment,
    /// The initial parameters of the networks.
    Initialisation,
    /// Exploration noise.
    Noise,
    /// Which samples of the replay a batch takes, and counterfactual starts.
    Replay,
    /// The environment while evaluating.
    Evaluation,
    /// Everything a test or a tool draws for itself.
    Tool,
}

/// A seeded generator (ChaCha with 8 rounds): the same numbers on every target.
#[derive(Clone, PartialEq, Debug)]
pub struct Rng(ChaCha8Rng);

/// Everything needed to go on with a generator where it stood.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct RngState {
    seed: [u8; 32],
    stream: u64,
    /// Position in 32-bit words, as decimal text: 68 bits do not fit the number types of JSON and TOML.
    word: String,
}

impl Rng {
    /// The stream of `seed` for one purpose.
    pub fn new(seed: u64, purpose: Purpose) -> Rng {
        let mut inner = ChaCha8Rng::seed_from_u64(seed);
        inner.set_stream(purpose as u64);
        Rng(inner)
    }

    /// A uniform number in `[0, 1)`.
    pub fn uniform(&mut self) -> f32 {
        self.0.random::<f32>()
    }

    /// A uniform number in `[low, high)`; `low` when the interval is empty.
    pub fn uniform_in(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.uniform()
    }

    /// A uniform index below `bound`.
    ///
    /// # Panics
    /// If `bound` is 0.
    pub fn below(&mut self, bound: usize) -> usize {
        assert!(bound > 0, "an index below 0 does not exist");
        // 32 bits on every target, so that native and wasm draw the same numbers.
        self.0.random_range(0..u32::try_from(bound).expect("fewer than 2^32 choices")) as usize
    }

    /// A standard normal number (mean 0, variance 1).
    pub fn normal(&mut self) -> f32 {
        self.0.sample(rand_distr::StandardNormal)
    }

    /// Whether an event of probability `p` happens.
    pub fn chance(&mut self, p: f32) -> bool {
        self.uniform() < p
    }

    /// 64 uniform bits.
    pub fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// Where the generator stands.
    pub fn state(&self) -> RngState {
        RngState { seed: self.0.get_seed(), stream: self.0.get_stream(), word: self.0.get_word_pos().to_string() }
    }

    /// The generator that stands at `state`; `None` if the state is no generator's.
    pub fn restore(state: &RngState) -> Option<Rng> {
        let mut inner = ChaCha8Rng::from_seed(state.seed);
        inner.set_stream(state.stream);
        let word: u128 = state.word.parse().ok()?;
        if word >= 1 << 68 {
            return None;
        }
        inner.set_word_pos(word);
        Some(Rng(inner))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_restored_generator_goes_on_with_the_same_numbers() {
        let mut rng = Rng::new(7, Purpose::Noise);
        for _ in 0..5 {
            rng.normal();
        }
        let mut again = Rng::restore(&rng.state()).unwrap();
        for _ in 0..100 {
            assert_eq!(rng.bits(), again.bits());
        }
    }

    #[test]
    fn streams_differ_and_are_fixed() {
        let mut a = Rng::new(1, Purpose::Environment);
        let mut b = Rng::new(1, Purpose::Noise);
        assert_ne!(a.bits(), b.bits());
    }
}
