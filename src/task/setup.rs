//! A task with one recipe and its automaton: everything that training needs, checked, so that from here on nothing fails.

use super::automaton::automaton;
use super::error::TaskError;
use super::file::TaskFile;
use super::parse::{Override, Task};
use super::preset::Preset;
use crate::agent::{Engine, ModularDdpg, Sizes};
use crate::automaton::{Embedding, Ldgba};
use crate::env::map::RoverMap;
use crate::eval::{Rollout, RolloutSettings};
use crate::nn::{ActorCritic, NetworkShape, fused::Fused};
use crate::product::{EpMdp, LdgbaReward, Reward};
use crate::rng::Rng;
use crate::train::{Checkpoint, CheckpointError, Origin, Run, Trainer, TrainingSettings};
use std::sync::Arc;

/// The most parameters that the networks of a learner may have together.
const MAX_PARAMETERS: usize = 50_000_000;

/// A task, a recipe and an automaton.
pub struct Setup {
    task: Task,
    preset_name: String,
    preset: Preset,
    hoa: Option<String>,
    product: EpMdp,
    reward: Arc<dyn Reward>,
}

/// The fast networks.
fn engine(shape: &NetworkShape, rng: &mut Rng) -> Box<dyn ActorCritic> {
    Box::new(Fused::new(shape, rng))
}

impl Setup {
    /// Joins a task, one of its presets with overrides in place, and the automaton given in the HOA format; without one the formula
    /// is translated.
    ///
    /// # Errors
    /// What [`Setup::with_automaton`] refuses; a text that is no automaton; an automaton that does not accept the task's formula.
    pub fn open(task: Task, preset: &str, overrides: &[Override], hoa: Option<&str>) -> Result<Setup, TaskError> {
        let automaton = automaton(&task, hoa)?;
        Ok(Setup { hoa: hoa.map(str::to_owned), ..Setup::with_automaton(task, preset, overrides, automaton)? })
    }

    /// Joins a task, one of its presets with overrides in place, and an automaton that accepts its formula.
    ///
    /// # Errors
    /// An unknown environment, propositions that it does not have, or settings that do not go with the automaton.
    pub fn with_automaton(task: Task, preset: &str, overrides: &[Override], automaton: Arc<Ldgba>) -> Result<Setup, TaskError> {
        let settings = task.preset(preset, overrides)?;
        Setup::join(task, preset, settings, automaton)
    }

    fn join(task: Task, preset_name: &str, preset: Preset, automaton: Arc<Ldgba>) -> Result<Setup, TaskError> {
        let error = |path: &[&str], message: String| TaskError::new(&task.name, &task.text, task.place(path), message);
        let environment = task.environment()?;
        let section = &preset.product;
        let product_path = ["presets", preset_name, "product"];
        let embedding = Embedding::new(automaton, section.frontier, section.shaping.tracking())
            .map_err(|e| error(&product_path, e.to_string()))?;
        let embedding = Arc::new(embedding);
        let reward = LdgbaReward::new(section.reward(), &embedding).map_err(|e| error(&product_path, e.to_string()))?;
        let product = EpMdp::new(environment, embedding, &task.file.specification.labels)
            .map_err(|e| error(&["specification", "labels"], e.to_string()))?;
        let disturbance = preset.training.disturbance;
        if disturbance != 1.0 && !product.clone().scale_disturbance(disturbance) {
            let name = product.environment().spec().name;
            let message = format!("`disturbance` is {disturbance}, but nothing random disturbs a step of `{name}`; allowed is 1");
            return Err(error(&["presets", preset_name, "training", "disturbance"], message));
        }
        let setup = Setup { preset_name: preset_name.to_owned(), preset, hoa: None, product, reward: Arc::new(reward), task };
        setup.check_modules()?;
        Ok(setup)
    }

    /// The task file with this one preset and every number written out.
    pub fn resolved(&self) -> String {
        let presets = [(self.preset_name.clone(), self.preset.clone())].into();
        toml::to_string(&TaskFile { presets, ..self.task.file.clone() }).expect("a task file has a form in TOML")
    }

    /// What this set-up is made of, for a checkpoint.
    pub fn origin(&self) -> Origin {
        Origin {
            task_name: self.task.name.clone(),
            task: self.task.text.clone(),
            preset: self.preset_name.clone(),
            settings: toml::to_string(&self.preset).expect("a preset has a form in TOML"),
            hoa: self.hoa.clone(),
            map: self.task.map.as_ref().map(|map| map.to_json()),
            ..Origin::default()
        }
    }

    /// The set-up that a checkpoint was made of.
    ///
    /// # Errors
    /// What is wrong with the task, the settings or the automaton in it.
    pub fn from_checkpoint(checkpoint: &Checkpoint) -> Result<Setup, TaskError> {
        let origin = &checkpoint.origin;
        let mut task = Task::parse(&origin.task, &origin.task_name)?;
        if let Some(text) = &origin.map {
            let map = RoverMap::from_json(text, None);
            task = task.with_map(map.map_err(|e| TaskError::new("map", "", None, e.to_string()))?);
        }
        let settings = Preset::parse(&origin.settings, &format!("settings of {}", origin.task_name))?;
        let automaton = automaton(&task, origin.hoa.as_deref())?;
        Ok(Setup { hoa: origin.hoa.clone(), ..Setup::join(task, &origin.preset, settings, automaton)? })
    }

