//! Finite labelled Markov decision processes, written out: states, choices, probabilities.

use crate::labels::{Labels, Propositions};

/// How far the probabilities of a choice may add up to something else than 1.
const TOLERANCE: f64 = 1e-9;

/// A choice: where it may lead, with which probability. The probabilities are positive and add up to 1.
pub type Distribution = Vec<(usize, f64)>;

/// A finite labelled MDP (S, A, p, Π, L) with one initial state.
#[derive(Clone, PartialEq, Debug)]
pub struct Mdp {
    propositions: Propositions,
    initial: usize,
    labels: Vec<Labels>,
    choices: Vec<Vec<Distribution>>,
}

/// Why lists of numbers are no Markov decision process.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MdpError {
    /// The list of labels and the list of choices have different lengths, or there is no state.
    #[error("{labels} labelled states, but {choices} lists of choices; there must be as many, and at least one")]
    Lengths {
        /// Labelled states.
        labels: usize,
        /// Lists of choices.
        choices: usize,
    },
    /// A state that does not exist is the initial one or can be reached.
    #[error("state {state} does not exist")]
    NoSuchState {
        /// The index.
        state: usize,
    },
    /// A state without a choice.
    #[error("state {state} has no choice")]
    Deadlock {
        /// The state.
        state: usize,
    },
    /// A probability that is not positive, or probabilities that do not add up to 1.
    #[error("state {state}, choice {choice}: the probabilities must be positive and add up to 1, but add up to {sum}")]
    Probabilities {
        /// The state.
        state: usize,
        /// The choice, from 0.
        choice: usize,
        /// The sum.
        sum: f64,
    },
    /// A state's label has a bit beyond the propositions.
    #[error("the label of state {state} has a proposition that does not exist")]
    NoSuchProposition {
        /// The state.
        state: usize,
    },
}

impl Mdp {
    /// Checks and keeps the lists; per state its label and its choices.
    ///
    /// # Errors
    /// [`MdpError`].
    pub fn new(
        propositions: Propositions,
        initial: usize,
        labels: Vec<Labels>,
        choices: Vec<Vec<Distribution>>,
    ) -> Result<Mdp, MdpError> {
        let count = labels.len();
        if count == 0 || choices.len() != count {
            return Err(MdpError::Lengths { labels: count, choices: choices.len() });
        }
        let targets = choices.iter().flatten().flatten().map(|(target, _)| *target);
        if let Some(state) = targets.chain([initial]).find(|state| *state >= count) {
            return Err(MdpError::NoSuchState { state });
        }
        if let Some(state) = choices.iter().position(Vec::is_empty) {
            return Err(MdpError::Deadlock { state });
        }
        let beyond = |sigma: &Labels| propositions.len() < 64 && sigma.0 >> propositions.len() != 0;
        if let Some(state) = labels.iter().position(beyond) {
            return Err(MdpError::NoSuchProposition { state });
        }
        for (state, list) in choices.iter().enumerate() {
            for (choice, distribution) in list.iter().enumerate() {
                let sum: f64 = distribution.iter().map(|(_, p)| p).sum();
                let positive = distribution.iter().all(|(_, p)| *p > 0.0);
                if !positive || sum.is_nan() || (sum - 1.0).abs() > TOLERANCE {
                    return Err(MdpError::Probabilities { state, choice, sum });
                }
            }
        }
        Ok(Mdp { propositions, initial, labels, choices })
    }

    /// The atomic propositions of labels.
    pub fn propositions(&self) -> &Propositions {
        &self.propositions
    }

    /// The number of states.
    pub fn len(&self) -> usize {
        self.labels.len()
    }

    /// Never: there is an initial state.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// s0.
    pub fn initial(&self) -> usize {
        self.initial
    }

    /// L(s).
    pub fn labels(&self, state: usize) -> Labels {
        self.labels[state]
    }

    /// The choices of a state, at least one.
    pub fn choices(&self, state: usize) -> &[Distribution] {
        &self.choices[state]
    }
}
