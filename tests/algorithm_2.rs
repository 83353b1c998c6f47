//! Modular DDPG against its definition: one update computed by hand, targets of the right modules, returns of n steps by brute force.

use ltl_rover::agent::{
    ExplorationSettings, Learner, LearnerSettings, ModularDdpg, ModuleMap, NoiseSettings, Replays, Schedule, Sizes, Trace,
    Transition,
};
use ltl_rover::automaton::{EmbeddedState, Embedding, FrontierRule, StateTracking, hoa};
use ltl_rover::env::Outcome;
use ltl_rover::labels::Labels;
use ltl_rover::nn::plain::Plain;
use ltl_rover::nn::{ActorCritic, Batch, Losses, NetworkShape, NetworkTensor, OptimiserSettings};
use ltl_rover::product::{LdgbaReward, Payoff, ProductStep, Reward, RewardSettings, Shaping};
use ltl_rover::rng::{Purpose, Rng};
use std::sync::Arc;

/// `G F a & G F b` with three states, and a sink for `c`.
const AUTOMATON: &str = r#"HOA: v1
States: 4
Start: 0
AP: 3 "a" "b" "c"
Acceptance: 2 Inf(0)&Inf(1)
--BODY--
State: 0
[!2&!0&!1] 0
[!2&0] 1
[!2&!0&1] 2
[2] 3
State: 1 {0}
[!2&!0&!1] 0
[!2&0] 1
[!2&!0&1] 2
[2] 3
State: 2 {1}
[!2&!0&!1] 0
[!2&0] 1
[!2&!0&1] 2
[2] 3
State: 3
[t] 3
--END--
"#;

const SETTINGS: RewardSettings =
    RewardSettings { accepting_discount: 0.9, discount: 0.99, sink_reward: -0.5, shaping: Shaping::None };

fn embedding() -> Arc<Embedding> {
    let automaton = Arc::new(hoa::read(AUTOMATON).unwrap().automaton);
    Arc::new(Embedding::new(automaton, FrontierRule::Refill, StateTracking::Off).unwrap())
}

fn learner_settings(n_step: usize) -> LearnerSettings {
    LearnerSettings {
        n_step,
        batch: 1,
        hidden: vec![5, 4],
        reward_scale: 2.0,
        exploration: ExplorationSettings { noise: NoiseSettings::None, ..ExplorationSettings::default() },
        actor_rate: Schedule::Constant(1e-2),
        critic_rate: Schedule::Constant(1e-2),
        tau: 0.1,
        ..LearnerSettings::default()
    }
}

fn learner(settings: LearnerSettings) -> ModularDdpg {
    let embedding = embedding();
    let reward = Arc::new(LdgbaReward::new(SETTINGS, &embedding).unwrap());
    let engine = |shape: &NetworkShape, rng: &mut Rng| -> Box<dyn ActorCritic> { Box::new(Plain::new(shape, rng)) };
    ModularDdpg::new(settings, embedding, reward, Sizes { observation: 2, control: 1 }, (engine, 7)).unwrap()
}

/// The tensors of module `m` of a learner's record, ready for a twin.
fn module(learner: &ModularDdpg, m: usize) -> Vec<NetworkTensor> {
    let prefix = format!("module.{m}.");
    let tensors = learner.save(Replays::Leave).1.into_iter();
    tensors.filter_map(|t| Some(NetworkTensor { name: t.name.strip_prefix(&prefix)?.to_owned(), ..t })).collect()
}

fn twin(tensors: &[NetworkTensor]) -> Plain {
    // Two observation channels and the two bits of T.
    let mut twin = Plain::new(&NetworkShape::new(4, 1, &[5, 4]), &mut Rng::new(0, Purpose::Tool));
    twin.load(tensors).unwrap();
    twin
}

