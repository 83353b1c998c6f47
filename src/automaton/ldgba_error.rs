//! Which invariant of an automaton does not hold, and where.

use super::construct::{MAX_SETS, MAX_STATES};
use super::guard::TooComplex;
use super::ldgba::StateId;
use crate::labels::Labels;

/// Why parts make no automaton.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LdgbaError {
    /// There is no state.
    #[error("an automaton needs at least one state")]
    NoStates,
    /// More than [`MAX_STATES`] states, the added sink included.
    #[error("{found} states; at most {MAX_STATES} are allowed")]
    TooManyStates {
        /// How many there were.
        found: usize,
    },
    /// More than [`MAX_SETS`] accepting sets.
    #[error("{found} accepting sets; at most {MAX_SETS} are allowed")]
    TooManySets {
        /// How many there were.
        found: usize,
    },
    /// The initial state, an edge's target or an ε-jump's target is not a state; or lists are longer than the list of states.
    #[error("state {state} does not exist: there are {count} states")]
    NoSuchState {
        /// The index.
        state: usize,
        /// How many states there are.
        count: usize,
    },
    /// An edge belongs to an accepting set that does not exist.
    #[error("an edge of state {state} belongs to accepting set {set}, but there are {count} sets")]
    NoSuchSet {
        /// Where the edge starts.
        state: StateId,
        /// The set.
        set: usize,
        /// How many sets there are.
        count: usize,
    },
    /// A guard speaks of a proposition that does not exist.
    #[error("a guard of state {state} speaks of proposition {proposition}, but there are {count}")]
    NoSuchProposition {
        /// Where the edge starts.
        state: StateId,
        /// The index of the proposition.
        proposition: usize,
        /// How many propositions there are.
        count: usize,
    },
    /// Two different edges of a state have a letter in common.
    #[error("state {state} is not deterministic: two different edges have a letter in common (to {first} and to {second})")]
    Overlap {
        /// The state.
        state: StateId,
        /// A letter of both edges.
        letter: Labels,
        /// Where the first one leads.
        first: StateId,
        /// Where the second one leads.
        second: StateId,
    },
    /// A state has no edge for a letter ([`Gaps::Refuse`](super::Gaps::Refuse)).
    #[error("state {state} is not complete: there is a letter without an edge")]
    Incomplete {
        /// The state.
        state: StateId,
        /// The letter.
        letter: Labels,
    },
    /// An ε-jump leads to a state from which another one can be reached, so its target is not in Q_D.
    #[error("the ε-jump from state {from} to state {to} does not lead into the deterministic part: more ε-jumps follow")]
    EpsilonOutsideDeterministicPart {
        /// Where the jump starts.
        from: StateId,
        /// Where it leads.
        to: StateId,
    },
    /// A run that is accepting may pass a state with ε-jumps for ever, so it is not deterministic in the limit.
    #[error("not limit-deterministic: an accepting run may visit state {state}, from which ε-jumps can be reached, for ever")]
    NotLimitDeterministic {
        /// The state.
        state: StateId,
    },
    /// The guards are too complex.
    #[error("state {state}: {cause}")]
    Complex {
        /// The state.
        state: StateId,
        /// What it was about.
        cause: TooComplex,
    },
}
