//! The training loop, one transition at a time: [`Trainer::step`] → [`Tick`]. It reads no clock and does no input or output.

use super::settings::{EmbeddedStart, TrainingSettings};
use crate::agent::{Learner, ModularDdpg, Transition, Update, View};
use crate::automaton::EmbeddedState;
use crate::nn::{NetworkTensor, target_of};
use crate::product::{Chosen, EpMdp, Move, MoveKind, ProductStart, ProductStep, Reward, RewardParts};
use crate::rng::{Purpose, Rng};
use serde::Serialize;
use std::sync::Arc;

/// The most embedded states that random starts are drawn from.
const MAX_STARTS: usize = 1 << 16;

/// How often a start is drawn anew because it lies in a sink, before it is taken as it is.
const MAX_DRAWS: usize = 1000;

/// Why an episode ended.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// In a product sink: Q_sink, or the environment terminated.
    Terminated,
    /// By the time limit.
    Truncated,
}

/// One transition of training and the updates that followed it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Tick {
    /// Environment steps so far, this one included; an ε-move is none.
    pub step: u64,
    /// The episode, from 0.
    pub episode: u64,
    /// Environment steps of this episode so far, this one included.
    pub episode_step: u32,
    /// Whether the episode is one of the [`ShortEpisodes`](super::settings::ShortEpisodes).
    pub short: bool,
    /// How the episode began, on its first tick.
    pub start: Option<ProductStart>,
    /// The transition.
    pub product: ProductStep,
    /// What it paid, in parts and in the paper's units.
    pub reward: RewardParts,
    /// Rounds completed in this episode so far.
    pub rounds: u32,
    /// The last update that followed.
    pub update: Option<Update>,
    /// Whether and why the episode ended here.
    pub end: Option<End>,
}

impl Tick {
    /// Why the episode ended here, if it did and counts: sums over a short one say nothing about the task, so curves leave it out.
    pub fn counted_end(&self) -> Option<End> {
        self.end.filter(|_| !self.short)
    }
}

/// Product, learner and everything between them.
pub struct Trainer {
    pub(super) product: EpMdp,
    pub(super) learner: ModularDdpg,
    pub(super) reward: Arc<dyn Reward>,
    pub(super) settings: TrainingSettings,
    pub(super) rng: Rng,
    pub(super) step: u64,
    /// Episodes begun.
    pub(super) begun: u64,
    pub(super) episode_step: u32,
    /// An episode is going on.
    pub(super) running: bool,
    /// The episode is one of the short ones.
    pub(super) short: bool,
    view: View,
    next: View,
    control: Vec<f32>,
    /// Embedded states for random starts.
    starts: Vec<EmbeddedState>,
}

impl Trainer {
    /// A fresh trainer; `seed` is for the environment's starts and transitions (the learner has its own streams of the same seed).
    /// [`TrainingSettings::disturbance`] is without effect where nothing random disturbs a step.
    pub fn new(
        mut product: EpMdp,
        learner: ModularDdpg,
        reward: Arc<dyn Reward>,
        settings: TrainingSettings,
        seed: u64,
    ) -> Trainer {
        product.scale_disturbance(settings.disturbance);
        let view = View::new(&product);
        let control = vec![0.0; product.environment().spec().action.len()];
        let mut starts = vec![];
        if settings.embedded_start == EmbeddedStart::Random {
            let automaton = product.embedding().automaton();
            starts = product.embedding().reachable(MAX_STARTS).unwrap_or_default();
            starts.retain(|at| !automaton.is_sink(at.q));
        }
        Trainer {
            rng: Rng::new(seed, Purpose::Environment),
            step: 0,
            begun: 0,
            episode_step: 0,
            running: false,
            short: false,
            next: view.clone(),
            view,
            control,
            starts,
            product,
            learner,
            reward,
            settings,
        }
    }

