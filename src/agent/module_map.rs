//! Which module is in charge of an embedded state, and what its networks see of it.

use super::settings::ModuleMap;
use crate::automaton::{EmbeddedState, Embedding, FrontierRule, Marks, StateId};
use std::collections::HashMap;

/// The most modules a learner may have.
pub const MAX_MODULES: usize = 1024;

/// The most embedded states that are listed, for modules per (q, T).
const MAX_EMBEDDED: usize = 1 << 16;

/// The module in charge of each embedded state. A sink of the automaton has none: nothing is chosen there.
#[derive(Clone, Debug)]
pub struct Modules {
    kind: Kind,
    names: Vec<String>,
}

#[derive(Clone, Debug)]
enum Kind {
    PerState(Vec<Option<usize>>),
    PerEmbedded(HashMap<(StateId, Marks), usize>),
    One,
}

/// Why there cannot be a module for each embedded state.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ModulesError {
    /// More than [`MAX_MODULES`].
    #[error("`modules` would need more than {MAX_MODULES} modules; use \"per_state\" or \"one\"")]
    TooMany,
}

impl Modules {
    /// Numbers the modules for the embedded states of `embedding`.
    ///
    /// # Errors
    /// More than [`MAX_MODULES`] modules.
    pub fn new(map: ModuleMap, embedding: &Embedding) -> Result<Modules, ModulesError> {
        let automaton = embedding.automaton();
        let label = |q: StateId| if automaton.name(q).is_empty() { format!("q{q}") } else { automaton.name(q).to_owned() };
        let mut names = vec![];
        let kind = match map {
            ModuleMap::PerState => {
                let mut of = vec![];
                for q in automaton.states() {
                    of.push((!automaton.is_sink(q)).then_some(names.len()));
                    if !automaton.is_sink(q) {
                        names.push(label(q));
                    }
                }
                Kind::PerState(of)
            }
            ModuleMap::PerEmbedded => {
                let reachable = embedding.reachable(MAX_EMBEDDED).ok_or(ModulesError::TooMany)?;
                let mut of = HashMap::new();
                // In the order of the sorted list, so that the numbers are the same on every run.
                for at in reachable.into_iter().filter(|at| !automaton.is_sink(at.q)) {
                    of.entry((at.q, at.frontier)).or_insert_with(|| {
                        let sets: Vec<String> = at.frontier.iter().map(|j| j.to_string()).collect();
                        names.push(format!("{} {{{}}}", label(at.q), sets.join(",")));
                        names.len() - 1
                    });
                }
                Kind::PerEmbedded(of)
            }
            ModuleMap::One => {
                names.push("all".to_owned());
                Kind::One
            }
        };
        if names.len() > MAX_MODULES {
            return Err(ModulesError::TooMany);
        }
        Ok(Modules { kind, names })
    }

    /// How many modules there are.
    pub fn len(&self) -> usize {
        self.names.len()
    }

    /// Whether there is none: every state is a sink.
    pub fn is_empty(&self) -> bool {
        self.names.is_empty()
    }

    /// What the module is in charge of: an automaton state, a pair `q {T}`, or `all`.
    pub fn name(&self, module: usize) -> &str {
        &self.names[module]
    }

    /// The module in charge of `at`; `None` in a sink.
    pub fn of(&self, at: EmbeddedState) -> Option<usize> {
        match &self.kind {
            Kind::PerState(of) => of[at.q as usize],
            Kind::PerEmbedded(of) => of.get(&(at.q, at.frontier)).copied(),
            Kind::One => Some(0),
        }
    }
}

/// How x becomes a network's input: the observation of s, T one-hot over the accepting sets, and q one-hot where one module serves
/// all states ("embedded … via one-hot encoding", [Cai et al. 2021](crate::bib::Cai2021), section V).
#[derive(Clone, PartialEq, Debug)]
pub struct Encoder {
    observation: usize,
    /// Accepting sets whose bits are shown; 0 for the standard product and where a module knows T.
    sets: usize,
    /// Automaton states whose one-hot code is shown; 0 where a module knows q.
    states: usize,
}

impl Encoder {
    /// The encoder for observations of `observation` numbers.
    pub fn new(map: ModuleMap, embedding: &Embedding, observation: usize) -> Encoder {
        let shown = |yes: bool, count: usize| if yes { count } else { 0 };
        let automaton = embedding.automaton();
        let knows_frontier = map == ModuleMap::PerEmbedded || embedding.rule() == FrontierRule::Standard;
        Encoder {
            observation,
            sets: shown(!knows_frontier, automaton.sets()),
            states: shown(map == ModuleMap::One, automaton.len()),
        }
    }

    /// Numbers in one network input.
    pub fn len(&self) -> usize {
        self.observation + self.sets + self.states
    }

    /// Never: an observation has numbers.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Appends the input for x = (`observation`, `at`).
    pub fn push(&self, observation: &[f32], at: EmbeddedState, input: &mut Vec<f32>) {
        input.extend_from_slice(observation);
        input.extend((0..self.sets).map(|j| f32::from(u8::from(at.frontier.has(j)))));
        input.extend((0..self.states).map(|q| f32::from(u8::from(q == at.q as usize))));
    }
}
