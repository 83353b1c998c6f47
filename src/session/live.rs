//! The session itself: one run of training, and everything that can be read from it or done with its policy.

use super::activity::{Activity, ModuleStatistics};
use super::curves::{CurveRecorder, Curves, EpisodeLosses, EpisodeOutcome};
use super::describe::{Description, EnvironmentFacts, TaskFacts, settings};
use super::drive::Drive;
use super::edges::EdgeIndex;
use super::frame::{Counters, FrameWriter, Layout, Source};
use super::open::{OpenRequest, Opened};
use super::refusal::{Refusal, Subject};
use super::translation::Translator;
use super::trial::{BestPolicy, Trial, TrialProgress};
use super::value_map::{self, ValueMap, ValueMapRequest};
use super::word::{self, Word, WordReading};
use super::{FormulaFacts, builtin};
use crate::automaton::{EmbeddedState, StateId, StateTracking};
use crate::eval::Rollout;
use crate::ltl::Formula;
use crate::rng::{Purpose, Rng};
use crate::task::Setup;
use crate::train::{End, Run, Tick};
use serde::Serialize;

/// The most episodes that one evaluation plays.
const MAX_RUNS: u32 = 100_000;

/// How much cheaper a move of an evaluation is than a step of training with its updates.
const TRIAL_MOVES: u32 = 8;

/// One greedy episode, frame by frame.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct EpisodeTrace {
    /// How many frames there are: the start, and one per move.
    pub rows: usize,
    /// The frames, end to end.
    pub data: Vec<f32>,
    /// Completed rounds.
    pub rounds: u32,
    /// Whether it satisfies the task.
    pub success: bool,
}

/// An open task under training.
pub struct Session {
    pub(super) request: OpenRequest,
    pub(super) setup: Setup,
    name: String,
    hoa: String,
    seed: u64,
    pub(super) run: Run,
    edges: EdgeIndex,
    layout: Layout,
    pub(super) curves: CurveRecorder,
    pub(super) activity: Vec<Activity>,
    last: Option<Tick>,
    /// Whether the critics are those of the policy: some policy files hold actors alone.
    pub(super) critics: bool,
    /// Σ R(x') of the present episode, and the losses of its updates.
    pub(super) total: f64,
    pub(super) losses: EpisodeLosses,
    /// A periodic evaluation of training that is going on.
    pub(super) check: Option<Trial>,
    trial: Option<Trial>,
    drive: Option<Drive>,
}

impl Session {
    /// Opens a task with a fresh learner.
    ///
    /// # Errors
    /// What is wrong with the task, formula, automaton, preset or overrides, and where.
    pub fn open(request: &OpenRequest) -> Result<Session, Refusal> {
        let Opened { setup, name, hoa } = request.open()?;
        let run = setup.run(request.seed);
        let request = OpenRequest { preset: Some(setup.preset_name().to_owned()), ..request.clone() };
        Ok(Session::around(request, setup, name, hoa, run))
    }

    pub(super) fn around(request: OpenRequest, setup: Setup, name: String, hoa: String, run: Run) -> Session {
        let edges = EdgeIndex::new(setup.automaton().clone());
        let product = run.trainer().product();
        let spec = product.environment().spec();
        let layout = Layout::new(setup.automaton().len(), spec.state.len(), spec.action.len());
        let modules = run.trainer().learner().modules().len();
        let activity = vec![Activity::default(); modules];
        Session {
            seed: run.seed(),
            request,
            setup,
            name,
            hoa,
            run,
            edges,
            layout,
            curves: CurveRecorder::default(),
            activity,
            last: None,
            critics: true,
            total: 0.0,
            losses: EpisodeLosses::new(modules),
            check: None,
            trial: None,
            drive: None,
        }
    }

