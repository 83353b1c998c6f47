//! Reward shaping by a potential on embedded states: the paper's and one that provably keeps the optimal policies.
//!
//! **\[D4\]** T_Φ is part of the embedded state, so that the shaped reward is a function of the state. With the printed Φ the sum of
//! γΦ(x') − Φ(x) does not telescope: x' is judged by T_Φ from before its visit, and Φ drops to 0 when q leaves T_Φ. The
//! invariance of [Ng, Harada & Russell 1999](crate::bib::Ng1999) therefore does not apply to [`Shaping::Paper`].
//! [`Shaping::Potential`] grows with the states visited in the round, is a function of x alone, and telescopes exactly, also
//! under state-dependent discounts.

use super::step::ProductStep;
use crate::automaton::{EmbeddedState, StateSet, StateTracking};
use serde::{Deserialize, Serialize};

/// A potential Φ. `weight` is η_Φ ≥ 0; potentials are multiples of η_Φ(1 − r_F), one first reward of an accepting set.
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[derive(Clone, Copy, PartialEq, Default, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum Shaping {
    /// Φ = 0.
    #[default]
    None,
    /// Φ(x) = η_Φ(1 − r_F) if q ∈ T_Φ, else 0 (equation 10 of [Cai et al. 2021](crate::bib::Cai2021)), both x and x' with T_Φ from
    /// before the update for x' (Algorithm 2, lines 10–12).
    Paper {
        /// η_Φ.
        weight: f64,
    },
    /// Φ(x) = η_Φ(1 − r_F)·|T_Φ0 \ T_Φ|: how many states of T_Φ0 the round has visited.
    Potential {
        /// η_Φ.
        weight: f64,
    },
}

impl Shaping {
    /// η_Φ; 0 for [`Shaping::None`].
    pub fn weight(self) -> f64 {
        match self {
            Shaping::None => 0.0,
            Shaping::Paper { weight } | Shaping::Potential { weight } => weight,
        }
    }

    /// Whether embedded states must carry T_Φ.
    pub fn tracking(self) -> StateTracking {
        if self == Shaping::None { StateTracking::Off } else { StateTracking::On }
    }

    /// Φ(x) and Φ(x') of a step, as multiples of η_Φ(1 − r_F); `initial` is T_Φ0.
    pub(super) fn units(self, step: &ProductStep, initial: StateSet) -> (f32, f32) {
        let first = |q| if step.from.unvisited.contains(q) { 1.0 } else { 0.0 };
        let visited = |at: EmbeddedState| (initial.len() - at.unvisited.len()) as f32;
        match self {
            Shaping::None => (0.0, 0.0),
            Shaping::Paper { .. } => (first(step.from.q), first(step.to.q)),
            Shaping::Potential { .. } => (visited(step.from), visited(step.to)),
        }
    }
}
