//! Module maps and network inputs: modules per accepting set compete by their values, Fourier features are sines and cosines.

use ltl_rover::agent::{
    Encoder, ExplorationSettings, Learner, LearnerSettings, ModularDdpg, ModuleMap, Modules, NoiseSettings, Policy, Replays,
    Schedule, Situation, Sizes, Transition,
};
use ltl_rover::automaton::{EmbeddedState, Embedding, FrontierRule, Marks, StateTracking, hoa};
use ltl_rover::env::Outcome;
use ltl_rover::labels::Labels;
use ltl_rover::nn::plain::Plain;
use ltl_rover::nn::{ActorCritic, Batch, NetworkShape, NetworkTensor, OptimiserSettings};
use ltl_rover::product::{LdgbaReward, ProductStep, RewardSettings, Shaping};
use ltl_rover::rng::{Purpose, Rng};
use std::sync::Arc;

/// `G F a & G F b & G F c & G !d` with one state and a sink.
const AUTOMATON: &str = r#"HOA: v1
States: 2
Start: 0
AP: 4 "a" "b" "c" "d"
Acceptance: 3 Inf(0)&Inf(1)&Inf(2)
--BODY--
State: 0
[!3&!0&!1&!2] 0
[!3&0] 0 {0}
[!3&!0&1] 0 {1}
[!3&!0&!1&2] 0 {2}
[3] 1
State: 1
[t] 1
--END--
"#;

const REWARD: RewardSettings =
    RewardSettings { accepting_discount: 0.9, discount: 0.99, sink_reward: -0.5, shaping: Shaping::None };

fn embedding() -> Arc<Embedding> {
    let automaton = Arc::new(hoa::read(AUTOMATON).unwrap().automaton);
    Arc::new(Embedding::new(automaton, FrontierRule::Refill, StateTracking::Off).unwrap())
}

fn at(frontier: u32) -> EmbeddedState {
    EmbeddedState { frontier: Marks(frontier), ..embedding().start() }
}

fn learner() -> ModularDdpg {
    let settings = LearnerSettings {
        modules: ModuleMap::PerSet,
        batch: 1,
        hidden: vec![5, 4],
        reward_scale: 2.0,
        exploration: ExplorationSettings { noise: NoiseSettings::None, ..ExplorationSettings::default() },
        actor_rate: Schedule::Constant(1e-2),
        critic_rate: Schedule::Constant(1e-2),
        tau: 0.1,
        ..LearnerSettings::default()
    };
    let embedding = embedding();
    let reward = Arc::new(LdgbaReward::new(REWARD, &embedding).unwrap());
    let engine = |shape: &NetworkShape, rng: &mut Rng| -> Box<dyn ActorCritic> { Box::new(Plain::new(shape, rng)) };
    ModularDdpg::new(settings, embedding, reward, Sizes { observation: 2, control: 1 }, (engine, 7)).unwrap()
}

/// A twin of module `m`: two observation channels, and the one-hot code of two automaton states.
fn twin(learner: &ModularDdpg, m: usize) -> Plain {
    let prefix = format!("module.{m}.");
    let tensors = learner.save(Replays::Leave).1.into_iter();
    let own = tensors.filter_map(|t| Some(NetworkTensor { name: t.name.strip_prefix(&prefix)?.to_owned(), ..t }));
    let mut twin = Plain::new(&NetworkShape::new(4, 1, &[5, 4]), &mut Rng::new(0, Purpose::Tool));
    twin.load(&own.collect::<Vec<_>>()).unwrap();
    twin
}

#[test]
fn the_module_that_promises_the_most_is_in_charge() {
    let mut learner = learner();
    assert_eq!((0..3).map(|m| learner.modules().name(m).to_owned()).collect::<Vec<_>>(), ["F0", "F1", "F2"]);
    let mut twins: Vec<Plain> = (0..3).map(|m| twin(&learner, m)).collect();
    let mut rng = Rng::new(3, Purpose::Tool);
    let mut chosen = [0; 3];
    for round in 0..200u32 {
        let observation = [rng.uniform_in(-3.0, 3.0), rng.uniform_in(-3.0, 3.0)];
        let frontier = 1 + round % 7;
        let input = [observation[0], observation[1], 1.0, 0.0];
        let value = |twin: &mut Plain| {
            let mut value = [0.0];
            twin.values(&input, &mut value);
            value[0]
        };
        let sets = (0..3).filter(|j| frontier >> j & 1 == 1);
        let (best, most) = sets.map(|j| (j, value(&mut twins[j]))).max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        let mut control = [0.0];
        learner.act(&Situation { observation: &observation, at: at(frontier), jumps: &[] }, &mut control);
        let mut expected = [0.0];
        twins[best].act(&input, &mut expected);
        assert_eq!((learner.acting(), learner.in_charge(&observation, at(frontier))), (Some(best), Some(best)));
        assert!((control[0] - expected[0]).abs() < 1e-6);
        // Values are reported in units of unscaled rewards.
        assert!((learner.value(&observation, at(frontier)).unwrap() - most / 2.0).abs() < 1e-6);
        chosen[best] += 1;
    }
    assert!(chosen.iter().all(|&n| n > 0), "every module has its places: {chosen:?}");
    let sink = EmbeddedState { q: 1, ..at(7) };
    assert_eq!((learner.in_charge(&[0.0, 0.0], sink), learner.value(&[0.0, 0.0], sink)), (None, None));
}

