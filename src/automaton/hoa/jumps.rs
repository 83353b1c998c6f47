//! Non-determinism becomes ε-jumps: which jumps a state may offer before and must offer after a letter, and the construction that
//! keeps every choice a run has, at the moment at which the run has it.
//!
//! Q_D stays as it is. The rest is tracked as sets of states, without choices (nothing is accepted there): after a letter σ, all
//! Q_N-successors together, and beside them the Q_D-successors, each offered as an ε-jump. A jump taken after σ is exactly the
//! choice that the run had when it read σ, so no probability is lost in the product with a Markov decision process.
//! A node of the construction is such a set with the jumps that are offered *because of the last letter*; it would split a state
//! into as many as there are ways to enter it. Two observations keep the states of the file:
//!
//! - A jump from `n` to `d` is *sound* at any time if every letter leads from `d` only to where it leads from `n` as well, or from `n` to where
//!   everything is accepted: what is accepted after the jump is accepted without it. Sound jumps are offered on every visit of `n`, and need no
//!   split.
//! - If the jumps of `n` are exactly those that sound ones stand for (the file was written by resolving ε-jumps), they are offered
//!   *before* the letter, as in the automaton that was resolved, wherever offering them afterwards would split a state.

use super::super::guard::{Cube, Effort, Guard, TooComplex};
use super::super::ldgba::Marks;
use super::super::symbolic::Symbolic;
use super::classes::{Class, refine};
use super::limit::Partition;
use crate::bdd::Bdd;
use std::collections::{HashMap, HashSet};

/// The largest number of states the construction may make.
pub const MAX_NODES: usize = 10_000;
/// From so many edges on, those of the same target are joined.
const MANY: usize = 64;

/// A node: states of Q_N that are tracked together, and Q_D-states offered because of the last letter. Both ascending. One state
/// of Q_D alone is the node ({}, {d}).
pub(super) type Node = (Vec<usize>, Vec<usize>);

/// A resolved automaton: per node, edges to nodes (by index) and ε-jumps to nodes.
pub(super) struct Resolved {
    pub nodes: Vec<Node>,
    pub start: usize,
    pub edges: Vec<Vec<(Guard, usize, Marks)>>,
    pub epsilon: Vec<Vec<usize>>,
    /// States of Q_N whose jumps are taken before the letter although a jump after it would have offered more.
    pub early: Vec<usize>,
}

/// What the states of Q_N offer.
struct Jumps<'a> {
    part: &'a Partition,
    /// Per state, the jumps of the file: targets in Q_D of ε-paths.
    given: Vec<Vec<usize>>,
    /// Per state, the states of Q_N on ε-paths from it, itself included.
    closure: Vec<Vec<usize>>,
    /// Per state, the sound jumps.
    sound: Vec<Vec<usize>>,
    /// Per state, the sound jumps that stand for all its choices by letters, if they do and if they are used for that.
    early: Vec<Option<Vec<usize>>>,
}

/// Resolves the non-determinism of an automaton.
///
/// # Errors
/// When that takes more than [`MAX_NODES`] states, or too much work.
pub(super) fn resolve(part: &Partition, starts: &[usize], effort: &mut Effort) -> Result<Resolved, TooComplex> {
    let jumps = Jumps::new(part, effort)?;
    explore(&jumps, starts, effort)
}

