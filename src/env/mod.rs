//! Environments: labelled Markov decision processes with continuous states and actions. They know no reward and no automaton.

mod environment;

pub use environment::{Channel, EnvSpec, Environment, Outcome};
