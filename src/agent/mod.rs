//! Learners: modular DDPG ([Cai et al. 2021](crate::bib::Cai2021), Algorithm 2), its replay and its exploration noise.

mod noise;
mod schedule;

pub use noise::{Noise, NoiseSettings};
pub use schedule::{Line, Schedule};
