//! A recipe for learning a task: product and reward, learner, training.

use crate::agent::LearnerSettings;
use crate::automaton::FrontierRule;
use crate::product::{RewardSettings, Shaping};
use crate::train::TrainingSettings;
use serde::{Deserialize, Serialize};

/// A recipe. What is left out is Algorithm 2 of [Cai et al. 2021](crate::bib::Cai2021).
#[derive(Clone, PartialEq, Default, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct Preset {
    /// A sentence about it.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub description: String,
    /// The product, its reward and its shaping.
    pub product: ProductSection,
    /// The learner.
    pub learner: LearnerSettings,
    /// The training.
    pub training: TrainingSettings,
}

/// The product, its reward and its shaping.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct ProductSection {
    /// How the frontier T is updated; `standard` is the standard product MDP, without T.
    pub frontier: FrontierRule,
    /// r_F: the discount in accepting states, whose reward is 1 − r_F.
    pub accepting_discount: f64,
    /// γ_F: the discount in all other states.
    pub discount: f64,
    /// The reward for reaching a product sink.
    pub sink_reward: f64,
    /// Φ: `{ kind = "none" }`, or `{ kind = "paper", weight = 1.0 }`, or `{ kind = "potential", weight = 1.0 }`.
    pub shaping: Shaping,
}

impl Default for ProductSection {
    fn default() -> ProductSection {
        let RewardSettings { accepting_discount, discount, sink_reward, shaping } = RewardSettings::default();
        ProductSection { frontier: FrontierRule::Refill, accepting_discount, discount, sink_reward, shaping }
    }
}

impl ProductSection {
    /// The part that the reward takes.
    pub fn reward(&self) -> RewardSettings {
        RewardSettings {
            accepting_discount: self.accepting_discount,
            discount: self.discount,
            sink_reward: self.sink_reward,
            shaping: self.shaping,
        }
    }
}
