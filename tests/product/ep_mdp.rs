//! The product walked on the fly: letters by name, the visit at time 0, ε-moves, snapshots, Algorithm 1.

use crate::frontier::two_sets;
use ltl_rover::automaton::{Cube, Edge, Embedding, FrontierRule, Gaps, Guard, Ldgba, LdgbaParts, Marks, StateTracking};
use ltl_rover::env::{BallPass, CartPole, Environment, Outcome};
use ltl_rover::labels::{Labels, Propositions};
use ltl_rover::ltl::Lasso;
use ltl_rover::product::{
    Chosen, EpMdp, Move, MoveKind, ProductStep, Renaming, RunEnd, Start, product_trace_hash, run, run_with,
};
use ltl_rover::rng::{Purpose, Rng};
use std::sync::Arc;

type Rows = Vec<Vec<(Guard, Edge)>>;

fn automaton(names: &[&str], sets: usize, edges: Rows, epsilon: Vec<Vec<u16>>) -> Arc<Ldgba> {
    let propositions = Propositions::new(names.iter().copied()).unwrap();
    let parts = LdgbaParts { propositions, initial: 0, sets, edges, epsilon, names: vec![] };
    Arc::new(Ldgba::new(parts, Gaps::Sink).unwrap())
}

fn when(positive: u64, negative: u64, target: u16, marks: u32) -> (Guard, Edge) {
    (Guard(vec![Cube { positive, negative }]), Edge { target, marks: Marks(marks) })
}

fn embedded(automaton: &Arc<Ldgba>) -> Arc<Embedding> {
    Arc::new(Embedding::new(automaton.clone(), FrontierRule::Refill, StateTracking::On).unwrap())
}

fn product(environment: impl Environment + 'static, automaton: &Arc<Ldgba>, names: &[(&str, &str)]) -> EpMdp {
    EpMdp::new(Box::new(environment), embedded(automaton), &renaming(names)).unwrap()
}

fn renaming(names: &[(&str, &str)]) -> Renaming {
    names.iter().map(|&(a, b)| (a.to_owned(), b.to_owned())).collect()
}

fn rng() -> Rng {
    Rng::new(1, Purpose::Tool)
}

const HOVER: [f32; 2] = [0.0, 0.5];
const R1: [f32; 4] = [180.0, 180.0, 0.0, 0.0];
const R2: [f32; 4] = [480.0, 360.0, 0.0, 0.0];
const NOWHERE: [f32; 4] = [300.0, 300.0, 0.0, 0.0];

#[test]
fn letters_are_matched_by_name_in_any_order() {
    // GF a & GF b over (a, b), with a renamed to r2 and b to r1.
    let mut ball = product(BallPass::new(), &two_sets(), &[("a", "r2"), ("b", "r1")]);
    assert_eq!(ball.reset_to(&R1).labels, Labels(0b10));
    assert_eq!(ball.reset_to(&R2).labels, Labels(0b01));
    // A part of the labels is enough, and the rest is not seen.
    let only = automaton(&["yellow"], 1, vec![vec![when(0, 0, 0, 1)]], vec![]);
    let mut cart = product(CartPole::new(), &only, &[]);
    assert_eq!(cart.reset_to(&[1.2, 0.0, 0.0, 0.0]).labels, Labels(1));
    assert_eq!(cart.reset_to(&[-1.2, 0.0, 0.0, 0.0]).labels, Labels(0));
}

#[test]
fn a_name_without_a_label_is_an_error_that_says_what_there_is() {
    let message = |names: &[&str], renames: &[(&str, &str)]| {
        let automaton = automaton(names, 1, vec![vec![when(0, 0, 0, 1)]], vec![]);
        let result = EpMdp::new(Box::new(CartPole::new()), embedded(&automaton), &renaming(renames));
        result.map(|_| ()).unwrap_err().to_string()
    };
    let error = message(&["green", "yelow"], &[]);
    assert!(error.contains("`yelow`") && error.contains("`green`, `yellow`, `unsafe`"), "{error}");
    assert!(error.contains("`cart_pole`") && error.contains("did you mean `yellow`?"), "{error}");
    let error = message(&["a"], &[("a", "goal")]);
    assert!(error.contains("`a`") && error.contains("`goal`") && !error.contains("did you mean"), "{error}");
    let error = message(&["green"], &[("gren", "yellow")]);
    assert!(error.contains("`gren`") && error.contains("did you mean `green`?"), "{error}");
}

