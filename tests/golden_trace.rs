//! Paths recorded once: environments and products walk bit for bit the same way on every target (native here, wasm under
//! `make test-wasm`).

use ltl_rover::automaton::{Embedding, FrontierRule, StateTracking, hoa};
use ltl_rover::env::{BallPass, CartPole, Current, Environment, Islands, Rover, trace_hash};
use ltl_rover::product::{EpMdp, Renaming, Start, product_trace_hash, run};
use std::sync::Arc;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test;

#[cfg_attr(target_arch = "wasm32", wasm_bindgen_test)]
#[cfg_attr(not(target_arch = "wasm32"), test)]
fn environments_walk_the_recorded_paths() {
    let rover = |name| Rover::shipped(name).unwrap();
    let found = [
        trace_hash(&mut BallPass::new(), 1, 5_000),
        trace_hash(&mut CartPole::new(), 1, 5_000),
        trace_hash(&mut rover("melas"), 1, 5_000),
        trace_hash(&mut rover("victoria"), 1, 5_000),
        trace_hash(&mut Islands::new(Current::AtA), 1, 5_000),
    ];
    let recorded =
        [0x2d52_5125_4aed_5547, 0x17fb_69c5_4f9f_845e, 0x7e21_7e03_1914_3d76, 0x6f86_fd81_36fe_3539, 0xcd2e_2caf_945b_3467];
    assert_eq!(found, recorded, "{found:#x?}");
}

/// G F p & G F q, marks on the transitions.
const BOTH: &str = r#"HOA: v1
States: 1
Start: 0
AP: 2 "p" "q"
Acceptance: 2 Inf(0) & Inf(1)
--BODY--
State: 0
[0 & !1] 0 {0}
[!0 & 1] 0 {1}
[!0 & !1] 0
[0 & 1] 0 {0 1}
--END--
"#;

#[cfg_attr(target_arch = "wasm32", wasm_bindgen_test)]
#[cfg_attr(not(target_arch = "wasm32"), test)]
fn products_walk_the_recorded_paths() {
    let walk = |environment: Box<dyn Environment>, p: &str, q: &str| {
        let automaton = hoa::read(BOTH).unwrap().automaton;
        let embedding = Embedding::new(Arc::new(automaton), FrontierRule::Refill, StateTracking::On).unwrap();
        let renaming = Renaming::from([("p".into(), p.into()), ("q".into(), q.into())]);
        let mut product = EpMdp::new(environment, Arc::new(embedding), &renaming).unwrap();
        let run = run(&mut product, Start::Anywhere, 2_000, 7);
        (run.rounds, product_trace_hash(&run))
    };
    let found = [
        walk(Box::new(Islands::new(Current::None)), "a", "b"),
        walk(Box::new(Rover::shipped("melas").unwrap()), "m1", "m1"),
        walk(Box::new(CartPole::new()), "yellow", "unsafe"),
    ];
    let recorded = [(3, 0xfe43_198a_5786_dae6), (0, 0xdb25_b48c_7713_22da), (0, 0x22fa_bfad_94ae_c99d)];
    assert_eq!(found, recorded, "{found:#x?}");
}

/// The same formula gives the same bytes on every target.
#[cfg_attr(target_arch = "wasm32", wasm_bindgen_test)]
#[cfg_attr(not(target_arch = "wasm32"), test)]
fn formulas_give_the_recorded_automata() {
    use ltl_rover::automaton::translate::{Acceptance, TranslateOptions, translate};
    use ltl_rover::ltl::families;
    let hash = |text: &str, start: u64| text.bytes().fold(start, |h, b| (h ^ u64::from(b)).wrapping_mul(0x100_0000_01b3));
    let found = [Acceptance::Transition, Acceptance::State].map(|acceptance| {
        let options = TranslateOptions { acceptance, ..TranslateOptions::default() };
        families::all().into_iter().flat_map(|family| family.formulas).fold(0xcbf2_9ce4_8422_2325, |sum, formula| {
            let automaton = translate(&formula, &options).expect("the families are within the budget");
            hash(&hoa::write(&automaton, &hoa::WriteOptions::default()).expect("they are small"), sum)
        })
    });
    assert_eq!(found, [0xd7cf_e7d5_e788_4c7d, 0x5ea2_2c69_d148_c26d], "{found:#x?}");
}
