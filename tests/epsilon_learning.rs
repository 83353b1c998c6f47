//! ε-moves are learned, and seen: on the Islands, with `a & X (F G a | F G b)`, the learner chooses which promise to make, and makes it
//! where it can be kept. In release only, since a debug build would take minutes: `cargo test --release --test epsilon_learning`.
#![cfg(not(debug_assertions))]

use ltl_rover::agent::{ModularDdpg, Policy, View};
use ltl_rover::eval::Rollout;
use ltl_rover::product::{Chosen, MoveKind, Snapshot};
use ltl_rover::rng::{Purpose, Rng};
use ltl_rover::task::{Override, Setup, Task};
use ltl_rover::train::Run;
use std::fs;
use std::path::Path;

/// Names of states in `specs/islands.hoa`.
const UNDECIDED: u16 = 1;
const A_FOR_EVER: u16 = 2;
const B_FOR_EVER: u16 = 3;
/// Centres of the islands, m; their radius is 1.5 m.
const ISLANDS: [[f32; 2]; 2] = [[2.5, 5.0], [7.5, 5.0]];

/// The task with a current somewhere, and a run of it, trained by the recipe with `overrides`.
fn trained(current: &str, overrides: &[&str], seed: u64) -> (Setup, Run) {
    let specs = Path::new(env!("CARGO_MANIFEST_DIR")).join("specs");
    let read = |file: &str| fs::read_to_string(specs.join(file)).unwrap();
    let text = read("islands.toml").replace("current = \"none\"", &format!("current = \"{current}\""));
    let overrides: Vec<Override> = overrides.iter().map(|o| o.parse().unwrap()).collect();
    let task = Task::parse(&text, "islands.toml").unwrap();
    let setup = Setup::open(task, "fast", &overrides, Some(&read("islands.hoa"))).unwrap_or_else(|e| panic!("{e}"));
    let mut run = setup.run(seed);
    while !run.finished() {
        run.advance();
    }
    (setup, run)
}

fn distance([x, y]: [f32; 2], [cx, cy]: [f32; 2]) -> f32 {
    ((x - cx) * (x - cx) + (y - cy) * (y - cy)).sqrt()
}

/// One greedy episode: the ε-moves with the places where they were made, and whether it succeeded.
fn jumps(rollout: &mut Rollout, learner: &mut ModularDdpg) -> (Vec<(u16, [f32; 2])>, bool) {
    let mut made = vec![];
    while let Some(step) = rollout.step(learner) {
        if step.kind == MoveKind::Epsilon {
            let state = rollout.product().environment().state();
            made.push((step.to.q, [state[0], state[1]]));
        }
    }
    (made, rollout.episode().success())
}

/// Where only one island can be held, that one is promised, once, and on it; the boat has crossed the water for b.
fn the_right_promise(current: &str, promised: u16) {
    for seed in [101, 102, 103] {
        let (setup, run) = trained(current, &[], seed);
        let mut learner = setup.learner(0);
        learner.load_policy(&run.policy()).unwrap();
        let mut rollout = setup.rollout(0);
        let (episodes, mut kept) = (100, 0);
        for k in 0..episodes {
            rollout.restart(5_000 + k);
            let (made, success) = jumps(&mut rollout, &mut learner);
            if success {
                kept += 1;
                assert_eq!(made.len(), 1, "{current}, seed {seed}: one promise is made");
                let (q, place) = made[0];
                assert_eq!(q, promised, "{current}, seed {seed}: the other promise could not be kept");
                assert!(distance(place, ISLANDS[usize::from(promised - A_FOR_EVER)]) < 1.75, "promised at {place:?}");
            }
        }
        assert!(kept >= 95, "{current}, seed {seed}: {kept} of {episodes} episodes keep their promise");
    }
}

#[test]
fn where_b_has_the_current_a_is_promised() {
    the_right_promise("at_b", A_FOR_EVER);
}

#[test]
fn where_a_has_the_current_the_boat_crosses_and_b_is_promised() {
    the_right_promise("at_a", B_FOR_EVER);
}

/// Without a current both promises are learned, each on its island, and none in open water.
#[test]
fn where_both_can_be_held_each_is_promised_on_its_island() {
    let (setup, mut run) = trained("none", &["training.stop=budget"], 101);
    // The last policy: for the evaluations, which all start on island a, one that never looks at b is as good.
    let learner = run.trainer_mut().learner_mut();
    let mut product = setup.product();
    let undecided = product.embedding().reachable(64).unwrap().into_iter().find(|at| at.q == UNDECIDED).unwrap();
    let mut rng = Rng::new(7, Purpose::Tool);
    let mut promised = |place: [f32; 2]| {
        let fresh = product.snapshot();
        product.restore(&Snapshot { state: place.to_vec(), at: undecided, ended: false, ..fresh }).unwrap();
        let view = View::new(&product);
        assert_eq!(view.situation().jumps.len(), 2, "both promises are on offer");
        let mut control = [0.0; 2];
        match learner.act(&view.situation(), &mut control) {
            Chosen::Control => None,
            Chosen::Epsilon(q) => Some(q),
        }
    };
    let (mut right, mut inside, mut rash, mut outside) = (0, 0, 0, 0);
    while inside < 400 || outside < 400 {
        let place = [rng.uniform_in(0.0, 10.0), rng.uniform_in(0.0, 10.0)];
        let apart = ISLANDS.map(|island| distance(place, island));
        if apart[0].min(apart[1]) < 1.2 {
            let wanted = if apart[0] < apart[1] { A_FOR_EVER } else { B_FOR_EVER };
            inside += 1;
            right += u32::from(promised(place) == Some(wanted));
        } else if apart[0].min(apart[1]) > 2.0 {
            outside += 1;
            rash += u32::from(promised(place).is_some());
        }
    }
    assert!(right * 100 >= inside * 90, "{right} of {inside} places on the islands lead to the right promise");
    assert!(rash * 100 <= outside * 10, "{rash} of {outside} places in open water lead to a promise that is broken at once");
}
