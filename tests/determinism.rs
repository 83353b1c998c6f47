//! The same task and seed are the same run, bit by bit: from the start, in two halves, and through a checkpoint in between.

use ltl_rover::agent::Replays;
use ltl_rover::env::TraceHasher;
use ltl_rover::rng::{Purpose, Rng};
use ltl_rover::task::{Override, Setup, Task};
use ltl_rover::train::{Checkpoint, Run, Tick};
use std::fs;
use std::path::Path;

fn setup(name: &str, overrides: &[&str]) -> Setup {
    let specs = Path::new(env!("CARGO_MANIFEST_DIR")).join("specs");
    let text = fs::read_to_string(specs.join(name).with_extension("toml")).unwrap();
    let task = Task::parse(&text, name).unwrap();
    let hoa = task.file().specification.hoa.clone().map(|file| fs::read_to_string(specs.join(file)).unwrap());
    // Small and early, so that a debug build sees many updates, evaluations and full replays.
    let small = ["learner.exploration.warm_up=30", "learner.batch=8", "learner.hidden=[8]", "learner.replay=50"];
    let rest = ["training.evaluate_every=70", "training.evaluation_runs=2"];
    let overrides: Vec<Override> = small.iter().chain(&rest).chain(overrides).map(|o| o.parse().unwrap()).collect();
    Setup::open(task, "fast", &overrides, hoa.as_deref()).unwrap_or_else(|e| panic!("{e}"))
}

fn hash(hasher: &mut TraceHasher, tick: &Tick) {
    hasher.word(tick.step);
    hasher.word(tick.episode);
    hasher.word(u64::from(tick.product.to.q));
    hasher.word(u64::from(tick.product.to.frontier.0));
    hasher.word(tick.product.labels.0);
    let payoff = tick.reward.payoff();
    hasher.numbers(&[payoff.reward, payoff.discount]);
    if let Some(update) = tick.update {
        hasher.word(update.module as u64);
        hasher.numbers(&[update.losses.critic, update.losses.actor]);
    }
}

/// The fingerprint of the next `ticks` steps.
fn advance(run: &mut Run, ticks: usize) -> u64 {
    let mut hasher = TraceHasher::new();
    for _ in 0..ticks {
        let progress = run.advance();
        hash(&mut hasher, &progress.tick);
        if let Some(e) = progress.evaluation {
            hasher.word(e.seed);
            hasher.word(u64::from(e.successes));
        }
    }
    hasher.finish()
}

#[test]
fn the_same_seed_is_the_same_run_and_another_is_not() {
    let setup = setup("ball_pass_b1", &[]);
    let run = |seed| advance(&mut setup.run(seed), 400);
    assert_eq!(run(1), run(1));
    assert_ne!(run(1), run(2));
}

/// Every option that has a memory of its own: waiting transitions, holds, noise, counterfactual draws, delayed policies.
const VARIANTS: &[(&str, &[&str])] = &[
    ("ball_pass_b1", &[]),
    ("ball_pass_b2", &["learner.n_step=7", "learner.exploration.hold_probability=0.3"]),
    ("cart_pole_c1", &["learner.exploration.noise={ kind = \"ornstein_uhlenbeck\", theta = 0.15, sigma = 0.2 }"]),
    ("cart_pole_c2", &["learner.policy_delay=2", "learner.critics=twin", "learner.target_smoothing={ sigma = 0.2, clip = 0.5 }"]),
    ("ball_pass_b1", &["learner.modules=one", "product.shaping={ kind = \"paper\", weight = 1.0 }"]),
    ("ball_pass_b1", &["learner.modules=per_embedded", "learner.counterfactual.samples=3", "training.embedded_start=random"]),
    ("ball_pass_b1", &["learner.modules=per_set", "learner.fourier_octaves=3", "learner.updated_module=random"]),
    ("cart_pole_c1", &["product.frontier=standard", "learner.updated_module=random", "learner.update_every=3"]),
    ("melas", &["training.disturbance=1.5", "training.short_episodes={ share = 0.7, max_steps = 9 }"]),
];

#[test]
fn a_restored_run_goes_on_bit_by_bit() {
    for (name, overrides) in VARIANTS {
        let setup = setup(name, overrides);
        let mut whole = setup.run(5);
        advance(&mut whole, 233);
        let expected = advance(&mut whole, 233);

        let mut half = setup.run(5);
        advance(&mut half, 233);
        let bytes = half.save(&setup.origin(), Replays::Keep);
        let checkpoint = Checkpoint::read(&bytes).unwrap();
        let again = Setup::from_checkpoint(&checkpoint).unwrap_or_else(|e| panic!("{name}: {e}"));
        let mut restored = again.resume(&checkpoint).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(restored.save(&again.origin(), Replays::Keep), bytes, "{name} {overrides:?}: saved again, the same bytes");
        assert_eq!(advance(&mut restored, 233), expected, "{name} {overrides:?}: the second half differs");
        assert_eq!(
            restored.save(&again.origin(), Replays::Keep),
            whole.save(&setup.origin(), Replays::Keep),
            "{name} {overrides:?}: the ends differ"
        );
    }
}

