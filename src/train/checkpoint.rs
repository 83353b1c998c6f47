//! Checkpoints: one safetensors file of tensors and text, from which training goes on bit by bit. Bytes in, bytes out.
//!
//! | metadata | what |
//! |---|---|
//! | `format` | [`FORMAT`] |
//! | `task_name`, `task`, `hoa` | the task file and its automaton, as they were read |
//! | `map` | the user's own rover map, if there is one, as one map file |
//! | `preset`, `settings` | the preset's name; all its numbers with overrides in place, in TOML |
//! | `seed`, `steps`, `episodes`, `updates` | of the run |
//! | `state` | everything else that is no tensor, in TOML; absent in a policy file, from which nothing can be continued |
//!
//! | tensors | what |
//! |---|---|
//! | `module.<i>.…` | networks, targets and optimisers of module i |
//! | `best.<i>.…` | networks of the best policy that an evaluation has seen |
//! | `replay.<i>.numbers`, `replay.<i>.embedded` | on request: samples of module i |
//! | `learner.…`, `product.state` | what is under way: noise, waiting transitions, the environment's state |

use super::run::{Best, PolicyTensors, Run};
use crate::agent::{LearnerMemory, Replays, embedded_from_text, embedded_to_text};
use crate::eval::Evaluation;
use crate::nn::{NetworkTensor, Record};
use crate::product::{Rounds, Snapshot};
use crate::rng::{Rng, RngState};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The version of the format; others are refused.
pub const FORMAT: &str = "ltl-rover checkpoint 1";

/// What the keys of notes begin with.
const NOTE: &str = "note.";

/// What a run was made of, as text: from it, the same parts are made again.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub struct Origin {
    /// The name of the task file.
    pub task_name: String,
    /// The text of the task file.
    pub task: String,
    /// The name of the preset.
    pub preset: String,
    /// All numbers of the preset, with overrides in place, in TOML.
    pub settings: String,
    /// The text of the automaton in the HOA format, if there was one.
    pub hoa: Option<String>,
    /// The user's own rover map as one map file, if there is one.
    pub map: Option<String>,
    /// What a shell keeps with the run, such as its learning curves; training does not look at it.
    pub notes: BTreeMap<String, String>,
}

/// Why bytes are no checkpoint, or not one of this run.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("this is no checkpoint that can be used: {reason}")]
pub struct CheckpointError {
    reason: String,
}

impl CheckpointError {
    /// With a reason, in a sentence.
    pub fn new(reason: impl Into<String>) -> CheckpointError {
        CheckpointError { reason: reason.into() }
    }
}

/// A checkpoint that was read, its run not made yet.
#[derive(Clone, PartialEq, Debug)]
pub struct Checkpoint {
    /// What the run was made of.
    pub origin: Origin,
    /// The run's seed.
    pub seed: u64,
    /// How far the run had come.
    pub extent: Extent,
    state: Option<RunMemory>,
    tensors: BTreeMap<String, NetworkTensor>,
}

/// How far a run had come when it was saved; 0 where a file does not say.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Extent {
    /// Environment steps.
    pub steps: u64,
    /// Episodes begun.
    pub episodes: u64,
    /// Updates of all modules.
    pub updates: u64,
}

#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RunMemory {
    step: u64,
    begun: u64,
    episode_step: u32,
    running: bool,
    #[serde(default)]
    short: bool,
    first_perfect_step: Option<u64>,
    last_evaluated: u64,
    embedded: String,
    ended: bool,
    fresh_start: bool,
    rounds: Rounds,
    environment: RngState,
    evaluations: RngState,
    best: Option<BestMemory>,
    learner: LearnerMemory,
}

#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct BestMemory {
    step: u64,
    evaluation: Evaluation,
}

