//! The translator as a WebAssembly module without imports: `benches/wasm/translate.mjs` holds the clock.

use ltl_rover::automaton::translate::{TranslateOptions, translate};
use ltl_rover::ltl::Formula;
use std::cell::RefCell;

thread_local! {
    static TEXT: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static FORMULA: RefCell<Formula> = const { RefCell::new(Formula::True) };
    static SIZE: RefCell<[u32; 2]> = const { RefCell::new([0; 2]) };
}

/// Room for a formula of `length` bytes; where to write it.
#[unsafe(no_mangle)]
pub extern "C" fn room(length: usize) -> *mut u8 {
    TEXT.with_borrow_mut(|text| {
        *text = vec![0; length];
        text.as_mut_ptr()
    })
}

/// Reads the formula that was written; 1 if it is one.
#[unsafe(no_mangle)]
pub extern "C" fn read() -> u32 {
    let text = TEXT.with_borrow(|text| String::from_utf8_lossy(text).into_owned());
    match Formula::parse(&text) {
        Ok(formula) => {
            FORMULA.set(formula);
            1
        }
        Err(_) => 0,
    }
}

/// Translates it; the number of states from which something is accepted, at least one; −1 if the budget is used up.
#[unsafe(no_mangle)]
pub extern "C" fn run() -> i32 {
    FORMULA.with_borrow(|formula| match translate(formula, &TranslateOptions::default()) {
        Ok(automaton) => {
            let statistics = automaton.statistics();
            SIZE.set([statistics.sets as u32, statistics.epsilon as u32]);
            (statistics.states - statistics.sinks).max(1) as i32
        }
        Err(_) => -1,
    })
}

/// The accepting sets of the last automaton.
#[unsafe(no_mangle)]
pub extern "C" fn sets() -> u32 {
    SIZE.with_borrow(|size| size[0])
}

/// The ε-jumps of the last automaton.
#[unsafe(no_mangle)]
pub extern "C" fn jumps() -> u32 {
    SIZE.with_borrow(|size| size[1])
}