/// From T = {F_0}, F_0 is visited: T becomes {F_1, F_2}, and y = R + r_F·max(V'_1, V'_2).
#[test]
fn targets_take_the_greatest_value_of_those_that_compete() {
    let mut learner = learner();
    let step = ProductStep::read(&embedding(), at(0b001), Labels::only(0), Outcome::Running);
    assert_eq!(step.to.frontier.0, 0b110);
    let (observation, next, control) = ([0.3f32, -0.2], [0.5f32, 0.1], [0.4f32]);
    let values = [1, 2].map(|m| {
        let mut value = [0.0];
        twin(&learner, m).target_values(&[0.5, 0.1, 1.0, 0.0], &mut value);
        value[0]
    });
    assert_ne!(values[0], values[1]);
    let y = 2.0 * 0.1 + 0.9 * values[0].max(values[1]);
    let batch = Batch { observations: &[0.3, -0.2, 1.0, 0.0], actions: &control, targets: &[y] };
    let optimiser = OptimiserSettings { actor_rate: 1e-2, critic_rate: 1e-2, tau: 0.1, ..OptimiserSettings::default() };
    let expected = twin(&learner, 0).update(batch, &optimiser);
    learner.record(&Transition { observation: &observation, labels: Labels::EMPTY, control: &control, step: &step, next: &next });
    let update = learner.update().expect("a batch of one sample is there");
    assert_eq!(update.module, 0);
    assert!((update.losses.critic - expected.critic).abs() < 1e-6);
}

/// A transition in x with T = {F_1, F_2} is a sample of one of the two, as if that set were all of T.
#[test]
fn one_of_those_that_compete_learns_from_a_transition() {
    let mut learner = learner();
    let step = ProductStep::read(&embedding(), at(0b110), Labels::EMPTY, Outcome::Running);
    for _ in 0..200 {
        let transition =
            Transition { observation: &[0.0, 0.0], labels: Labels::EMPTY, control: &[0.0], step: &step, next: &[0.0, 0.0] };
        learner.record(&transition);
    }
    let samples = [0, 1, 2].map(|m| learner.samples_of(m));
    assert!(samples[0] == 0 && samples[1] + samples[2] == 200 && samples.iter().skip(1).all(|&n| n > 60), "{samples:?}");
}

#[test]
fn after_a_round_of_the_printed_rule_every_set_may_come_next() {
    let modules = Modules::new(ModuleMap::PerSet, &embedding()).unwrap();
    assert_eq!(modules.candidates(at(0)).map(|(m, _)| m).collect::<Vec<_>>(), [0, 1, 2]);
    let one: Vec<_> = modules.candidates(at(0b100)).collect();
    assert_eq!((one, modules.of(at(0b100)), modules.of(at(0b110))), (vec![(2, at(0b100))], Some(2), None));
}

#[test]
fn an_automaton_that_accepts_everything_has_one_set_and_one_module() {
    let text = "HOA: v1\nStates: 1\nStart: 0\nAP: 1 \"a\"\nAcceptance: 0 t\n--BODY--\nState: 0\n[t] 0\n--END--\n";
    let automaton = Arc::new(hoa::read(text).unwrap().automaton);
    let embedding = Embedding::new(automaton.clone(), FrontierRule::Refill, StateTracking::Off).unwrap();
    // The reader gives an acceptance without sets one that is always met.
    assert_eq!(automaton.sets(), 1);
    assert_eq!(Modules::new(ModuleMap::PerSet, &embedding).unwrap().len(), 1);
}

#[test]
fn fourier_features_are_sines_and_cosines() {
    let embedding = embedding();
    let encoder = Encoder::new(ModuleMap::PerState, &embedding, 2).with_fourier_features(7);
    let observation = [0.37f32, -0.81];
    let mut input = vec![];
    encoder.push(&observation, at(0b101), &mut input);
    assert_eq!((input.len(), encoder.len()), (2 + 2 * 2 * 7 + 3, 2 + 2 * 2 * 7 + 3));
    assert_eq!((&input[..2], &input[30..]), (&observation[..], &[1.0, 0.0, 1.0][..]));
    for (i, &o) in observation.iter().enumerate() {
        for k in 0..7 {
            let angle = f64::from(o) * std::f64::consts::FRAC_PI_2 * f64::from(1 << k);
            let found = &input[2 + i * 14 + 2 * k..][..2];
            assert!((f64::from(found[0]) - angle.sin()).abs() < 1e-4 && (f64::from(found[1]) - angle.cos()).abs() < 1e-4);
        }
    }
}
