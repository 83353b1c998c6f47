//! What a learner holds, as text and tensors for a checkpoint, and back: everything that the next step depends on.

use super::exploration::Hold;
use super::modular::ModularDdpg;
use super::trace::Entry;
use crate::automaton::{EmbeddedState, Embedding, Marks, StateSet};
use crate::env::Outcome;
use crate::labels::Labels;
use crate::nn::NetworkTensor;
use crate::rng::{Rng, RngState};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// Whether a checkpoint holds the replays, which are most of it. Without them training goes on, but not as it would have.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Replays {
    /// Leave them out.
    Leave,
    /// Keep them: the restored learner goes on bit by bit as the saved one.
    Keep,
}

/// The part of a learner's memory that is no tensor. 64-bit numbers stand as text, since TOML's integers are signed.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LearnerMemory {
    steps: u64,
    noise: RngState,
    replay: RngState,
    hold_left: u32,
    /// Updates per module.
    updates: Vec<u64>,
    /// Where each replay writes next; empty without replays.
    cursors: Vec<usize>,
    /// Waiting transitions, oldest first: embedded state, letter before, letter after, ending.
    trace: Vec<(String, String, String, bool)>,
    /// The embedded states that replays refer to by number.
    embedded: Vec<String>,
}

/// Numbers below this are exact in a 32-bit floating-point number.
const MAX_TABLE: usize = 1 << 24;

/// (q, T, T_Φ) as text: `2 5 1,3`, the state, the bits of T, the states of T_Φ.
pub fn embedded_to_text(at: EmbeddedState) -> String {
    let states: Vec<String> = at.unvisited.iter().map(|q| q.to_string()).collect();
    format!("{} {} {}", at.q, at.frontier.0, states.join(","))
}

/// What [`embedded_to_text`] wrote, if it is an embedded state of `embedding`.
pub fn embedded_from_text(text: &str, embedding: &Embedding) -> Option<EmbeddedState> {
    let mut parts = text.split(' ');
    let (q, frontier, states) = (parts.next()?.parse().ok()?, parts.next()?.parse().ok()?, parts.next()?);
    let mut unvisited = StateSet::EMPTY;
    for state in states.split(',').filter(|s| !s.is_empty()) {
        let state = state.parse().ok().filter(|&s: &u16| embedding.start().unvisited.contains(s))?;
        unvisited = unvisited.with(state);
    }
    let automaton = embedding.automaton();
    let fits = usize::from(q) < automaton.len() && frontier & !automaton.all_sets().0 == 0 && parts.next().is_none();
    fits.then_some(EmbeddedState { q, frontier: Marks(frontier), unvisited })
}

fn tensor(name: String, columns: usize, values: Vec<f32>) -> NetworkTensor {
    let rows = values.len().checked_div(columns).unwrap_or(0);
    NetworkTensor { name, shape: vec![rows, columns], values }
}

/// Collects embedded states, each once.
#[derive(Default)]
struct Table {
    numbers: HashMap<EmbeddedState, usize>,
    texts: Vec<String>,
}

impl Table {
    fn number(&mut self, at: EmbeddedState) -> f32 {
        let next = self.texts.len();
        let number = *self.numbers.entry(at).or_insert(next);
        if number == next {
            self.texts.push(embedded_to_text(at));
        }
        number as f32
    }
}

impl ModularDdpg {
    /// Everything this learner's next step depends on: text, and tensors whose names begin with `module.`, `learner.` or `replay.`.
    pub fn save(&self, replays: Replays) -> (LearnerMemory, Vec<NetworkTensor>) {
        let control = self.sizes().control;
        let mut tensors = vec![];
        let mut table = Table::default();
        let mut cursors = vec![];
        for (m, module) in self.modules.iter().enumerate() {
            for t in module.networks.tensors(true) {
                tensors.push(NetworkTensor { name: format!("module.{m}.{}", t.name), ..t });
            }
            if replays == Replays::Keep {
                let (numbers, embedded, cursor) = module.replay.parts();
                let indices: Vec<f32> = embedded.iter().flatten().map(|&at| table.number(at)).collect();
                tensors.push(tensor(format!("replay.{m}.numbers"), module.replay.row(), numbers.to_vec()));
                tensors.push(tensor(format!("replay.{m}.embedded"), 2, indices));
                cursors.push(cursor);
            }
        }
        let noise = self.modules.iter().flat_map(|m| m.noise.value().to_vec()).collect();
        tensors.push(tensor("learner.noise".to_owned(), control, noise));
        tensors.push(tensor("learner.hold".to_owned(), control, self.hold.control().to_vec()));
        tensors.push(tensor("learner.actor_loss".to_owned(), 1, self.modules.iter().map(|m| m.actor_loss).collect()));
        let (mut trace, mut numbers) = (vec![], vec![]);
        for e in self.trace.entries() {
            let ended = e.outcome == Outcome::Terminated;
            trace.push((embedded_to_text(e.at), format!("{:x}", e.labels.0), format!("{:x}", e.next_labels.0), ended));
            for part in [&e.observation, &e.next, &e.control] {
                numbers.extend_from_slice(part);
            }
        }
        tensors.push(tensor("learner.trace".to_owned(), 2 * self.sizes().observation + control, numbers));
        let memory = LearnerMemory {
            steps: self.steps,
            noise: self.noise_rng.state(),
            replay: self.replay_rng.state(),
            hold_left: self.hold.left(),
            updates: self.modules.iter().map(|m| m.updates).collect(),
            cursors,
            trace,
            embedded: table.texts,
        };
        (memory, tensors)
    }

