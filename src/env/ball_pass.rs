//! Ball-Pass: a ball with two accelerations under gravity in a square arena, and two discs to touch.
//!
//! Section V of [Cai et al. 2021](crate::bib::Cai2021) gives the arena (600 m × 600 m), ẍ = a_x, ÿ = a_y + g and Δt = 0.05 s.
//! The printed range a ∈ \[0, 1\] m/s could never turn back. The public environment that the experiment was run in works in
//! arena units (1 = 600 m): a ∈ \[−1, 1\]², g = −0.5, discs of radius 0.05 around (0.3, 0.3) and (0.8, 0.6), a ball of radius
//! 1/60 that has to touch them, a start at rest at (0.5, 1). Those numbers stand here in metres. Within a step the acceleration
//! is constant, so that the step is integrated exactly: x ← x + v Δt + a Δt²/2, v ← v + a Δt.

use super::environment::{Channel, EnvSpec, Environment, Outcome, command};
use super::scene::{Body, Ground, Region, Scene, Shape, YAxis};
use crate::labels::{Labels, Propositions};
use crate::rng::Rng;

/// Side of the arena, m.
const SIDE: f32 = 600.0;
/// Seconds per step.
const DT: f32 = 0.05;
/// Greatest acceleration per axis, m/s².
const ACCELERATION: f32 = 600.0;
/// Gravity, m/s².
const GRAVITY: f32 = -300.0;
/// Greatest speed per axis, m/s. From rest inside the arena √(2 · 900 · 600) = 1039 m/s cannot be passed, so this cuts off
/// nothing but states chosen by hand.
const SPEED: f32 = 1200.0;
/// Radius of the ball, m.
const BALL: f32 = 10.0;
/// Radius of both regions, m.
const REGION: f32 = 30.0;
/// Centres of r1 and r2, m.
const CENTRES: [[f32; 2]; 2] = [[180.0, 180.0], [480.0, 360.0]];
/// The start, m: in the middle of the ceiling, at rest.
const START: [f32; 2] = [300.0, 600.0];

/// The Ball-Pass environment.
///
/// | channel | unit | range |
/// |---|---|---|
/// | x, y | m | 0 … 600 |
/// | velocity x, y | m/s | −1200 … 1200 |
/// | action: acceleration x, y | m/s² | −600 … 600 |
///
/// | proposition | holds when |
/// |---|---|
/// | `r1` | the centre of the ball is at most 40 m from (180, 180) m: the ball touches the disc of radius 30 m |
/// | `r2` | the same for (480, 360) m |
///
/// The environment terminates when the centre of the ball leaves the arena; the state reached is then the nearest one in it.
#[derive(Clone, Debug)]
pub struct BallPass {
    spec: EnvSpec,
    /// x, y, velocity x, velocity y.
    state: [f32; 4],
}

impl BallPass {
    /// The environment at its start.
    pub fn new() -> BallPass {
        let touches =
            |[x, y]: [f32; 2]| format!("the ball (radius {BALL} m) touches the disc of radius {REGION} m around ({x}, {y}) m");
        let spec = EnvSpec {
            name: "ball_pass",
            state: vec![
                Channel::new("x", "m", 0.0, SIDE),
                Channel::new("y", "m", 0.0, SIDE),
                Channel::new("velocity x", "m/s", -SPEED, SPEED),
                Channel::new("velocity y", "m/s", -SPEED, SPEED),
            ],
            action: vec![
                Channel::new("acceleration x", "m/s²", -ACCELERATION, ACCELERATION),
                Channel::new("acceleration y", "m/s²", -ACCELERATION, ACCELERATION),
            ],
            observation: 4,
            propositions: Propositions::new(["r1", "r2"]).expect("two different names"),
            meanings: CENTRES.map(touches).to_vec(),
            letters: vec![Labels::EMPTY, Labels::only(0), Labels::only(1)],
            dt: DT,
        };
        BallPass { spec, state: [START[0], START[1], 0.0, 0.0] }
    }
}

impl Default for BallPass {
    fn default() -> Self {
        BallPass::new()
    }
}

impl Environment for BallPass {
    fn spec(&self) -> &EnvSpec {
        &self.spec
    }

    fn scene(&self) -> Scene {
        let region = |i: usize| Region {
            proposition: i,
            name: format!("Region {}", i + 1),
            shape: Shape::Disc { centre: CENTRES[i], radius: REGION },
            margin: BALL,
        };
        Scene {
            ground: Ground { x: [0.0, SIDE], y: [0.0, SIDE], unit: "m".into(), y_axis: YAxis::Up },
            regions: vec![region(0), region(1)],
            body: Body::Ball { radius: BALL, position: [0, 1], velocity: [2, 3] },
            hazard: None,
            picture: None,
        }
    }

    /// At rest in the middle of the ceiling, (300, 600) m: the public environment's only start.
    fn reset(&mut self, _rng: &mut Rng) {
        self.state = [START[0], START[1], 0.0, 0.0];
    }

    /// At rest, uniform over the places where the whole ball is in the arena. From rest every place can be held or left, since
    /// a_y may be twice gravity.
    fn reset_anywhere(&mut self, rng: &mut Rng) {
        self.state = [rng.uniform_in(BALL, SIDE - BALL), rng.uniform_in(BALL, SIDE - BALL), 0.0, 0.0];
    }

    fn step(&mut self, action: &[f32], _rng: &mut Rng) -> Outcome {
        let acceleration = [ACCELERATION * command(action[0]), ACCELERATION * command(action[1]) + GRAVITY];
        let mut outcome = Outcome::Running;
        for (axis, a) in acceleration.into_iter().enumerate() {
            let (position, velocity) = (self.state[axis], self.state[axis + 2]);
            let next = position + velocity * DT + 0.5 * a * DT * DT;
            if !(0.0..=SIDE).contains(&next) {
                outcome = Outcome::Terminated;
            }
            self.state[axis] = next.clamp(0.0, SIDE);
            self.state[axis + 2] = (velocity + a * DT).clamp(-SPEED, SPEED);
        }
        outcome
    }

    fn state(&self) -> &[f32] {
        &self.state
    }

    fn set_state(&mut self, state: &[f32]) {
        assert_eq!(state.len(), 4, "a state of Ball-Pass has 4 channels");
        for (i, channel) in self.spec.state.iter().enumerate() {
            self.state[i] = channel.clamp(state[i]);
        }
    }

    /// (x, y) from −1 at 0 m to 1 at 600 m; velocities as multiples of 600 m/s.
    fn observe(&self, observation: &mut [f32]) {
        let [x, y, vx, vy] = self.state;
        observation.copy_from_slice(&[2.0 * x / SIDE - 1.0, 2.0 * y / SIDE - 1.0, vx / SIDE, vy / SIDE]);
    }

    fn labels(&self) -> Labels {
        let mut labels = Labels::EMPTY;
        for (i, [cx, cy]) in CENTRES.into_iter().enumerate() {
            let (dx, dy) = (self.state[0] - cx, self.state[1] - cy);
            let reach = REGION + BALL;
            labels = labels.with(i, dx * dx + dy * dy <= reach * reach);
        }
        labels
    }

    fn boxed_clone(&self) -> Box<dyn Environment> {
        Box::new(self.clone())
    }
}