impl<'a> Jumps<'a> {
    fn new(part: &'a Partition, effort: &mut Effort) -> Result<Jumps<'a>, TooComplex> {
        let count = part.classes.len();
        let (mut given, mut closure) = (vec![Vec::new(); count], vec![Vec::new(); count]);
        let mut sound = vec![Vec::new(); count];
        for n in (0..count).filter(|n| !part.deterministic[*n]) {
            (closure[n], given[n]) = closed(part, n);
            effort.spend(closure[n].len() + given[n].len())?;
            sound[n] = sound_jumps(part, n, effort)?;
        }
        let mut jumps = Jumps { part, given, closure, sound, early: vec![None; count] };
        // A state's jumps are taken before the letter only if offering them afterwards would split a successor.
        for n in (0..count).filter(|n| !part.deterministic[*n]) {
            if jumps.splits(n) {
                jumps.early[n] = standing_for_all(part, n, &jumps.sound[n], effort)?;
            }
        }
        Ok(jumps)
    }

    /// Whether offering the jumps of a state after the letter splits a successor.
    fn splits(&self, n: usize) -> bool {
        self.part.classes[n].iter().filter(|class| class.targets.len() > 1).any(|class| {
            let (next, offered) = self.divide(class.targets.iter().map(|(target, _)| *target));
            !offered.iter().all(|d| next.iter().any(|m| self.given[*m].contains(d) || self.sound[*m].contains(d)))
        })
    }

    /// Targets of a letter as states of Q_N, ε-closed, and states of Q_D. Both ascending.
    fn divide(&self, targets: impl Iterator<Item = usize>) -> Node {
        let (mut next, mut offered) = (Vec::new(), Vec::new());
        for target in targets {
            if self.part.deterministic[target] { offered.push(target) } else { next.extend(&self.closure[target]) }
        }
        for list in [&mut next, &mut offered] {
            list.sort_unstable();
            list.dedup();
        }
        (next, offered)
    }

    /// The choices of a set of Q_N-states, cut into classes. Jumps that are taken before the letter are left out.
    fn letters(&self, set: &[usize], effort: &mut Effort) -> Result<Vec<Class>, TooComplex> {
        let kept = |n: usize| {
            let early = self.early[n].is_some();
            self.part.classes[n].iter().cloned().map(move |mut class| {
                if early && class.targets.len() > 1 {
                    class.targets.retain(|(target, _)| !self.part.deterministic[*target]);
                }
                class
            })
        };
        match set {
            [n] => Ok(kept(*n).collect()),
            _ => refine(set.iter().flat_map(|n| kept(*n)).collect(), effort),
        }
    }

    /// The jumps offered on every visit of a set.
    fn always(&self, set: &[usize]) -> impl Iterator<Item = usize> {
        set.iter().flat_map(|n| self.given[*n].iter().chain(self.early[*n].iter().flatten()).copied())
    }
}

/// The states of Q_N and of Q_D on ε-paths from `n`.
fn closed(part: &Partition, n: usize) -> Node {
    let (mut inside, mut jumps) = (HashSet::from([n]), HashSet::new());
    let mut open = vec![n];
    while let Some(state) = open.pop() {
        for &target in &part.epsilon[state] {
            if part.deterministic[target] {
                jumps.insert(target);
            } else if inside.insert(target) {
                open.push(target);
            }
        }
    }
    let sorted = |set: HashSet<usize>| {
        let mut list: Vec<usize> = set.into_iter().collect();
        list.sort_unstable();
        list
    };
    (sorted(inside), sorted(jumps))
}

/// The edges of a state of Q_D from whose targets something is accepted.
fn live_edges(part: &Partition, d: usize) -> impl Iterator<Item = (&Guard, usize)> {
    part.classes[d].iter().map(|class| (&class.guard, class.targets[0].0)).filter(|(_, target)| part.live[*target])
}

/// The states d of Q_D for which every letter leads from d only to where it leads from `n` as well, or leads from `n` to where everything is
/// accepted.
fn sound_jumps(part: &Partition, n: usize, effort: &mut Effort) -> Result<Vec<usize>, TooComplex> {
    let mut sound = Vec::new();
    let inside = part.reach[n].iter().filter(|(_, target)| part.deterministic[*target]);
    let reach: HashMap<usize, &Guard> = inside.map(|(letters, target)| (*target, letters)).collect();
    if reach.is_empty() {
        return Ok(sound);
    }
    let free = part.reach[n].iter().filter(|(_, target)| part.universal[*target]);
    let free: Vec<Cube> = free.flat_map(|(letters, _)| letters.0.iter().copied()).collect();
    for d in (0..part.classes.len()).filter(|d| part.deterministic[*d] && part.live[*d]) {
        effort.spend(1)?;
        let mut fits = true;
        for (guard, target) in live_edges(part, d) {
            let own = reach.get(&target).map_or(&[][..], |letters| &letters.0);
            fits = Guard([own, &free].concat()).includes(guard, effort)?;
            if !fits {
                break;
            }
        }
        if fits {
            sound.push(d);
        }
    }
    Ok(sound)
}

/// A small part of the sound jumps of `n` that together lead wherever its choices by letters lead; `None` if there is none, or no
/// such choice.
fn standing_for_all(part: &Partition, n: usize, sound: &[usize], effort: &mut Effort) -> Result<Option<Vec<usize>>, TooComplex> {
    let choices: Vec<(&Guard, usize)> = part.classes[n]
        .iter()
        .filter(|class| class.targets.len() > 1)
        .flat_map(|class| class.targets.iter().map(|(target, _)| (&class.guard, *target)))
        .filter(|(_, target)| part.deterministic[*target])
        .collect();
    if choices.is_empty() {
        return Ok(None);
    }
    let mut covered = |jumps: &[usize]| -> Result<bool, TooComplex> {
        let mut reach: HashMap<usize, Guard> = HashMap::new();
        for (guard, target) in jumps.iter().flat_map(|d| live_edges(part, *d)) {
            reach.entry(target).or_default().0.extend(guard.0.iter().copied());
        }
        for (guard, target) in &choices {
            match reach.get(target) {
                Some(letters) if letters.includes(guard, effort)? => {}
                _ => return Ok(false),
            }
        }
        Ok(true)
    };
    let mut chosen = sound.to_vec();
    if !covered(&chosen)? {
        return Ok(None);
    }
    for d in sound.iter().rev() {
        let fewer: Vec<usize> = chosen.iter().copied().filter(|c| c != d).collect();
        if covered(&fewer)? {
            chosen = fewer;
        }
    }
    Ok(Some(chosen))
}

/// The nodes found so far.
struct Explorer<'a, 'b> {
    jumps: &'b Jumps<'a>,
    nodes: Vec<Node>,
    index: HashMap<Node, usize>,
    /// Per set, jumps that some way into it must offer and that are sound there, so that every visit offers them.
    arrived: HashMap<Vec<usize>, Vec<usize>>,
}

impl Explorer<'_, '_> {
    fn node(&mut self, node: Node) -> Result<usize, TooComplex> {
        if let Some(&known) = self.index.get(&node) {
            return Ok(known);
        }
        if self.nodes.len() >= MAX_NODES {
            return Err(TooComplex);
        }
        self.index.insert(node.clone(), self.nodes.len());
        self.nodes.push(node);
        Ok(self.nodes.len() - 1)
    }

