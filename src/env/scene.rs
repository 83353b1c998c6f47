//! What a view draws of an environment, as data: the ground, the regions behind the labels, the body that moves.

use serde::Serialize;
use std::borrow::Cow;

/// A drawing of an environment in its own physical units. Views know no constant of any environment beside this.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Scene {
    /// The part of the plane that is shown.
    pub ground: Ground,
    /// The regions behind the labels. A proposition with several regions holds in their union.
    pub regions: Vec<Region>,
    /// What moves.
    pub body: Body,
    /// The proposition that hides all others where it holds, if there is one: an index into
    /// [`EnvSpec::propositions`](super::environment::EnvSpec::propositions).
    pub hazard: Option<usize>,
    /// The file name of a picture that fills the ground exactly, if there is one.
    pub picture: Option<String>,
}

/// The rectangle that is shown.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Ground {
    /// Left and right end, in `unit`.
    pub x: [f32; 2],
    /// Least and greatest y, in `unit`.
    pub y: [f32; 2],
    /// The unit of length: `m`, `km`.
    pub unit: Cow<'static, str>,
    /// Which way y grows on the screen.
    pub y_axis: YAxis,
}

/// Which way y grows.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum YAxis {
    /// As in a plot: y grows upwards.
    Up,
    /// As in a picture: y grows downwards.
    Down,
}

/// A region in which a proposition holds.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Region {
    /// Index into [`EnvSpec::propositions`](super::environment::EnvSpec::propositions).
    pub proposition: usize,
    /// What the region is called on the map; may be empty.
    pub name: String,
    /// Where it is.
    pub shape: Shape,
    /// How near the body's reference point must come to the shape, in the ground's unit; 0 where the point itself must be
    /// inside. A ball of radius r that needs only to touch has margin r.
    pub margin: f32,
}

/// The shape of a region.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Shape {
    /// All points at most `radius` away from `centre` (x, y).
    Disc {
        /// (x, y).
        centre: [f32; 2],
        /// In the ground's unit.
        radius: f32,
    },
    /// The inside of a closed polygon by the even-odd rule.
    Polygon {
        /// Corners (x, y) in order; the last is joined to the first.
        points: Vec<[f32; 2]>,
    },
    /// All states whose channel `channel` lies in `[low, high]`, whatever the other channels are.
    Band {
        /// Index into [`EnvSpec::state`](super::environment::EnvSpec::state).
        channel: usize,
        /// Least value, in the channel's unit.
        low: f32,
        /// Greatest value, in the channel's unit.
        high: f32,
    },
    /// Cells of a grid that starts in the ground's top-left corner.
    Cells {
        /// Width and height of a cell, in the ground's unit.
        cell: [f32; 2],
        /// Neighbouring cells of a row: row, first column, number of cells.
        runs: Vec<[u32; 3]>,
    },
}

/// What moves, and which channels of the state place it.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Body {
    /// A ball.
    Ball {
        /// Its radius in the ground's unit.
        radius: f32,
        /// The channels of the state that are x and y.
        position: [usize; 2],
        /// The channels of the state that are the velocity's x and y.
        velocity: [usize; 2],
    },
    /// A cart on the x axis with a pole hinged on it.
    CartPole {
        /// The channel that is the cart's x.
        position: usize,
        /// The channel that is the pole's angle, in radians, 0 = upright, positive = leaning to the right.
        angle: usize,
        /// The whole length of the pole in the ground's unit.
        pole_length: f32,
    },
    /// A point that moves over a map.
    Rover {
        /// The channels of the state that are x and y.
        position: [usize; 2],
        /// The longest way of one step, in the ground's unit.
        reach: f32,
    },
}
