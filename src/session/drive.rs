//! An episode that the user drives by hand: the same product, the same reward, somebody else's policy.

use super::edges::EdgeIndex;
use super::frame::{FrameWriter, Layout, Source};

use super::refusal::{Refusal, Subject};
use crate::automaton::StateId;
use crate::product::{EpMdp, Move, Reward};
use crate::rng::{Purpose, Rng};
use crate::task::Setup;
use crate::train::End;
use std::sync::Arc;

/// An episode under the user's hand.
pub(super) struct Drive {
    product: EpMdp,
    reward: Arc<dyn Reward>,
    rng: Rng,
    max_steps: u32,
    steps: u32,
    total: f64,
    writer: FrameWriter,
}

impl Drive {
    /// An episode from a start drawn from `seed`.
    pub fn new(setup: &Setup, layout: &Layout, edges: &EdgeIndex, seed: u64) -> Drive {
        let mut rng = Rng::new(seed, Purpose::Evaluation);
        let mut product = setup.product();
        let settings = setup.rollout_settings();
        let start = product.reset(settings.start, &mut rng);
        let mut writer = FrameWriter::new(layout.clone(), Source::Driven);
        writer.start(&start, edges, setup.automaton().initial());
        let still = vec![0.0; product.environment().spec().action.len()];
        writer.product(&product, None, 0, &still);
        Drive { product, reward: setup.reward().clone(), rng, max_steps: settings.max_steps, steps: 0, total: 0.0, writer }
    }

    /// One step under `control`, or along the ε-jump to `jump`; nothing once the episode is over.
    pub fn step(&mut self, control: &[f32], jump: Option<StateId>, edges: &EdgeIndex) -> Result<(), Refusal> {
        let wanted = self.product.environment().spec().action.len();
        if control.len() != wanted {
            let message = format!("a control has {wanted} numbers here, not {}", control.len());
            return Err(Refusal::new(Subject::Session, message));
        }
        if let Some(target) = jump.filter(|target| !self.product.epsilon_moves().contains(target)) {
            let message = format!("there is no ε-jump to q{target} from q{}", self.product.at().q);
            return Err(Refusal::new(Subject::Session, message));
        }
        if self.product.ended() || self.steps >= self.max_steps {
            return Ok(());
        }
        let step = self.product.step(jump.map_or(Move::Control(control), Move::Epsilon), &mut self.rng);
        self.steps += u32::from(jump.is_none());
        let parts = self.reward.parts(&step);
        self.total += f64::from(parts.base);
        let end = match (step.ends(), self.steps >= self.max_steps) {
            (true, _) => Some(End::Terminated),
            (false, true) => Some(End::Truncated),
            (false, false) => None,
        };
        self.writer.step(&step, &parts, end, edges);
        self.writer.total(self.total);
        self.writer.product(&self.product, None, self.steps, control);
        Ok(())
    }

    /// The frame of this moment.
    pub fn frame(&self) -> &[f32] {
        self.writer.frame()
    }
}
