//! The benchmark's work as a WebAssembly module without imports: `benches/wasm/kernels.mjs` holds the clock.

use std::cell::RefCell;

use ltl_rover::nn::NetworkShape;
use ltl_rover::nn::fused::Fused;
use ltl_rover::nn::workload::Workload;
use ltl_rover::rng::{Purpose, Rng};
use ltl_rover::task::{Setup, Task};
use ltl_rover::train::Trainer;

thread_local! {
    static WORKLOADS: RefCell<Vec<Workload>> = const { RefCell::new(Vec::new()) };
    static TRAINER: RefCell<Option<Trainer>> = const { RefCell::new(None) };
}

/// Gets ready for updates of `rows` samples with two hidden layers of `hidden`; returns the workload's number.
#[unsafe(no_mangle)]
pub extern "C" fn prepare(observation: usize, action: usize, hidden: usize, rows: usize) -> usize {
    let shape = NetworkShape::new(observation, action, &[hidden, hidden]);
    let module = Fused::new(&shape, &mut Rng::new(1, Purpose::Initialisation));
    WORKLOADS.with_borrow_mut(|workloads| {
        workloads.push(Workload::new(Box::new(module), rows, 1));
        workloads.len() - 1
    })
}

/// Does `count` full updates; returns the sum of the critic's losses.
#[unsafe(no_mangle)]
pub extern "C" fn updates(workload: usize, count: usize) -> f32 {
    WORKLOADS.with_borrow_mut(|workloads| (0..count).map(|_| workloads[workload].update().critic).sum())
}

/// Takes `count` actions; returns their sum.
#[unsafe(no_mangle)]
pub extern "C" fn acts(workload: usize, count: usize) -> f32 {
    WORKLOADS.with_borrow_mut(|workloads| (0..count).map(|_| workloads[workload].act()).sum())
}

/// Gets ready to train Ball-Pass with the recipe of the paper, replays filled for a batch.
#[unsafe(no_mangle)]
pub extern "C" fn prepare_trainer() -> usize {
    let task = Task::parse(include_str!("../../specs/ball_pass_b1.toml"), "ball_pass_b1.toml").expect("the task file is tested");
    let setup = Setup::open(task, "paper", &[], Some(include_str!("../../specs/ball_pass_b1.hoa"))).expect("it is tested");
    TRAINER.set(Some(setup.trainer(1)));
    steps(0, 2000);
    0
}

/// Trains `count` steps; returns how many there were in all.
#[unsafe(no_mangle)]
pub extern "C" fn steps(_trainer: usize, count: usize) -> f64 {
    TRAINER.with_borrow_mut(|trainer| {
        let trainer = trainer.as_mut().expect("`prepare_trainer` comes first");
        trainer.ticks().take(count).for_each(|_| {});
        trainer.steps() as f64
    })
}

/// Gets ready for updates as the trainer's modules make them.
#[unsafe(no_mangle)]
pub extern "C" fn prepare_step_update() -> usize {
    let weights: Vec<Vec<usize>> = TRAINER.with_borrow(|trainer| {
        let policy = trainer.as_ref().expect("`prepare_trainer` comes first").learner().policy();
        let actor = policy[0].iter().filter(|tensor| tensor.name.starts_with("actor.") && tensor.name.ends_with(".weight"));
        actor.map(|tensor| tensor.shape.clone()).collect()
    });
    prepare(weights[0][0], weights[weights.len() - 1][1], weights[0][1], 64)
}
