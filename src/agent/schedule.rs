//! A number that may change while training: constant, or moving in a straight line to its final value.

use serde::{Deserialize, Serialize};

/// A value over training steps, written in a task file as a number, or as `{ from = 0.4, to = 0.1, over = 50000 }`.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(untagged, expecting = "a number, or a table such as { from = 0.4, to = 0.1, over = 50000 }")]
pub enum Schedule {
    /// The same at every step.
    Constant(f32),
    /// A straight line.
    Linear(Line),
}

/// A straight line from one value to another over a number of environment steps, constant afterwards.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// The value at step 0.
    pub from: f32,
    /// The value at step `over` and after.
    pub to: f32,
    /// Environment steps, at least 1.
    pub over: u64,
}

impl Schedule {
    /// The value after `step` environment steps.
    pub fn at(&self, step: u64) -> f32 {
        match *self {
            Schedule::Constant(value) => value,
            Schedule::Linear(Line { to, over, .. }) if step >= over => to,
            Schedule::Linear(Line { from, to, over }) => from + (to - from) * (step as f32 / over as f32),
        }
    }

    /// The least and the greatest value it takes.
    pub fn range(&self) -> (f32, f32) {
        match *self {
            Schedule::Constant(value) => (value, value),
            Schedule::Linear(Line { from, to, .. }) => (from.min(to), from.max(to)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_ends_at_its_end_and_stays_there() {
        let line = Schedule::Linear(Line { from: 0.4, to: 0.1, over: 100 });
        assert_eq!((line.at(0), line.at(100), line.at(1_000_000)), (0.4, 0.1, 0.1));
        assert!((line.at(50) - 0.25).abs() < 1e-6);
        assert_eq!(line.range(), (0.1, 0.4));
    }

    #[test]
    fn both_spellings_are_read() {
        #[derive(Deserialize)]
        struct File {
            a: Schedule,
            b: Schedule,
            c: Schedule,
        }
        let file: File = toml::from_str("a = 1e-3\nb = 2\nc = { from = 1, to = 0.5, over = 7 }").unwrap();
        assert_eq!(file.a, Schedule::Constant(1e-3));
        assert_eq!(file.b, Schedule::Constant(2.0));
        assert_eq!(file.c, Schedule::Linear(Line { from: 1.0, to: 0.5, over: 7 }));
    }
}
