//! The plain learner against finite differences and against arithmetic done by hand.

use super::*;
use crate::nn::actor_critic::{Critics, LayerNorm};
use crate::nn::record::Record;
use crate::nn::tensors::tensor_shapes;
use crate::rng::Purpose;

fn shapes() -> Vec<NetworkShape> {
    let mut shapes = Vec::new();
    for hidden in [vec![5], vec![7, 6], vec![4, 5, 3]] {
        for critics in [Critics::One, Critics::Twin] {
            for layer_norm in [LayerNorm::None, LayerNorm::Critic, LayerNorm::Both] {
                shapes.push(NetworkShape { critics, layer_norm, ..NetworkShape::new(3, 2, &hidden) });
            }
        }
    }
    shapes
}

/// Parameters all of about size 1, so that no derivative is small by accident.
fn spread(shape: &NetworkShape, rng: &mut Rng) -> Plain {
    let mut plain = Plain::new(shape, rng);
    let mut tensors = plain.tensors(false);
    tensors.iter_mut().flat_map(|tensor| &mut tensor.values).for_each(|value| *value = rng.uniform_in(-1.0, 1.0));
    plain.load(&tensors).unwrap();
    plain
}

fn numbers(count: usize, rng: &mut Rng) -> Vec<f32> {
    (0..count).map(|_| rng.uniform_in(-1.0, 1.0)).collect()
}

/// Compares `gradient` with central differences of `loss` in every parameter that `tensors` finds in the module. A difference
/// across a ReLU's kink is spoilt, so the better of two steps counts.
fn check_gradient(
    plain: &mut Plain,
    tensors: fn(&mut Plain) -> &mut Vec<Vec<f32>>,
    gradient: &[Vec<f64>],
    loss: &dyn Fn(&Plain) -> f64,
) {
    for (tensor, derivatives) in gradient.iter().enumerate() {
        for (i, &derivative) in derivatives.iter().enumerate() {
            let middle = tensors(plain)[tensor][i];
            let mut at = |offset: f32| {
                tensors(plain)[tensor][i] = middle + offset;
                let result = (f64::from(middle + offset), loss(plain));
                tensors(plain)[tensor][i] = middle;
                result
            };
            let errors = [-18, -20].map(|exponent| {
                let step = libm::ldexpf(1.0, exponent);
                let ((low, below), (high, above)) = (at(-step), at(step));
                ((above - below) / (high - low) - derivative).abs()
            });
            let error = errors[0].min(errors[1]);
            assert!(error <= 1e-6 * (1.0 + derivative.abs()), "tensor {tensor}[{i}]: {derivative} is off by {error}");
        }
    }
}

#[test]
fn gradients_are_the_finite_differences_of_the_losses() {
    let mut rng = Rng::new(1, Purpose::Tool);
    for shape in shapes() {
        let mut plain = spread(&shape, &mut rng);
        let (observations, actions, targets) = (numbers(15, &mut rng), numbers(10, &mut rng), numbers(5, &mut rng));
        let batch = Batch { observations: &observations, actions: &actions, targets: &targets };
        for i in 0..plain.critics.len() {
            let find: fn(&mut Plain) -> &mut Vec<Vec<f32>> = match i {
                0 => |plain| &mut plain.critics[0].network.tensors,
                _ => |plain| &mut plain.critics[1].network.tensors,
            };
            let (_, gradient) = plain.critic_gradient(&plain.critics[i].network, batch);
            check_gradient(&mut plain, find, &gradient, &|plain| plain.critic_gradient(&plain.critics[i].network, batch).0);
        }
        for penalty in [0.0, 0.7] {
            let (_, gradient) = plain.actor_gradient(&observations, penalty);
            let find: fn(&mut Plain) -> &mut Vec<Vec<f32>> = |plain| &mut plain.actor.network.tensors;
            let squares = |plain: &Plain| -> f64 {
                let rows = observations.chunks_exact(3).map(|x| plain.actor.network.forward(&wide(x)));
                rows.map(|trace| trace.output().iter().map(|a| libm::atanh(*a)).map(|z| z * z).sum::<f64>()).sum::<f64>() / 5.0
            };
            let loss = |plain: &Plain| plain.actor_gradient(&observations, penalty).0 + penalty * squares(plain);
            check_gradient(&mut plain, find, &gradient, &loss);
        }
    }
}

