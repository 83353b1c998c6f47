//! Everything about an open session that does not change from step to step, ready to be serialised.

use super::check::FormulaFacts;
use super::frame::Layout;
use super::open::OpenRequest;
use crate::automaton::Graph;
use crate::env::{Channel, Environment, Scene};
use serde::Serialize;

/// The task.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct TaskFacts {
    /// The name of a built-in task, or of the file it came from.
    pub name: String,
    /// Its title.
    pub title: String,
    /// A sentence or two about it.
    pub description: String,
    /// The preset in force.
    pub preset: String,
    /// The presets there are.
    pub presets: Vec<String>,
    /// Environment steps in an episode of evaluation.
    pub max_steps: u32,
    /// The task file with everything in force, as TOML.
    pub text: String,
}

/// A proposition of the environment.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct PropositionFacts {
    /// Its name.
    pub name: String,
    /// When it holds, in a sentence.
    pub meaning: String,
}

/// The environment.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct EnvironmentFacts {
    /// Its name.
    pub name: String,
    /// Seconds of simulated time a step; 0 where time has no unit.
    pub dt: f32,
    /// The channels of its state.
    pub state: Vec<Channel>,
    /// The channels of its action.
    pub action: Vec<Channel>,
    /// Its propositions, in the order of letter bits.
    pub propositions: Vec<PropositionFacts>,
    /// What a view draws.
    pub scene: Scene,
}

impl EnvironmentFacts {
    /// The facts of `environment`.
    pub fn new(environment: &dyn Environment) -> EnvironmentFacts {
        let spec = environment.spec();
        let named = spec.propositions.iter().zip(&spec.meanings);
        EnvironmentFacts {
            name: spec.name.to_owned(),
            dt: spec.dt,
            state: spec.state.clone(),
            action: spec.action.clone(),
            propositions: named
                .map(|(name, meaning)| PropositionFacts { name: name.to_owned(), meaning: meaning.clone() })
                .collect(),
            scene: environment.scene(),
        }
    }
}

/// One hyper-parameter in force.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Setting {
    /// Its dotted key, by which an override names it: `learner.n_step`.
    pub key: String,
    /// Its value in TOML.
    pub value: String,
}

/// The leaves of a TOML value, each with its dotted key.
pub(super) fn settings(value: &toml::Value) -> Vec<Setting> {
    fn walk(prefix: &str, value: &toml::Value, found: &mut Vec<Setting>) {
        match value {
            toml::Value::Table(table) => {
                for (key, inner) in table {
                    let key = if prefix.is_empty() { key.clone() } else { format!("{prefix}.{key}") };
                    walk(&key, inner, found);
                }
            }
            // Numbers pass through f32: shown as they were meant, not with the digits that f64 adds.
            toml::Value::Float(x) => found.push(Setting { key: prefix.to_owned(), value: short(*x) }),
            other => found.push(Setting { key: prefix.to_owned(), value: other.to_string() }),
        }
    }
    let mut found = vec![];
    walk("", value, &mut found);
    found
}

/// The shortest decimal that is the same `f32`, if the number is one; else the number.
fn short(x: f64) -> String {
    if f64::from(x as f32) == x { (x as f32).to_string() } else { x.to_string() }
}

/// All of it.
#[derive(Clone, Debug, Serialize)]
pub struct Description {
    /// The task.
    pub task: TaskFacts,
    /// The formula.
    pub formula: FormulaFacts,
    /// The environment.
    pub environment: EnvironmentFacts,
    /// The automaton, to be drawn.
    pub automaton: Graph,
    /// The automaton in the HOA format.
    pub hoa: String,
    /// Whether visited automaton states are kept track of: without shaping T_Φ means nothing.
    pub shaping: bool,
    /// The modules' names.
    pub modules: Vec<String>,
    /// The hyper-parameters in force.
    pub settings: Vec<Setting>,
    /// The seed.
    pub seed: u64,
    /// Where the numbers of a frame lie.
    pub layout: Layout,
    /// The request that opens the same task anew.
    pub request: OpenRequest,
}
