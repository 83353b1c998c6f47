//! Learning works: the `fast` recipes solve their tasks on most seeds within their budget. In release only, since a debug build
//! would take minutes: `cargo test --release --test learning`.
#![cfg(not(debug_assertions))]

use ltl_rover::eval::{Evaluation, evaluate};
use ltl_rover::task::{Override, Setup, Task};
use std::fs;
use std::path::Path;

/// Trains by the recipe and judges the best policy on starts that training has not seen.
fn trained(name: &str, overrides: &[&str], seed: u64) -> (Option<u64>, Evaluation) {
    let specs = Path::new(env!("CARGO_MANIFEST_DIR")).join("specs");
    let text = fs::read_to_string(specs.join(name).with_extension("toml")).unwrap();
    let task = Task::parse(&text, name).unwrap();
    let hoa = task.file().specification.hoa.clone().map(|file| fs::read_to_string(specs.join(file)).unwrap());
    let overrides: Vec<Override> = overrides.iter().map(|o| o.parse().unwrap()).collect();
    let setup = Setup::open(task, "fast", &overrides, hoa.as_deref()).unwrap_or_else(|e| panic!("{e}"));
    let mut run = setup.run(seed);
    while !run.finished() {
        run.advance();
    }
    let mut policy = setup.learner(0);
    policy.load_policy(&run.policy()).unwrap();
    (run.first_perfect_step(), evaluate(&mut setup.rollout(1000), &mut policy, 200, 1000))
}

/// Seeds 101 … 105: recipes were chosen on others.
fn solved(name: &str) {
    let results: Vec<_> = (101..=105).map(|seed| trained(name, &[], seed)).collect();
    let perfect = results.iter().filter(|(step, e)| e.perfect() && step.is_some_and(|s| s <= 60_000)).count();
    assert!(perfect >= 4, "{name}: 200 of 200 on {perfect} of 5 seeds: {results:?}");
}

#[test]
fn ball_pass_b1_is_solved_within_60_000_steps() {
    solved("ball_pass_b1");
}

#[test]
fn ball_pass_b2_is_solved_within_60_000_steps() {
    solved("ball_pass_b2");
}

/// A test of the test: with nothing learned nothing is solved.
#[test]
fn an_untrained_policy_solves_nothing() {
    let (step, e) = trained("ball_pass_b1", &["learner.updates_per_step=0", "training.steps=2000"], 101);
    assert_eq!((step, e.successes), (None, 0));
}