#[test]
fn losses_are_those_of_values_and_targets() {
    let mut rng = Rng::new(2, Purpose::Tool);
    let shape = NetworkShape { critics: Critics::Twin, ..NetworkShape::new(3, 2, &[6, 6]) };
    let mut plain = spread(&shape, &mut rng);
    let observations = numbers(12, &mut rng);
    let mut actions = vec![0.0; 8];
    plain.act(&observations, &mut actions);
    // Both critics equal, batch of the actor's own actions: then the critic's loss is that of `values`.
    plain.critics[1].network = plain.critics[0].network.clone();
    let mut values = vec![0.0; 4];
    plain.values(&observations, &mut values);
    let settings = OptimiserSettings { critic_rate: 0.0, actor_rate: 0.0, ..OptimiserSettings::default() };
    let batch = Batch { observations: &observations, actions: &actions, targets: &[0.5, -0.5, 0.0, 2.0] };
    let losses = plain.update(batch, &settings);
    let expected: f32 = values.iter().zip(batch.targets).map(|(q, y)| (q - y) * (q - y) / 4.0).sum();
    assert!((losses.critic - expected).abs() < 1e-5);
    assert!((losses.actor + values.iter().sum::<f32>() / 4.0).abs() < 1e-5);
}

#[test]
fn target_values_are_the_smaller_of_the_twins_for_the_target_actions() {
    let mut rng = Rng::new(3, Purpose::Tool);
    let shape = NetworkShape { critics: Critics::Twin, ..NetworkShape::new(3, 2, &[16]) };
    let mut plain = spread(&shape, &mut rng);
    let observations = numbers(60, &mut rng);
    let (mut actions, mut values, mut together) = (vec![0.0; 40], vec![0.0; 20], vec![0.0; 20]);
    plain.target_act(&observations, &mut actions);
    // The second critic is the first, mirrored at its mean value of these actions: each is the smaller one somewhere.
    plain.critics.truncate(1);
    plain.target_action_values(&observations, &actions, &mut values);
    let mean = values.iter().sum::<f32>() / 20.0;
    plain.critics.push(plain.critics[0].clone());
    let mirrored = &mut plain.critics[1].target.tensors;
    mirrored[2].iter_mut().for_each(|weight| *weight = -*weight);
    mirrored[3][0] = 2.0 * mean - mirrored[3][0];
    plain.target_action_values(&observations, &actions, &mut values);
    plain.target_values(&observations, &mut together);
    let mut chosen = [0, 0];
    for (row, (split, whole)) in values.iter().zip(&together).enumerate() {
        assert!((split - whole).abs() < 1e-5);
        let input = joined(&observations[3 * row..3 * row + 3], &wide(&actions[2 * row..2 * row + 2]));
        let both = [0, 1].map(|i| plain.critics[i].target.forward(&input).output()[0] as f32);
        assert_eq!(*split, both[0].min(both[1]));
        chosen[usize::from(both[1] < both[0])] += 1;
    }
    assert!(chosen.iter().all(|&count| count > 0), "both critics decide somewhere");
}

#[test]
fn adam_takes_the_steps_of_its_algorithm() {
    let shape = NetworkShape::new(1, 1, &[1]);
    let mut network = Network::new(shape.widths(Role::Critic), Output::Linear);
    let mut adam = Adam::new(&network);
    let settings = OptimiserSettings { beta1: 0.5, beta2: 0.75, epsilon: 1.0, ..OptimiserSettings::default() };
    let mut gradient = network.zeros();
    gradient[1][0] = 4.0;
    // t = 1: m = 2, v = 4, unbiased 4 and 16, step 0.5·4/(4+1).
    adam.step(&mut network, &gradient, 0.5, &settings);
    assert_eq!(network.tensors[1][0], -0.4);
    // t = 2: m = 1 − 2, v = 3 + 4, unbiased −4/3 and 16, step 0.5·(−4/3)/5.
    gradient[1][0] = -4.0;
    adam.step(&mut network, &gradient, 0.5, &settings);
    assert!((network.tensors[1][0] - (-0.4 + 0.5 * 4.0 / 15.0)).abs() < 1e-7);
    assert_eq!((adam.m[1][0], adam.v[1][0], adam.steps), (-1.0, 7.0, 2));
    assert!(network.tensors[0].iter().all(|&weight| weight == 0.0), "no gradient, no step");
}

