//! What an environment is: a continuous labelled MDP (S, A, p_S, Π, L) that is driven from outside.

use super::scene::Scene;
use crate::labels::{Labels, Propositions};
use crate::rng::Rng;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// One number of a state or an action: its name, unit and range.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Channel {
    /// The quantity, in words: `x`, `pole angle`.
    pub name: Cow<'static, str>,
    /// The unit: `m`, `rad`, `m/s`; empty for a pure number.
    pub unit: Cow<'static, str>,
    /// The least value it takes.
    pub low: f32,
    /// The greatest value it takes.
    pub high: f32,
}

impl Channel {
    /// A channel that takes values in `[low, high]`.
    pub fn new(name: impl Into<Cow<'static, str>>, unit: impl Into<Cow<'static, str>>, low: f32, high: f32) -> Channel {
        Channel { name: name.into(), unit: unit.into(), low, high }
    }

    /// `value` brought into the range; NaN becomes the middle of it.
    pub fn clamp(&self, value: f32) -> f32 {
        if value.is_nan() { 0.5 * (self.low + self.high) } else { value.clamp(self.low, self.high) }
    }
}

/// The fixed facts of an environment.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct EnvSpec {
    /// The name by which task files choose it: `ball_pass`.
    pub name: &'static str,
    /// The physical state, as [`Environment::state`] gives it.
    pub state: Vec<Channel>,
    /// The action; every channel is scaled to `[-1, 1]` for the learner, its range here is in physical units.
    pub action: Vec<Channel>,
    /// How many numbers [`Environment::observe`] writes, each of order 1.
    pub observation: usize,
    /// The atomic propositions of the labelling function; letter bits follow this order.
    pub propositions: Propositions,
    /// A sentence for each proposition: when it holds.
    pub meanings: Vec<String>,
    /// The letters L(s) that some state s has, each once. Groups of propositions that exclude one another, and propositions that hold nowhere,
    /// follow from them.
    pub letters: Vec<Labels>,
    /// Seconds of simulated time per step; 0 where time has no unit.
    pub dt: f32,
}

impl EnvSpec {
    /// Groups of at least two propositions of which at most one holds at a time, such as regions that do not overlap. Each proposition is in one
    /// group at most: in order, it joins the first group whose members never hold together with it.
    pub fn disjoint(&self) -> Vec<Vec<usize>> {
        let together = |i: usize, j: usize| self.letters.iter().any(|letter| letter.holds(i) && letter.holds(j));
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for i in 0..self.propositions.len() {
            match groups.iter_mut().find(|group| group.iter().all(|j| !together(i, *j))) {
                Some(group) => group.push(i),
                None => groups.push(vec![i]),
            }
        }
        groups.retain(|group| group.len() > 1);
        groups
    }

    /// Whether proposition `index` holds in some state.
    pub fn can_hold(&self, index: usize) -> bool {
        self.letters.iter().any(|letter| letter.holds(index))
    }
}

/// How a step ended.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
pub enum Outcome {
    /// The state is a regular one.
    Running,
    /// The environment ended by itself: the state reached has no successor. A time limit is never this.
    Terminated,
}

/// A continuous labelled MDP. All randomness comes in from outside; the same seed gives the same path on every target.
pub trait Environment: Send {
    /// The fixed facts.
    fn spec(&self) -> &EnvSpec;
    /// What a view draws: the regions behind the labels and the body that moves. Fixed for the environment's life.
    fn scene(&self) -> Scene;
    /// Draws an initial state from the environment's own distribution, the paper's.
    fn reset(&mut self, rng: &mut Rng);
    /// Draws an initial state spread over all safe ground (uniform starts); by default a plain [`Environment::reset`].
    fn reset_anywhere(&mut self, rng: &mut Rng) {
        self.reset(rng);
    }
    /// Scales the random disturbance of later steps: 1 is the environment's own. Returns false, and changes nothing, where nothing
    /// random disturbs a step.
    fn scale_disturbance(&mut self, _factor: f32) -> bool {
        false
    }
    /// Applies `action`, one number in `[-1, 1]` per channel of [`EnvSpec::action`] (values outside are clamped; NaN counts as 0).
    fn step(&mut self, action: &[f32], rng: &mut Rng) -> Outcome;
    /// The state in physical units, one number per channel of [`EnvSpec::state`]: all that a view or a checkpoint needs.
    fn state(&self) -> &[f32];
    /// Puts the environment into a state that [`Environment::state`] gave, or that a user chose; values are clamped to their range
    /// and NaN becomes the middle of it.
    ///
    /// # Panics
    /// If `state` has another length than [`EnvSpec::state`].
    fn set_state(&mut self, state: &[f32]);
    /// Writes the learner's scaled view of the state into `observation` ([`EnvSpec::observation`] numbers of order 1).
    fn observe(&self, observation: &mut [f32]);
    /// L(s) of the present state.
    fn labels(&self) -> Labels;
    /// A boxed copy in the same state.
    fn boxed_clone(&self) -> Box<dyn Environment>;
}

/// One number of an action as every environment takes it: clamped to `[-1, 1]`, and 0 for NaN.
pub(super) fn command(value: f32) -> f32 {
    if value.is_nan() { 0.0 } else { value.clamp(-1.0, 1.0) }
}
