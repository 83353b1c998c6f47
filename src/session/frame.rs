//! The flat numbers of one moment, and the layout by which a shell finds its way in them.
//!
//! A frame is one array of `f32`: cheap to copy across a boundary, and a row of frames is a matrix. Whole numbers are exact up to
//! 2^24; counters therefore take two numbers (units below 2^24, multiples of 2^24), and bit sets 16 bits a number. The [`Layout`]
//! is made once per session and handed out with its description, so that no shell repeats an offset.

use super::edges::EdgeIndex;
use crate::automaton::{EmbeddedState, Marks, StateId};
use crate::labels::Labels;
use crate::product::{EpMdp, MoveKind, ProductStart, ProductStep, RewardParts};
use crate::train::End;
use serde::Serialize;
use std::ops::Range;

/// The version of the layout: raised when a field changes its meaning, is renamed or goes.
pub const LAYOUT_VERSION: u32 = 1;

/// One number of a counter holds values below this.
const UNIT: u64 = 1 << 24;

/// A named stretch of a frame.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct LayoutField {
    /// The name; see [`Layout::new`] for the list.
    pub name: &'static str,
    /// Where it begins.
    pub offset: usize,
    /// How many numbers it has.
    pub length: usize,
}

/// Where each field of a frame lies.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Layout {
    /// [`LAYOUT_VERSION`].
    pub version: u32,
    /// Numbers in one frame.
    pub length: usize,
    /// The fields, in order, without gaps.
    pub fields: Vec<LayoutField>,
}

impl Layout {
    /// The layout for automata of `states` states and environments of `state` and `action` numbers.
    ///
    /// | field | numbers | meaning |
    /// |---|---|---|
    /// | `source` | 1 | a [`Source`]: 0 training, 1 greedy episode, 2 driven by hand, 3 a word |
    /// | `step` | 2 | counter: environment steps of training so far |
    /// | `updates` | 2 | counter: gradient updates so far |
    /// | `episode` | 2 | counter: the episode of training, from 0 |
    /// | `episode_step` | 1 | environment steps of this episode |
    /// | `rounds` | 1 | rounds completed in this episode |
    /// | `q`, `q_before` | 1 | automaton state now, and before the last step |
    /// | `edge` | 1 | the edge of the [`Graph`](crate::automaton::Graph) taken last |
    /// | `module` | 1 | the module in charge now; −1 in a sink |
    /// | `epsilon` | 1 | target of the ε-move made last; −1 if it was a control |
    /// | `jumps` | states/16 | bits: states that an ε-move reaches from here |
    /// | `letter` | 4 | bits: the environment's labels L(s) |
    /// | `frontier` | 2 | bits: T, accepting sets still to be visited |
    /// | `unvisited` | states/16 | bits: T_Φ, states whose first visit shaping still rewards |
    /// | `visited`, `fresh` | 2 | bits: sets visited by the last step, and those of them that were in T |
    /// | `closes_round` | 1 | 1 if the last step completed a round |
    /// | `end` | 1 | 0 going on, 1 terminated (sink), 2 truncated by the time limit |
    /// | `reward`, `discount` | 1 | R' and γ(x') of the last step |
    /// | `accepting_reward`, `sink_reward`, `shaping_reached`, `shaping_left` | 1 | the parts of R': R(x'), for a sink, γΦ(x'), −Φ(x) |
    /// | `return` | 1 | Σ R(x') of this episode |
    /// | `losses` | 3 | the last update: its module, critic loss, actor loss; −1, 0, 0 if there was none |
    /// | `state` | state | the environment's state, physical units |
    /// | `action` | action | the control applied last, in `[-1, 1]` |
    pub fn new(states: usize, state: usize, action: usize) -> Layout {
        let bits = states.div_ceil(16);
        let sizes: [(&'static str, usize); 29] = [
            ("source", 1),
            ("step", 2),
            ("updates", 2),
            ("episode", 2),
            ("episode_step", 1),
            ("rounds", 1),
            ("q", 1),
            ("q_before", 1),
            ("edge", 1),
            ("module", 1),
            ("epsilon", 1),
            ("jumps", bits),
            ("letter", 4),
            ("frontier", 2),
            ("unvisited", bits),
            ("visited", 2),
            ("fresh", 2),
            ("closes_round", 1),
            ("end", 1),
            ("reward", 1),
            ("discount", 1),
            ("accepting_reward", 1),
            ("sink_reward", 1),
            ("shaping_reached", 1),
            ("shaping_left", 1),
            ("return", 1),
            ("losses", 3),
            ("state", state),
            ("action", action),
        ];
        let mut length = 0;
        let fields = sizes
            .into_iter()
            .map(|(name, size)| {
                let field = LayoutField { name, offset: length, length: size };
                length += size;
                field
            })
            .collect();
        Layout { version: LAYOUT_VERSION, length, fields }
    }
}

/// Where a frame comes from; its number is the field `source`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Source {
    /// Training, exploration and all.
    Training = 0,
    /// An episode of the greedy policy.
    Greedy = 1,
    /// An episode that the user drives.
    Driven = 2,
    /// A word that is read without an environment.
    Word = 3,
}

