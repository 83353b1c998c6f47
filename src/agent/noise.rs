//! Exploration noise on the actor's actions: Ornstein–Uhlenbeck or Gaussian, one process per module.

use super::schedule::Schedule;
use crate::rng::Rng;
use serde::{Deserialize, Serialize};

/// Which noise is added to π(x) while training. Actions are in units of the action range, `[-1, 1]`.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum NoiseSettings {
    /// The Ornstein–Uhlenbeck process n ← n − θ·n + σ·𝒩(0, 1) of [Lillicrap et al. 2016](crate::bib::Lillicrap2016), section 7
    /// (there θ = 0.15, σ = 0.2), started at 0 in every episode.
    OrnsteinUhlenbeck {
        /// θ, the pull towards 0 per step, in `(0, 1]`.
        theta: f32,
        /// σ, the deviation added per step.
        sigma: Schedule,
    },
    /// Independent normal noise of deviation σ.
    Gaussian {
        /// σ.
        sigma: Schedule,
    },
    /// No noise.
    None,
}

impl Default for NoiseSettings {
    fn default() -> NoiseSettings {
        NoiseSettings::OrnsteinUhlenbeck { theta: 0.15, sigma: Schedule::Constant(0.2) }
    }
}

/// One module's noise process.
#[derive(Clone, PartialEq, Debug)]
pub struct Noise {
    settings: NoiseSettings,
    /// The Ornstein–Uhlenbeck process's value, one number per action channel.
    value: Vec<f32>,
}

impl Noise {
    /// A process at 0 for actions of `channels` numbers.
    pub fn new(settings: NoiseSettings, channels: usize) -> Noise {
        Noise { settings, value: vec![0.0; channels] }
    }

    /// Puts the process back to 0.
    pub fn reset(&mut self) {
        self.value.fill(0.0);
    }

    /// Adds the next noise to `control` and clamps it to `[-1, 1]`; `step` counts environment steps, for the schedules.
    pub fn disturb(&mut self, control: &mut [f32], step: u64, rng: &mut Rng) {
        match self.settings {
            NoiseSettings::OrnsteinUhlenbeck { theta, sigma } => {
                let sigma = sigma.at(step);
                for (u, n) in control.iter_mut().zip(&mut self.value) {
                    *n += sigma * rng.normal() - theta * *n;
                    *u = (*u + *n).clamp(-1.0, 1.0);
                }
            }
            NoiseSettings::Gaussian { sigma } => {
                let sigma = sigma.at(step);
                for u in control {
                    *u = (*u + sigma * rng.normal()).clamp(-1.0, 1.0);
                }
            }
            NoiseSettings::None => {}
        }
    }

    /// The process's value, for a checkpoint.
    pub fn value(&self) -> &[f32] {
        &self.value
    }

    /// Puts the process to a value that [`Noise::value`] gave; `false` if the number of channels differs.
    #[must_use]
    pub fn restore(&mut self, value: &[f32]) -> bool {
        let fits = value.len() == self.value.len();
        if fits {
            self.value.copy_from_slice(value);
        }
        fits
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Purpose;

    /// The stationary deviation of the process is σ / √(1 − (1−θ)²): for the defaults 0.2 / √(1 − 0.85²) ≈ 0.3797; the
    /// correlation of neighbours is 1−θ.
    #[test]
    fn ornstein_uhlenbeck_has_its_stationary_deviation_and_correlation() {
        let mut rng = Rng::new(3, Purpose::Tool);
        let mut noise = Noise::new(NoiseSettings::OrnsteinUhlenbeck { theta: 0.15, sigma: Schedule::Constant(0.02) }, 1);
        let n = 200_000;
        let (mut square, mut product, mut before) = (0.0f64, 0.0f64, 0.0f64);
        for _ in 0..n {
            let mut u = [0.0];
            noise.disturb(&mut u, 0, &mut rng);
            square += f64::from(u[0]).powi(2);
            product += before * f64::from(u[0]);
            before = f64::from(u[0]);
        }
        let expected = 0.02 / (1.0f64 - 0.85 * 0.85).sqrt();
        assert!(((square / f64::from(n)).sqrt() / expected - 1.0).abs() < 0.03);
        assert!((product / square - 0.85).abs() < 0.01);
    }

    #[test]
    fn actions_stay_in_range_and_a_reset_forgets() {
        let mut rng = Rng::new(4, Purpose::Tool);
        let mut noise = Noise::new(NoiseSettings::Gaussian { sigma: Schedule::Constant(3.0) }, 2);
        for _ in 0..100 {
            let mut u = [0.9, -0.9];
            noise.disturb(&mut u, 0, &mut rng);
            assert!(u.iter().all(|u| (-1.0..=1.0).contains(u)));
        }
        let mut process = Noise::new(NoiseSettings::default(), 2);
        process.disturb(&mut [0.0, 0.0], 0, &mut rng);
        assert_ne!(process.value(), [0.0, 0.0]);
        process.reset();
        assert_eq!(process.value(), [0.0, 0.0]);
    }
}
