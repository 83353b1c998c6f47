//! The embedded product MDP (Definition 4 of [Cai et al. 2021](crate::bib::Cai2021)), walked on the fly.
//!
//! **The visit at time 0.** Reset reads L(s_0) \[D1\], so that q = δ(q0, L(s_0)) and its accepting sets are visited before any move.
//! That visit updates T, T_Φ and the count of rounds like every other, but earns nothing: its reward would be the same for all
//! policies, and there is no step to pay it on.
//!
//! **ε before the first letter.** A run may jump before it reads L(s_0). Jump and letter are then taken together: at time 0
//! [`EpMdp::epsilon_moves`] offers, beside the jumps of the present q, the states δ(d, L(s_0)) for every ε-jump q0 → d.

use super::letters::{LetterMap, LetterMapError, Renaming};
use super::rounds::Rounds;
use super::step::{Move, MoveKind, ProductStep};
use crate::automaton::{EmbeddedState, Embedding, Marks, StateId, Succession};
use crate::env::{Environment, Outcome};
use crate::labels::Labels;
use crate::rng::Rng;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// From which distribution an episode starts.
#[cfg_attr(feature = "cli", derive(schemars::JsonSchema, clap::ValueEnum))]
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Start {
    /// The environment's own, the paper's: [`Environment::reset`].
    #[default]
    Initial,
    /// Spread over all safe ground: [`Environment::reset_anywhere`].
    Anywhere,
}

/// The beginning of an episode: what reading L(s_0) has done.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
pub struct ProductStart {
    /// (q, T, T_Φ) after L(s_0).
    pub at: EmbeddedState,
    /// L(s_0), as a letter of the automaton.
    pub labels: Labels,
    /// The accepting sets visited at time 0.
    pub visited: Marks,
    /// Whether that visit completes a round.
    pub closes_round: bool,
    /// Whether the episode starts in a sink of the automaton: the task has failed before the first move.
    pub sink: bool,
}

/// An environment and an embedded automaton that move together.
pub struct EpMdp {
    environment: Box<dyn Environment>,
    embedding: Arc<Embedding>,
    letters: LetterMap,
    at: EmbeddedState,
    labels: Labels,
    rounds: Rounds,
    ended: bool,
    /// Targets of the ε-moves there are now, and what they lead to.
    epsilon: Vec<StateId>,
    jumps: Vec<Succession>,
    /// No move has been made in this episode.
    fresh_start: bool,
}

/// Where an [`EpMdp`] stands, for checkpoints and for looking back.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Snapshot {
    /// [`Environment::state`].
    pub state: Vec<f32>,
    /// (q, T, T_Φ).
    pub at: EmbeddedState,
    /// The count of rounds.
    pub rounds: Rounds,
    /// Whether the episode is over.
    pub ended: bool,
    /// Whether no move has been made in this episode.
    pub fresh_start: bool,
}

/// Why a snapshot does not fit.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("the snapshot belongs to another environment or automaton: {reason}")]
pub struct SnapshotError {
    reason: &'static str,
}

impl EpMdp {
    /// Joins an environment and an automaton; call [`EpMdp::reset`] before the first step.
    ///
    /// # Errors
    /// A proposition of the automaton that no label of the environment answers to, or a renaming of no proposition.
    pub fn new(
        environment: Box<dyn Environment>,
        embedding: Arc<Embedding>,
        renaming: &Renaming,
    ) -> Result<EpMdp, LetterMapError> {
        let automaton = embedding.automaton();
        let letters = LetterMap::new(automaton.propositions(), environment.spec(), renaming)?;
        let rounds = Rounds::new(automaton.all_sets());
        let at = embedding.start();
        let mut product = EpMdp {
            environment,
            embedding,
            letters,
            at,
            labels: Labels::EMPTY,
            rounds,
            ended: false,
            epsilon: vec![],
            jumps: vec![],
            fresh_start: true,
        };
        product.begin();
        Ok(product)
    }

    /// Starts an episode.
    pub fn reset(&mut self, start: Start, rng: &mut Rng) -> ProductStart {
        match start {
            Start::Initial => self.environment.reset(rng),
            Start::Anywhere => self.environment.reset_anywhere(rng),
        }
        self.begin()
    }

    /// Scales the random disturbance of later steps ([`Environment::scale_disturbance`]); false where there is none.
    pub fn scale_disturbance(&mut self, factor: f32) -> bool {
        self.environment.scale_disturbance(factor)
    }

    /// Starts an episode in a given state of the environment (physical units; clamped to its range).
    ///
    /// # Panics
    /// If `state` has another length than [`EnvSpec::state`](crate::env::EnvSpec::state).
    pub fn reset_to(&mut self, state: &[f32]) -> ProductStart {
        self.environment.set_state(state);
        self.begin()
    }

    fn begin(&mut self) -> ProductStart {
        self.rounds = Rounds::new(self.embedding.automaton().all_sets());
        self.labels = self.letters.letter(self.environment.labels());
        let Succession { to, visited, .. } = self.embedding.read(self.embedding.start(), self.labels);
        self.at = to;
        let closes_round = self.rounds.visit(visited);
        let sink = self.embedding.automaton().is_sink(to.q);
        self.fresh_start = true;
        // Before the first letter there may still be a jump that saves the run.
        self.find_jumps();
        self.ended = sink && self.epsilon.is_empty();
        ProductStart { at: to, labels: self.labels, visited, closes_round, sink }
    }

