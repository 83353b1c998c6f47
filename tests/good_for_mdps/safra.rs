//! Safra's construction: a Büchi automaton becomes a deterministic Rabin automaton, here only along the states of an MDP, and the
//! maximal probability is that to reach an end component that satisfies a Rabin pair.

use super::tableau::Buchi;
use ltl_rover::finite::{Arena, Interval, Mdp, Transition, maximal_end_components, maximal_reachability};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// A node of a Safra tree: its name, its states, its children from old to young.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
struct Node {
    name: usize,
    states: BTreeSet<usize>,
    children: Vec<Node>,
}

/// Names of nodes: green in this step (bit 2·name), or gone in this step (bit 2·name + 1).
type Events = u64;

/// The largest number of names.
const NAMES: usize = 32;

impl Node {
    fn names(&self, found: &mut BTreeSet<usize>) {
        found.insert(self.name);
        self.children.iter().for_each(|child| child.names(found));
    }

    /// Reads a letter in every node, and gives every node a young child with the states behind accepting edges.
    fn step(&self, automaton: &Buchi, letter: usize, used: &mut BTreeSet<usize>) -> Option<Node> {
        let children: Option<Vec<Node>> = self.children.iter().map(|child| child.step(automaton, letter, used)).collect();
        let mut children = children?;
        let edges = || self.states.iter().flat_map(|q| &automaton.edges[*q][letter]);
        let accepting: BTreeSet<usize> = edges().filter(|(_, accepting)| *accepting).map(|(to, _)| *to).collect();
        if !accepting.is_empty() {
            let name = (0..NAMES).find(|name| !used.contains(name))?;
            used.insert(name);
            children.push(Node { name, states: accepting, children: vec![] });
        }
        Some(Node { name: self.name, states: edges().map(|(to, _)| *to).collect(), children })
    }

    /// A state stays only in the oldest child that has it.
    fn keep(&mut self, allowed: &BTreeSet<usize>) {
        self.states = self.states.intersection(allowed).copied().collect();
        let mut left = self.states.clone();
        for child in &mut self.children {
            child.keep(&left);
            left = left.difference(&child.states).copied().collect();
        }
        self.children.retain(|child| !child.states.is_empty());
    }

    /// A node all of whose states are in its children is green, and loses them.
    fn turn_green(&mut self, events: &mut Events) {
        let covered: usize = self.children.iter().map(|child| child.states.len()).sum();
        if covered == self.states.len() {
            *events |= 1 << (2 * self.name);
            self.children.clear();
        }
        self.children.iter_mut().for_each(|child| child.turn_green(events));
    }
}

/// The tree after a letter, and what happened to the names; `None` if the names do not suffice. No tree: all runs have died.
fn step(automaton: &Buchi, tree: &Option<Node>, letter: usize) -> Option<(Option<Node>, Events)> {
    let mut before = BTreeSet::new();
    let Some(root) = tree else { return Some((None, u64::MAX / 3 * 2)) };
    root.names(&mut before);
    let mut used = before.clone();
    let mut next = root.step(automaton, letter, &mut used)?;
    let all = next.states.clone();
    next.keep(&all);
    let mut events = 0;
    let tree = if next.states.is_empty() {
        None
    } else {
        next.turn_green(&mut events);
        Some(next)
    };
    let mut after = BTreeSet::new();
    if let Some(root) = &tree {
        root.names(&mut after);
    }
    // A name that is not in the tree is gone, also when it was given and lost in this very step.
    for name in (0..NAMES).filter(|name| !after.contains(name)) {
        events |= 1 << (2 * name + 1);
    }
    Some((tree, events))
}

/// The maximal probability of the language of `automaton`; `None` if the construction takes more than 3000 states.
pub fn maximal_probability(automaton: &Buchi, mdp: &Mdp, precision: f64) -> Option<Interval> {
    let letter = |s: usize| mdp.labels(s).0 as usize;
    let root = Node { name: 0, states: BTreeSet::from([automaton.initial]), children: vec![] };
    let mut memory: BTreeMap<(usize, usize), (usize, Events)> = BTreeMap::new();
    let mut trees: Vec<Option<Node>> = vec![Some(root)];
    let mut tree_index: HashMap<Option<Node>, usize> = HashMap::from([(trees[0].clone(), 0)]);
    let mut read = |tree: usize, s: usize| -> Option<(usize, Events)> {
        if let Some(known) = memory.get(&(tree, letter(s))) {
            return Some(*known);
        }
        let (next, events) = step(automaton, &trees[tree], letter(s))?;
        let number = *tree_index.entry(next.clone()).or_insert_with(|| {
            trees.push(next);
            trees.len() - 1
        });
        memory.insert((tree, letter(s)), (number, events));
        Some((number, events))
    };
    let start = (mdp.initial(), read(0, mdp.initial())?.0);
    let mut states = vec![start];
    let mut index = HashMap::from([(start, 0)]);
    let mut arena = Arena { initial: 0, choices: vec![] };
    while arena.choices.len() < states.len() {
        let (s, tree) = states[arena.choices.len()];
        let mut choices = Vec::new();
        for distribution in mdp.choices(s) {
            let mut transitions = Vec::new();
            for (to, probability) in distribution {
                let (next, marks) = read(tree, *to)?;
                let target = *index.entry((*to, next)).or_insert_with(|| {
                    states.push((*to, next));
                    states.len() - 1
                });
                transitions.push(Transition { target, probability: *probability, marks });
            }
            choices.push(transitions);
        }
        arena.choices.push(choices);
        if states.len() > 3000 {
            return None;
        }
    }
    let mut goal = vec![false; arena.len()];
    for name in 0..NAMES {
        let (green, gone) = (1 << (2 * name), 1 << (2 * name + 1));
        for component in maximal_end_components(&arena, &|_, transitions| transitions.iter().all(|t| t.marks & gone == 0)) {
            if component.marks(&arena) & green != 0 {
                component.states.iter().for_each(|s| goal[*s] = true);
            }
        }
    }
    Some(maximal_reachability(&arena, &goal, precision)[0])
}