#[test]
fn evaluations_change_nothing_about_training() {
    let ticks = |every: &str| {
        let setup = setup("ball_pass_b1", &[every]);
        let mut run = setup.run(3);
        let mut hasher = TraceHasher::new();
        (0..300).for_each(|_| hash(&mut hasher, &run.advance().tick));
        hasher.finish()
    };
    assert_eq!(ticks("training.evaluate_every=50"), ticks("training.evaluate_every=0"));
}

#[test]
fn a_policy_file_acts_as_the_policy_it_was_made_of() {
    let setup = setup("ball_pass_b1", &[]);
    let mut run = setup.run(4);
    advance(&mut run, 300);
    let bytes = run.save_policy(&setup.origin());
    let checkpoint = Checkpoint::read(&bytes).unwrap();
    assert!(!checkpoint.resumable());
    let mut from_file = setup.resume(&checkpoint).unwrap();
    let mut best = setup.learner(0);
    best.load_policy(&run.policy()).unwrap();
    let play = |learner: &mut ltl_rover::agent::ModularDdpg| {
        let mut rollout = setup.rollout(9);
        let mut path = vec![];
        while rollout.step(learner).is_some() {
            path.extend_from_slice(rollout.product().environment().state());
        }
        path
    };
    assert_eq!(play(&mut best), play(from_file.trainer_mut().learner_mut()));
}

/// Cut, changed and hostile files are refused or read; nothing panics, and nothing is allocated that the file is not large enough for.
#[test]
fn damaged_checkpoints_are_errors() {
    let setup = setup("ball_pass_b1", &[]);
    let mut run = setup.run(6);
    advance(&mut run, 150);
    let bytes = run.save(&setup.origin(), Replays::Keep);
    let open = |bytes: &[u8]| -> Result<Run, String> {
        let checkpoint = Checkpoint::read(bytes).map_err(|e| e.to_string())?;
        let setup = Setup::from_checkpoint(&checkpoint).map_err(|e| e.to_string())?;
        setup.resume(&checkpoint).map_err(|e| e.to_string())
    };
    assert!(open(&bytes).is_ok());
    let mut rng = Rng::new(1, Purpose::Tool);
    for _ in 0..60 {
        assert!(open(&bytes[..rng.below(bytes.len())]).is_err(), "a file that is cut off is refused");
    }
    let header = 8 + u64::from_le_bytes(bytes[..8].try_into().unwrap()) as usize;
    let mut refused = 0;
    for _ in 0..400 {
        let mut changed = bytes.clone();
        for _ in 0..1 + rng.below(3) {
            // Mostly in the header, where all the structure is.
            let end = if rng.chance(0.9) { header } else { bytes.len() };
            changed[rng.below(end)] = rng.bits() as u8;
        }
        match open(&changed) {
            Err(_) => refused += 1,
            // What was not noticed must still be a run that can go on.
            Ok(mut run) => _ = advance(&mut run, 3),
        }
    }
    assert!(refused > 100, "most damage is noticed: {refused} of 400");
    let text = String::from_utf8_lossy(&bytes[8..header]).into_owned();
    for (old, new) in [
        ("ltl-rover checkpoint 1", "ltl-rover checkpoint 9"),
        ("learner.noise", "learner.noisy"),
        ("module.0.actor.0.weight", "module.9.actor.0.weight"),
        ("begun = ", "begun = -"),
        ("hidden = [8]", "hidden = [0]"),
    ] {
        assert!(text.contains(old), "the test looks for `{old}`");
        let header = text.replacen(old, new, 1);
        let changed = [&(header.len() as u64).to_le_bytes(), header.as_bytes(), &bytes[8 + text.len()..]].concat();
        assert!(open(&changed).is_err(), "`{new}` is refused");
    }
}

#[test]
fn a_training_can_start_from_the_networks_of_another_one() {
    let setup = setup("ball_pass_b1", &[]);
    let mut teacher = setup.run(1);
    advance(&mut teacher, 400);
    let policy = teacher.trainer().learner().policy();
    let mut pupil = setup.run(2);
    assert_ne!(pupil.trainer().learner().policy(), policy);
    pupil.trainer_mut().start_from(&policy).unwrap();
    for (own, given) in pupil.trainer().learner().policy().iter().zip(&policy) {
        for tensor in own {
            // The targets begin as copies of the networks themselves, not of the other run's targets.
            let name = tensor.name.replace("_target.", ".");
            assert_eq!(tensor.values, given.iter().find(|t| t.name == name).unwrap().values, "{}", tensor.name);
        }
    }
    advance(&mut pupil, 400);
    let misfit = self::setup("ball_pass_b1", &["learner.hidden=[9]"]);
    let refused = misfit.run(1).trainer_mut().start_from(&policy).unwrap_err();
    assert!(refused.contains("actor"), "{refused}");
}
