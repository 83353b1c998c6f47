//! The count of rounds, kept apart from the frontier T.

use crate::automaton::Marks;
use serde::{Deserialize, Serialize};

/// Counts rounds: a round ends when all f accepting sets have been visited since the last round ended.
///
/// This is the measure of every result, and the same for every [`FrontierRule`](crate::automaton::FrontierRule). T cannot serve:
/// under `Refill` the visit that ends one round of T already counts for the next, under `Standard` there is no T.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Rounds {
    all: Marks,
    missing: Marks,
    completed: u32,
}

impl Rounds {
    /// No round completed, all sets of `all` missing.
    pub fn new(all: Marks) -> Rounds {
        Rounds { all, missing: all, completed: 0 }
    }

    /// Takes in a visit to all sets of `visited`; true if it completes a round.
    pub fn visit(&mut self, visited: Marks) -> bool {
        self.missing = Marks(self.missing.0 & !visited.0);
        // Without an accepting set there is nothing to complete.
        let complete = self.missing.0 == 0 && self.all.0 != 0;
        if complete {
            self.missing = self.all;
            self.completed += 1;
        }
        complete
    }

    /// How many rounds have been completed.
    pub fn completed(&self) -> u32 {
        self.completed
    }

    /// The accepting sets that the current round still lacks.
    pub fn missing(&self) -> Marks {
        self.missing
    }

    /// Whether this counts rounds of exactly the sets of `all`.
    pub(super) fn counts(&self, all: Marks) -> bool {
        self.all == all && self.missing.0 & !all.0 == 0
    }
}
