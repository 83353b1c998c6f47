//! Adam and the soft update, plain.

use super::super::actor_critic::OptimiserSettings;
use super::network::{Network, Tensors};

/// Adam's memory of one network ([Kingma & Ba 2015](crate::bib::KingmaBa2015), algorithm 1).
#[derive(Clone, Debug)]
pub struct Adam {
    /// First moments.
    pub m: Tensors,
    /// Second moments.
    pub v: Tensors,
    /// t, the steps taken.
    pub steps: u32,
}

impl Adam {
    /// No steps taken yet.
    pub fn new(network: &Network) -> Adam {
        let zeros: Tensors = network.tensors.iter().map(|tensor| vec![0.0; tensor.len()]).collect();
        Adam { m: zeros.clone(), v: zeros, steps: 0 }
    }

    /// One step of `network` against `gradient`.
    pub fn step(&mut self, network: &mut Network, gradient: &[Vec<f64>], rate: f32, settings: &OptimiserSettings) {
        self.steps = self.steps.saturating_add(1);
        let [rate, beta1, beta2, epsilon] = [rate, settings.beta1, settings.beta2, settings.epsilon].map(f64::from);
        let [unbias1, unbias2] = [beta1, beta2].map(|beta| 1.0 - libm::pow(beta, f64::from(self.steps)));
        for (tensor, parameters) in network.tensors.iter_mut().enumerate() {
            for (i, parameter) in parameters.iter_mut().enumerate() {
                let g = gradient[tensor][i];
                let m = beta1 * f64::from(self.m[tensor][i]) + (1.0 - beta1) * g;
                let v = beta2 * f64::from(self.v[tensor][i]) + (1.0 - beta2) * g * g;
                let step = rate * (m / unbias1) / (libm::sqrt(v / unbias2) + epsilon);
                *parameter = (f64::from(*parameter) - step) as f32;
                self.m[tensor][i] = m as f32;
                self.v[tensor][i] = v as f32;
            }
        }
    }
}

/// θ' ← τθ + (1−τ)θ' ([Lillicrap et al. 2016](crate::bib::Lillicrap2016), algorithm 1).
pub fn soft_update(target: &mut Network, network: &Network, tau: f32) {
    let tau = f64::from(tau);
    for (target, own) in target.tensors.iter_mut().flatten().zip(network.tensors.iter().flatten()) {
        *target = (tau * f64::from(*own) + (1.0 - tau) * f64::from(*target)) as f32;
    }
}
