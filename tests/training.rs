//! What training does otherwise than an evaluation: a scaled disturbance, and short episodes among the others.

use ltl_rover::env::map::RoverMap;
use ltl_rover::session::builtin_task;
use ltl_rover::task::{Override, Setup};
use ltl_rover::train::{End, Metrics, Tick};

/// Melas with uniformly random controls and without updates.
fn melas(changes: &[&str]) -> Setup {
    let (task, hoa) = builtin_task("melas").unwrap();
    let overrides: Vec<Override> = changes
        .iter()
        .chain(&["learner.exploration.warm_up=1000000", "learner.hidden=[8]"])
        .map(|o| o.parse().unwrap())
        .collect();
    Setup::open(task, "fast", &overrides, Some(hoa)).unwrap_or_else(|e| panic!("{e}"))
}

/// A wider disturbance is for training alone: evaluations take place in the environment as it is.
#[test]
fn the_disturbance_is_scaled_while_training_only() {
    let far = |change: &str| {
        let setup = melas(&[change]);
        let distance = |a: &[f32], b: &[f32]| (a[0] - b[0]).hypot(a[1] - b[1]);
        let (mut trainer, mut rollout, mut learner) = (setup.trainer(1), setup.rollout(1), setup.learner(1));
        let (mut training, mut evaluation, mut before) = (0.0_f32, 0.0_f32, vec![]);
        for _ in 0..1_000 {
            if trainer.step().episode_step > 1 {
                training = training.max(distance(&before, trainer.product().environment().state()));
            }
            before = trainer.product().environment().state().to_vec();
            let from = rollout.product().environment().state().to_vec();
            rollout.step(&mut learner);
            evaluation = evaluation.max(distance(&from, rollout.product().environment().state()));
        }
        (training, evaluation)
    };
    let (as_it_is, wider) = (far("training.disturbance=1.0"), far("training.disturbance=1.5"));
    let reach = RoverMap::from_json(RoverMap::shipped("melas").unwrap(), None).unwrap().reach;
    let about = |x: f32, expected: f32| x > 0.95 * expected && x < 1.001 * expected;
    assert!(about(as_it_is.0, reach) && about(wider.0, 1.5 * reach), "{as_it_is:?} {wider:?}");
    assert!(wider.1 < 1.001 * reach, "{wider:?}");
}

#[test]
fn short_episodes_are_as_many_and_as_long_as_said_and_stand_in_no_curve() {
    let mut trainer = melas(&["training.short_episodes={ share = 0.75, max_steps = 7 }", "training.max_steps=21"]).trainer(1);
    let mut metrics = Metrics::of(&trainer);
    let (mut ends, mut summaries): (Vec<Tick>, Vec<u32>) = (vec![], vec![]);
    while ends.len() < 2_000 {
        let tick = trainer.step();
        summaries.extend(metrics.fold(&tick).map(|summary| summary.steps));
        ends.extend(tick.end.map(|_| tick));
    }
    let (short, others): (Vec<Tick>, Vec<Tick>) = ends.into_iter().partition(|tick| tick.short);
    // Binomial, deviation 19: five of them.
    assert!((1_405..=1_595).contains(&short.len()), "{} of 2 000", short.len());
    for (episodes, limit) in [(&short, 7), (&others, 21)] {
        let truncated = |tick: &&Tick| tick.end == Some(End::Truncated);
        assert!(episodes.iter().filter(truncated).all(|tick| tick.episode_step == limit));
        assert!(episodes.iter().all(|tick| tick.episode_step <= limit));
        assert!(episodes.iter().filter(truncated).count() * 2 > episodes.len());
    }
    assert_eq!(summaries, others.iter().map(|tick| tick.episode_step).collect::<Vec<_>>());
}
