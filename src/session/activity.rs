//! How each module fares while it is trained, as far as ticks tell.

use serde::{Deserialize, Serialize};

/// How a module has fared.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ModuleStatistics {
    /// What it is in charge of.
    pub name: String,
    /// Moves it has chosen while training.
    pub visits: u64,
    /// Samples in its replay.
    pub replay: usize,
    /// Samples that its replay can hold.
    pub capacity: usize,
    /// Updates of its networks.
    pub updates: u64,
    /// Its critic's loss at the last update.
    pub critic: f32,
    /// Its actor's loss at the last update.
    pub actor: f32,
}

/// What one module has done.
#[derive(Clone, Copy, Default, Debug, Serialize, Deserialize)]
pub(super) struct Activity {
    pub visits: u64,
    pub updates: u64,
    pub critic: f32,
    pub actor: f32,
}
