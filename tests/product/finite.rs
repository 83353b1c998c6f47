//! Random automata and finite MDPs, their product with an embedding, and its exact solution: the oracle of these tests.

use ltl_rover::automaton::{
    Cube, Edge, EmbeddedState, Embedding, FrontierRule, Gaps, Guard, Ldgba, LdgbaParts, Marks, StateTracking,
};
use ltl_rover::env::Outcome;
use ltl_rover::labels::{Labels, Propositions};
use ltl_rover::product::{Payoff, ProductStep};
use proptest::prelude::*;
use std::collections::HashMap;
use std::sync::Arc;

/// Two propositions everywhere: four letters.
const LETTERS: u64 = 4;

/// An automaton from a table: per state and letter the target and the marks.
pub fn table(sets: usize, rows: &[Vec<(u16, u32)>]) -> Arc<Ldgba> {
    let propositions = Propositions::new(["a", "b"]).unwrap();
    let row = |row: &Vec<(u16, u32)>| {
        let edge = |(sigma, &(target, marks)): (usize, &(u16, u32))| {
            (Guard(vec![Cube::letter(Labels(sigma as u64), 2)]), Edge { target, marks: Marks(marks) })
        };
        row.iter().enumerate().map(edge).collect()
    };
    let edges = rows.iter().map(row).collect();
    let parts = LdgbaParts { propositions, initial: 0, sets, edges, epsilon: vec![], names: vec![] };
    Arc::new(Ldgba::new(parts, Gaps::Refuse).unwrap())
}

/// Deterministic automata with 1–4 states and 1–3 accepting sets; about a third of the edges carry marks.
pub fn automata() -> impl Strategy<Value = Arc<Ldgba>> {
    (1_u16..=4, 1_usize..=3).prop_flat_map(|(states, sets)| {
        let marks = prop_oneof![2 => Just(0_u32), 1 => 1_u32..1 << sets];
        let row = prop::collection::vec((0..states, marks), LETTERS as usize);
        prop::collection::vec(row, states as usize).prop_map(move |rows| table(sets, &rows))
    })
}

/// A finite labelled MDP; state 0 is initial.
#[derive(Clone, Debug)]
pub struct Mdp {
    /// L(s).
    pub labels: Vec<Labels>,
    /// Per state and action: successors with probabilities.
    pub transitions: Vec<Vec<Vec<(usize, f64)>>>,
}

/// MDPs with 1–4 states, `actions` actions, one or two successors each.
pub fn mdps(actions: usize) -> impl Strategy<Value = Mdp> {
    (1_usize..=4).prop_flat_map(move |states| {
        let successors = (0..states, 0..states, 1_u32..=4).prop_map(|(a, b, quarters)| match quarters {
            4 => vec![(a, 1.0)],
            q => vec![(a, f64::from(q) / 4.0), (b, 1.0 - f64::from(q) / 4.0)],
        });
        let labels = prop::collection::vec((0..LETTERS).prop_map(Labels), states);
        let transitions = prop::collection::vec(prop::collection::vec(successors, actions), states);
        (labels, transitions).prop_map(|(labels, transitions)| Mdp { labels, transitions })
    })
}

/// A product state x, without its history.
pub type Node = (usize, EmbeddedState);

/// A transition of the product: probability, index of the state reached, and the step.
pub type Arrow = (f64, usize, ProductStep);

/// The reachable product of an MDP and an embedding.
pub struct Product {
    /// The product states; the initial one comes first.
    pub nodes: Vec<Node>,
    /// Per product state and action: the transitions.
    pub arrows: Vec<Vec<Vec<Arrow>>>,
}

pub fn embedding(automaton: &Arc<Ldgba>, rule: FrontierRule, tracking: StateTracking) -> Embedding {
    Embedding::new(automaton.clone(), rule, tracking).unwrap()
}

