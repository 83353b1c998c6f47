//! An automaton as a drawing needs it: states, edges with readable labels, marks, sinks, ε-jumps. Plain data, ready for JSON.

use super::ldgba::{Ldgba, Marks, StateId};
use serde::Serialize;

/// A description of an automaton for views.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Graph {
    /// The atomic propositions, in the order of letters.
    pub propositions: Vec<String>,
    /// q0.
    pub initial: StateId,
    /// f, the number of accepting sets.
    pub sets: usize,
    /// The states, by number.
    pub states: Vec<GraphState>,
    /// The edges by source, letters before ε-jumps.
    pub edges: Vec<GraphEdge>,
}

/// A state of a [`Graph`].
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct GraphState {
    /// Its number.
    pub id: StateId,
    /// Its name, such as the formula that is left; may be empty.
    pub name: String,
    /// Whether nothing is accepted from it.
    pub sink: bool,
    /// Whether it belongs to Q_D.
    pub deterministic: bool,
    /// Whether it can be reached from the initial state.
    pub reachable: bool,
    /// The accepting sets that every edge into it belongs to (all of them, in a state-based automaton); empty without an edge.
    pub marks: Vec<usize>,
}

/// Whether a letter is read.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum GraphEdgeKind {
    /// An edge that reads a letter.
    Letter,
    /// An ε-jump.
    Epsilon,
}

/// An edge of a [`Graph`].
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct GraphEdge {
    /// Where it starts.
    pub from: StateId,
    /// Where it leads.
    pub to: StateId,
    /// Whether it reads a letter.
    pub kind: GraphEdgeKind,
    /// Its letters in words: `r1 & !r2`, `true`; `ε` for a jump.
    pub label: String,
    /// The accepting sets it belongs to, ascending.
    pub marks: Vec<usize>,
}

impl Ldgba {
    /// A description for views. Labels are minimised.
    pub fn graph(&self) -> Graph {
        let mut into = vec![None; self.len()];
        let mut edges = Vec::new();
        for from in self.states() {
            for (guard, edge) in self.edges(from) {
                let common: &mut Option<Marks> = &mut into[usize::from(edge.target)];
                *common = Some(Marks(common.map_or(edge.marks.0, |known| known.0 & edge.marks.0)));
                let label = guard.text(self.propositions());
                let (to, marks) = (edge.target, edge.marks.iter().collect());
                edges.push(GraphEdge { from, to, kind: GraphEdgeKind::Letter, label, marks });
            }
            let jump = |&to| GraphEdge { from, to, kind: GraphEdgeKind::Epsilon, label: "ε".into(), marks: vec![] };
            edges.extend(self.epsilon(from).iter().map(jump));
        }
        let reachable = self.reachable();
        let state = |id: StateId| GraphState {
            id,
            name: self.name(id).to_owned(),
            sink: self.is_sink(id),
            deterministic: self.is_deterministic(id),
            reachable: reachable[usize::from(id)],
            marks: into[usize::from(id)].unwrap_or(Marks::NONE).iter().collect(),
        };
        Graph {
            propositions: self.propositions().iter().map(str::to_owned).collect(),
            initial: self.initial(),
            sets: self.sets(),
            states: self.states().map(state).collect(),
            edges,
        }
    }
}
