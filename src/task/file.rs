//! The task file as it is written: TOML, every key known, what is left out taken from the defaults.

use super::preset::Preset;
use crate::env::Current;
use crate::product::{Renaming, Start};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A task: an environment, what is to be done in it, how that is judged, and the recipes for learning it.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct TaskFile {
    /// A short title.
    pub title: String,
    /// A sentence or two for people.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub description: String,
    /// The environment.
    pub environment: EnvironmentSection,
    /// What is to be done.
    pub specification: SpecificationSection,
    /// How policies are judged.
    pub evaluation: EvaluationSection,
    /// Recipes by name; `paper` and `fast` by custom.
    pub presets: BTreeMap<String, Preset>,
}

/// The environment.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct EnvironmentSection {
    /// Its name, such as `ball_pass`.
    pub name: String,
    /// For `rover`: a shipped map (`melas`, `victoria`, `three_targets`), or a map file (JSON, or a flat PNG) relative to the task file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map: Option<String>,
    /// For `islands`: where the current is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub current: Option<Current>,
}

/// What is to be done: a formula, an automaton, or both, which must then agree.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SpecificationSection {
    /// The formula of linear temporal logic.
    pub ltl: String,
    /// A file in the HOA format, relative to the task file; without it the formula is translated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hoa: Option<String>,
    /// For propositions of the formula that are called otherwise in the environment: formula's name = environment's name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub labels: Renaming,
}

/// How policies are judged: an episode succeeds if it completes a round of the accepting sets within its steps and meets no sink.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct EvaluationSection {
    /// Environment steps in an episode.
    pub max_steps: u32,
    /// Episodes.
    #[serde(default = "default_runs")]
    pub runs: u32,
    /// Where the environment starts: `initial`, its own distribution, the paper's; or `anywhere`, spread over all safe ground. Where
    /// the former is a single state, as in `ball_pass`, all episodes from it are one and the same.
    #[serde(default)]
    pub start: Start,
}

fn default_runs() -> u32 {
    200
}