/// One transition whose x' belongs to another module: the target, the loss and all new parameters, computed from the definition.
#[test]
fn one_update_is_algorithm_2() {
    let mut learner = learner(learner_settings(1));
    let embedding = embedding();
    // (q0, {F_0, F_1}) reads {a}: to q1, F_0 is visited and leaves T.
    let from = embedding.start();
    let step = ProductStep::read(&embedding, from, Labels::only(0), Outcome::Running);
    assert_eq!((from.q, step.to.q, step.to.frontier.0), (0, 1, 0b10));
    let (observation, next, control) = ([0.3f32, -0.2], [0.5f32, 0.1], [0.4f32]);

    let mut q0 = twin(&module(&learner, 0));
    let mut q1 = twin(&module(&learner, 1));
    let mut value = [0.0];
    q1.target_values(&[0.5, 0.1, 0.0, 1.0], &mut value);
    // R(x') = 1 − r_F = 0.1, scaled by 2; γ(x') = r_F = 0.9, since x' is accepting.
    let y = 2.0 * 0.1 + 0.9 * value[0];
    let batch = Batch { observations: &[0.3, -0.2, 1.0, 1.0], actions: &control, targets: &[y] };
    let optimiser = OptimiserSettings { actor_rate: 1e-2, critic_rate: 1e-2, tau: 0.1, ..OptimiserSettings::default() };
    let expected: Losses = q0.update(batch, &optimiser);

    learner.record(&Transition { observation: &observation, labels: Labels::EMPTY, control: &control, step: &step, next: &next });
    let update = learner.update().expect("a batch of one sample is there");
    assert_eq!(update.module, 0, "the module of q_t is updated");
    assert!((update.losses.critic - expected.critic).abs() < 1e-6);
    assert!((update.losses.actor - expected.actor).abs() < 1e-6);
    for (found, expected) in module(&learner, 0).iter().zip(q0.tensors(true)) {
        for (f, e) in found.values.iter().zip(&expected.values) {
            assert!((f - e).abs() < 1e-6, "{}: {f} against {e}", found.name);
        }
    }
    assert_eq!(module(&learner, 1), q1.tensors(true), "no other module changes");
    assert!(learner.update().is_none(), "one update a step");
}

#[test]
fn into_a_sink_the_target_is_the_reward_alone() {
    let mut learner = learner(learner_settings(1));
    let embedding = embedding();
    let step = ProductStep::read(&embedding, embedding.start(), Labels::only(2), Outcome::Running);
    let mut q0 = twin(&module(&learner, 0));
    let batch = Batch { observations: &[0.0, 0.0, 1.0, 1.0], actions: &[1.0], targets: &[2.0 * -0.5] };
    let optimiser = OptimiserSettings { actor_rate: 1e-2, critic_rate: 1e-2, tau: 0.1, ..OptimiserSettings::default() };
    let expected = q0.update(batch, &optimiser);
    let zeros = [0.0, 0.0];
    learner.record(&Transition { observation: &zeros, labels: Labels::EMPTY, control: &[1.0], step: &step, next: &zeros });
    let update = learner.update().unwrap();
    assert!((update.losses.critic - expected.critic).abs() < 1e-6);
}

/// A random path: letters, and whether the environment ended with the last one.
struct Path {
    letters: Vec<Labels>,
    terminated: bool,
}

fn path(rng: &mut Rng, length: usize) -> Path {
    // Letters without `c` mostly, so that paths get long.
    let letters = (0..=length).map(|_| if rng.chance(0.03) { Labels::only(2) } else { Labels(rng.bits() & 3) }).collect();
    Path { letters, terminated: rng.chance(0.3) }
}

/// The return of n steps from step `from` on, by its definition.
fn brute_force(payoffs: &[Payoff], from: usize, n: usize) -> (f32, f32) {
    let window = &payoffs[from..payoffs.len().min(from + n)];
    let reward = (0..window.len()).map(|k| window[..k].iter().map(|p| p.discount).product::<f32>() * window[k].reward).sum();
    (reward, window.iter().map(|p| p.discount).product())
}

/// Every transition of random episodes becomes one sample, whose reward, discount and last state are those of the definition:
/// full windows in the middle, shorter ones at the end, bootstrapped if the end was a time limit.
#[test]
fn returns_of_n_steps_are_their_definition() {
    let embedding = embedding();
    let reward = LdgbaReward::new(SETTINGS, &embedding).unwrap();
    let mut rng = Rng::new(11, Purpose::Tool);
    for round in 0..60 {
        let n = 1 + rng.below(6);
        let mut learner = learner(LearnerSettings { updates_per_step: 0, ..learner_settings(n) });
        let Path { letters, terminated } = path(&mut rng, 1 + round % 17);
        let mut at: EmbeddedState = embedding.read(embedding.start(), Labels::EMPTY).to;
        let mut labels = Labels::EMPTY;
        let (mut payoffs, mut states, mut ended) = (vec![], vec![at], false);
        for (t, &letter) in letters.iter().enumerate() {
            let last = t + 1 == letters.len();
            let outcome = if last && terminated { Outcome::Terminated } else { Outcome::Running };
            let step = ProductStep::read(&embedding, at, letter, outcome);
            let (x, next) = ([t as f32, 0.0], [t as f32 + 1.0, 0.0]);
            learner.record(&Transition { observation: &x, labels, control: &[0.0], step: &step, next: &next });
            payoffs.push(reward.payoff(&step));
            (at, labels) = (step.to, letter);
            states.push(at);
            if step.ends() {
                ended = true;
                break;
            }
        }
        if !ended {
            learner.finish_episode();
        }
        let found = samples(&learner);
        assert_eq!(found.len(), payoffs.len(), "each transition is one sample");
        for (t, reward, discount, next_t, module) in found {
            let (expected_reward, expected_discount) = brute_force(&payoffs, t, n);
            assert!((reward - 2.0 * expected_reward).abs() < 1e-5, "n {n}, t {t}");
            assert!((discount - expected_discount).abs() < 1e-6, "n {n}, t {t}");
            assert_eq!(module, usize::from(states[t].q), "a sample lies in the replay of q_t");
            if discount > 0.0 {
                assert_eq!(next_t, (t + n).min(payoffs.len()), "n {n}, t {t}: bootstrapped at the right state");
            }
        }
    }
}

