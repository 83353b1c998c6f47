//! Asking a learner what it would do somewhere, without its choosing anything.

use super::modular::ModularDdpg;
use crate::automaton::EmbeddedState;

impl ModularDdpg {
    /// Q(x, π(x)) of the module in charge, in units of unscaled rewards; `None` in a sink.
    pub fn value(&mut self, observation: &[f32], at: EmbeddedState) -> Option<f32> {
        self.best(observation, at).map(|(_, value)| value)
    }

    /// The module in charge of x = (`observation`, `at`): of several that compete, the one whose Q(x, π(x)) is greatest, and of equal
    /// ones the first. `None` in a sink.
    pub fn in_charge(&mut self, observation: &[f32], at: EmbeddedState) -> Option<usize> {
        self.index.of(at).or_else(|| self.best(observation, at).map(|(module, _)| module))
    }

    /// Q(x, π(x)) in units of unscaled rewards, with π(x) written into `control`; `None` and zeros in a sink. What was chosen last stays so.
    pub fn consider(&mut self, observation: &[f32], at: EmbeddedState, control: &mut [f32]) -> Option<f32> {
        control.fill(0.0);
        let (module, value) = self.best(observation, at)?;
        self.control_of(module, observation, at, control);
        Some(value)
    }

    /// The module in charge, and what it promises in units of unscaled rewards.
    fn best(&mut self, observation: &[f32], at: EmbeddedState) -> Option<(usize, f32)> {
        let mut best: Option<(usize, f32)> = None;
        for (module, at) in self.index.candidates(at) {
            self.input.clear();
            self.encoder.push(observation, at, &mut self.input);
            let mut value = [0.0];
            self.modules[module].networks.values(&self.input, &mut value);
            if best.is_none_or(|(_, most)| value[0] > most) {
                best = Some((module, value[0]));
            }
        }
        best.map(|(module, value)| (module, value / self.settings.reward_scale))
    }

    /// π(x) of `module` into `control`.
    pub(super) fn control_of(&mut self, module: usize, observation: &[f32], at: EmbeddedState, control: &mut [f32]) {
        self.input.clear();
        self.encoder.push(observation, at, &mut self.input);
        self.modules[module].networks.act(&self.input, control);
    }
}