/// Where a product stands, as a frame says it.
pub(super) struct Place<'a> {
    pub at: EmbeddedState,
    /// The targets of the ε-moves that can be made.
    pub jumps: &'a [StateId],
    pub rounds: u32,
    pub labels: Labels,
    pub module: Option<usize>,
    pub episode_step: u32,
}

/// Counters of training that every frame carries.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Counters {
    /// Environment steps.
    pub step: u64,
    /// Gradient updates.
    pub updates: u64,
    /// The episode, from 0.
    pub episode: u64,
}

/// Writes frames of one session: keeps what stays from step to step.
#[derive(Clone, Debug)]
pub struct FrameWriter {
    layout: Layout,
    data: Vec<f32>,
}

impl FrameWriter {
    /// A writer whose frame is all zeros.
    pub fn new(layout: Layout, source: Source) -> FrameWriter {
        let data = vec![0.0; layout.length];
        let mut writer = FrameWriter { layout, data };
        writer.put("source", &[source as u8 as f32]);
        writer.put("losses", &[-1.0, 0.0, 0.0]);
        writer
    }

    /// The frame, [`Layout::length`] numbers.
    pub fn frame(&self) -> &[f32] {
        &self.data
    }

    /// Writes the counters of training.
    pub fn counters(&mut self, counters: Counters) {
        let Counters { step, updates, episode } = counters;
        for (name, value) in [("step", step), ("updates", updates), ("episode", episode)] {
            self.put(name, &[(value % UNIT) as f32, (value / UNIT) as f32]);
        }
    }

    /// Writes the beginning of an episode: the product after it read L(s_0).
    pub fn start(&mut self, start: &ProductStart, edges: &EdgeIndex, initial: StateId) {
        for name in ["episode_step", "reward", "discount", "accepting_reward", "sink_reward", "shaping_reached", "shaping_left"] {
            self.put(name, &[0.0]);
        }
        self.put("epsilon", &[-1.0]);
        self.put("return", &[0.0]);
        self.put("q_before", &[f32::from(initial)]);
        self.put("edge", &[edges.letter(initial, start.labels).map_or(-1.0, |e| e as f32)]);
        self.marks("visited", start.visited);
        self.marks("fresh", start.visited);
        self.put("closes_round", &[f32::from(u8::from(start.closes_round))]);
        self.put("end", &[if start.sink { 1.0 } else { 0.0 }]);
    }

    /// Marks that nothing has happened yet.
    pub fn unread(&mut self, initial: StateId) {
        self.put("q_before", &[f32::from(initial)]);
        self.put("edge", &[-1.0]);
        self.put("epsilon", &[-1.0]);
    }

