//! CartPole: a pole balanced on a cart that has to pass between two bands of its track.
//!
//! The cart and pole of [Barto, Sutton & Anderson 1983](crate::bib::Barto1983) with the constants of Gymnasium's `CartPole`
//! (gravity 9.8 m/s², masses 1.0 kg and 0.1 kg, half a pole 0.5 m, 0.02 s, explicit Euler), and the continuous force of
//! −10 … 10 N, the bands and the limits of section V of [Cai et al. 2021](crate::bib::Cai2021).

use super::environment::{Channel, EnvSpec, Environment, Outcome, command};
use super::scene::{Body, Ground, Region, Scene, Shape, YAxis};
use crate::labels::{Labels, Propositions};
use crate::rng::Rng;

/// Gravity, m/s².
const GRAVITY: f32 = 9.8;
/// Mass of the pole, kg.
const POLE_MASS: f32 = 0.1;
/// Mass of cart and pole, kg.
const TOTAL_MASS: f32 = 1.1;
/// Half the length of the pole, m: from the hinge to its centre of mass.
const HALF_LENGTH: f32 = 0.5;
/// Greatest force, N.
const FORCE: f32 = 10.0;
/// Seconds per step.
const DT: f32 = 0.02;
/// The cart is unsafe beyond this |x|, m.
const TRACK: f32 = 2.4;
/// The pole is unsafe beyond this |angle|: 12° in radians.
const LEAN: f32 = 0.209_439_51;
/// Each initial number lies within ± this (m, m/s, rad, rad/s).
const START: f32 = 0.05;
/// Uniform starts have |x| up to this, m: near enough to the end of the track to matter, far enough to be saved.
const START_TRACK: f32 = 2.0;
/// Greatest speed, m/s. Along the whole track 10 N cannot give more than √(2 · 10 · 4.8) = 9.8 m/s.
const SPEED: f32 = 12.0;
/// Greatest angular speed, rad/s; falling through the safe 24° gives less than 5.
const ANGULAR_SPEED: f32 = 12.0;
/// Green and yellow: least and greatest x, m.
const BANDS: [[f32; 2]; 2] = [[-1.44, -0.96], [0.96, 1.44]];

/// The CartPole environment.
///
/// | channel | unit | range |
/// |---|---|---|
/// | x (cart) | m | −4.8 … 4.8 |
/// | velocity | m/s | −12 … 12 |
/// | pole angle (0 = upright, positive = to the right) | rad | −0.419 … 0.419 (±24°) |
/// | pole angular velocity | rad/s | −12 … 12 |
/// | action: force on the cart | N | −10 … 10 |
///
/// | proposition | holds when |
/// |---|---|
/// | `green` | −1.44 m ≤ x ≤ −0.96 m |
/// | `yellow` | 0.96 m ≤ x ≤ 1.44 m |
/// | `unsafe` | \|x\| > 2.4 m or \|angle\| > 12° |
///
/// The environment terminates in the first unsafe state, which has that label.
#[derive(Clone, Debug)]
pub struct CartPole {
    spec: EnvSpec,
    /// x, velocity, angle, angular velocity.
    state: [f32; 4],
}

impl CartPole {
    /// The environment with the cart in the middle, everything at rest.
    pub fn new() -> CartPole {
        let spec = EnvSpec {
            name: "cart_pole",
            state: vec![
                Channel::new("x", "m", -2.0 * TRACK, 2.0 * TRACK),
                Channel::new("velocity", "m/s", -SPEED, SPEED),
                Channel::new("pole angle", "rad", -2.0 * LEAN, 2.0 * LEAN),
                Channel::new("pole angular velocity", "rad/s", -ANGULAR_SPEED, ANGULAR_SPEED),
            ],
            action: vec![Channel::new("force", "N", -FORCE, FORCE)],
            observation: 4,
            propositions: Propositions::new(["green", "yellow", "unsafe"]).expect("three different names"),
            meanings: vec![
                format!("the cart's x lies in [{}, {}] m", BANDS[0][0], BANDS[0][1]),
                format!("the cart's x lies in [{}, {}] m", BANDS[1][0], BANDS[1][1]),
                format!("the cart is more than {TRACK} m from the middle, or the pole leans more than 12°"),
            ],
            // The pole may fall in either band.
            letters: [0b000, 0b001, 0b010, 0b100, 0b101, 0b110].map(Labels).to_vec(),
            dt: DT,
        };
        CartPole { spec, state: [0.0; 4] }
    }