impl Product {
    pub fn new(mdp: &Mdp, embedding: &Embedding) -> Product {
        let mut nodes = vec![(0, embedding.read(embedding.start(), mdp.labels[0]).to)];
        let mut index = HashMap::from([(nodes[0], 0)]);
        let mut arrows = vec![];
        while arrows.len() < nodes.len() {
            let (s, at) = nodes[arrows.len()];
            let mut actions = vec![];
            for successors in &mdp.transitions[s] {
                let mut action = vec![];
                for &(next, probability) in successors {
                    let step = ProductStep::read(embedding, at, mdp.labels[next], Outcome::Running);
                    let fresh = nodes.len();
                    let target = *index.entry((next, step.to)).or_insert_with(|| {
                        nodes.push((next, step.to));
                        fresh
                    });
                    action.push((probability, target, step));
                }
                actions.push(action);
            }
            arrows.push(actions);
        }
        Product { nodes, arrows }
    }

    /// All transitions from a product state, whatever the action.
    fn out(&self, x: usize) -> impl Iterator<Item = &Arrow> {
        self.arrows[x].iter().flatten()
    }

    /// The recurrent classes of the Markov chain (all actions taken with positive probability): components that are never left.
    pub fn recurrent_classes(&self) -> Vec<Vec<usize>> {
        let n = self.nodes.len();
        let reach: Vec<Vec<bool>> = (0..n).map(|x| self.reachable(x)).collect();
        let closed = |x: usize| (0..n).all(|y| !reach[x][y] || reach[y][x]);
        let mut classes: Vec<Vec<usize>> = vec![];
        for x in (0..n).filter(|&x| closed(x)) {
            if !classes.iter().any(|class| class.contains(&x)) {
                classes.push((0..n).filter(|&y| reach[x][y]).collect());
            }
        }
        classes
    }

    fn reachable(&self, from: usize) -> Vec<bool> {
        let mut seen = vec![false; self.nodes.len()];
        let mut open = vec![from];
        while let Some(x) = open.pop() {
            if !std::mem::replace(&mut seen[x], true) {
                open.extend(self.out(x).map(|arrow| arrow.1));
            }
        }
        seen
    }

    /// All marks of one kind on the transitions inside a class.
    pub fn marks(&self, class: &[usize], of: impl Fn(&ProductStep) -> Marks) -> Marks {
        Marks(class.iter().flat_map(|&x| self.out(x)).fold(0, |all, arrow| all | of(&arrow.2).0))
    }

    /// Q*(x, u) by value iteration.
    pub fn solve(&self, payoff: impl Fn(&ProductStep) -> Payoff) -> Vec<Vec<f64>> {
        let mut best = vec![0.0_f64; self.nodes.len()];
        loop {
            let q = self.backup(&best, &payoff);
            let next: Vec<f64> = q.iter().map(|row| row.iter().copied().fold(f64::NEG_INFINITY, f64::max)).collect();
            let change = next.iter().zip(&best).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            best = next;
            if change < 1e-10 {
                return q;
            }
        }
    }

    /// V of a deterministic policy (an action per product state), by iteration.
    pub fn evaluate(&self, policy: &[usize], payoff: impl Fn(&ProductStep) -> Payoff) -> Vec<f64> {
        let mut values = vec![0.0_f64; self.nodes.len()];
        loop {
            let q = self.backup(&values, &payoff);
            let next: Vec<f64> = q.iter().zip(policy).map(|(row, &u)| row[u]).collect();
            let change = next.iter().zip(&values).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            values = next;
            if change < 1e-10 {
                return values;
            }
        }
    }

    fn backup(&self, values: &[f64], payoff: &impl Fn(&ProductStep) -> Payoff) -> Vec<Vec<f64>> {
        let value = |action: &Vec<Arrow>| {
            let terms = action.iter().map(|(probability, target, step)| {
                let Payoff { reward, discount } = payoff(step);
                probability * (f64::from(reward) + f64::from(discount) * values[*target])
            });
            terms.sum()
        };
        self.arrows.iter().map(|actions| actions.iter().map(value).collect()).collect()
    }
}
