//! How controls are explored: uniform ones at first, noise on the actor's, and now and then one random control that is held.

use super::noise::NoiseSettings;
use super::schedule::Schedule;
use crate::rng::Rng;
use serde::{Deserialize, Serialize};

/// How a learner explores.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct ExplorationSettings {
    /// Environment steps with uniformly random controls, and without updates, before learning starts.
    pub warm_up: u64,
    /// Noise on the actor's control.
    pub noise: NoiseSettings,
    /// The probability per step of drawing a uniform control and holding it for a while, so that places are reached that noise
    /// around the policy does not lead to (temporally extended exploration, [Dabney et al. 2021](crate::bib::Dabney2021)).
    pub hold_probability: Schedule,
    /// The longest hold, in steps; lengths are uniform from 1.
    pub hold_steps: u32,
    /// The probability of choosing uniformly among the ε-moves and going on, where there are ε-moves.
    pub jump_probability: f32,
}

impl Default for ExplorationSettings {
    /// Ornstein–Uhlenbeck noise alone, as Algorithm 2 has it; ε-moves, about which it is silent, are explored with 0.1.
    fn default() -> ExplorationSettings {
        ExplorationSettings {
            warm_up: 0,
            noise: NoiseSettings::default(),
            hold_probability: Schedule::Constant(0.0),
            hold_steps: 20,
            jump_probability: 0.1,
        }
    }
}

/// A random control that is being held.
#[derive(Clone, PartialEq, Debug)]
pub struct Hold {
    control: Vec<f32>,
    left: u32,
}

impl Hold {
    /// Nothing held, for controls of `channels` numbers.
    pub fn new(channels: usize) -> Hold {
        Hold { control: vec![0.0; channels], left: 0 }
    }

    /// Lets go.
    pub fn reset(&mut self) {
        self.left = 0;
    }

    /// A hold of `control` for `left` more steps.
    pub fn restored(control: Vec<f32>, left: u32) -> Hold {
        Hold { control, left }
    }

    /// The control that is or was held last.
    pub fn control(&self) -> &[f32] {
        &self.control
    }

    /// For how many more steps it is held.
    pub fn left(&self) -> u32 {
        self.left
    }

    /// Goes on holding, or begins to with the settings' probability; writes the held control and returns true while holding.
    pub fn take(&mut self, settings: &ExplorationSettings, step: u64, control: &mut [f32], rng: &mut Rng) -> bool {
        if self.left == 0 {
            let probability = settings.hold_probability.at(step);
            if probability <= 0.0 || settings.hold_steps == 0 || !rng.chance(probability) {
                return false;
            }
            self.left = 1 + rng.below(settings.hold_steps as usize) as u32;
            self.control.fill_with(|| rng.uniform_in(-1.0, 1.0));
        }
        self.left -= 1;
        control.copy_from_slice(&self.control);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Purpose;

    /// With probability p of beginning and a mean length m, the share of held steps is p·m / (p·m + 1 − p).
    #[test]
    fn the_share_of_held_steps_is_what_theory_gives() {
        let settings =
            ExplorationSettings { hold_probability: Schedule::Constant(0.02), hold_steps: 20, ..ExplorationSettings::default() };
        let mut rng = Rng::new(5, Purpose::Tool);
        let mut hold = Hold::new(2);
        let n = 200_000;
        let held = (0..n).filter(|&step| hold.take(&settings, step, &mut [0.0, 0.0], &mut rng)).count();
        let expected = 0.02 * 10.5 / (0.02 * 10.5 + 0.98);
        assert!((held as f64 / n as f64 / expected - 1.0).abs() < 0.05);
    }

    #[test]
    fn a_held_control_stays_the_same_until_let_go() {
        let settings =
            ExplorationSettings { hold_probability: Schedule::Constant(1.0), hold_steps: 1000, ..ExplorationSettings::default() };
        let mut rng = Rng::new(5, Purpose::Tool);
        let mut hold = Hold::new(1);
        let mut take = |hold: &mut Hold| {
            let mut control = [0.0];
            assert!(hold.take(&settings, 0, &mut control, &mut rng));
            control[0]
        };
        let first = take(&mut hold);
        assert_eq!(first, take(&mut hold));
        hold.reset();
        assert_ne!(first, take(&mut hold));
    }
}
