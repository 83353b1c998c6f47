//! Paths recorded once: environments and automata walk bit for bit the same way on every target (native here, wasm under
//! `wasm-pack test --node -- --no-default-features --test golden_trace`).

use ltl_rover::env::map::RoverMap;
use ltl_rover::env::{BallPass, CartPole, Rover, trace_hash};
use std::sync::Arc;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test;

#[cfg_attr(target_arch = "wasm32", wasm_bindgen_test)]
#[cfg_attr(not(target_arch = "wasm32"), test)]
fn environments_walk_the_recorded_paths() {
    let rover = |name| Rover::new(Arc::new(RoverMap::from_json(RoverMap::shipped(name).unwrap(), None).unwrap()));
    let found = [
        trace_hash(&mut BallPass::new(), 1, 5_000),
        trace_hash(&mut CartPole::new(), 1, 5_000),
        trace_hash(&mut rover("melas"), 1, 5_000),
        trace_hash(&mut rover("victoria"), 1, 5_000),
    ];
    assert_eq!(
        found,
        [0x2d52_5125_4aed_5547, 0x17fb_69c5_4f9f_845e, 0x7e21_7e03_1914_3d76, 0x6f86_fd81_36fe_3539],
        "{found:#x?}"
    );
}
