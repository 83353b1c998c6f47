//! The kernel of WebAssembly's simd128 against the portable one and the plain networks, under Node.
#![cfg(target_arch = "wasm32")]

use ltl_rover::nn::fused::{Fused, Kernel};
use ltl_rover::nn::plain::Plain;
use ltl_rover::nn::{ActorCritic, Batch, Critics, LayerNorm, NetworkShape, OptimiserSettings};
use ltl_rover::rng::{Purpose, Rng};
use wasm_bindgen_test::wasm_bindgen_test;

/// Everything a module computes from data that depend on the seed only: actions, values, losses, and all tensors after updates.
fn all_numbers(module: &mut dyn ActorCritic, rows: usize) -> Vec<Vec<f32>> {
    let shape = module.shape().clone();
    let mut rng = Rng::new(2, Purpose::Tool);
    let mut numbers = |count: usize| -> Vec<f32> { (0..count).map(|_| rng.uniform_in(-1.0, 1.0)).collect() };
    let settings = OptimiserSettings { epsilon: 1e-4, tau: 0.1, saturation_penalty: 0.05, ..OptimiserSettings::default() };
    let mut losses = Vec::new();
    for _ in 0..5 {
        let (observations, actions) = (numbers(rows * shape.observation), numbers(rows * shape.action));
        let batch = Batch { observations: &observations, actions: &actions, targets: &numbers(rows) };
        let both = module.update(batch, &settings);
        losses.extend([both.critic, both.actor]);
    }
    let observations = numbers(rows * shape.observation);
    let (mut actions, mut values) = (vec![0.0; rows * shape.action], vec![0.0; rows]);
    module.act(&observations, &mut actions);
    module.target_values(&observations, &mut values);
    let tensors = module.tensors(false).into_iter().map(|tensor| tensor.values);
    [losses, actions, values].into_iter().chain(tensors).collect()
}

#[wasm_bindgen_test]
fn simd128_agrees_with_the_portable_kernel_and_the_plain_networks() {
    assert_eq!(Kernel::fastest().name(), "simd128", "the module is built with simd128");
    let options = |critics, layer_norm, shape| NetworkShape { critics, layer_norm, ..shape };
    for (shape, rows) in [
        (NetworkShape::new(8, 2, &[64, 64]), 64),
        (NetworkShape::new(5, 1, &[7]), 1),
        (NetworkShape::new(11, 3, &[20, 33, 9]), 13),
        (options(Critics::Twin, LayerNorm::Both, NetworkShape::new(6, 5, &[24, 17])), 10),
    ] {
        let init = || Rng::new(1, Purpose::Initialisation);
        let plain = all_numbers(&mut Plain::new(&shape, &mut init()), rows);
        for kernel in [Kernel::fastest(), Kernel::PORTABLE] {
            let fused = all_numbers(&mut Fused::with_kernel(&shape, &mut init(), kernel), rows);
            for (i, (ours, theirs)) in fused.iter().zip(&plain).enumerate() {
                let size = theirs.iter().fold(1e-2f32, |size, x| size.max(x.abs()));
                let apart = ours.iter().zip(theirs).fold(0.0f32, |apart, (a, b)| apart.max((a - b).abs()));
                assert!(apart <= 1e-4 * size, "{} {shape:?}: numbers {i} are off by {apart:e}", kernel.name());
            }
        }
    }
}