    /// Exactly one transition, the first of a new episode if the last one has ended, and the updates that are due after it.
    pub fn step(&mut self) -> Tick {
        let start = (!self.running).then(|| self.begin());
        self.view.look(&self.product);
        let labels = self.product.labels();
        let action = match self.learner.explore(&self.view.situation(), &mut self.control) {
            Chosen::Control => Move::Control(&self.control),
            Chosen::Epsilon(target) => Move::Epsilon(target),
        };
        let product = self.product.step(action, &mut self.rng);
        self.next.look(&self.product);
        if product.kind == MoveKind::Control {
            self.step += 1;
            self.episode_step += 1;
        }
        self.learner.record(&Transition {
            observation: self.view.observation(),
            labels,
            control: &self.control,
            step: &product,
            next: self.next.observation(),
        });
        let end = if product.ends() {
            Some(End::Terminated)
        } else if self.episode_step >= self.time_limit() {
            Some(End::Truncated)
        } else {
            None
        };
        if end.is_some() {
            self.learner.finish_episode();
            self.running = false;
        }
        let update = self.learner.update();
        Tick {
            step: self.step,
            episode: self.episode(),
            episode_step: self.episode_step,
            short: self.short,
            start,
            product,
            reward: self.reward.parts(&product),
            rounds: self.product.rounds().completed(),
            update,
            end,
        }
    }

    /// The ticks of training, without end.
    pub fn ticks(&mut self) -> impl Iterator<Item = Tick> + '_ {
        std::iter::from_fn(|| Some(self.step()))
    }

    /// Begins an episode.
    fn begin(&mut self) -> ProductStart {
        self.begun += 1;
        self.running = true;
        self.episode_step = 0;
        let share = self.settings.short_episodes.share;
        self.short = share > 0.0 && self.rng.chance(share);
        let mut start = self.product.reset(self.settings.start, &mut self.rng);
        for _ in 0..MAX_DRAWS {
            if let Some(at) = self.random_embedded() {
                let mut snapshot = self.product.snapshot();
                (snapshot.at, snapshot.ended, snapshot.fresh_start) = (at, false, false);
                self.product.restore(&snapshot).expect("the snapshot is of this very product, the state of its embedding");
                start.at = at;
            }
            if !self.product.ended() {
                break;
            }
            start = self.product.reset(self.settings.start, &mut self.rng);
        }
        start
    }

    /// Environment steps after which the present episode is truncated.
    fn time_limit(&self) -> u32 {
        if self.short { self.settings.short_episodes.max_steps } else { self.settings.max_steps }
    }

    /// A random embedded state after reading L(s_0), if episodes start in such; `None` where that is a sink.
    fn random_embedded(&mut self) -> Option<EmbeddedState> {
        if self.starts.is_empty() {
            return None;
        }
        let before = self.starts[self.rng.below(self.starts.len())];
        let at = self.product.embedding().read(before, self.product.labels()).to;
        (!self.product.embedding().automaton().is_sink(at.q)).then_some(at)
    }

    /// Environment steps so far.
    pub fn steps(&self) -> u64 {
        self.step
    }

    /// Episodes begun so far.
    pub fn episodes(&self) -> u64 {
        self.begun
    }

    /// The number of the present or last episode, from 0.
    pub fn episode(&self) -> u64 {
        self.begun.saturating_sub(1)
    }

    /// Whether the budget of steps or episodes is spent.
    pub fn budget_spent(&self) -> bool {
        let episodes_done = self.begun - u64::from(self.running);
        self.step >= self.settings.steps || self.settings.episodes > 0 && episodes_done >= self.settings.episodes
    }

    /// Changes the budget of environment steps.
    pub fn set_budget(&mut self, steps: u64) {
        self.settings.steps = steps;
    }

    /// Takes over networks that [`ModularDdpg::policy`] gave, for further training: the target networks become copies of them.
    ///
    /// # Errors
    /// A sentence naming what does not fit.
    pub fn start_from(&mut self, policy: &[Vec<NetworkTensor>]) -> Result<(), String> {
        self.learner.load_policy(policy)?;
        let trained = |tensor: &&NetworkTensor| !tensor.name.contains("_target.");
        let targets: Vec<Vec<NetworkTensor>> =
            policy.iter().map(|module| module.iter().filter(trained).map(target_of).collect()).collect();
        self.learner.load_policy(&targets)
    }

    /// The product, where it stands.
    pub fn product(&self) -> &EpMdp {
        &self.product
    }

    /// The control applied last, one number in `[-1, 1]` per action channel.
    pub fn control(&self) -> &[f32] {
        &self.control
    }

    /// The learner.
    pub fn learner(&self) -> &ModularDdpg {
        &self.learner
    }

    /// The learner, to act with its policy.
    pub fn learner_mut(&mut self) -> &mut ModularDdpg {
        &mut self.learner
    }

    /// The reward.
    pub fn reward(&self) -> &Arc<dyn Reward> {
        &self.reward
    }

    /// How is trained.
    pub fn settings(&self) -> &TrainingSettings {
        &self.settings
    }
}
