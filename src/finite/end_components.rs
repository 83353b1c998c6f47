//! Maximal end components: where a policy can stay for ever with probability 1
//! ([Baier & Katoen 2008](crate::bib::BaierKatoen2008), section 10.6.3).

use super::arena::{Arena, Transition};
use crate::automaton::components;

/// An end component: states, and for each the choices that do not leave them; from every state every other can be reached.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct EndComponent {
    /// The states, ascending.
    pub states: Vec<usize>,
    /// For each state, the choices that stay inside; at least one.
    pub choices: Vec<Vec<usize>>,
}

impl EndComponent {
    /// The union of the marks on its transitions: what a policy that takes each of its choices again and again meets infinitely
    /// often with probability 1.
    pub fn marks(&self, arena: &Arena) -> u64 {
        let transitions = |(state, choices): (&usize, &Vec<usize>)| -> u64 {
            choices.iter().flat_map(|choice| &arena.choices[*state][*choice]).fold(0, |all, t| all | t.marks)
        };
        self.states.iter().zip(&self.choices).map(transitions).fold(0, |all, marks| all | marks)
    }
}

/// The maximal end components of the part of `arena` that has only the choices for which `allowed` (state, transitions) holds.
pub fn maximal_end_components(arena: &Arena, allowed: &dyn Fn(usize, &[Transition]) -> bool) -> Vec<EndComponent> {
    let mut kept: Vec<Vec<usize>> =
        (0..arena.len()).map(|s| (0..arena.choices[s].len()).filter(|c| allowed(s, &arena.choices[s][*c])).collect()).collect();
    loop {
        // A state without a choice takes part in nothing; a choice that leaves its component cannot be repeated for ever.
        let targets = |s: usize| kept[s].iter().flat_map(move |c| arena.choices[s][*c].iter().map(|t| t.target));
        let found = components(&(0..arena.len()).map(|s| targets(s).collect()).collect::<Vec<Vec<usize>>>());
        let stays = |s: usize, c: usize, kept: &[Vec<usize>]| {
            arena.choices[s][c].iter().all(|t| found.of[t.target] == found.of[s] && !kept[t.target].is_empty())
        };
        let next: Vec<Vec<usize>> =
            (0..arena.len()).map(|s| kept[s].iter().copied().filter(|c| stays(s, *c, &kept)).collect()).collect();
        if next == kept {
            let mut result: Vec<EndComponent> = Vec::new();
            let mut index = vec![usize::MAX; found.count];
            for s in (0..arena.len()).filter(|s| !kept[*s].is_empty()) {
                let slot = &mut index[found.of[s]];
                if *slot == usize::MAX {
                    *slot = result.len();
                    result.push(EndComponent { states: vec![], choices: vec![] });
                }
                result[*slot].states.push(s);
                result[*slot].choices.push(kept[s].clone());
            }
            return result;
        }
        kept = next;
    }
}
