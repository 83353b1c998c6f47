//! Letters σ ∈ 2^AP: which atomic propositions hold at one instant.

use serde::{Deserialize, Serialize};

/// The largest number of atomic propositions an alphabet may have.
pub const MAX_PROPOSITIONS: usize = 64;

/// One letter σ ∈ 2^AP: bit `i` is set when proposition `i` of the [`Propositions`] in charge holds.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Debug, Serialize, Deserialize)]
pub struct Labels(pub u64);

impl Labels {
    /// The letter in which no proposition holds.
    pub const EMPTY: Labels = Labels(0);

    /// The letter in which exactly proposition `index` (0 ≤ index < 64) holds.
    pub fn only(index: usize) -> Labels {
        Labels(1 << index)
    }

    /// Whether proposition `index` (0 ≤ index < 64) holds.
    pub fn holds(self, index: usize) -> bool {
        self.0 >> index & 1 == 1
    }

    /// This letter with proposition `index` (0 ≤ index < 64) set to `value`.
    #[must_use]
    pub fn with(self, index: usize, value: bool) -> Labels {
        Labels(self.0 & !(1 << index) | u64::from(value) << index)
    }
}

/// The ordered names of the atomic propositions of an alphabet. Names are unique; at most [`MAX_PROPOSITIONS`].
#[derive(Clone, PartialEq, Eq, Hash, Default, Debug, Serialize)]
pub struct Propositions(Vec<String>);

impl Propositions {
    /// Takes the names in order.
    ///
    /// # Errors
    /// A name that occurs twice, an empty name, or more than [`MAX_PROPOSITIONS`] names.
    pub fn new<S: Into<String>>(names: impl IntoIterator<Item = S>) -> Result<Propositions, PropositionsError> {
        let names: Vec<String> = names.into_iter().map(Into::into).collect();
        if names.len() > MAX_PROPOSITIONS {
            return Err(PropositionsError::TooMany { found: names.len() });
        }
        for (i, name) in names.iter().enumerate() {
            if name.is_empty() {
                return Err(PropositionsError::Empty { index: i });
            }
            if names[..i].contains(name) {
                return Err(PropositionsError::Duplicate { name: name.clone() });
            }
        }
        Ok(Propositions(names))
    }

    /// How many propositions there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there is no proposition.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The index of `name`, if it is one of these.
    pub fn index(&self, name: &str) -> Option<usize> {
        self.0.iter().position(|n| n == name)
    }

    /// The name of proposition `index`.
    ///
    /// # Panics
    /// If `index` is not below [`Propositions::len`].
    pub fn name(&self, index: usize) -> &str {
        &self.0[index]
    }

    /// The names, in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &str> {
        self.0.iter().map(String::as_str)
    }
}

/// Why a list of names is no alphabet.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PropositionsError {
    /// More than [`MAX_PROPOSITIONS`] names.
    #[error("{found} propositions; at most {MAX_PROPOSITIONS} are allowed")]
    TooMany {
        /// How many there were.
        found: usize,
    },
    /// The same name twice.
    #[error("the proposition `{name}` is listed twice")]
    Duplicate {
        /// The name.
        name: String,
    },
    /// A name of length 0.
    #[error("proposition {index} has an empty name")]
    Empty {
        /// Its index.
        index: usize,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_set_and_read_bits() {
        let sigma = Labels::only(3).with(63, true).with(3, false);
        assert_eq!(sigma, Labels(1 << 63));
        assert!(sigma.holds(63) && !sigma.holds(3));
    }

    #[test]
    fn names_are_unique() {
        assert_eq!(Propositions::new(["a", "b", "a"]), Err(PropositionsError::Duplicate { name: "a".into() }));
        assert!(Propositions::new((0..65).map(|i| format!("p{i}"))).is_err());
        let ap = Propositions::new(["a", "b"]).unwrap();
        assert_eq!((ap.index("b"), ap.index("c"), ap.name(0)), (Some(1), None, "a"));
    }
}