    fn state(&mut self, d: usize) -> Result<usize, TooComplex> {
        self.node((vec![], vec![d]))
    }

    /// The node in which a letter arrives that leads to `set` and to one of `offered`.
    fn arrive(&mut self, set: Vec<usize>, mut offered: Vec<usize>) -> Result<usize, TooComplex> {
        if !set.is_empty() {
            let always: HashSet<usize> = self.jumps.always(&set).collect();
            offered.retain(|d| !always.contains(d));
            let sound = |d: &usize| set.iter().any(|n| self.jumps.sound[*n].contains(d));
            let (free, bound): (Vec<usize>, Vec<usize>) = offered.into_iter().partition(sound);
            offered = bound;
            for d in free {
                self.state(d)?;
                let known = self.arrived.entry(set.clone()).or_default();
                if !known.contains(&d) {
                    known.push(d);
                }
            }
        }
        self.node((set, offered))
    }

    fn edges(&mut self, node: &Node, effort: &mut Effort) -> Result<Vec<(Guard, usize, Marks)>, TooComplex> {
        let part = self.jumps.part;
        let mut edges = Vec::new();
        if let ([], [d]) = (&node.0[..], &node.1[..]) {
            for class in &part.classes[*d] {
                let (target, marks) = class.targets[0];
                edges.push((class.guard.clone(), self.state(target)?, marks));
            }
            return Ok(edges);
        }
        for class in self.jumps.letters(&node.0, effort)? {
            let mut targets = class.targets;
            if targets.iter().any(|(target, _)| part.live[*target]) {
                targets.retain(|(target, _)| part.live[*target]);
            } else {
                targets.truncate(1);
            }
            let (next, offered) = self.jumps.divide(targets.iter().map(|(target, _)| *target));
            // Nothing is accepted in Q_N, so only marks on the way into Q_D are kept (Definition 2).
            let marks = if next.is_empty() && offered.len() == 1 { targets[0].1 } else { Marks::NONE };
            if !targets.is_empty() {
                edges.push((class.guard, self.arrive(next, offered)?, marks));
            }
        }
        joined(edges, effort)
    }
}

/// Edges that differ in their letters only become one, if there are many of them.
fn joined(edges: Vec<(Guard, usize, Marks)>, effort: &mut Effort) -> Result<Vec<(Guard, usize, Marks)>, TooComplex> {
    if edges.len() < MANY {
        return Ok(edges);
    }
    let mut symbolic = Symbolic::new();
    let mut places: HashMap<(usize, Marks), usize> = HashMap::new();
    let mut all: Vec<(Bdd, usize, Marks)> = Vec::new();
    for (guard, node, marks) in edges {
        let letters = symbolic.letters(&guard)?;
        let place = *places.entry((node, marks)).or_insert(all.len());
        match all.get_mut(place) {
            Some((known, ..)) => *known = symbolic.or(*known, letters)?,
            None => all.push((letters, node, marks)),
        }
    }
    all.into_iter().map(|(letters, node, marks)| Ok((symbolic.guard(letters, effort)?, node, marks))).collect()
}

/// Builds the nodes that can be reached.
fn explore(jumps: &Jumps<'_>, starts: &[usize], effort: &mut Effort) -> Result<Resolved, TooComplex> {
    let mut explorer = Explorer { jumps, nodes: Vec::new(), index: HashMap::new(), arrived: HashMap::new() };
    let (set, offered) = jumps.divide(starts.iter().copied());
    let start = explorer.arrive(set, offered)?;
    let (mut edges, mut epsilon) = (Vec::new(), Vec::new());
    while edges.len() < explorer.nodes.len() {
        let node = explorer.nodes[edges.len()].clone();
        edges.push(explorer.edges(&node, effort)?);
        let single = node.0.is_empty() && node.1.len() == 1;
        let offered: Vec<usize> = if single { vec![] } else { node.1.iter().copied().chain(jumps.always(&node.0)).collect() };
        epsilon.push(offered.into_iter().map(|d| explorer.state(d)).collect::<Result<Vec<_>, _>>()?);
        effort.spend(1)?;
    }
    let Explorer { nodes, index, arrived, .. } = explorer;
    for (node, targets) in nodes.iter().zip(&mut epsilon) {
        targets.extend(arrived.get(&node.0).into_iter().flatten().map(|d| index[&(vec![], vec![*d])]));
    }
    let early = (0..jumps.early.len()).filter(|n| jumps.early[*n].is_some()).collect();
    Ok(Resolved { nodes, start, edges, epsilon, early })
}
