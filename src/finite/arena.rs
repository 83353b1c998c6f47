//! A Markov decision process with marks on its transitions, the form in which acceptance is decided.

use crate::automaton::can_reach;

/// A transition: where it leads, with which probability, and which marks it carries (bit j = mark j).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Transition {
    /// The state reached.
    pub target: usize,
    /// The probability, positive.
    pub probability: f64,
    /// The marks.
    pub marks: u64,
}

/// States with choices between distributions over transitions. Every state has a choice, every choice a transition; the
/// probabilities of a choice add up to 1.
#[derive(Clone, PartialEq, Default, Debug)]
pub struct Arena {
    /// The initial state.
    pub initial: usize,
    /// Per state and choice: its transitions.
    pub choices: Vec<Vec<Vec<Transition>>>,
}

impl Arena {
    /// The number of states.
    pub fn len(&self) -> usize {
        self.choices.len()
    }

    /// Whether there is no state.
    pub fn is_empty(&self) -> bool {
        self.choices.is_empty()
    }

    /// Per state, whether a goal can be reached with positive probability by some policy.
    pub fn can_reach(&self, goal: &[bool]) -> Vec<bool> {
        let targets = |list: &Vec<Vec<Transition>>| list.iter().flatten().map(|t| t.target).collect::<Vec<_>>();
        can_reach(&self.choices.iter().map(targets).collect::<Vec<_>>(), goal)
    }
}