    fn is_unsafe(&self) -> bool {
        self.state[0].abs() > TRACK || self.state[2].abs() > LEAN
    }

    fn put(&mut self, state: [f32; 4]) {
        for (i, channel) in self.spec.state.iter().enumerate() {
            self.state[i] = channel.clamp(state[i]);
        }
    }
}

impl Default for CartPole {
    fn default() -> Self {
        CartPole::new()
    }
}

impl Environment for CartPole {
    fn spec(&self) -> &EnvSpec {
        &self.spec
    }

    fn scene(&self) -> Scene {
        let band = |proposition, name: &str, channel, low, high| Region {
            proposition,
            name: name.to_owned(),
            shape: Shape::Band { channel, low, high },
            margin: 0.0,
        };
        Scene {
            ground: Ground { x: [-1.1 * TRACK, 1.1 * TRACK], y: [-0.4, 1.4], unit: "m".into(), y_axis: YAxis::Up },
            regions: vec![
                band(0, "Green", 0, BANDS[0][0], BANDS[0][1]),
                band(1, "Yellow", 0, BANDS[1][0], BANDS[1][1]),
                band(2, "Off the track", 0, -2.0 * TRACK, -TRACK),
                band(2, "Off the track", 0, TRACK, 2.0 * TRACK),
                band(2, "Fallen", 2, -2.0 * LEAN, -LEAN),
                band(2, "Fallen", 2, LEAN, 2.0 * LEAN),
            ],
            body: Body::CartPole { position: 0, angle: 2, pole_length: 2.0 * HALF_LENGTH },
            hazard: None,
            picture: None,
        }
    }

    /// Each number uniform in ±0.05 (m, m/s, rad, rad/s), as in Gymnasium.
    fn reset(&mut self, rng: &mut Rng) {
        self.state = std::array::from_fn(|_| rng.uniform_in(-START, START));
    }

    /// As [`CartPole::reset`](Environment::reset), but x uniform in ±2 m.
    fn reset_anywhere(&mut self, rng: &mut Rng) {
        self.reset(rng);
        self.state[0] = rng.uniform_in(-START_TRACK, START_TRACK);
    }

    fn step(&mut self, action: &[f32], _rng: &mut Rng) -> Outcome {
        let force = FORCE * command(action[0]);
        let [x, velocity, angle, spin] = self.state;
        let (sin, cos) = (libm::sinf(angle), libm::cosf(angle));
        let pull = (force + POLE_MASS * HALF_LENGTH * spin * spin * sin) / TOTAL_MASS;
        let spin_change = (GRAVITY * sin - cos * pull) / (HALF_LENGTH * (4.0 / 3.0 - POLE_MASS * cos * cos / TOTAL_MASS));
        let velocity_change = pull - POLE_MASS * HALF_LENGTH * spin_change * cos / TOTAL_MASS;
        // Explicit Euler: positions move by the velocities from before the step.
        self.put([x + DT * velocity, velocity + DT * velocity_change, angle + DT * spin, spin + DT * spin_change]);
        if self.is_unsafe() { Outcome::Terminated } else { Outcome::Running }
    }

    fn state(&self) -> &[f32] {
        &self.state
    }

    fn set_state(&mut self, state: &[f32]) {
        self.put(state.try_into().expect("a state of CartPole has 4 channels"));
    }

    /// x as a multiple of 2.4 m, velocity of 2.4 m/s, angle of 12°, angular velocity of 2 rad/s.
    fn observe(&self, observation: &mut [f32]) {
        let [x, velocity, angle, spin] = self.state;
        observation.copy_from_slice(&[x / TRACK, velocity / TRACK, angle / LEAN, spin / 2.0]);
    }

    fn labels(&self) -> Labels {
        let x = self.state[0];
        let within = |[low, high]: [f32; 2]| low <= x && x <= high;
        Labels::EMPTY.with(0, within(BANDS[0])).with(1, within(BANDS[1])).with(2, self.is_unsafe())
    }

    fn boxed_clone(&self) -> Box<dyn Environment> {
        Box::new(self.clone())
    }
}
