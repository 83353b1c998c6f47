//! Islands: a boat between two islands, one of which may have a current that nobody can hold against.
//!
//! Made for formulas with an eventual choice such as `a & X (F G a | F G b)` (Fig. 9 of [Cai et al. 2021](crate::bib::Cai2021)):
//! which island to stay at for ever has to be promised by an ε-move, and which promise can be kept depends on the [`Current`].

use super::environment::{Channel, EnvSpec, Environment, Outcome, command};
use super::scene::{Body, Ground, Region, Scene, Shape, YAxis};
use crate::labels::{Labels, Propositions};
use crate::rng::Rng;
use serde::{Deserialize, Serialize};

/// Side of the water, m.
const SIDE: f32 = 10.0;
/// Centres of a and b, m.
const CENTRES: [[f32; 2]; 2] = [[2.5, 5.0], [7.5, 5.0]];
/// Radius of both, m.
const RADIUS: f32 = 1.5;
/// Greatest speed of the boat per axis, m/s.
const SPEED: f32 = 1.0;
/// Speed of a current, m/s: more than the boat's √2 m/s along a diagonal.
const CURRENT: f32 = 2.0;
/// Standard deviation of the gusts' displacement per step and axis, m.
const GUST: f32 = 0.05;
/// Seconds per step.
const DT: f32 = 0.2;

/// Where a current sweeps the boat away, straight from the island's centre at 2 m/s.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Current {
    /// Nowhere: one can stay at either island.
    #[default]
    None,
    /// At island a: only b can be held.
    AtA,
    /// At island b: only a can be held.
    AtB,
}

/// The Islands environment.
///
/// | channel | unit | range |
/// |---|---|---|
/// | x, y | m | 0 … 10 |
/// | action: velocity x, y | m/s | −1 … 1 |
///
/// | proposition | holds when |
/// |---|---|
/// | `a` | the boat is at most 1.5 m from (2.5, 5) m |
/// | `b` | the boat is at most 1.5 m from (7.5, 5) m |
///
/// A step takes 0.2 s; gusts add a normal displacement of standard deviation 0.05 m per axis. The border stops the boat. The
/// environment never terminates.
#[derive(Clone, Debug)]
pub struct Islands {
    spec: EnvSpec,
    current: Current,
    /// Standard deviation of the gusts' displacement per step and axis, m.
    gust: f32,
    /// x, y.
    state: [f32; 2],
}

impl Islands {
    /// The environment with the boat in the middle of island a.
    pub fn new(current: Current) -> Islands {
        let meaning = |[x, y]: [f32; 2]| format!("the boat is at most {RADIUS} m from ({x}, {y}) m");
        let spec = EnvSpec {
            name: "islands",
            state: vec![Channel::new("x", "m", 0.0, SIDE), Channel::new("y", "m", 0.0, SIDE)],
            action: vec![Channel::new("velocity x", "m/s", -SPEED, SPEED), Channel::new("velocity y", "m/s", -SPEED, SPEED)],
            observation: 2,
            propositions: Propositions::new(["a", "b"]).expect("two different names"),
            meanings: CENTRES.map(meaning).to_vec(),
            letters: vec![Labels::EMPTY, Labels::only(0), Labels::only(1)],
            dt: DT,
        };
        Islands { spec, current, gust: GUST, state: CENTRES[0] }
    }

    /// Where the current is.
    pub fn current(&self) -> Current {
        self.current
    }

    fn at(&self, island: usize) -> bool {
        let (dx, dy) = (self.state[0] - CENTRES[island][0], self.state[1] - CENTRES[island][1]);
        dx * dx + dy * dy <= RADIUS * RADIUS
    }

    /// The velocity of the water where the boat is, m/s.
    fn drift(&self) -> [f32; 2] {
        let island = match self.current {
            Current::None => return [0.0, 0.0],
            Current::AtA => 0,
            Current::AtB => 1,
        };
        if !self.at(island) {
            return [0.0, 0.0];
        }
        let (dx, dy) = (self.state[0] - CENTRES[island][0], self.state[1] - CENTRES[island][1]);
        let distance = (dx * dx + dy * dy).sqrt();
        // In the very centre, where "away" has no direction, the water flows to the right.
        if distance > 0.0 { [CURRENT * dx / distance, CURRENT * dy / distance] } else { [CURRENT, 0.0] }
    }
}

impl Environment for Islands {
    fn spec(&self) -> &EnvSpec {
        &self.spec
    }

    fn scene(&self) -> Scene {
        let region = |i: usize, name: &str| Region {
            proposition: i,
            name: name.to_owned(),
            shape: Shape::Disc { centre: CENTRES[i], radius: RADIUS },
            margin: 0.0,
        };
        Scene {
            ground: Ground { x: [0.0, SIDE], y: [0.0, SIDE], unit: "m".into(), y_axis: YAxis::Up },
            regions: vec![region(0, "Island a"), region(1, "Island b")],
            body: Body::Rover { position: [0, 1], reach: SPEED * DT },
            hazard: None,
            picture: None,
        }
    }

    /// Uniform over island a, where `a` holds.
    fn reset(&mut self, rng: &mut Rng) {
        loop {
            let at = |centre: f32, share: f32| centre + RADIUS * (2.0 * share - 1.0);
            self.state = [at(CENTRES[0][0], rng.uniform()), at(CENTRES[0][1], rng.uniform())];
            // π/4 of the square around the island is on it, so this loop ends soon.
            if self.at(0) {
                return;
            }
        }
    }

    /// Uniform over the water.
    fn reset_anywhere(&mut self, rng: &mut Rng) {
        self.state = [rng.uniform_in(0.0, SIDE), rng.uniform_in(0.0, SIDE)];
    }

    /// The gusts' displacement is `factor` times as great.
    fn scale_disturbance(&mut self, factor: f32) -> bool {
        self.gust = factor * GUST;
        true
    }

    fn step(&mut self, action: &[f32], rng: &mut Rng) -> Outcome {
        let drift = self.drift();
        for axis in 0..2 {
            let moved = self.state[axis] + DT * (SPEED * command(action[axis]) + drift[axis]) + self.gust * rng.normal();
            self.state[axis] = moved.clamp(0.0, SIDE);
        }
        Outcome::Running
    }

    fn state(&self) -> &[f32] {
        &self.state
    }

    fn set_state(&mut self, state: &[f32]) {
        assert_eq!(state.len(), 2, "a state of Islands has 2 channels");
        for (i, channel) in self.spec.state.iter().enumerate() {
            self.state[i] = channel.clamp(state[i]);
        }
    }

    /// (x, y) from −1 to 1 across the water.
    fn observe(&self, observation: &mut [f32]) {
        observation.copy_from_slice(&self.state.map(|v| 2.0 * v / SIDE - 1.0));
    }

    fn labels(&self) -> Labels {
        Labels::EMPTY.with(0, self.at(0)).with(1, self.at(1))
    }

    fn boxed_clone(&self) -> Box<dyn Environment> {
        Box::new(self.clone())
    }
}