    /// Everything that does not change from step to step.
    pub fn describe(&self) -> Description {
        let task = self.setup.task();
        let product = self.run.trainer().product();
        let environment = EnvironmentFacts::new(product.environment());
        let known: Vec<String> = environment.propositions.iter().map(|p| p.name.clone()).collect();
        let text = &task.file().specification.ltl;
        let reading = Formula::read(text).expect("the task's formula was parsed when it was opened");
        let modules = self.run.trainer().learner().modules();
        let preset = toml::Value::try_from(self.setup.preset()).expect("a preset is made of tables, numbers and texts");
        Description {
            task: TaskFacts {
                name: self.name.clone(),
                title: task.file().title.clone(),
                description: task.file().description.clone(),
                preset: self.setup.preset_name().to_owned(),
                presets: builtin::presets(task),
                max_steps: self.setup.rollout_settings().max_steps,
                text: task.text().to_owned(),
            },
            formula: FormulaFacts::new(text, &reading, &known),
            environment,
            automaton: self.setup.automaton().graph(),
            hoa: self.hoa.clone(),
            shaping: product.embedding().tracking() == StateTracking::On,
            modules: (0..modules.len()).map(|m| modules.name(m).to_owned()).collect(),
            settings: settings(&preset).into_iter().filter(|s| s.key != "description").collect(),
            seed: self.seed,
            layout: self.layout.clone(),
            request: self.request.clone(),
        }
    }

    /// Translates formulas for the environment of this session.
    pub fn translator(&self) -> Translator {
        let labels = &self.setup.task().file().specification.labels;
        Translator::of_environment(self.run.trainer().product().environment(), labels)
    }

    /// Trains for at most `steps` moves and the updates after them, and at first no further than the recipe's end, where the policy is
    /// the one that its last evaluation has seen; the number of moves made. While an evaluation is due, its moves are made instead.
    pub fn advance(&mut self, steps: u32) -> u32 {
        let (beyond, mut made) = (self.finished(), 0);
        for _ in 0..steps {
            if self.check.is_some() {
                self.advance_check();
            } else {
                let tick = self.run.trainer_mut().step();
                made += 1;
                self.fold(&tick);
                self.check = self.run.due().map(|seed| {
                    let settings = *self.run.trainer().settings();
                    let trial = Trial::new(self.setup.rollout(seed), settings.evaluation_runs, seed);
                    trial.giving_up_after(settings.evaluation_failures)
                });
            }
            if !beyond && self.finished() {
                break;
            }
        }
        made
    }

    pub(super) fn advance_check(&mut self) {
        let check = self.check.as_mut().expect("asked only while one is going on");
        if !check.advance(self.run.trainer_mut().learner_mut(), TRIAL_MOVES) {
            let check = self.check.take().expect("it was there a line ago");
            self.run.take_in(check.played(), check.seed());
        }
    }

    fn fold(&mut self, tick: &Tick) {
        if tick.start.is_some() {
            self.total = 0.0;
            self.losses.clear();
        }
        self.total += f64::from(tick.reward.base);
        let learner = self.run.trainer().learner();
        if let Some(module) = learner.modules().of(tick.product.from).or(learner.acting()) {
            self.activity[module].visits += 1;
        }
        if let Some(update) = tick.update {
            let activity = &mut self.activity[update.module];
            activity.updates += 1;
            (activity.critic, activity.actor) = (update.losses.critic, update.losses.actor);
            self.losses.add(update.module, update.losses.critic);
        }
        if let Some(end) = tick.counted_end() {
            let outcome = EpisodeOutcome {
                steps: tick.episode_step,
                total: self.total,
                rounds: tick.rounds,
                success: tick.rounds > 0 && end != End::Terminated,
            };
            self.curves.push(outcome, &self.losses);
        }
        self.last = Some(*tick);
    }

    /// Environment steps of training so far.
    pub fn steps(&self) -> u64 {
        self.run.trainer().steps()
    }

    /// Environment steps at the first periodic evaluation without a failure.
    pub fn first_perfect_step(&self) -> Option<u64> {
        self.run.first_perfect_step()
    }

    /// What the best policy so far came to; `None` before the first periodic evaluation.
    pub fn best(&self) -> Option<BestPolicy> {
        self.run.best().map(BestPolicy::of)
    }