    /// Writes one step, what it paid, and whether it ended the episode.
    pub fn step(&mut self, step: &ProductStep, parts: &RewardParts, end: Option<End>, edges: &EdgeIndex) {
        let payoff = parts.payoff();
        let edge = match step.kind {
            MoveKind::Control => edges.letter(step.from.q, step.labels),
            MoveKind::Epsilon => edges.jump(step.from.q, step.to.q),
        };
        self.put("q_before", &[f32::from(step.from.q)]);
        self.put("edge", &[edge.map_or(-1.0, |e| e as f32)]);
        self.put("epsilon", &[if step.kind == MoveKind::Epsilon { f32::from(step.to.q) } else { -1.0 }]);
        self.marks("visited", step.visited);
        self.marks("fresh", step.fresh);
        self.put("closes_round", &[f32::from(u8::from(step.closes_round))]);
        let end = match end {
            None => 0.0,
            Some(End::Terminated) => 1.0,
            Some(End::Truncated) => 2.0,
        };
        self.put("end", &[end]);
        self.put("reward", &[payoff.reward]);
        self.put("discount", &[payoff.discount]);
        self.put("accepting_reward", &[parts.base]);
        self.put("sink_reward", &[parts.sink]);
        self.put("shaping_reached", &[parts.discount * parts.potential_after]);
        self.put("shaping_left", &[-parts.potential_before]);
    }

    /// Writes Σ R(x') of the episode so far, in the paper's units.
    pub fn total(&mut self, total: f64) {
        self.put("return", &[total as f32]);
    }

    /// Writes where the product stands after a start or a step.
    pub fn product(&mut self, product: &EpMdp, module: Option<usize>, episode_step: u32, control: &[f32]) {
        self.place(&Place {
            at: product.at(),
            jumps: product.epsilon_moves(),
            rounds: product.rounds().completed(),
            labels: product.environment().labels(),
            module,
            episode_step,
        });
        self.put("state", product.environment().state());
        self.put("action", control);
    }

    /// Writes where automaton, frontier and labels stand.
    pub(super) fn place(&mut self, place: &Place<'_>) {
        let EmbeddedState { q, frontier, unvisited } = place.at;
        self.put("episode_step", &[place.episode_step as f32]);
        self.put("rounds", &[place.rounds as f32]);
        self.put("q", &[f32::from(q)]);
        self.put("module", &[place.module.map_or(-1.0, |m| m as f32)]);
        self.marks("frontier", frontier);
        self.states("unvisited", unvisited.iter());
        self.states("jumps", place.jumps.iter().copied());
        self.letter(place.labels);
    }

    /// Writes the losses of an update.
    pub fn losses(&mut self, module: usize, critic: f32, actor: f32) {
        self.put("losses", &[module as f32, critic, actor]);
    }

    fn put(&mut self, name: &str, values: &[f32]) {
        let field = self.field(name);
        self.data[field].copy_from_slice(values);
    }

    fn field(&self, name: &str) -> Range<usize> {
        let field = self.layout.fields.iter().find(|f| f.name == name).expect("the layout has every field that is written");
        field.offset..field.offset + field.length
    }

    fn marks(&mut self, name: &str, marks: Marks) {
        self.put(name, &[(marks.0 & 0xffff) as f32, (marks.0 >> 16) as f32]);
    }

    fn letter(&mut self, labels: Labels) {
        let part = |k: u32| (labels.0 >> (16 * k) & 0xffff) as f32;
        self.put("letter", &[part(0), part(1), part(2), part(3)]);
    }

    fn states(&mut self, name: &str, states: impl Iterator<Item = StateId>) {
        let field = self.field(name);
        self.data[field.clone()].fill(0.0);
        for q in states {
            self.data[field.start + q as usize / 16] += f32::from(1u16 << (q % 16));
        }
    }
}
