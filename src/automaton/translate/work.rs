//! Counting the work of a translation, so that it ends in time: states, nodes, and a caller's wish to stop.

use super::options::Budget;
use crate::bdd::Exhausted;

/// Why an attempt was given up.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Stop {
    /// The budget of states, of the translation or of this attempt.
    States,
    /// The budget of diagram nodes.
    Nodes,
    /// The budget of steps.
    Steps,
    /// Too many fixpoints to guess about.
    Guesses(usize),
    /// Too many accepting sets.
    Sets(usize),
    /// The caller asked for it.
    Cancelled,
}

impl From<Exhausted> for Stop {
    fn from(exhausted: Exhausted) -> Stop {
        match exhausted {
            Exhausted::Nodes { .. } => Stop::Nodes,
            Exhausted::Steps { .. } => Stop::Steps,
        }
    }
}

/// What is left of the budget.
pub(super) struct Work<'a> {
    budget: Budget,
    states: usize,
    /// States that the present attempt may still make.
    attempt: usize,
    /// Fixpoints that the present attempt may guess about.
    guesses: usize,
    ticks: usize,
    cancelled: &'a dyn Fn() -> bool,
}

/// How many small steps are made between two questions to the caller.
const PATIENCE: usize = 256;

impl<'a> Work<'a> {
    pub fn new(budget: Budget, cancelled: &'a dyn Fn() -> bool) -> Work<'a> {
        Work { budget, states: budget.states, attempt: budget.states, guesses: budget.guesses, ticks: 0, cancelled }
    }

    pub fn budget(&self) -> Budget {
        self.budget
    }

    /// Allows the next attempt at most `states` states, and guesses about at most `guesses` fixpoints.
    pub fn start_attempt(&mut self, states: usize, guesses: usize) {
        self.attempt = states;
        self.guesses = guesses.min(self.budget.guesses);
    }

    /// How many fixpoints the present attempt may guess about.
    pub fn guesses(&self) -> usize {
        self.guesses
    }

    /// How many states were made.
    pub fn states(&self) -> usize {
        self.budget.states - self.states
    }

    /// Counts one new state.
    pub fn state(&mut self) -> Result<(), Stop> {
        self.tick(8)?;
        self.states = self.states.checked_sub(1).ok_or(Stop::States)?;
        self.attempt = self.attempt.checked_sub(1).ok_or(Stop::States)?;
        Ok(())
    }

    /// Counts `steps` small steps.
    pub fn tick(&mut self, steps: usize) -> Result<(), Stop> {
        self.ticks += steps;
        if self.ticks >= PATIENCE {
            self.ticks = 0;
            if (self.cancelled)() {
                return Err(Stop::Cancelled);
            }
        }
        Ok(())
    }
}
