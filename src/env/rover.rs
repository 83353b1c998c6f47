//! The rover: a point that moves over a label map in a chosen direction by a random distance.
//!
//! Section V-B of [Cai et al. 2021](crate::bib::Cai2021): the action is a direction in [0, 2π), and a step leads that way by a
//! distance drawn uniformly from (0, D]. The direction is given here as a vector, which has no seam at 2π.

use super::environment::{Channel, EnvSpec, Environment, Outcome, command};
use super::map::RoverMap;
use super::scene::{Body, Ground, Scene, YAxis};
use crate::labels::Labels;
use crate::rng::Rng;
use std::sync::Arc;

/// The rover environment on a map.
///
/// | channel | unit | range |
/// |---|---|---|
/// | x (to the right), y (downwards) | the map's | 0 … width, 0 … height |
/// | action: direction x, y | – | −1 … 1; only the direction counts, (0, 0) is taken as (1, 0) |
///
/// Propositions are the map's labels. A step that would leave the map ends on its border. The environment never terminates: what
/// an unsafe place means is the task's affair.
#[derive(Clone, Debug)]
pub struct Rover {
    spec: EnvSpec,
    map: Arc<RoverMap>,
    /// The greatest distance of a step, in the map's unit.
    reach: f32,
    /// x, y.
    state: [f32; 2],
}

impl Rover {
    /// The environment on `map`, at the middle of the ground where episodes may start.
    pub fn new(map: Arc<RoverMap>) -> Rover {
        let channel = |name: &'static str, high: f32| Channel::new(name, map.unit.clone(), 0.0, high);
        let spec = EnvSpec {
            name: "rover",
            state: vec![channel("x", map.size[0]), channel("y", map.size[1])],
            action: vec![Channel::new("direction x", "", -1.0, 1.0), Channel::new("direction y", "", -1.0, 1.0)],
            observation: 2,
            propositions: map.propositions.clone(),
            meanings: map.meanings.clone(),
            letters: map.grid.letters().collect(),
            dt: 0.0,
        };
        let state = map.grid.start(0.5, [0.5, 0.5]);
        Rover { spec, reach: map.reach, map, state }
    }

    /// The environment on a shipped map ([`RoverMap::shipped_names`]); `None` for other names.
    pub fn shipped(name: &str) -> Option<Rover> {
        let text = RoverMap::shipped(name)?;
        let map = RoverMap::from_json(text, None).expect("the tests read every shipped map");
        Some(Rover::new(Arc::new(map)))
    }

    /// The map.
    pub fn map(&self) -> &RoverMap {
        &self.map
    }

    fn put(&mut self, state: [f32; 2]) {
        for (i, channel) in self.spec.state.iter().enumerate() {
            self.state[i] = channel.clamp(state[i]);
        }
    }
}

impl Environment for Rover {
    fn spec(&self) -> &EnvSpec {
        &self.spec
    }

    fn scene(&self) -> Scene {
        let [width, height] = self.map.size;
        Scene {
            ground: Ground { x: [0.0, width], y: [0.0, height], unit: self.map.unit.clone().into(), y_axis: YAxis::Down },
            regions: self.map.regions.clone(),
            body: Body::Rover { position: [0, 1], reach: self.map.reach },
            hazard: self.map.hazard,
            picture: self.map.picture.clone(),
        }
    }

    /// Uniform over the free ground: places without label from which, as far as the map can tell, every label can be reached
    /// without touching unsafe ground.
    fn reset(&mut self, rng: &mut Rng) {
        let share = rng.uniform();
        let place = self.map.grid.start(share, [rng.uniform(), rng.uniform()]);
        self.put(place);
    }

    /// The distance of a step is drawn from (0, `factor`·D].
    fn scale_disturbance(&mut self, factor: f32) -> bool {
        self.reach = factor * self.map.reach;
        true
    }

    fn step(&mut self, action: &[f32], rng: &mut Rng) -> Outcome {
        let (x, y) = (command(action[0]), command(action[1]));
        // `sqrt` is correctly rounded on every target.
        let length = (x * x + y * y).sqrt();
        let direction = if length > 0.0 { [x / length, y / length] } else { [1.0, 0.0] };
        let distance = self.reach * (1.0 - rng.uniform());
        self.put([self.state[0] + distance * direction[0], self.state[1] + distance * direction[1]]);
        Outcome::Running
    }

    fn state(&self) -> &[f32] {
        &self.state
    }

    fn set_state(&mut self, state: &[f32]) {
        self.put(state.try_into().expect("a state of the rover has 2 channels"));
    }

    /// (x, y) from −1 to 1 across the map.
    fn observe(&self, observation: &mut [f32]) {
        let [width, height] = self.map.size;
        observation.copy_from_slice(&[2.0 * self.state[0] / width - 1.0, 2.0 * self.state[1] / height - 1.0]);
    }

    fn labels(&self) -> Labels {
        self.map.grid.labels(self.state[0], self.state[1])
    }

    fn boxed_clone(&self) -> Box<dyn Environment> {
        Box::new(self.clone())
    }
}
