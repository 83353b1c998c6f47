//! Environments: labelled Markov decision processes with continuous states and actions. They know no reward and no automaton.
//!
//! An environment is driven from outside: all randomness comes in through a seeded [`Rng`](crate::rng::Rng), there is no time
//! limit inside, and terminating ([`Outcome::Terminated`]) is a fact of the dynamics alone. Arithmetic is plain `f32` and
//! [`libm`], so that the same seed and the same actions give the same bits on every target ([`trace_hash`] is how that is tested).

mod ball_pass;
mod cart_pole;
mod environment;
mod islands;
pub mod map;
mod rover;
mod scene;
mod trace;

pub use ball_pass::BallPass;
pub use cart_pole::CartPole;
pub use environment::{Channel, EnvSpec, Environment, Outcome};
pub use islands::{Current, Islands};
pub use rover::Rover;
pub use scene::{Body, Ground, Region, Scene, Shape, YAxis};
pub use trace::{TraceHasher, trace_hash};
