//! The replay of one module: a ring of samples, flat in memory, that grows up to its capacity.

use crate::automaton::EmbeddedState;

/// One sample (x, u, R, Γ, x') for the target y = R + Γ·max V'(x'): of one step, or of several added up.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Sample<'a> {
    /// The observation of s.
    pub observation: &'a [f32],
    /// The embedded part of x.
    pub at: EmbeddedState,
    /// The control u that was used in x.
    pub control: &'a [f32],
    /// R, the discounted sum of rewards from x to x', scaled.
    pub reward: f32,
    /// Γ, the product of the discounts from x to x'; 0 if nothing follows.
    pub discount: f32,
    /// The observation of s'.
    pub next: &'a [f32],
    /// The embedded part of x'.
    pub next_at: EmbeddedState,
}

/// A ring of samples.
#[derive(Clone, PartialEq, Debug)]
pub struct Replay {
    capacity: usize,
    observation: usize,
    control: usize,
    /// Where the next sample goes once the ring is full.
    cursor: usize,
    /// Per sample: observation of s, observation of s', control, R, Γ.
    numbers: Vec<f32>,
    /// Per sample: the embedded parts of x and x'.
    embedded: Vec<[EmbeddedState; 2]>,
}

impl Replay {
    /// An empty replay for observations and controls of the given lengths, which allocates as it fills.
    ///
    /// # Panics
    /// If `capacity` is 0.
    pub fn new(capacity: usize, observation: usize, control: usize) -> Replay {
        assert!(capacity > 0, "a replay keeps at least one sample");
        Replay { capacity, observation, control, cursor: 0, numbers: vec![], embedded: vec![] }
    }

    /// How many samples there are.
    pub fn len(&self) -> usize {
        self.embedded.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.embedded.is_empty()
    }

    /// Numbers per sample.
    pub fn row(&self) -> usize {
        2 * self.observation + self.control + 2
    }

    /// Adds a sample, in place of the oldest if the replay is full.
    pub fn push(&mut self, sample: &Sample<'_>) {
        let tail = [sample.reward, sample.discount];
        let parts = [sample.observation, sample.next, sample.control, &tail];
        let embedded = [sample.at, sample.next_at];
        if self.len() < self.capacity {
            for part in parts {
                self.numbers.extend_from_slice(part);
            }
            self.embedded.push(embedded);
        } else {
            let mut at = self.cursor * self.row();
            for part in parts {
                self.numbers[at..at + part.len()].copy_from_slice(part);
                at += part.len();
            }
            self.embedded[self.cursor] = embedded;
            self.cursor = (self.cursor + 1) % self.capacity;
        }
    }

    /// The sample in place `index`; places have no order in time.
    pub fn get(&self, index: usize) -> Sample<'_> {
        let row = &self.numbers[index * self.row()..][..self.row()];
        let (observation, rest) = row.split_at(self.observation);
        let (next, rest) = rest.split_at(self.observation);
        let (control, tail) = rest.split_at(self.control);
        let [at, next_at] = self.embedded[index];
        Sample { observation, at, control, reward: tail[0], discount: tail[1], next, next_at }
    }

    /// All numbers (one row per sample: observation of s, of s', control, R, Γ), the embedded parts, and the cursor: for checkpoints.
    pub fn parts(&self) -> (&[f32], &[[EmbeddedState; 2]], usize) {
        (&self.numbers, &self.embedded, self.cursor)
    }

    /// Takes over what [`Replay::parts`] gave; `false`, and nothing is changed, if it does not fit together.
    #[must_use]
    pub fn restore(&mut self, numbers: Vec<f32>, embedded: Vec<[EmbeddedState; 2]>, cursor: usize) -> bool {
        let rows = embedded.len();
        let in_range = cursor == 0 || rows == self.capacity && cursor < rows;
        let fits = rows <= self.capacity && numbers.len() == rows * self.row() && in_range;
        if fits {
            (self.numbers, self.embedded, self.cursor) = (numbers, embedded, cursor);
        }
        fits
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::automaton::{Marks, StateSet};
    use std::collections::VecDeque;

    fn at(q: u16) -> EmbeddedState {
        EmbeddedState { q, frontier: Marks(u32::from(q) + 1), unvisited: StateSet::EMPTY }
    }

    /// A queue that drops its oldest is what a ring must be, but for the order.
    #[test]
    fn a_ring_keeps_the_last_samples() {
        let mut replay = Replay::new(5, 2, 1);
        let mut queue = VecDeque::new();
        for i in 0..13u16 {
            let x = f32::from(i);
            let (observation, control, next) = ([x, x + 0.1], [x + 0.2], [x + 0.3, x + 0.4]);
            replay.push(&Sample {
                observation: &observation,
                at: at(i),
                control: &control,
                reward: x + 0.5,
                discount: x + 0.6,
                next: &next,
                next_at: at(i + 1),
            });
            queue.push_back((observation, control, next, i));
            if queue.len() > 5 {
                queue.pop_front();
            }
            assert_eq!(replay.len(), queue.len());
            for (observation, control, next, i) in &queue {
                let found = (0..replay.len()).map(|k| replay.get(k)).find(|s| s.at == at(*i)).expect("it is kept");
                let x = f32::from(*i);
                assert_eq!((found.observation, found.control, found.next), (&observation[..], &control[..], &next[..]));
                assert_eq!((found.reward, found.discount, found.next_at), (x + 0.5, x + 0.6, at(i + 1)));
            }
        }
        let (numbers, embedded, cursor) = replay.parts();
        let mut other = Replay::new(5, 2, 1);
        assert!(other.restore(numbers.to_vec(), embedded.to_vec(), cursor));
        assert_eq!(other, replay);
        assert!(!other.restore(vec![0.0], vec![], 0));
        assert!(!Replay::new(4, 2, 1).restore(numbers.to_vec(), embedded.to_vec(), cursor));
    }
}
