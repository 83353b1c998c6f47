//! An environment of one's own: a shuttle on a track that shall serve both stations for ever, from formula to learned policy.
//!
//! `cargo run --release --example own_environment`

use ltl_rover::agent::{ExplorationSettings, LearnerSettings, ModularDdpg, NoiseSettings, Schedule, Sizes};
use ltl_rover::automaton::translate::{TranslateOptions, translate};
use ltl_rover::automaton::{Embedding, FrontierRule, StateTracking};
use ltl_rover::env::{Body, Channel, EnvSpec, Environment, Ground, Outcome, Region, Scene, Shape, YAxis};
use ltl_rover::eval::{Rollout, RolloutSettings, evaluate};
use ltl_rover::labels::{Labels, Propositions};
use ltl_rover::ltl::Formula;
use ltl_rover::nn::fused::Fused;
use ltl_rover::product::{EpMdp, LdgbaReward, Renaming, Reward, RewardSettings, Shaping, Start};
use ltl_rover::rng::Rng;
use ltl_rover::train::{Run, Stop, Trainer, TrainingSettings};
use std::sync::Arc;

/// Position from −1 to 1 km, pushed by a velocity of at most 0.1 km per step; stations `west` and `east` at the ends.
#[derive(Clone)]
struct Shuttle {
    spec: EnvSpec,
    state: [f32; 1],
}

impl Shuttle {
    fn new() -> Shuttle {
        let spec = EnvSpec {
            name: "shuttle",
            state: vec![Channel::new("x", "km", -1.0, 1.0)],
            action: vec![Channel::new("velocity", "km/step", -0.1, 0.1)],
            observation: 1,
            propositions: Propositions::new(["west", "east"]).expect("two different names"),
            meanings: vec!["x is at most −0.8 km".into(), "x is at least 0.8 km".into()],
            letters: vec![Labels::EMPTY, Labels::only(0), Labels::only(1)],
            dt: 0.0,
        };
        Shuttle { spec, state: [0.0] }
    }
}

impl Environment for Shuttle {
    fn spec(&self) -> &EnvSpec {
        &self.spec
    }

    fn scene(&self) -> Scene {
        let ends = [("West", -0.9), ("East", 0.9)];
        let region = |(i, (name, x)): (usize, (&str, f32))| Region {
            proposition: i,
            name: name.to_owned(),
            shape: Shape::Disc { centre: [x, 0.0], radius: 0.1 },
            margin: 0.0,
        };
        Scene {
            ground: Ground { x: [-1.0, 1.0], y: [-0.2, 0.2], unit: "km".into(), y_axis: YAxis::Up },
            regions: ends.into_iter().enumerate().map(region).collect(),
            body: Body::Rover { position: [0, 0], reach: 0.1 },
            hazard: None,
            picture: None,
        }
    }

    fn reset(&mut self, rng: &mut Rng) {
        self.state = [rng.uniform_in(-1.0, 1.0)];
    }

    fn step(&mut self, action: &[f32], _: &mut Rng) -> Outcome {
        self.state[0] = self.spec.state[0].clamp(self.state[0] + 0.1 * action[0].clamp(-1.0, 1.0));
        Outcome::Running
    }

    fn state(&self) -> &[f32] {
        &self.state
    }

    fn set_state(&mut self, state: &[f32]) {
        self.state = [self.spec.state[0].clamp(state[0])];
    }

    fn observe(&self, observation: &mut [f32]) {
        observation.copy_from_slice(&self.state);
    }

    fn labels(&self) -> Labels {
        Labels::EMPTY.with(0, self.state[0] <= -0.8).with(1, self.state[0] >= 0.8)
    }

    fn boxed_clone(&self) -> Box<dyn Environment> {
        Box::new(self.clone())
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let formula = Formula::parse("G F west & G F east")?;
    let automaton = Arc::new(translate(&formula, &TranslateOptions::default())?);
    println!("{formula}: {} states, {} accepting sets", automaton.states().count(), automaton.sets());

    let embedding = Arc::new(Embedding::new(automaton, FrontierRule::Refill, StateTracking::Off)?);
    let settings = RewardSettings { accepting_discount: 0.9, discount: 0.99, sink_reward: 0.0, shaping: Shaping::None };
    let reward: Arc<dyn Reward> = Arc::new(LdgbaReward::new(settings, &embedding)?);
    let product = EpMdp::new(Box::new(Shuttle::new()), embedding.clone(), &Renaming::default())?;

    let learner = LearnerSettings {
        n_step: 5,
        reward_scale: 10.0,
        tau: 0.005,
        actor_rate: Schedule::Constant(1e-3),
        exploration: ExplorationSettings {
            warm_up: 500,
            noise: NoiseSettings::Gaussian { sigma: Schedule::Constant(0.3) },
            hold_probability: Schedule::Constant(0.05),
            ..ExplorationSettings::default()
        },
        ..LearnerSettings::default()
    };
    let fresh = |seed| {
        ModularDdpg::new(
            learner.clone(),
            embedding.clone(),
            reward.clone(),
            Sizes { observation: 1, control: 1 },
            (|shape, rng| Box::new(Fused::new(shape, rng)), seed),
        )
    };
    let training = TrainingSettings {
        steps: 30_000,
        max_steps: 100,
        evaluate_every: 1_000,
        stop: Stop::Perfect,
        ..TrainingSettings::default()
    };
    let rollout =
        |seed| Rollout::new(product.clone(), reward.clone(), RolloutSettings { max_steps: 100, start: Start::Initial }, seed);

    let mut run = Run::new(Trainer::new(product.clone(), fresh(1)?, reward.clone(), training, 1), rollout(1), 1);
    while !run.finished() {
        run.advance();
    }
    let mut policy = fresh(0)?;
    policy.load_policy(&run.policy())?;
    let judged = evaluate(&mut rollout(1000), &mut policy, 200, 1000);
    println!(
        "after {:?} steps: {} of {} runs serve both stations, {:.1} rounds each",
        run.first_perfect_step(),
        judged.successes,
        judged.runs,
        judged.rounds_mean
    );
    match judged.success_rate > 0.9 {
        true => Ok(()),
        false => Err("not learned".into()),
    }
}
