//! What is timed and by whom: contenders compute a measure some number of times and say how long one took.

use crate::agent::Engine;
use crate::nn::fused::{Fused, Kernel};
use crate::nn::plain::Plain;
use crate::nn::workload::Workload;
use crate::nn::{ActorCritic, NetworkShape};
use crate::rng::{Purpose, Rng};
use crate::task::{Setup, Task};
use crate::train::Trainer;
use std::collections::BTreeMap;
use std::time::Instant;

/// The task whose environment steps are counted: Ball-Pass with the recipe of the paper, one update of 64 samples a step.
const TASK: &str = include_str!("../../../specs/ball_pass_b1.toml");
const AUTOMATON: &str = include_str!("../../../specs/ball_pass_b1.hoa");

/// Steps before the clock runs: until the replays hold a batch and every step updates.
const WARM_UP: usize = 2000;

/// One thing that is timed.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, serde::Serialize)]
#[serde(rename_all = "snake_case", tag = "what")]
pub enum Measure {
    /// A full update: batch, targets, critic, actor, soft updates; observation 8, action 2, two hidden layers.
    Update {
        /// Width of the hidden layers.
        hidden: usize,
        /// Samples in the batch.
        rows: usize,
    },
    /// One action for one observation; hidden layers of 64.
    Act,
    /// One training step of Ball-Pass: environment, product, replay and one update of 64 samples.
    Step,
    /// The update of such a step alone.
    StepUpdate,
}

impl Measure {
    /// All measures.
    pub const ALL: [Measure; 6] = [
        Measure::Update { hidden: 64, rows: 64 },
        Measure::Update { hidden: 128, rows: 128 },
        Measure::Update { hidden: 256, rows: 128 },
        Measure::Act,
        Measure::Step,
        Measure::StepUpdate,
    ];

    /// The networks and rows of an update.
    pub fn shape(self) -> Option<(NetworkShape, usize)> {
        match self {
            Measure::Update { hidden, rows } => Some((NetworkShape::new(8, 2, &[hidden, hidden]), rows)),
            _ => None,
        }
    }
}

/// Someone who computes.
pub trait Contender {
    /// Who.
    fn name(&self) -> &str;
    /// Seconds that one `measure` took on average of `count`; `None` if this contender does not do it.
    ///
    /// # Errors
    /// What kept it from computing.
    fn time(&mut self, measure: Measure, count: usize) -> Result<Option<f64>, String>;
}

/// Networks of this crate, computed in this process.
pub struct Native {
    name: String,
    engine: Engine,
    workloads: BTreeMap<Measure, Workload>,
    trainer: Option<Trainer>,
}

impl Native {
    fn new(name: &str, engine: Engine) -> Native {
        Native { name: name.to_owned(), engine, workloads: BTreeMap::new(), trainer: None }
    }

    /// Every implementation that this build has, the fastest first.
    pub fn all() -> Vec<Native> {
        fn fused(shape: &NetworkShape, rng: &mut Rng) -> Box<dyn ActorCritic> {
            Box::new(Fused::new(shape, rng))
        }
        fn portable(shape: &NetworkShape, rng: &mut Rng) -> Box<dyn ActorCritic> {
            Box::new(Fused::with_kernel(shape, rng, Kernel::PORTABLE))
        }
        fn plain(shape: &NetworkShape, rng: &mut Rng) -> Box<dyn ActorCritic> {
            Box::new(Plain::new(shape, rng))
        }
        let fastest = format!("fast kernel, {}", Kernel::fastest().name());
        let mut all = vec![Native::new(&fastest, fused)];
        if Kernel::fastest() != Kernel::PORTABLE {
            all.push(Native::new("fast kernel, portable", portable));
        }
        #[cfg(feature = "burn")]
        {
            use crate::nn::reference::{Backend, Reference};
            fn flex(shape: &NetworkShape, rng: &mut Rng) -> Box<dyn ActorCritic> {
                Box::new(Reference::new(shape, rng, Backend::Flex))
            }
            fn ndarray(shape: &NetworkShape, rng: &mut Rng) -> Box<dyn ActorCritic> {
                Box::new(Reference::new(shape, rng, Backend::NdArray))
            }
            all.push(Native::new(Backend::Flex.name(), flex));
            all.push(Native::new(Backend::NdArray.name(), ndarray));
        }
        all.push(Native::new("plain networks, f64", plain));
        all
    }

    fn workload(&self, shape: &NetworkShape, rows: usize) -> Workload {
        let module = (self.engine)(shape, &mut Rng::new(1, Purpose::Initialisation));
        let mut workload = Workload::new(module, rows, 1);
        workload.update();
        workload
    }

    fn trainer(&mut self) -> &mut Trainer {
        self.trainer.get_or_insert_with(|| {
            let task = Task::parse(TASK, "ball_pass_b1.toml").expect("the task file is tested");
            let setup = Setup::open(task, "paper", &[], Some(AUTOMATON)).expect("the task file is tested");
            let mut trainer = setup.trainer_on(self.engine, 1);
            trainer.ticks().take(WARM_UP).for_each(|_| {});
            trainer
        })
    }
}

impl Contender for Native {
    fn name(&self) -> &str {
        &self.name
    }

    fn time(&mut self, measure: Measure, count: usize) -> Result<Option<f64>, String> {
        let mean = |start: Instant| Ok(Some(start.elapsed().as_secs_f64() / count as f64));
        if measure == Measure::Step {
            let trainer = self.trainer();
            let start = Instant::now();
            trainer.ticks().take(count).for_each(|_| {});
            return mean(start);
        }
        if !self.workloads.contains_key(&measure) {
            let (shape, rows) = match measure {
                Measure::StepUpdate => (module_shape(self.trainer()), 64),
                _ => measure.shape().unwrap_or((NetworkShape::new(8, 2, &[64, 64]), 64)),
            };
            self.workloads.insert(measure, self.workload(&shape, rows));
        }
        let workload = self.workloads.get_mut(&measure).expect("it was put there");
        let start = Instant::now();
        let compute = |workload: &mut Workload| match measure {
            Measure::Act => workload.act(),
            _ => workload.update().critic,
        };
        for _ in 0..count {
            std::hint::black_box(compute(workload));
        }
        mean(start)
    }
}

/// The networks that a trainer's modules have.
fn module_shape(trainer: &Trainer) -> NetworkShape {
    let policy = trainer.learner().policy();
    let actor = policy[0].iter().filter(|tensor| tensor.name.starts_with("actor.") && tensor.name.ends_with(".weight"));
    let weights: Vec<_> = actor.map(|tensor| &tensor.shape).collect();
    let hidden: Vec<usize> = weights[1..].iter().map(|shape| shape[0]).collect();
    NetworkShape::new(weights[0][0], weights[weights.len() - 1][1], &hidden)
}