    /// Whether the recipe's budget is spent, or its goal reached. Training may go on nevertheless.
    pub fn finished(&self) -> bool {
        self.check.is_none() && self.run.finished()
    }

    fn counters(&self) -> Counters {
        let trainer = self.run.trainer();
        Counters { step: trainer.steps(), updates: trainer.learner().updates(), episode: trainer.episode() }
    }

    fn initial(&self) -> StateId {
        self.setup.automaton().initial()
    }

    /// The numbers of this moment of training, as [`Session::describe`]'s layout names them.
    pub fn frame(&self) -> Vec<f32> {
        let trainer = self.run.trainer();
        let mut writer = FrameWriter::new(self.layout.clone(), Source::Training);
        writer.counters(self.counters());
        let steps = match &self.last {
            Some(tick) => {
                writer.step(&tick.product, &tick.reward, tick.end, &self.edges);
                if let Some(update) = tick.update {
                    writer.losses(update.module, update.losses.critic, update.losses.actor);
                }
                tick.episode_step
            }
            None => {
                writer.unread(self.initial());
                0
            }
        };
        writer.total(self.total);
        let module = trainer.learner().modules().of(trainer.product().at()).or(trainer.learner().acting());
        writer.product(trainer.product(), module, steps, trainer.control());
        writer.frame().to_vec()
    }

    /// One episode of the greedy policy as it is now; `index` chooses the start.
    pub fn rollout(&mut self, index: u64) -> EpisodeTrace {
        let rollout = self.setup.rollout(start_seed(self.seed, index));
        self.trace(rollout)
    }

    /// One episode of the greedy policy from a start of one's own: a state in physical units, clamped to its range; `index` chooses
    /// the chances on the way.
    ///
    /// # Errors
    /// A state of another length than the environment's.
    pub fn rollout_from(&mut self, index: u64, state: &[f32]) -> Result<EpisodeTrace, Refusal> {
        let wanted = self.run.trainer().product().environment().spec().state.len();
        if state.len() != wanted {
            return Err(Refusal::new(Subject::Session, format!("a state has {wanted} numbers here, not {}", state.len())));
        }
        let mut rollout = self.setup.rollout(start_seed(self.seed, index));
        rollout.restart_at(state);
        Ok(self.trace(rollout))
    }

    /// Plays `rollout` to its end.
    fn trace(&mut self, mut rollout: Rollout) -> EpisodeTrace {
        let counters = self.counters();
        let (initial, reward) = (self.initial(), self.setup.reward().clone());
        let learner = self.run.trainer_mut().learner_mut();
        let mut writer = FrameWriter::new(self.layout.clone(), Source::Greedy);
        let mut data = vec![];
        writer.counters(counters);
        writer.start(rollout.start(), &self.edges, initial);
        let in_charge = |learner: &crate::agent::ModularDdpg, at: EmbeddedState| learner.modules().of(at).or(learner.acting());
        writer.product(rollout.product(), in_charge(learner, rollout.product().at()), 0, rollout.control());
        data.extend_from_slice(writer.frame());
        while let Some(step) = rollout.step(learner) {
            let end = match (step.ends(), rollout.over()) {
                (true, _) => Some(End::Terminated),
                (false, true) => Some(End::Truncated),
                (false, false) => None,
            };
            writer.step(&step, &reward.parts(&step), end, &self.edges);
            let episode = rollout.episode();
            writer.total(f64::from(episode.total_reward));
            writer.product(rollout.product(), in_charge(learner, step.to), episode.steps, rollout.control());
            data.extend_from_slice(writer.frame());
        }
        let episode = rollout.episode();
        let rows = data.len() / self.layout.length;
        EpisodeTrace { rows, data, rounds: episode.rounds, success: episode.success() }
    }

