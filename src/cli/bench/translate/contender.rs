//! Who translates: this program, or its WebAssembly build under Node.

use super::super::node::Node;
use crate::automaton::translate::{Spent, TranslateOptions, translate_counting};
use crate::ltl::Formula;
use std::path::Path;
use std::time::Instant;

/// The script that holds Node's clock.
const SCRIPT: &str = include_str!("../../../../benches/wasm/translate.mjs");

/// What one translation came to; an error is the budget's message.
pub struct Outcome {
    /// Seconds, the best of the rounds.
    pub seconds: f64,
    /// The automaton's live states, sets and jumps and what was spent, or why there is none.
    pub result: Result<Size, String>,
}

/// How large an automaton is, and what it took.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Size {
    pub states: usize,
    pub sets: usize,
    pub jumps: usize,
    pub spent: Spent,
}

/// Somebody who translates.
pub trait Translates {
    /// For the table.
    fn name(&self) -> &'static str;
    /// Translates `formula` `rounds` times.
    fn best(&mut self, formula: &Formula, rounds: u32) -> Result<Outcome, String>;
}

/// This program.
pub struct Native;

impl Translates for Native {
    fn name(&self) -> &'static str {
        "native"
    }

    fn best(&mut self, formula: &Formula, rounds: u32) -> Result<Outcome, String> {
        let mut seconds = f64::INFINITY;
        let before = processor_time();
        let mut result = Err(String::new());
        for _ in 0..rounds {
            let start = Instant::now();
            let translated = translate_counting(formula, &TranslateOptions::default(), &|| false);
            seconds = seconds.min(start.elapsed().as_secs_f64());
            result = translated.map_err(|error| error.to_string()).map(|(automaton, spent)| {
                let statistics = automaton.statistics();
                let states = (statistics.states - statistics.sinks).max(1);
                Size { states, sets: statistics.sets, jumps: statistics.epsilon, spent }
            });
        }
        // On a busy machine long translations are interrupted; what they took of the processor is their time. The system counts it in ticks of
        // some milliseconds, so it must be long.
        let spent = processor_time().zip(before).map(|(after, before)| after - before).filter(|spent| *spent > 0.05);
        Ok(Outcome { seconds: spent.map_or(seconds, |spent| seconds.min(spent / f64::from(rounds))), result })
    }
}

/// Seconds for which this thread had a processor, where the system tells.
fn processor_time() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(text.split_whitespace().next()?.parse::<f64>().ok()? * 1e-9)
}

/// The translator's build, `benches/wasm/translate.rs`, under Node.
pub struct WebAssembly(Node);

impl WebAssembly {
    /// Starts Node with `module`.
    ///
    /// # Errors
    /// If the file is not there or Node does not start.
    pub fn start(module: &Path) -> Result<WebAssembly, String> {
        Node::start(module, SCRIPT).map(WebAssembly)
    }
}

impl Translates for WebAssembly {
    fn name(&self) -> &'static str {
        "wasm"
    }

    fn best(&mut self, formula: &Formula, rounds: u32) -> Result<Outcome, String> {
        let question = serde_json::json!({ "formula": formula.to_string(), "rounds": rounds });
        let answer = self.0.ask(&question)?;
        let answer: serde_json::Value = serde_json::from_str(&answer).map_err(|_| format!("node answered {answer:?}"))?;
        let number = |key: &str| answer[key].as_f64().ok_or_else(|| format!("node answered {answer}"));
        let states = number("states")?;
        let count = |key: &str| number(key).map(|n| n as usize);
        let result = if states < 0.0 {
            Err("the budget was used up".to_owned())
        } else {
            Ok(Size { states: states as usize, sets: count("sets")?, jumps: count("jumps")?, spent: Spent::default() })
        };
        Ok(Outcome { seconds: number("seconds")?, result })
    }
}
