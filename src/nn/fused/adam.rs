//! Adam and the soft update in one pass over a network's buffers.
#![allow(unsafe_code)]

use super::super::actor_critic::OptimiserSettings;
use super::lanes::{LANES, Lanes, Work};

/// The numbers of one step ([Kingma & Ba 2015](crate::bib::KingmaBa2015), algorithm 1, with the corrections of the bias moved
/// into the rate and the root's factor).
#[derive(Clone, Copy, Debug)]
pub struct Step {
    beta1: f32,
    beta2: f32,
    epsilon: f32,
    tau: f32,
    /// Rate / (1 − β₁ᵗ).
    rate: f32,
    /// 1 / √(1 − β₂ᵗ).
    root: f32,
}

impl Step {
    /// The `steps`-th step, counted from 1.
    pub fn new(steps: u32, rate: f32, settings: &OptimiserSettings) -> Step {
        let unbias = |beta: f32| 1.0 - libm::pow(f64::from(beta), f64::from(steps));
        let OptimiserSettings { beta1, beta2, epsilon, tau, .. } = *settings;
        Step {
            beta1,
            beta2,
            epsilon,
            tau,
            rate: (f64::from(rate) / unbias(beta1)) as f32,
            root: (1.0 / libm::sqrt(unbias(beta2))) as f32,
        }
    }
}

/// One step of Adam for a network; its target follows, if one is given.
pub struct Descend<'a> {
    /// The numbers of the step.
    pub step: Step,
    /// The derivative of the loss.
    pub gradient: &'a [f32],
    /// The parameters.
    pub parameters: &'a mut [f32],
    /// First moments.
    pub m: &'a mut [f32],
    /// Second moments.
    pub v: &'a mut [f32],
    /// The target's parameters, or nothing.
    pub target: &'a mut [f32],
}

impl Work for Descend<'_> {
    type Output = ();

    #[inline(always)]
    unsafe fn run<L: Lanes>(self) {
        let length = self.parameters.len();
        assert!(length.is_multiple_of(LANES) && self.gradient.len() >= length);
        assert!(self.m.len() == length && self.v.len() == length);
        assert!(self.target.is_empty() || self.target.len() == length);
        let [parameters, m, v] = [self.parameters, self.m, self.v].map(<[f32]>::as_mut_ptr);
        // SAFETY: all buffers are as long as the parameters, whole vectors each; the caller vouches for `L`.
        unsafe {
            let (beta1, rest1) = (L::splat(self.step.beta1), L::splat(1.0 - self.step.beta1));
            let (beta2, rest2) = (L::splat(self.step.beta2), L::splat(1.0 - self.step.beta2));
            let (epsilon, tau) = (L::splat(self.step.epsilon), L::splat(self.step.tau));
            let (rate, root) = (L::splat(self.step.rate), L::splat(self.step.root));
            for at in (0..length).step_by(LANES) {
                let g = L::load(self.gradient.as_ptr().add(at));
                let first = beta1.times(L::load(m.add(at))).plus_product(rest1, g);
                let second = beta2.times(L::load(v.add(at))).plus_product(rest2.times(g), g);
                let change = rate.times(first).over(epsilon.plus_product(second.root(), root));
                let parameter = L::load(parameters.add(at)).minus(change);
                first.store(m.add(at));
                second.store(v.add(at));
                parameter.store(parameters.add(at));
                if !self.target.is_empty() {
                    let target = self.target.as_mut_ptr().add(at);
                    let old = L::load(target);
                    old.plus_product(tau, parameter.minus(old)).store(target);
                }
            }
        }
    }
}