    /// Begins an evaluation of `runs` episodes (at most 100 000) with starts drawn from the session's seed.
    ///
    /// # Errors
    /// No episode, or more than are allowed.
    pub fn begin_evaluation(&mut self, runs: u32) -> Result<(), Refusal> {
        if !(1..=MAX_RUNS).contains(&runs) {
            return Err(Refusal::new(Subject::Session, format!("an evaluation has 1 to {MAX_RUNS} runs, not {runs}")));
        }
        self.trial = Some(Trial::new(self.setup.rollout(self.seed), runs, self.seed));
        Ok(())
    }

    /// Makes at most `steps` moves of the evaluation; whether there is more to do.
    pub fn advance_evaluation(&mut self, steps: u32) -> bool {
        let learner = self.run.trainer_mut().learner_mut();
        self.trial.as_mut().is_some_and(|trial| trial.advance(learner, steps))
    }

    /// How the last evaluation stands; `None` if there was none.
    pub fn evaluation(&self) -> Option<TrialProgress> {
        self.trial.as_ref().map(Trial::progress)
    }

    /// Begins an episode that the user drives, and gives its first frame; `index` chooses the start.
    pub fn begin_drive(&mut self, index: u64) -> Vec<f32> {
        let drive = Drive::new(&self.setup, &self.layout, &self.edges, start_seed(self.seed, index));
        let frame = drive.frame().to_vec();
        self.drive = Some(drive);
        frame
    }

    /// One step under the user's `control` (a number in `[-1, 1]` per action channel), or along the ε-jump to `jump`; the frame after
    /// it. An episode that is over stays as it is.
    ///
    /// # Errors
    /// No episode was begun, the control has the wrong length, or there is no such ε-jump.
    pub fn drive(&mut self, control: &[f32], jump: Option<StateId>) -> Result<Vec<f32>, Refusal> {
        let drive = self.drive.as_mut().ok_or_else(|| Refusal::new(Subject::Session, "no episode was begun"))?;
        drive.step(control, jump, &self.edges)?;
        Ok(drive.frame().to_vec())
    }

    /// Reads an infinite word letter by letter with the automaton, the frontier and the reward of this session.
    ///
    /// # Errors
    /// A word that is none, a proposition that the environment does not have, or an ε-jump that does not exist.
    pub fn read_word(&self, word: &Word) -> Result<WordReading, Refusal> {
        let specification = &self.setup.task().file().specification;
        let formula = Formula::parse(&specification.ltl).expect("the task's formula was parsed when it was opened");
        let product = self.run.trainer().product();
        let reward = self.setup.reward().as_ref();
        word::read(product, reward, (&self.layout, &self.edges), (&formula, &specification.labels), word)
    }

    /// What the critic of the module in charge thinks of a plane of states.
    ///
    /// # Errors
    /// A grid that is empty or too fine, an embedded state that no module is in charge of, or a policy that came without its critics.
    pub fn value_map(&mut self, request: &ValueMapRequest) -> Result<ValueMap, Refusal> {
        if !self.critics {
            let message = "this policy came without its critics: it knows what to do, but not what that is worth";
            return Err(Refusal::new(Subject::Session, message));
        }
        let product = self.run.trainer().product().clone();
        value_map::over(&product, self.run.trainer_mut().learner_mut(), request)
    }

    /// The learning curves so far.
    pub fn curves(&self) -> Curves {
        self.curves.curves()
    }

    /// How each module has fared.
    pub fn statistics(&self) -> Vec<ModuleStatistics> {
        let learner = self.run.trainer().learner();
        let each = |(m, a): (usize, &Activity)| ModuleStatistics {
            name: learner.modules().name(m).to_owned(),
            visits: a.visits,
            replay: learner.samples_of(m),
            capacity: learner.settings().replay,
            updates: a.updates,
            critic: a.critic,
            actor: a.actor,
        };
        self.activity.iter().enumerate().map(each).collect()
    }
}

/// The seed of the `index`-th start that a session shows.
fn start_seed(seed: u64, index: u64) -> u64 {
    Rng::new(seed ^ index.wrapping_mul(0x9e37_79b9_7f4a_7c15), Purpose::Tool).bits()
}