#[test]
fn reset_reads_the_first_letter_and_every_letter_is_read_once() {
    let mut ball = product(BallPass::new(), &two_sets(), &[("a", "r1"), ("b", "r2")]);
    let start = ball.reset_to(&R1);
    assert_eq!((start.at.q, start.at.frontier, start.visited), (1, Marks(0b10), Marks(0b01)));
    assert_eq!(ball.rounds().missing(), Marks(0b10), "the visit at time 0 counts for the round");
    let step = ball.step(Move::Control(&HOVER), &mut rng());
    assert_eq!((step.from, step.visited, step.fresh), (start.at, Marks(0b01), Marks(0)));
    assert!(!step.closes_round && !step.ends() && step.kind == MoveKind::Control);
    assert_eq!(ball.reset_to(&NOWHERE).at.frontier, Marks(0b11), "another episode knows nothing of the first");
    assert_eq!(ball.rounds().completed(), 0);
}

#[test]
fn the_pure_function_makes_the_same_steps() {
    let automaton = two_sets();
    let mut ball = product(BallPass::new(), &automaton, &[("a", "r1"), ("b", "r2")]);
    let (mut world, mut draws) = (rng(), Rng::new(2, Purpose::Tool));
    ball.reset(Start::Anywhere, &mut world);
    let mut visits = 0;
    for _ in 0..5_000 {
        let action = [draws.uniform_in(-1.0, 1.0), draws.uniform_in(-0.3, 1.0)];
        let step = ball.step(Move::Control(&action), &mut world);
        let mut again = ProductStep::read(ball.embedding(), step.from, step.labels, step.outcome);
        again.closes_round = step.closes_round;
        assert_eq!(step, again);
        visits += usize::from(step.visited.0 != 0);
        if step.ends() {
            assert!(ball.ended());
            ball.reset(Start::Anywhere, &mut world);
        }
    }
    assert!(visits > 20, "the walk met the regions {visits} times");
}

/// F G a | F G b over (a, b): q0 waits; q1 demands a, q2 demands b for ever.
fn settle() -> Arc<Ldgba> {
    let edges = vec![vec![when(0, 0, 0, 0)], vec![when(1, 0, 1, 1)], vec![when(2, 0, 2, 1)]];
    automaton(&["a", "b"], 1, edges, vec![vec![1, 2], vec![], vec![]])
}

#[test]
fn an_epsilon_move_takes_no_time_and_reads_no_letter() {
    let mut ball = product(BallPass::new(), &settle(), &[("a", "r1"), ("b", "r2")]);
    ball.reset_to(&NOWHERE);
    ball.step(Move::Control(&HOVER), &mut rng());
    assert_eq!(ball.epsilon_moves(), [1, 2]);
    let before = ball.environment().state().to_vec();
    let ahead = ball.look_ahead(2).unwrap();
    let step = ball.step(Move::Epsilon(2), &mut rng());
    assert_eq!(step, ahead);
    assert_eq!(step, ProductStep::jump(ball.embedding(), step.from, 2, step.labels));
    assert_eq!((step.from.q, step.to.q, step.kind), (0, 2, MoveKind::Epsilon));
    assert_eq!((step.visited, step.outcome, step.from.frontier), (Marks(0), Outcome::Running, step.to.frontier));
    assert!(step.from.unvisited.contains(2) && !step.to.unvisited.contains(2), "the state jumped to is visited");
    assert_eq!(ball.environment().state(), before);
    assert!(ball.epsilon_moves().is_empty(), "there is no way back");
    assert_eq!(ball.look_ahead(1), None);
    // The letter at (300, 300) is empty: the next step breaks the promise.
    let step = ball.step(Move::Control(&HOVER), &mut rng());
    assert!(step.sink && step.ends() && ball.ended());
}

/// G a | G b with jumps that must come before the first letter.
fn from_the_start() -> Arc<Ldgba> {
    let edges = vec![vec![when(0, 0, 3, 0)], vec![when(1, 0, 1, 1)], vec![when(2, 0, 2, 1)], vec![when(0, 0, 3, 0)]];
    automaton(&["a", "b"], 1, edges, vec![vec![1, 2], vec![], vec![], vec![]])
}

#[test]
fn a_jump_before_the_first_letter_is_offered_at_time_0() {
    let automaton = from_the_start();
    let letters = |sigma| Lasso { prefix: vec![], cycle: vec![Labels(sigma)] };
    assert!(automaton.accepts(&letters(1)) && automaton.accepts(&letters(2)) && !automaton.accepts(&letters(0)));
    let mut ball = product(BallPass::new(), &automaton, &[("a", "r1"), ("b", "r2")]);
    let start = ball.reset_to(&R1);
    assert!(start.sink && !ball.ended(), "the letter leads to the sink, a jump before it does not");
    assert_eq!(ball.epsilon_moves(), [1], "the other jump would fail on the first letter");
    let step = ball.step(Move::Epsilon(1), &mut rng());
    assert_eq!((step.to.q, step.visited), (1, Marks(1)), "the first letter is read after the jump");
    assert!(!ball.step(Move::Control(&HOVER), &mut rng()).ends());
    // Once a move is made, time 0 is over.
    ball.reset_to(&R1);
    assert!(ball.step(Move::Control(&HOVER), &mut rng()).ends());
    ball.reset_to(&NOWHERE);
    assert!(ball.ended() && ball.epsilon_moves().is_empty());
}

