//! The kernel benchmark's work as a WebAssembly module without imports: `benches/wasm/kernels.mjs` holds the clock.

use std::cell::RefCell;

use ltl_rover::nn::NetworkShape;
use ltl_rover::nn::fused::{Fused, Kernel};
use ltl_rover::nn::workload::Workload;
use ltl_rover::rng::{Purpose, Rng};

thread_local! {
    static WORKLOAD: RefCell<Option<Workload>> = const { RefCell::new(None) };
}

/// Gets ready for batches of `rows` with two hidden layers of `hidden`; `fastest` 0 takes the portable kernel.
#[unsafe(no_mangle)]
pub extern "C" fn prepare(hidden: usize, rows: usize, fastest: u32) {
    let shape = NetworkShape::new(8, 2, &[hidden, hidden]);
    let kernel = if fastest == 0 { Kernel::PORTABLE } else { Kernel::fastest() };
    let module = Fused::with_kernel(&shape, &mut Rng::new(1, Purpose::Initialisation), kernel);
    WORKLOAD.set(Some(Workload::new(Box::new(module), rows, 1)));
}

/// Does `count` full updates; returns the last critic loss.
#[unsafe(no_mangle)]
pub extern "C" fn updates(count: usize) -> f32 {
    WORKLOAD.with_borrow_mut(|workload| {
        let workload = workload.as_mut().expect("`prepare` comes first");
        (0..count).map(|_| workload.update().critic).last().unwrap_or(0.0)
    })
}

/// Takes `count` actions; returns the last.
#[unsafe(no_mangle)]
pub extern "C" fn acts(count: usize) -> f32 {
    WORKLOAD.with_borrow_mut(|workload| {
        let workload = workload.as_mut().expect("`prepare` comes first");
        (0..count).map(|_| workload.act()).last().unwrap_or(0.0)
    })
}