    /// Takes over what [`ModularDdpg::save`] gave, into a fresh learner of the same settings; `tensors` yields a tensor by its name.
    ///
    /// # Errors
    /// A sentence about what does not fit. The learner must not be used then.
    pub fn restore(
        &mut self,
        memory: &LearnerMemory,
        tensors: &dyn Fn(&str) -> Option<NetworkTensor>,
        networks: &dyn Fn(&str) -> Vec<NetworkTensor>,
    ) -> Result<(), String> {
        let sizes = self.sizes();
        let count = self.modules.len();
        let take = |name: String, length: Option<usize>| -> Result<Vec<f32>, String> {
            let tensor = tensors(&name).ok_or_else(|| format!("the tensor `{name}` is missing"))?;
            let fits = length.is_none_or(|length| length == tensor.values.len());
            if fits { Ok(tensor.values) } else { Err(format!("the tensor `{name}` has the wrong size")) }
        };
        let rng = |state: &RngState| Rng::restore(state).ok_or("a random stream's state is invalid");
        if memory.updates.len() != count || !(memory.cursors.is_empty() || memory.cursors.len() == count) {
            return Err("the number of modules differs".to_owned());
        }
        let at = |text: &String| embedded_from_text(text, &self.embedding).ok_or(format!("`{text}` is no embedded state"));
        let table: Vec<EmbeddedState> = memory.embedded.iter().map(at).collect::<Result<_, _>>()?;
        let trace = self.entries(memory, &take("learner.trace".to_owned(), None)?)?;
        let noise = take("learner.noise".to_owned(), Some(count * sizes.control))?;
        let losses = take("learner.actor_loss".to_owned(), Some(count))?;
        self.hold = Hold::restored(take("learner.hold".to_owned(), Some(sizes.control))?, memory.hold_left);
        (self.noise_rng, self.replay_rng) = (rng(&memory.noise)?, rng(&memory.replay)?);
        self.steps = memory.steps;
        self.current = None;
        if !self.trace.restore(trace) {
            return Err("the waiting transitions do not fit".to_owned());
        }
        for m in 0..count {
            let parts = networks(&format!("module.{m}."));
            if parts.len() != self.modules[m].networks.tensors(true).len() {
                return Err(format!("tensors of `module.{m}` are missing"));
            }
            self.modules[m].networks.load(&parts)?;
            if !self.modules[m].noise.restore(&noise[m * sizes.control..(m + 1) * sizes.control]) {
                return Err("the noise does not fit".to_owned());
            }
            self.modules[m].updates = memory.updates[m];
            self.modules[m].actor_loss = losses[m];
            if let Some(&cursor) = memory.cursors.get(m) {
                let numbers = take(format!("replay.{m}.numbers"), None)?;
                let indices = take(format!("replay.{m}.embedded"), None)?;
                self.restore_replay(m, numbers, &indices, &table, cursor)?;
            }
        }
        Ok(())
    }

    fn restore_replay(
        &mut self,
        m: usize,
        numbers: Vec<f32>,
        indices: &[f32],
        table: &[EmbeddedState],
        cursor: usize,
    ) -> Result<(), String> {
        let (pairs, rest) = indices.as_chunks::<2>();
        let one = |&i: &f32| (i >= 0.0 && i < MAX_TABLE as f32).then(|| table.get(i as usize).copied()).flatten();
        let both = |[a, b]: &[f32; 2]| Some([one(a)?, one(b)?]);
        let embedded: Option<Vec<[EmbeddedState; 2]>> = pairs.iter().map(both).collect();
        let embedded = embedded.filter(|_| rest.is_empty()).ok_or("a replay refers to embedded states that do not exist")?;
        let replay = &mut self.modules[m].replay;
        if !replay.restore(numbers, embedded, cursor) {
            return Err("a replay does not fit".to_owned());
        }
        let fits = |k| {
            let sample = replay.get(k);
            self.index.of(sample.at) == Some(m)
                && (sample.discount == 0.0 || self.index.candidates(sample.next_at).next().is_some())
        };
        if (0..replay.len()).all(fits) { Ok(()) } else { Err("a replay holds samples of another module".to_owned()) }
    }

    fn entries(&self, memory: &LearnerMemory, numbers: &[f32]) -> Result<Vec<Entry>, String> {
        let sizes = self.sizes();
        let row = 2 * sizes.observation + sizes.control;
        if numbers.len() != row * memory.trace.len() {
            return Err("the tensor `learner.trace` has the wrong size".to_owned());
        }
        let letter = |text: &String| u64::from_str_radix(text, 16).map(Labels).map_err(|_| format!("`{text}` is no letter"));
        let mut entries = vec![];
        for ((at, labels, next_labels, ended), numbers) in memory.trace.iter().zip(numbers.chunks_exact(row)) {
            let (observation, rest) = numbers.split_at(sizes.observation);
            let (next, control) = rest.split_at(sizes.observation);
            entries.push(Entry {
                observation: observation.to_vec(),
                at: embedded_from_text(at, &self.embedding).ok_or(format!("`{at}` is no embedded state"))?,
                labels: letter(labels)?,
                control: control.to_vec(),
                next: next.to_vec(),
                next_labels: letter(next_labels)?,
                outcome: if *ended { Outcome::Terminated } else { Outcome::Running },
            });
        }
        Ok(entries)
    }
}