impl Run {
    /// This run as the bytes of a file. With [`Replays::Keep`] a run restored from it goes on bit by bit as this one.
    pub fn save(&self, origin: &Origin, replays: Replays) -> Vec<u8> {
        let trainer = &self.trainer;
        let (learner, mut tensors) = trainer.learner.save(replays);
        let Snapshot { state, at, rounds, ended, fresh_start } = trainer.product.snapshot();
        tensors.push(NetworkTensor { name: "product.state".to_owned(), shape: vec![state.len()], values: state });
        tensors.extend(self.best.iter().flat_map(|best| named(&best.policy)));
        let memory = RunMemory {
            step: trainer.step,
            begun: trainer.begun,
            episode_step: trainer.episode_step,
            running: trainer.running,
            short: trainer.short,
            first_perfect_step: self.first_perfect_step,
            last_evaluated: self.last_evaluated,
            embedded: embedded_to_text(at),
            ended,
            fresh_start,
            rounds,
            environment: trainer.rng.state(),
            evaluations: self.seeds.state(),
            best: self.best.as_ref().map(|b| BestMemory { step: b.step, evaluation: b.evaluation }),
            learner,
        };
        let mut metadata = self.metadata(origin);
        metadata.insert("state".to_owned(), toml::to_string(&memory).expect("plain data has a form in TOML"));
        Record { metadata, tensors }.to_bytes().expect("names are unique and shapes count their values")
    }

    /// The best policy alone (of this moment, if no evaluation has seen one) as the bytes of a small file: actors and critics, without
    /// targets and optimisers. It can be replayed, evaluated and asked what it expects from a place, not trained on.
    pub fn save_policy(&self, origin: &Origin) -> Vec<u8> {
        let needed = |t: &NetworkTensor| {
            let role = t.name.splitn(3, '.').nth(2).unwrap_or_default();
            role.starts_with("actor.") || role.starts_with("critic") && !role.contains("target")
        };
        let mut tensors = named(&self.policy());
        tensors.retain(needed);
        Record { metadata: self.metadata(origin), tensors }.to_bytes().expect("names are unique and shapes count their values")
    }

    /// The best policy that an evaluation has seen, or the present one if there was none.
    pub fn policy(&self) -> PolicyTensors {
        self.best.as_ref().map_or_else(|| self.trainer.learner.policy(), |best| best.policy.clone())
    }

    fn metadata(&self, origin: &Origin) -> BTreeMap<String, String> {
        let trainer = &self.trainer;
        let mut entries = vec![
            ("format", FORMAT.to_owned()),
            ("task_name", origin.task_name.clone()),
            ("task", origin.task.clone()),
            ("preset", origin.preset.clone()),
            ("settings", origin.settings.clone()),
            ("seed", self.seed.to_string()),
            ("steps", trainer.step.to_string()),
            ("episodes", trainer.begun.to_string()),
            ("updates", trainer.learner.updates().to_string()),
        ];
        entries.extend(origin.hoa.iter().map(|hoa| ("hoa", hoa.clone())));
        entries.extend(origin.map.iter().map(|map| ("map", map.clone())));
        let notes = origin.notes.iter().map(|(key, text)| (format!("{NOTE}{key}"), text.clone()));
        entries.into_iter().map(|(key, text)| (key.to_owned(), text)).chain(notes).collect()
    }

    /// Puts a fresh run, made of the checkpoint's [`Origin`] and seed, where the saved one stood. From a policy file only the policy
    /// is taken.
    ///
    /// # Errors
    /// What does not fit. The run must not be used then.
    pub fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), CheckpointError> {
        let error = |reason: String| CheckpointError { reason };
        let rng = |state: &RngState| Rng::restore(state).ok_or_else(|| error("a random stream's state is invalid".into()));
        let Some(memory) = &checkpoint.state else {
            let policy = checkpoint.policy(self.trainer.learner.modules().len());
            return self.trainer.learner.load_policy(&policy).map_err(error);
        };
        let one = |name: &str| checkpoint.tensors.get(name).cloned();
        let within = |prefix: &str| checkpoint.within(prefix);
        self.trainer.learner.restore(&memory.learner, &one, &within).map_err(error)?;
        let at = embedded_from_text(&memory.embedded, self.trainer.product.embedding());
        let snapshot = Snapshot {
            state: one("product.state").ok_or_else(|| error("the tensor `product.state` is missing".into()))?.values,
            at: at.ok_or_else(|| error(format!("`{}` is no embedded state", memory.embedded)))?,
            rounds: memory.rounds,
            ended: memory.ended,
            fresh_start: memory.fresh_start,
        };
        self.trainer.product.restore(&snapshot).map_err(|e| error(e.to_string()))?;
        let modules = self.trainer.learner.modules().len();
        self.best = None;
        if let Some(best) = &memory.best {
            let policy = checkpoint.policy(modules);
            // Loaded once to see whether it fits; the networks of training come back right after.
            let present = self.trainer.learner.policy();
            self.trainer.learner.load_policy(&policy).map_err(error)?;
            self.trainer.learner.load_policy(&present).map_err(error)?;
            self.best = Some(Best { step: best.step, evaluation: best.evaluation, policy });
        }
        let trainer = &mut self.trainer;
        trainer.rng = rng(&memory.environment)?;
        self.seeds = rng(&memory.evaluations)?;
        (trainer.step, trainer.begun) = (memory.step, memory.begun);
        (trainer.episode_step, trainer.running, trainer.short) = (memory.episode_step, memory.running, memory.short);
        (self.first_perfect_step, self.last_evaluated) = (memory.first_perfect_step, memory.last_evaluated);
        Ok(())
    }
}

