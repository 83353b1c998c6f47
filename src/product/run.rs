//! Algorithm 1 of [Cai et al. 2021](crate::bib::Cai2021): a run of the embedded product MDP, generated step by step.

use super::ep_mdp::{EpMdp, ProductStart, Start};
use super::step::{Move, ProductStep};
use crate::automaton::StateId;
use crate::env::TraceHasher;
use crate::rng::{Purpose, Rng};

/// One product state x_i of a run, i ≥ 1, and the step that led to it.
#[derive(Clone, PartialEq, Debug)]
pub struct RunState {
    /// s_i, physical units.
    pub state: Vec<f32>,
    /// The step x_{i−1} → x_i; x_i is accepting where `step.fresh` is not empty.
    pub step: ProductStep,
}

/// Why a run has the length it has.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum RunEnd {
    /// It has the length that was asked for.
    Length,
    /// It reached Q_sink: no continuation satisfies the task. (The print, whose automata leave the sink out, finds no successor.)
    Sink,
    /// The environment terminated.
    Terminated,
}

/// A run x_0 x_1 … of the product.
#[derive(Clone, PartialEq, Debug)]
pub struct Run {
    /// s_0, physical units.
    pub initial: Vec<f32>,
    /// The embedded part of x_0.
    pub start: ProductStart,
    /// x_1 … x_n.
    pub states: Vec<RunState>,
    /// Why it is not longer.
    pub end: RunEnd,
    /// Completed rounds, the visit at time 0 included.
    pub rounds: u32,
}

/// What a policy of [`run_with`] chooses: an ε-move, or the control it has written.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Chosen {
    /// The control.
    Control,
    /// The ε-move to a state of [`EpMdp::epsilon_moves`].
    Epsilon(StateId),
}

/// Algorithm 1: a run of at most `length` steps under a uniformly random policy. Where there are ε-moves, each of them and "a
/// control" are equally likely; controls are uniform in `[-1, 1]`. The same seed gives the same run.
pub fn run(product: &mut EpMdp, start: Start, length: usize, seed: u64) -> Run {
    let mut draws = Rng::new(seed, Purpose::Tool);
    run_with(product, start, length, seed, |product, control| {
        let moves = product.epsilon_moves();
        let pick = if moves.is_empty() { 0 } else { draws.below(moves.len() + 1) };
        if pick > 0 {
            return Chosen::Epsilon(moves[pick - 1]);
        }
        control.fill_with(|| draws.uniform_in(-1.0, 1.0));
        Chosen::Control
    })
}

/// A run of at most `length` steps under any policy. The policy sees where the product stands, and writes a control (one number
/// in `[-1, 1]` per action channel, given as zeros) or chooses an ε-move. `seed` is for the environment.
///
/// # Panics
/// If the policy chooses an ε-move that does not exist.
pub fn run_with(
    product: &mut EpMdp,
    start: Start,
    length: usize,
    seed: u64,
    mut policy: impl FnMut(&EpMdp, &mut [f32]) -> Chosen,
) -> Run {
    let mut world = Rng::new(seed, Purpose::Environment);
    let start = product.reset(start, &mut world);
    let initial = product.environment().state().to_vec();
    let mut control = vec![0.0; product.environment().spec().action.len()];
    let mut states: Vec<RunState> = vec![];
    while states.len() < length && !product.ended() {
        control.fill(0.0);
        let step = match policy(product, &mut control) {
            Chosen::Control => product.step(Move::Control(&control), &mut world),
            Chosen::Epsilon(target) => product.step(Move::Epsilon(target), &mut world),
        };
        states.push(RunState { state: product.environment().state().to_vec(), step });
    }
    let sink = states.last().map_or(start.sink, |last| last.step.sink);
    let end = match (product.ended(), sink) {
        (false, _) => RunEnd::Length,
        (true, true) => RunEnd::Sink,
        (true, false) => RunEnd::Terminated,
    };
    Run { initial, start, states, end, rounds: product.rounds().completed() }
}

/// The fingerprint of a random run: states, letters, embedded states, accepting sets. Equal on every target for equal seeds.
pub fn product_trace_hash(run: &Run) -> u64 {
    let mut hasher = TraceHasher::new();
    hasher.numbers(&run.initial);
    for RunState { state, step } in &run.states {
        hasher.numbers(state);
        hasher.word(step.labels.0);
        hasher.word(u64::from(step.to.q));
        hasher.word(u64::from(step.to.frontier.0));
        hasher.word(u64::from(step.fresh.0));
    }
    hasher.finish()
}
