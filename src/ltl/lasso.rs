//! Ultimately periodic words u·v^ω, on which the truth of a formula can be computed exactly.

use crate::labels::Labels;
use serde::{Deserialize, Serialize};

/// The infinite word u·v^ω.
#[derive(Clone, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
pub struct Lasso {
    /// u, possibly empty.
    pub prefix: Vec<Labels>,
    /// v, never empty.
    pub cycle: Vec<Labels>,
}
