//! Asking a learner what it would do somewhere, without its choosing anything.

use super::learner::{Policy, Situation};
use super::modular::ModularDdpg;
use crate::automaton::EmbeddedState;

impl ModularDdpg {
    /// Q(x, π(x)) in units of unscaled rewards, with π(x) written into `control`; `None` in a sink. What was chosen last stays so.
    pub fn consider(&mut self, observation: &[f32], at: EmbeddedState, control: &mut [f32]) -> Option<f32> {
        let chosen = self.chosen;
        let value = self.value(observation, at);
        self.act(&Situation { observation, at, jumps: &[] }, control);
        self.chosen = chosen;
        value
    }
}