    /// Collects the ε-moves of the present state; at time 0 also those that jump before the first letter.
    fn find_jumps(&mut self) {
        self.epsilon.clear();
        self.jumps.clear();
        let automaton = self.embedding.automaton();
        for &target in automaton.epsilon(self.at.q) {
            self.epsilon.push(target);
            self.jumps.push(self.embedding.jump(self.at, target));
        }
        if self.fresh_start {
            let start = self.embedding.start();
            for &target in automaton.epsilon(start.q) {
                let early = self.embedding.read(self.embedding.jump(start, target).to, self.labels);
                if early.to.q != self.at.q && !self.epsilon.contains(&early.to.q) && !automaton.is_sink(early.to.q) {
                    self.epsilon.push(early.to.q);
                    self.jumps.push(early);
                }
            }
        }
    }

    /// Makes a move.
    ///
    /// # Panics
    /// For an ε-move that is not among [`EpMdp::epsilon_moves`], or a control of another length than the environment's action.
    pub fn step(&mut self, action: Move<'_>, rng: &mut Rng) -> ProductStep {
        let mut step = match action {
            Move::Control(control) => {
                assert_eq!(control.len(), self.environment.spec().action.len(), "one number per action channel");
                let outcome = self.environment.step(control, rng);
                self.labels = self.letters.letter(self.environment.labels());
                ProductStep::read(&self.embedding, self.at, self.labels, outcome)
            }
            Move::Epsilon(target) => self.look_ahead(target).expect("only ε-moves that exist may be made"),
        };
        step.closes_round = self.rounds.visit(step.visited);
        self.at = step.to;
        self.ended = step.ends();
        self.fresh_start = false;
        self.find_jumps();
        step
    }

    /// The step that the ε-move to `target` would be, without making it; `None` if there is no such move now.
    pub fn look_ahead(&self, target: StateId) -> Option<ProductStep> {
        let index = self.epsilon.iter().position(|&q| q == target)?;
        let (jump, kind) = (self.jumps[index], MoveKind::Epsilon);
        Some(ProductStep::new(&self.embedding, self.at, jump, self.labels, Outcome::Running, kind))
    }

    /// The automaton states that ε-moves lead to from here.
    pub fn epsilon_moves(&self) -> &[StateId] {
        &self.epsilon
    }

    /// (q, T, T_Φ).
    pub fn at(&self) -> EmbeddedState {
        self.at
    }

    /// L(s), as a letter of the automaton.
    pub fn labels(&self) -> Labels {
        self.labels
    }

    /// The rounds of this episode.
    pub fn rounds(&self) -> &Rounds {
        &self.rounds
    }

    /// Whether the last step ended the episode, or it began in a sink that no ε-move avoids.
    pub fn ended(&self) -> bool {
        self.ended
    }

    /// The environment.
    pub fn environment(&self) -> &dyn Environment {
        self.environment.as_ref()
    }

    /// The automaton with its memory.
    pub fn embedding(&self) -> &Arc<Embedding> {
        &self.embedding
    }

    /// How labels become letters.
    pub fn letters(&self) -> &LetterMap {
        &self.letters
    }

    /// Where the product stands. Together with the random streams it is all that goes on from here.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            state: self.environment.state().to_vec(),
            at: self.at,
            rounds: self.rounds,
            ended: self.ended,
            fresh_start: self.fresh_start,
        }
    }

    /// Puts the product where a snapshot was taken.
    ///
    /// # Errors
    /// If the snapshot was taken of another environment or automaton. Nothing is changed then.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), SnapshotError> {
        let automaton = self.embedding.automaton();
        let refuse = |reason| Err(SnapshotError { reason });
        if snapshot.state.len() != self.environment.spec().state.len() {
            return refuse("the states have different lengths");
        }
        if snapshot.at.q as usize >= automaton.len() {
            return refuse("there is no such automaton state");
        }
        if snapshot.at.frontier.0 & !automaton.all_sets().0 != 0 || !snapshot.rounds.counts(automaton.all_sets()) {
            return refuse("the accepting sets differ");
        }
        if snapshot.at.unvisited.iter().any(|q| !self.embedding.start().unvisited.contains(q)) {
            return refuse("the states to be visited differ");
        }
        self.environment.set_state(&snapshot.state);
        self.labels = self.letters.letter(self.environment.labels());
        (self.at, self.rounds, self.ended) = (snapshot.at, snapshot.rounds, snapshot.ended);
        self.fresh_start = snapshot.fresh_start;
        self.find_jumps();
        Ok(())
    }
}

impl Clone for EpMdp {
    fn clone(&self) -> Self {
        EpMdp {
            environment: self.environment.boxed_clone(),
            embedding: self.embedding.clone(),
            letters: self.letters.clone(),
            at: self.at,
            labels: self.labels,
            rounds: self.rounds,
            ended: self.ended,
            epsilon: self.epsilon.clone(),
            jumps: self.jumps.clone(),
            fresh_start: self.fresh_start,
        }
    }
}
