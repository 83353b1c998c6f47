//! Which module is in charge of an embedded state, and what its networks see of it.

use super::settings::ModuleMap;
use crate::automaton::{EmbeddedState, Embedding, FrontierRule, Marks, StateId};
use std::collections::HashMap;

/// The most modules a learner may have.
pub const MAX_MODULES: usize = 1024;

/// The most embedded states that are listed, for modules per (q, T).
const MAX_EMBEDDED: usize = 1 << 16;

/// The module in charge of each embedded state. A sink of the automaton has none: nothing is chosen there.
///
/// **Modules per accepting set.** Under [`ModuleMap::PerSet`] module j learns the values of the embedded states (q, {j}): visit F_j
/// next, keep out of the sinks, and go on with what the frontier rule leaves. With T = {j, k, …} the modules of T compete:
/// V(s, q, T) = max over j ∈ T of V_j(s, q), in acting and in the targets alike. This is generalised policy improvement over the
/// policies "F_j first" ([Barreto et al. 2017](crate::bib::Barreto2017)): following the most promising one, asked anew in each state,
/// visits some set of T at least as well as any of them alone. Nothing about the task changes: automaton, frontier, rewards and rounds
/// are those of the EP-MDP, by which every policy is judged, and the policy is a function of (s, q, T). What is given up is the
/// planning of a tour: which sets remain after the next one is not weighed, so that a way of visiting all of them may be longer than
/// needed. In return 2^f frontiers become f tasks, each learned from every transition by counterfactual replay, and an actor never has
/// to choose between several equally near goals, which a continuous function of s cannot do.
#[derive(Clone, Debug)]
pub struct Modules {
    kind: Kind,
    names: Vec<String>,
}

#[derive(Clone, Debug)]
enum Kind {
    PerState(Vec<Option<usize>>),
    PerEmbedded(HashMap<(StateId, Marks), usize>),
    PerSet {
        /// By automaton state: whether it is a sink.
        sinks: Vec<bool>,
        /// F.
        all: Marks,
    },
    One,
}

/// Why there cannot be a module for each embedded state.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ModulesError {
    /// More than [`MAX_MODULES`].
    #[error("`modules` would need more than {MAX_MODULES} modules; use \"per_state\" or \"one\"")]
    TooMany,
    /// Modules per accepting set of an automaton without any.
    #[error("`modules` is \"per_set\", and the automaton has no accepting set; use \"per_state\" or \"one\"")]
    NoSets,
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
            ModuleMap::PerSet => {
                let all = automaton.all_sets();
                names.extend(all.iter().map(|j| format!("F{j}")));
                if names.is_empty() {
                    return Err(ModulesError::NoSets);
                }
                Kind::PerSet { sinks: automaton.states().map(|q| automaton.is_sink(q)).collect(), all }
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

    /// What the module is in charge of: an automaton state, a pair `q {T}`, an accepting set `F0`, or `all`.
    pub fn name(&self, module: usize) -> &str {
        &self.names[module]
    }

    /// The modules that may take charge of `at`, each with the embedded state for which it does: `at` itself but for modules per
    /// accepting set, of which those of T compete, each for T = {j}. None in a sink.
    pub fn candidates(&self, at: EmbeddedState) -> impl Iterator<Item = (usize, EmbeddedState)> + use<> {
        let (one, sets) = match &self.kind {
            Kind::PerState(of) => (of[at.q as usize], Marks(0)),
            Kind::PerEmbedded(of) => (of.get(&(at.q, at.frontier)).copied(), Marks(0)),
            Kind::PerSet { sinks, .. } if sinks[at.q as usize] => (None, Marks(0)),
            // The rule of the print leaves T empty after a round: any set may then come next.
            Kind::PerSet { all, .. } => (None, if at.frontier == Marks(0) { *all } else { at.frontier }),
            Kind::One => (Some(0), Marks(0)),
        };
        let each = (0..u32::BITS as usize).filter(move |&j| sets.has(j));
        let one = one.map(|module| (module, at)).into_iter();
        one.chain(each.map(move |j| (j, EmbeddedState { frontier: Marks(1 << j), ..at })))
    }

    /// The module in charge of `at` where the embedded state alone decides it; `None` in a sink, and where several compete.
    pub fn of(&self, at: EmbeddedState) -> Option<usize> {
        let mut candidates = self.candidates(at);
        let (module, _) = candidates.next()?;
        candidates.next().is_none().then_some(module)
    }
}

/// How x becomes a network's input: the observation of s, T one-hot over the accepting sets, and q one-hot where one module serves
/// several states ("embedded … via one-hot encoding", [Cai et al. 2021](crate::bib::Cai2021), section V).
#[derive(Clone, PartialEq, Debug)]
pub struct Encoder {
    observation: usize,
    /// Octaves of Fourier features of the observation; 0 for none.
    octaves: u32,
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
        let knows_frontier =
            matches!(map, ModuleMap::PerEmbedded | ModuleMap::PerSet) || embedding.rule() == FrontierRule::Standard;
        Encoder {
            observation,
            octaves: 0,
            sets: shown(!knows_frontier, automaton.sets()),
            states: shown(matches!(map, ModuleMap::PerSet | ModuleMap::One), automaton.len()),
        }
    }

    /// The same encoder with Fourier features: behind the observation, for each octave k < `octaves` and each number o of it,
    /// sin(2^k·o·π/2) and cos(2^k·o·π/2). What changes within a small part of the observation's range is learned faster with them
    /// ([Tancik et al. 2020](crate::bib::Tancik2020); for values in reinforcement learning
    /// [Yang et al. 2022](crate::bib::Yang2022)).
    #[must_use]
    pub fn with_fourier_features(self, octaves: u32) -> Encoder {
        Encoder { octaves, ..self }
    }

    /// Numbers in one network input.
    pub fn len(&self) -> usize {
        self.observation * (1 + 2 * self.octaves as usize) + self.sets + self.states
    }

    /// Never: an observation has numbers.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Appends the input for x = (`observation`, `at`).
    pub fn push(&self, observation: &[f32], at: EmbeddedState, input: &mut Vec<f32>) {
        input.extend_from_slice(observation);
        if self.octaves > 0 {
            for o in observation {
                let angle = o * std::f32::consts::FRAC_PI_2;
                let (mut sin, mut cos) = (libm::sinf(angle), libm::cosf(angle));
                for _ in 0..self.octaves {
                    input.extend([sin, cos]);
                    // The double angle: an octave higher.
                    (sin, cos) = (2.0 * sin * cos, cos * cos - sin * sin);
                }
            }
        }
        input.extend((0..self.sets).map(|j| f32::from(u8::from(at.frontier.has(j)))));
        input.extend((0..self.states).map(|q| f32::from(u8::from(q == at.q as usize))));
    }
}