/// The tensors of a policy under their names in a file.
fn named(policy: &PolicyTensors) -> Vec<NetworkTensor> {
    let name = |(m, tensors): (usize, &Vec<NetworkTensor>)| {
        let full = |t: &NetworkTensor| NetworkTensor { name: format!("best.{m}.{}", t.name), ..t.clone() };
        tensors.iter().map(full).collect::<Vec<_>>()
    };
    policy.iter().enumerate().flat_map(name).collect()
}

impl Checkpoint {
    /// Reads the bytes that [`Run::save`] or [`Run::save_policy`] gave.
    ///
    /// # Errors
    /// If they are not of this format and version.
    pub fn read(bytes: &[u8]) -> Result<Checkpoint, CheckpointError> {
        let record = Record::from_bytes(bytes).map_err(|e| CheckpointError::new(e.to_string()))?;
        let text = |key: &str| record.metadata.get(key).cloned();
        let needed = |key: &str| text(key).ok_or_else(|| CheckpointError::new(format!("`{key}` is missing in its metadata")));
        let format = needed("format")?;
        if format != FORMAT {
            return Err(CheckpointError::new(format!("its format is `{format}`, not `{FORMAT}`")));
        }
        let origin = Origin {
            task_name: needed("task_name")?,
            task: needed("task")?,
            preset: needed("preset")?,
            settings: needed("settings")?,
            hoa: text("hoa"),
            map: text("map"),
            notes: record
                .metadata
                .iter()
                .filter_map(|(k, text)| Some((k.strip_prefix(NOTE)?.to_owned(), text.clone())))
                .collect(),
        };
        let seed = needed("seed")?;
        let seed = seed.parse().map_err(|_| CheckpointError::new(format!("`{seed}` is no seed")))?;
        let state = text("state").map(|state| toml::from_str(&state)).transpose();
        let state = state.map_err(|e| CheckpointError::new(format!("its state is malformed: {}", e.message())))?;
        let tensors = record.tensors.into_iter().map(|t| (t.name.clone(), t)).collect();
        let number = |key: &str| text(key).and_then(|text| text.parse().ok()).unwrap_or(0);
        let extent = Extent { steps: number("steps"), episodes: number("episodes"), updates: number("updates") };
        Ok(Checkpoint { origin, seed, extent, state, tensors })
    }

    /// Whether the critics are among its networks: without them a policy knows what to do, but not what that is worth.
    pub fn has_critics(&self) -> bool {
        self.tensors.keys().any(|name| name.contains(".critic"))
    }

    /// Whether training can go on from it; otherwise it is a policy file.
    pub fn resumable(&self) -> bool {
        self.state.is_some()
    }

    /// The networks of the best policy of a learner with `modules` modules; of the present one, if no evaluation has seen any.
    pub fn policy(&self, modules: usize) -> PolicyTensors {
        let best = self.state.as_ref().is_none_or(|s| s.best.is_some());
        let prefix = if best { "best" } else { "module" };
        let plain = |t: &NetworkTensor| !t.name.contains(".adam.");
        (0..modules).map(|m| self.within(&format!("{prefix}.{m}.")).into_iter().filter(plain).collect()).collect()
    }

    fn within(&self, prefix: &str) -> Vec<NetworkTensor> {
        let inside = self.tensors.range(prefix.to_owned()..).take_while(|(name, _)| name.starts_with(prefix));
        inside.map(|(name, t)| NetworkTensor { name: name[prefix.len()..].to_owned(), ..t.clone() }).collect()
    }
}