/// All samples of a learner: time of x (its observation's first number), R, Γ, time of x', module.
fn samples(learner: &ModularDdpg) -> Vec<(usize, f32, f32, usize, usize)> {
    let mut found = vec![];
    for tensor in learner.save(Replays::Keep).1 {
        let Some(m) = tensor.name.strip_prefix("replay.").and_then(|n| n.strip_suffix(".numbers")) else { continue };
        // observation (2), next observation (2), control (1), R, Γ
        for row in tensor.values.chunks_exact(7) {
            found.push((row[0] as usize, row[5], row[6], row[2] as usize, m.parse().unwrap()));
        }
    }
    found
}

/// A segment replayed from another embedded state is what the product would have done from there.
#[test]
fn counterfactual_samples_are_what_the_product_would_have_done() {
    let embedding = embedding();
    let reward = LdgbaReward::new(SETTINGS, &embedding).unwrap();
    let mut rng = Rng::new(12, Purpose::Tool);
    let starts = embedding.reachable(100).unwrap();
    for _ in 0..200 {
        let Path { letters, terminated } = path(&mut rng, 4);
        let mut trace = Trace::new(letters.len(), 1, 1);
        let (mut at, mut labels) = (embedding.start(), Labels::EMPTY);
        for (t, &letter) in letters.iter().enumerate() {
            let last = t + 1 == letters.len();
            let outcome = if last && terminated { Outcome::Terminated } else { Outcome::Running };
            let step = ProductStep::read(&embedding, at, letter, outcome);
            let (x, next) = ([t as f32], [t as f32 + 1.0]);
            trace.push(&Transition { observation: &x, labels, control: &[0.0], step: &step, next: &next });
            (at, labels) = (step.to, letter);
        }
        let other = starts[rng.below(starts.len())];
        let sample = trace.sample(other, &embedding, &reward, 1.0);
        let (mut now, mut payoffs) = (other, vec![]);
        for (t, &letter) in letters.iter().enumerate() {
            let outcome = if t + 1 == letters.len() && terminated { Outcome::Terminated } else { Outcome::Running };
            let step = ProductStep::read(&embedding, now, letter, outcome);
            payoffs.push(reward.payoff(&step));
            now = step.to;
            if step.ends() {
                break;
            }
        }
        let (expected, discount) = brute_force(&payoffs, 0, letters.len());
        assert!((sample.reward - expected).abs() < 1e-6 && (sample.discount - discount).abs() < 1e-6);
        assert_eq!((sample.at, sample.next_at), (other, now));
        assert_eq!(sample.next[0] as usize, payoffs.len());
    }
}

/// Counterfactual samples fill the replays of states that were never visited, and all are consistent with the letter of s.
#[test]
fn counterfactual_replay_teaches_modules_that_were_not_in_charge() {
    let mut settings = learner_settings(1);
    settings.counterfactual.samples = 3;
    let mut learner = learner(LearnerSettings { updates_per_step: 0, modules: ModuleMap::PerEmbedded, ..settings });
    let embedding = embedding();
    let mut at = embedding.read(embedding.start(), Labels::EMPTY).to;
    for t in 0..200 {
        let step = ProductStep::read(&embedding, at, Labels::EMPTY, Outcome::Running);
        let (x, next) = ([t as f32, 0.0], [t as f32 + 1.0, 0.0]);
        learner.record(&Transition { observation: &x, labels: Labels::EMPTY, control: &[0.0], step: &step, next: &next });
        at = step.to;
    }
    // Only q0 reads the empty letter into itself, with each T: {F_0}, {F_1} and both.
    let filled: Vec<&str> =
        (0..learner.modules().len()).filter(|&m| learner.samples_of(m) > 0).map(|m| learner.modules().name(m)).collect();
    assert_eq!(filled.len(), 3, "{filled:?}");
    assert!(filled.iter().all(|name| name.starts_with("q0")), "{filled:?}");
}