#[test]
#[should_panic(expected = "only ε-moves that exist")]
fn an_epsilon_move_that_does_not_exist_is_a_broken_invariant() {
    let mut ball = product(BallPass::new(), &two_sets(), &[("a", "r1"), ("b", "r2")]);
    ball.reset_to(&R1);
    ball.step(Move::Epsilon(2), &mut rng());
}

#[test]
fn a_snapshot_goes_on_bit_for_bit() {
    let mut ball = product(BallPass::new(), &settle(), &[("a", "r1"), ("b", "r2")]);
    let mut world = rng();
    ball.reset(Start::Anywhere, &mut world);
    for moves in 0..20 {
        let text = serde_json::to_string(&ball.snapshot()).unwrap();
        let mut other = product(BallPass::new(), &settle(), &[("a", "r1"), ("b", "r2")]);
        other.restore(&serde_json::from_str(&text).unwrap()).unwrap();
        assert_eq!(other.epsilon_moves(), ball.epsilon_moves());
        assert_eq!(other.snapshot(), ball.snapshot());
        let action = if moves == 10 { Move::Epsilon(1) } else { Move::Control(&[0.1, 0.6]) };
        let mut copy = ball.clone();
        let step = ball.step(action, &mut world.clone());
        assert_eq!(step, other.step(action, &mut world.clone()));
        assert_eq!(step, copy.step(action, &mut world));
        assert_eq!(other.snapshot(), ball.snapshot());
        if ball.ended() {
            break;
        }
    }
    let mut cart = product(CartPole::new(), &settle(), &[("a", "green"), ("b", "yellow")]);
    let mut foreign = ball.snapshot();
    assert!(cart.restore(&foreign).is_ok(), "both have four numbers and the same automaton");
    foreign.at.q = 9;
    assert!(cart.restore(&foreign).unwrap_err().to_string().contains("no such automaton state"));
    foreign.state.pop();
    assert!(cart.restore(&foreign).unwrap_err().to_string().contains("lengths"));
    let mut two = product(BallPass::new(), &two_sets(), &[("a", "r1"), ("b", "r2")]);
    assert!(two.restore(&ball.snapshot()).is_err());
}

#[test]
fn algorithm_1_makes_valid_random_runs() {
    let automaton = settle();
    let mut ball = product(BallPass::new(), &automaton, &[("a", "r1"), ("b", "r2")]);
    let (mut jumped, mut ends) = (0, vec![]);
    for seed in 0..50 {
        let found = run(&mut ball, Start::Anywhere, 300, seed);
        assert_eq!(found, run(&mut ball, Start::Anywhere, 300, seed), "the same seed gives the same run");
        let mut at = found.start.at;
        for state in &found.states {
            assert_eq!(state.step.from, at);
            at = state.step.to;
            let (q, letter) = (state.step.from.q, state.step.labels);
            match state.step.kind {
                MoveKind::Control => assert_eq!(automaton.edge(q, letter).target, at.q),
                MoveKind::Epsilon => assert!(automaton.epsilon(q).contains(&at.q)),
            }
            jumped += usize::from(state.step.kind == MoveKind::Epsilon);
        }
        assert_eq!(found.end == RunEnd::Length, found.states.len() == 300);
        ends.push(found.end);
    }
    assert!(jumped > 10);
    assert!(ends.contains(&RunEnd::Sink));
    let (a, b) = (run(&mut ball, Start::Initial, 100, 1), run(&mut ball, Start::Initial, 100, 2));
    assert_ne!(product_trace_hash(&a), product_trace_hash(&b));
}

#[test]
fn a_run_under_a_policy_counts_rounds() {
    let mut ball = product(BallPass::new(), &two_sets(), &[("a", "r1"), ("b", "r2")]);
    // A controller by hand: towards the region that the round lacks, damped.
    let controller = |product: &EpMdp, control: &mut [f32]| {
        let goal = if product.rounds().missing().has(0) { R1 } else { R2 };
        let state = product.environment().state();
        for axis in 0..2 {
            control[axis] = (goal[axis] - state[axis]) / 150.0 - state[axis + 2] / 200.0 + HOVER[axis];
        }
        Chosen::Control
    };
    let found = run_with(&mut ball, Start::Initial, 1_000, 1, controller);
    assert_eq!((found.end, found.states.len()), (RunEnd::Length, 1_000));
    let closed = found.states.iter().filter(|state| state.step.closes_round).count();
    assert_eq!(found.rounds as usize, closed);
    assert!(closed >= 5, "{closed} rounds");
    let refilled = found.states.iter().filter(|state| state.step.refilled).count();
    assert!(refilled >= closed, "T comes round at least as often: the visit that ends one round already counts for its next");
}
