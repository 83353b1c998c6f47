//! The three contenders of Tables 1 and 2, each one switch away from the others.

use crate::task::Override;
use clap::ValueEnum;
use serde::{Deserialize, Serialize};

/// A contender.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Modular DDPG on the EP-MDP: what [Cai et al. 2021](crate::bib::Cai2021) propose.
    Modular,
    /// Standard DDPG on the EP-MDP: one module for all automaton states, which stand one-hot in its input.
    StandardDdpg,
    /// Modular DDPG on the standard product MDP, whose states do not know which accepting sets are still to be visited.
    StandardProduct,
}

impl Method {
    /// All of them.
    pub const ALL: [Method; 3] = [Method::Modular, Method::StandardDdpg, Method::StandardProduct];

    /// Its name in files.
    pub fn key(self) -> &'static str {
        match self {
            Method::Modular => "modular",
            Method::StandardDdpg => "standard_ddpg",
            Method::StandardProduct => "standard_product",
        }
    }

    /// Its name in tables.
    pub fn title(self) -> &'static str {
        match self {
            Method::Modular => "modular DDPG",
            Method::StandardDdpg => "standard DDPG",
            Method::StandardProduct => "standard product",
        }
    }

    /// What it changes in a recipe; everything else stays, the budget above all.
    pub fn overrides(self) -> Vec<Override> {
        let change = |path: &str, value: &str| vec![Override { path: path.to_owned(), value: value.to_owned() }];
        match self {
            Method::Modular => vec![],
            Method::StandardDdpg => change("learner.modules", "one"),
            Method::StandardProduct => change("product.frontier", "standard"),
        }
    }

    /// Whether it differs from the others where the automaton has that many accepting sets: with a single one, both products are
    /// the same up to the frontier's name.
    pub fn applies(self, sets: usize) -> bool {
        self != Method::StandardProduct || sets > 1
    }
}
