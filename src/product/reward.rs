//! Reward and discount of a product step: pure functions of the transition.
//!
//! **\[D3\]** R (equation 2) and γ (equation 3 of [Cai et al. 2021](crate::bib::Cai2021)) belong to the state reached, as the sample
//! that Algorithm 2 stores has it: R' = R(x') + γ(x')·Φ(x') − Φ(x), and the target is y = R' + γ(x')·Q'(x', π'(x')).

use super::shaping::Shaping;
use super::step::ProductStep;
use crate::automaton::{Embedding, StateSet, StateTracking};
use serde::{Deserialize, Serialize};

/// What a step pays: the reward, and the discount of everything after it. Discount 0 ends; there is no other flag.
#[derive(Clone, Copy, PartialEq, Default, Debug, Serialize, Deserialize)]
pub struct Payoff {
    /// R'(x, u, x').
    pub reward: f32,
    /// γ(x') in `[0, 1]`; 0 in a product sink.
    pub discount: f32,
}

/// The parts of a payoff: the answer to "why this reward?".
#[derive(Clone, Copy, PartialEq, Default, Debug, Serialize)]
pub struct RewardParts {
    /// R(x') of equation 2.
    pub base: f32,
    /// The sink reward, 0 unless x' is a product sink.
    pub sink: f32,
    /// γ(x') of equation 3; 0 in a product sink.
    pub discount: f32,
    /// Φ(x).
    pub potential_before: f32,
    /// Φ(x').
    pub potential_after: f32,
}

impl RewardParts {
    /// R' = R(x') + sink reward + γ(x')·Φ(x') − Φ(x), and γ(x').
    pub fn payoff(self) -> Payoff {
        let shaping = self.discount * self.potential_after - self.potential_before;
        Payoff { reward: self.base + self.sink + shaping, discount: self.discount }
    }
}

/// A way to pay for product steps. Implementations are pure: what they must remember belongs into the embedded state.
pub trait Reward: Send + Sync {
    /// What the step pays, in parts.
    fn parts(&self, step: &ProductStep) -> RewardParts;

    /// What the step pays.
    fn payoff(&self, step: &ProductStep) -> Payoff {
        self.parts(step).payoff()
    }
}

/// The numbers of an [`LdgbaReward`].
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct RewardSettings {
    /// r_F in (0, 1): the discount in an accepting state, whose reward is 1 − r_F.
    pub accepting_discount: f64,
    /// γ_F in (0, 1]: the discount in every other state.
    pub discount: f64,
    /// The reward for reaching a product sink; the paper has 0.
    pub sink_reward: f64,
    /// Φ.
    pub shaping: Shaping,
}

impl Default for RewardSettings {
    /// Algorithm 2, line 1: r_F = 0.99, γ_F = 0.9999; no sink reward, and Φ of equation 10 with η_Φ = 1.
    fn default() -> Self {
        RewardSettings { accepting_discount: 0.99, discount: 0.9999, sink_reward: 0.0, shaping: Shaping::Paper { weight: 1.0 } }
    }
}

/// The paper's reward: 1 − r_F in x' ∈ F_U^P, discounts r_F there and γ_F elsewhere (equations 2 and 3), shaped by Φ (equation 8).
///
/// F_U^P is the union of the F_j^P. In a product sink the discount is 0 and the optional sink reward is added; Φ(x') is then
/// discounted away with the rest. An ε-move is a transition like any other and is discounted by γ(x').
#[derive(Clone, Debug)]
pub struct LdgbaReward {
    settings: RewardSettings,
    /// 1 − r_F, rounded once.
    accepting: f32,
    /// η_Φ(1 − r_F), rounded once.
    potential: f32,
    /// T_Φ0.
    initial: StateSet,
}

/// Why numbers make no reward.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RewardError {
    /// A number outside its range.
    #[error("{name} = {value} is outside {range}")]
    OutOfRange {
        /// Which number.
        name: &'static str,
        /// What it was.
        value: f64,
        /// What is allowed.
        range: &'static str,
    },
    /// Shaping over embedded states that do not carry T_Φ.
    #[error("reward shaping needs embedded states that keep track of visited automaton states")]
    Untracked,
}

impl LdgbaReward {
    /// Checks the numbers; `embedding` is the memory whose steps will be paid.
    ///
    /// # Errors
    /// A number outside its range, or shaping where `embedding` does not keep T_Φ.
    pub fn new(settings: RewardSettings, embedding: &Embedding) -> Result<LdgbaReward, RewardError> {
        let RewardSettings { accepting_discount, discount, sink_reward, shaping } = settings;
        let check = |name, value: f64, range, ok: bool| {
            if ok { Ok(()) } else { Err(RewardError::OutOfRange { name, value, range }) }
        };
        check("accepting_discount", accepting_discount, "(0, 1)", accepting_discount > 0.0 && accepting_discount < 1.0)?;
        check("discount", discount, "(0, 1]", discount > 0.0 && discount <= 1.0)?;
        check("sink_reward", sink_reward, "the finite numbers", sink_reward.is_finite())?;
        let weight = shaping.weight();
        check("shaping weight", weight, "the finite numbers ≥ 0", weight.is_finite() && weight >= 0.0)?;
        if shaping.tracking() == StateTracking::On && embedding.tracking() == StateTracking::Off {
            return Err(RewardError::Untracked);
        }
        let accepting = 1.0 - accepting_discount;
        Ok(LdgbaReward {
            settings,
            accepting: accepting as f32,
            potential: (weight * accepting) as f32,
            initial: embedding.start().unvisited,
        })
    }

    /// The numbers.
    pub fn settings(&self) -> &RewardSettings {
        &self.settings
    }
}

impl Reward for LdgbaReward {
    fn parts(&self, step: &ProductStep) -> RewardParts {
        let accepting = step.fresh.0 != 0;
        let discount = match (step.ends(), accepting) {
            (true, _) => 0.0,
            (false, true) => self.settings.accepting_discount as f32,
            (false, false) => self.settings.discount as f32,
        };
        let (before, after) = self.settings.shaping.units(step, self.initial);
        RewardParts {
            base: if accepting { self.accepting } else { 0.0 },
            sink: if step.ends() { self.settings.sink_reward as f32 } else { 0.0 },
            discount,
            potential_before: self.potential * before,
            potential_after: self.potential * after,
        }
    }
}
