//! What a user may ask of a translation, and how much work it may cost.

use serde::Serialize;
use std::fmt;

/// Where acceptance is written.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Acceptance {
    /// On the transitions: the smallest automata.
    #[default]
    Transition,
    /// On the states: all edges into a state carry the same marks. The paper's form; a state for every pair of a state and the marks it is
    /// entered with.
    State,
}

/// Which of several automata for a formula is best.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Preference {
    /// The one with the fewest states.
    #[default]
    Smallest,
    /// One without ε-jumps, if any is found, even if it has more states.
    Deterministic,
}

/// Which constructions are tried.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Construction {
    /// All that fit; the best result is kept.
    #[default]
    All,
    /// Only jumps with symmetric guesses: which fixpoints recur, and which last.
    Symmetric,
    /// Only jumps with symmetric guesses cut into pieces.
    Split,
    /// Only jumps with asymmetric guesses: which greatest fixpoints hold from now on.
    Asymmetric,
}

/// How much work a translation may cost. Translating LTL is doubly exponential in the worst case, so there is always a limit.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Budget {
    /// How many states may be made in all, those of discarded attempts included.
    pub states: usize,
    /// How many nodes of decision diagrams may be made in all (about 40 bytes each).
    pub nodes: usize,
    /// How many steps of recursion decision diagrams may take in all.
    pub steps: u64,
    /// About how many fixpoint subformulas may be guessed, each by itself: at most 2 to the power of this many guesses are made in a state.
    pub guesses: usize,
}

impl Default for Budget {
    /// 20 000 states, 1 million nodes, 10 million steps, 14 guesses: at most a few seconds.
    fn default() -> Budget {
        Budget { states: 20_000, nodes: 1_000_000, steps: 10_000_000, guesses: 14 }
    }
}

/// How much work a translation took, in the units of the [`Budget`].
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
pub struct Spent {
    /// States that were made, those of discarded attempts included.
    pub states: usize,
    /// Nodes of decision diagrams.
    pub nodes: usize,
    /// Steps of recursion.
    pub steps: u64,
}

/// What a user may ask of a translation.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct TranslateOptions {
    /// Where acceptance is written.
    pub acceptance: Acceptance,
    /// Groups of propositions of which at most one holds at a time, such as disjoint regions of a map. A letter in which several of a group
    /// hold is read as if only the one named first held.
    pub exclusive: Vec<Vec<String>>,
    /// The alphabet, in order; propositions of the formula that are missing are added behind. Empty: those of the formula in order of
    /// occurrence.
    pub propositions: Vec<String>,
    /// Which of several automata is best.
    pub prefer: Preference,
    /// Which constructions are tried: for study and for tests.
    pub construction: Construction,
    /// How much work it may cost.
    pub budget: Budget,
}

/// Why a formula was not translated.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum TranslateErrorKind {
    /// [`Budget::states`] was used up.
    States {
        /// The limit.
        limit: usize,
    },
    /// [`Budget::nodes`] was used up.
    Nodes {
        /// The limit.
        limit: usize,
    },
    /// [`Budget::steps`] was used up.
    Steps {
        /// The limit.
        limit: u64,
    },
    /// More fixpoint subformulas than [`Budget::guesses`] would have to be guessed about.
    Guesses {
        /// How many there are.
        found: usize,
        /// The limit.
        limit: usize,
    },
    /// More accepting sets than an automaton may have.
    Sets {
        /// How many are needed.
        found: usize,
    },
    /// More propositions than an alphabet may have, or one that is listed twice.
    Propositions(crate::labels::PropositionsError),
    /// An exclusive group names a proposition twice, or two groups share one.
    Exclusive {
        /// The proposition.
        name: String,
    },
    /// The caller asked to stop.
    Cancelled,
    /// The automaton's guards are too complex.
    Automaton(crate::automaton::ldgba_error::LdgbaError),
}

/// Why a formula was not translated, and the part of it that was too much.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct TranslateError {
    kind: TranslateErrorKind,
    subformula: Option<String>,
}

impl TranslateError {
    pub(super) fn new(kind: TranslateErrorKind) -> TranslateError {
        TranslateError { kind, subformula: None }
    }

    /// The same, with the part of the formula that was worked on.
    pub(super) fn at(self, subformula: Option<String>) -> TranslateError {
        TranslateError { subformula, ..self }
    }

    /// What went wrong.
    pub fn kind(&self) -> &TranslateErrorKind {
        &self.kind
    }

    /// The part of the formula whose automaton grew too large, if one can be blamed.
    pub fn subformula(&self) -> Option<&str> {
        self.subformula.as_deref()
    }
}

impl fmt::Display for TranslateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.kind {
            TranslateErrorKind::States { limit } => write!(f, "the translation needs more than the {limit} states allowed")?,
            TranslateErrorKind::Nodes { limit } => {
                write!(f, "the translation needs more than the {limit} diagram nodes allowed")?
            }
            TranslateErrorKind::Steps { limit } => {
                write!(f, "the translation needs more than the {limit} steps on diagrams allowed")?;
            }
            TranslateErrorKind::Guesses { found, limit } => {
                write!(f, "the translation has to guess about {found} subformulas; at most {limit} are allowed")?;
            }
            TranslateErrorKind::Sets { found } => {
                write!(
                    f,
                    "the automaton needs {found} accepting sets; at most {} are allowed",
                    crate::automaton::construct::MAX_SETS
                )?;
            }
            TranslateErrorKind::Propositions(error) => write!(f, "{error}")?,
            TranslateErrorKind::Exclusive { name } => {
                write!(f, "the proposition `{name}` is in two exclusive groups, or twice in one; groups must not overlap")?;
            }
            TranslateErrorKind::Cancelled => write!(f, "the translation was cancelled")?,
            TranslateErrorKind::Automaton(error) => write!(f, "{error}")?,
        }
        match &self.subformula {
            Some(part) => write!(f, " (it grew too large at `{part}`)"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for TranslateError {}
