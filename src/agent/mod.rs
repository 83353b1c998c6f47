//! Learners: modular DDPG ([Cai et al. 2021](crate::bib::Cai2021), Algorithm 2), its replay and its exploration noise.
//!
//! [`ModularDdpg`] is modular DDPG, standard DDPG ([`ModuleMap::One`]) and, over a product without T
//! ([`FrontierRule::Standard`](crate::automaton::FrontierRule)), the paper's third contender. The defaults of [`LearnerSettings`] are
//! Algorithm 2; every option beyond it names its source.

mod bootstrap;
mod exploration;
mod learner;
mod look;
mod memory;
mod modular;
mod module;
mod module_map;
mod noise;
mod replay;
mod schedule;
mod settings;
mod trace;

pub use exploration::{ExplorationSettings, Hold};
pub use learner::{Learner, Policy, Situation, Transition, Update, View};
pub use memory::{LearnerMemory, Replays, embedded_from_text, embedded_to_text};
pub use modular::{Engine, ModularDdpg, Sizes};
pub use module_map::{Encoder, MAX_MODULES, Modules, ModulesError};
pub use noise::{Noise, NoiseSettings};
pub use replay::{Replay, Sample};
pub use schedule::{Line, Schedule};
pub use settings::{CounterfactualSettings, LearnerSettings, ModuleMap, TargetSmoothing, UpdatedModule};
pub use trace::Trace;