#[test]
fn targets_follow_by_tau() {
    let mut rng = Rng::new(4, Purpose::Tool);
    let mut plain = spread(&NetworkShape::new(2, 1, &[16]), &mut rng);
    let before = plain.clone();
    let batch = Batch { observations: &[0.3, -0.7], actions: &[0.1], targets: &[1.0] };
    plain.update(batch, &OptimiserSettings { tau: 0.25, ..OptimiserSettings::default() });
    for (new, old) in [(&plain.actor, &before.actor), (&plain.critics[0], &before.critics[0])] {
        let pairs = new.target.tensors.iter().flatten().zip(new.network.tensors.iter().flatten());
        for ((target, own), old) in pairs.zip(old.target.tensors.iter().flatten()) {
            assert!((target - (0.25 * own + 0.75 * old)).abs() < 1e-6);
        }
        assert_ne!(new.network.tensors, old.network.tensors);
    }
}

#[test]
fn a_record_carries_everything_over() {
    let mut rng = Rng::new(5, Purpose::Tool);
    for shape in shapes() {
        let mut first = spread(&shape, &mut rng);
        let (observations, actions, targets) = (numbers(15, &mut rng), numbers(10, &mut rng), numbers(5, &mut rng));
        let batch = Batch { observations: &observations, actions: &actions, targets: &targets };
        first.update(batch, &OptimiserSettings::default());
        let tensors = first.tensors(true);
        let listed: Vec<_> = tensors.iter().map(|tensor| (tensor.name.clone(), tensor.shape.clone())).collect();
        assert_eq!(listed, tensor_shapes(&shape, true));
        let bytes = Record { metadata: [].into(), tensors }.to_bytes().unwrap();
        let mut second = Plain::new(&shape, &mut Rng::new(9, Purpose::Tool));
        second.load(&Record::from_bytes(&bytes).unwrap().tensors).unwrap();
        for plain in [&mut first, &mut second] {
            plain.update(batch, &OptimiserSettings::default());
        }
        assert_eq!(first.tensors(true), second.tensors(true));
    }
}

#[test]
fn what_does_not_fit_is_refused_and_changes_nothing() {
    let mut plain = Plain::new(&NetworkShape::new(2, 1, &[3]), &mut Rng::new(6, Purpose::Initialisation));
    let before = plain.tensors(true);
    let good = NetworkTensor { name: "actor.0.bias".into(), shape: vec![3], values: vec![1.0; 3] };
    let unknown = NetworkTensor { name: "actor.7.bias".into(), ..good.clone() };
    let error = plain.load(&[good.clone(), unknown]).unwrap_err();
    assert_eq!(error, "tensor `actor.7.bias` is not one of this module's networks");
    let wrong = NetworkTensor { name: "critic.0.weight".into(), ..good.clone() };
    let error = plain.load(&[good, wrong]).unwrap_err();
    assert_eq!(error, "tensor `critic.0.weight` has shape [3]; this module's has [3, 3]");
    assert_eq!(plain.tensors(true), before);
    assert!(NetworkShape { hidden: vec![], ..plain.shape().clone() }.check().is_err());
    assert!(NetworkShape { hidden: vec![0], ..plain.shape().clone() }.check().is_err());
}

#[test]
fn first_parameters_lie_in_their_ranges() {
    let shape = NetworkShape { layer_norm: LayerNorm::Critic, ..NetworkShape::new(14, 2, &[100, 64]) };
    let tensors = initial_tensors(&shape, &mut Rng::new(7, Purpose::Initialisation));
    let range = |name: &str| {
        let tensor = tensors.iter().find(|tensor| tensor.name == name).unwrap();
        tensor.values.iter().fold((f32::MAX, f32::MIN), |(low, high), &value| (low.min(value), high.max(value)))
    };
    for (name, bound) in [("critic.0.weight", 0.25), ("critic.1.weight", 0.1), ("critic.2.weight", 3e-3), ("actor.1.bias", 0.1)] {
        let (low, high) = range(name);
        assert!(-bound <= low && low < -0.8 * bound && 0.8 * bound < high && high <= bound, "{name}: {low} … {high}");
    }
    assert_eq!((range("critic.0.gain"), range("critic.1.shift")), ((1.0, 1.0), (0.0, 0.0)));
    let value = |name: &str| &tensors.iter().find(|tensor| tensor.name == name).unwrap().values;
    assert_eq!(value("actor.0.weight"), value("actor_target.0.weight"));
}
