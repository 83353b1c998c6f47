//! What to put in the places of variables.

use super::{Bdd, Memo, Variable};

/// What to put in the places of variables, for [`Manager::substitute`](super::Manager::substitute). Remembers what it was applied to, so keep one that is used often.
#[derive(Clone, Default)]
pub struct Substitution {
    pub(super) values: Memo<Variable, Bdd>,
    pub(super) memo: Memo<Bdd, Bdd>,
}

impl Substitution {
    /// From now on `variable` is replaced by `value`. Set it before a function that depends on it is substituted.
    pub fn set(&mut self, variable: Variable, value: Bdd) {
        if self.values.insert(variable, value).is_some_and(|old| old != value) {
            self.memo.clear();
        }
    }

    /// Whether nothing is replaced.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Whether `variable` is replaced.
    pub fn has(&self, variable: Variable) -> bool {
        self.values.contains_key(&variable)
    }
}
