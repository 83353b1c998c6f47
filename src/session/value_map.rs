//! What a critic thinks of a plane of states: V(x) = Q(x, π(x)) on a grid, with the control that π chooses there.

use super::refusal::{Refusal, Subject};
use crate::agent::ModularDdpg;
use crate::automaton::{EmbeddedState, Marks, StateId};
use crate::env::{Body, Channel, Environment};
use crate::product::EpMdp;
use serde::{Deserialize, Serialize};

/// The most points of a grid.
const MAX_POINTS: usize = 40_000;

/// Which values are asked for.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ValueMapRequest {
    /// The automaton state q.
    pub q: StateId,
    /// The frontier T, one bit per accepting set. Sets that the automaton does not have are ignored.
    pub frontier: u32,
    /// Points from left to right.
    pub columns: usize,
    /// Points from the least to the greatest value of the second channel.
    pub rows: usize,
}

/// One side of the plane.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ValueAxis {
    /// Index into [`EnvSpec::state`](crate::env::EnvSpec::state).
    pub channel: usize,
    /// The value at the first point's outer border.
    pub low: f32,
    /// The value at the last point's outer border.
    pub high: f32,
}

/// Values on a grid. Point (column, row) stands in the middle of its cell; all other channels of the state are at rest: the middle of their range.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ValueMap {
    /// The module that was asked; `None` where several compete, the one that promises most in each place.
    pub module: Option<usize>,
    /// What changes along a row, and along a column.
    pub axes: [ValueAxis; 2],
    /// Points in a row.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
    /// rows × columns: V(x) in units of unscaled rewards.
    pub values: Vec<f32>,
    /// rows × columns × controls: π(x), in `[-1, 1]`.
    pub controls: Vec<f32>,
}

/// The channels that span the plane in which the body moves: (x, y), or (x, angle) for a cart with its pole.
fn plane(body: &Body) -> [usize; 2] {
    match *body {
        Body::Ball { position, .. } | Body::Rover { position, .. } => position,
        Body::CartPole { position, angle, .. } => [position, angle],
    }
}

/// The values of `learner` over the plane of `product`'s environment.
pub(super) fn over(product: &EpMdp, learner: &mut ModularDdpg, request: &ValueMapRequest) -> Result<ValueMap, Refusal> {
    let ValueMapRequest { q, frontier, columns, rows } = *request;
    let refuse = |message: String| Err(Refusal::new(Subject::Session, message));
    if columns == 0 || rows == 0 || columns.saturating_mul(rows) > MAX_POINTS {
        return refuse(format!("a value map has 1 to {MAX_POINTS} points, not {columns} × {rows}"));
    }
    let embedding = product.embedding();
    let automaton = embedding.automaton();
    if usize::from(q) >= automaton.len() {
        return refuse(format!("there is no state q{q}; the automaton has {} states", automaton.len()));
    }
    let at = EmbeddedState { q, frontier: Marks(frontier & automaton.all_sets().0), ..embedding.start() };
    let module = learner.modules().of(at);
    if learner.modules().candidates(at).next().is_none() {
        return refuse(format!("no module is in charge of q{q} with this frontier"));
    }
    let mut environment = product.environment().boxed_clone();
    let spec = environment.spec().clone();
    let axes = plane(&environment.scene().body).map(|channel| axis(&*environment, channel));
    let mut state: Vec<f32> = spec.state.iter().map(middle).collect();
    let mut observation = vec![0.0; spec.observation];
    let mut control = vec![0.0; spec.action.len()];
    let mut values = Vec::with_capacity(columns * rows);
    let mut controls = Vec::with_capacity(columns * rows * control.len());
    for row in 0..rows {
        for column in 0..columns {
            state[axes[0].channel] = within(&axes[0], column, columns);
            state[axes[1].channel] = within(&axes[1], row, rows);
            environment.set_state(&state);
            environment.observe(&mut observation);
            values.push(learner.consider(&observation, at, &mut control).expect("some module was just found"));
            controls.extend_from_slice(&control);
        }
    }
    Ok(ValueMap { module, axes, columns, rows, values, controls })
}

fn middle(channel: &Channel) -> f32 {
    channel.clamp(f32::NAN)
}

/// The stretch of `channel` that is shown: what the scene's bands name of it, with as much again on each side, or its whole range.
fn axis(environment: &dyn Environment, channel: usize) -> ValueAxis {
    let range = &environment.spec().state[channel];
    let ground = environment.scene().ground;
    let (low, high) = match environment.scene().body {
        Body::CartPole { position, .. } if position == channel => (ground.x[0], ground.x[1]),
        _ => (range.low, range.high),
    };
    ValueAxis { channel, low: low.max(range.low), high: high.min(range.high) }
}

fn within(axis: &ValueAxis, point: usize, points: usize) -> f32 {
    axis.low + (axis.high - axis.low) * (point as f32 + 0.5) / points as f32
}