    /// The run that a checkpoint of this set-up was taken of, where it stood.
    ///
    /// # Errors
    /// What does not fit.
    pub fn resume(&self, checkpoint: &Checkpoint) -> Result<Run, CheckpointError> {
        let mut run = self.run(checkpoint.seed);
        run.restore(checkpoint)?;
        Ok(run)
    }

    /// Whether the modules can be numbered and their networks fit into memory.
    fn check_modules(&self) -> Result<(), TaskError> {
        let path = ["presets", &self.preset_name, "learner", "modules"];
        let error = |message| TaskError::new(&self.task.name, &self.task.text, self.task.place(&path), message);
        let learner = &self.preset.learner;
        let modules = crate::agent::Modules::new(learner.modules, self.product.embedding()).map_err(|e| error(e.to_string()))?;
        let sizes = self.sizes();
        let encoder = crate::agent::Encoder::new(learner.modules, self.product.embedding(), sizes.observation);
        let input = encoder.with_fourier_features(learner.fourier_octaves).len();
        let shape = NetworkShape::new(input, sizes.control, &learner.hidden);
        let one: usize = crate::nn::tensor_shapes(&shape, true).iter().map(|(_, s)| s.iter().product::<usize>()).sum();
        if one.saturating_mul(modules.len()) > MAX_PARAMETERS {
            return Err(error(format!(
                "{} modules with networks of these sizes hold {} numbers; allowed are {MAX_PARAMETERS}",
                modules.len(),
                one.saturating_mul(modules.len())
            )));
        }
        Ok(())
    }

    fn sizes(&self) -> Sizes {
        let spec = self.product.environment().spec();
        Sizes { observation: spec.observation, control: spec.action.len() }
    }

    /// The task.
    pub fn task(&self) -> &Task {
        &self.task
    }

    /// The name of the preset.
    pub fn preset_name(&self) -> &str {
        &self.preset_name
    }

    /// The preset, with overrides in place.
    pub fn preset(&self) -> &Preset {
        &self.preset
    }

    /// The text of the automaton in the HOA format, if it was given in that.
    pub fn hoa(&self) -> Option<&str> {
        self.hoa.as_deref()
    }

    /// A fresh product.
    pub fn product(&self) -> EpMdp {
        self.product.clone()
    }

    /// The automaton.
    pub fn automaton(&self) -> &Arc<Ldgba> {
        self.product.embedding().automaton()
    }

    /// The reward.
    pub fn reward(&self) -> &Arc<dyn Reward> {
        &self.reward
    }

    /// How policies are judged.
    pub fn rollout_settings(&self) -> RolloutSettings {
        let evaluation = &self.task.file.evaluation;
        RolloutSettings { max_steps: evaluation.max_steps, start: evaluation.start }
    }

    /// An episode from a start drawn from `seed`, to be played by any policy.
    pub fn rollout(&self, seed: u64) -> Rollout {
        self.rollout_under(self.rollout_settings(), seed)
    }

    /// An episode from a start drawn from `seed`, under other settings than the task's.
    pub fn rollout_under(&self, settings: RolloutSettings, seed: u64) -> Rollout {
        Rollout::new(self.product(), self.reward.clone(), settings, seed)
    }

    /// A fresh learner.
    pub fn learner(&self, seed: u64) -> ModularDdpg {
        self.learner_on(engine, seed)
    }

    /// A fresh learner whose networks `engine` makes.
    pub fn learner_on(&self, engine: Engine, seed: u64) -> ModularDdpg {
        let start: (Engine, u64) = (engine, seed);
        let (embedding, reward) = (self.product.embedding().clone(), self.reward.clone());
        ModularDdpg::new(self.preset.learner.clone(), embedding, reward, self.sizes(), start)
            .expect("the modules were numbered when this was made")
    }

    /// A fresh trainer.
    pub fn trainer(&self, seed: u64) -> Trainer {
        self.trainer_on(engine, seed)
    }

    /// A fresh trainer whose networks `engine` makes: to compare implementations.
    pub fn trainer_on(&self, engine: Engine, seed: u64) -> Trainer {
        let mut settings: TrainingSettings = self.preset.training;
        if settings.max_steps == 0 {
            settings.max_steps = self.task.file.evaluation.max_steps;
        }
        Trainer::new(self.product(), self.learner_on(engine, seed), self.reward.clone(), settings, seed)
    }

    /// A fresh run: a trainer with evaluations.
    pub fn run(&self, seed: u64) -> Run {
        Run::new(self.trainer(seed), self.rollout(seed), seed)
    }
}
