//! How long, from where and under which time limit is trained, and how often is evaluated in between.

use crate::product::Start;
use serde::{Deserialize, Serialize};

/// In which embedded states (q, T, T_Φ) training episodes start.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum EmbeddedStart {
    /// In the initial one, after reading L(s_0).
    #[default]
    Initial,
    /// In any that can be reached, after reading L(s_0): later parts of a task are practised from the beginning.
    Random,
}

/// When training ends before its budget is spent.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Stop {
    /// Never.
    #[default]
    Budget,
    /// At the first periodic evaluation without a failure.
    Perfect,
}

/// Short episodes: more starts for the same steps, so that what only few starts meet, such as a nook between obstacles, is practised
/// often (exploring starts, [Sutton and Barto 2018](crate::bib::SuttonBarto2018), section 5.3). Off by default.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct ShortEpisodes {
    /// The share of episodes, from 0 to 1, that are short.
    pub share: f32,
    /// Their environment steps, in place of [`TrainingSettings::max_steps`].
    pub max_steps: u32,
}

impl Default for ShortEpisodes {
    fn default() -> ShortEpisodes {
        ShortEpisodes { share: 0.0, max_steps: 10 }
    }
}

/// The numbers of training. The defaults are those of no task in particular: a task file gives its own.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct TrainingSettings {
    /// The budget in environment steps.
    pub steps: u64,
    /// The budget in episodes; 0 for none. What is spent first ends training.
    pub episodes: u64,
    /// Environment steps in an episode; 0 for the evaluation's. Reaching them truncates, which is not the end of the task: values
    /// are bootstrapped through it.
    pub max_steps: u32,
    /// Short episodes among the others.
    pub short_episodes: ShortEpisodes,
    /// Where the environment starts.
    pub start: Start,
    /// Where the automaton starts.
    pub embedded_start: EmbeddedStart,
    /// What the environment's random disturbance is multiplied by while training, the rover's distances for instance: above 1, what is rare
    /// and ends an episode is met more often, and the policy keeps a margin (a plain kind of domain randomisation,
    /// [Tobin et al. 2017](crate::bib::Tobin2017)). Evaluations take place in the environment as it is.
    pub disturbance: f32,
    /// Environment steps between evaluations of the greedy policy; 0 for none.
    pub evaluate_every: u64,
    /// Episodes of such an evaluation.
    pub evaluation_runs: u32,
    /// Failures after which such an evaluation gives up.
    pub evaluation_failures: u32,
    /// When training ends early.
    pub stop: Stop,
}

impl Default for TrainingSettings {
    fn default() -> TrainingSettings {
        TrainingSettings {
            steps: 300_000,
            episodes: 0,
            max_steps: 0,
            short_episodes: ShortEpisodes::default(),
            start: Start::Initial,
            embedded_start: EmbeddedStart::Initial,
            disturbance: 1.0,
            evaluate_every: 2_000,
            evaluation_runs: 200,
            evaluation_failures: 4,
            stop: Stop::Budget,
        }
    }
}
