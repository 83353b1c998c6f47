//! Do two automata accept a word in common? An exact answer, with the word.
//!
//! The product of two automata over the same alphabet is searched for a strongly connected component in which the accepting sets of both are
//! visited: section 4.3 of [Baier & Katoen](crate::bib::BaierKatoen2008).

use super::guard::{Effort, TooComplex};
use super::ldgba::{Ldgba, Marks, StateId};
use super::scc::components;
use crate::labels::Labels;
use crate::ltl::Lasso;
use std::collections::{HashMap, VecDeque};

/// The largest number of pairs of states that are looked at.
pub const MAX_PAIRS: usize = 1 << 20;

/// Why the question was not answered.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum IntersectionError {
    /// The automata have different propositions, or the same in another order.
    #[error("the automata have different propositions")]
    Propositions,
    /// More than [`MAX_PAIRS`] pairs of states.
    #[error("the product of the automata has more than {MAX_PAIRS} states")]
    TooLarge,
    /// The guards are too complex.
    #[error(transparent)]
    Labels(#[from] TooComplex),
}

/// Which runs of an automaton count.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Runs {
    /// Accepting runs: the words of the automaton's language.
    Accepting,
    /// Runs that never enter a sink: the words all of whose prefixes can be continued to a word of the language, its safety closure.
    Unfailing,
}

/// A word that both automata accept, if there is one.
///
/// # Errors
/// Different propositions, or a product that is too large.
pub fn common_word(left: &Ldgba, right: &Ldgba) -> Result<Option<Lasso>, IntersectionError> {
    common_word_of((left, Runs::Accepting), (right, Runs::Accepting))
}

/// A word of which both automata have a run that counts, if there is one.
///
/// # Errors
/// As [`common_word`].
pub fn common_word_of(left: (&Ldgba, Runs), right: (&Ldgba, Runs)) -> Result<Option<Lasso>, IntersectionError> {
    if left.0.propositions() != right.0.propositions() {
        return Err(IntersectionError::Propositions);
    }
    let product = Product::new(left, right)?;
    Ok(product.accepting_component().map(|nodes| product.word(&nodes)))
}

/// An edge of the product; without a letter, a jump of one side.
#[derive(Clone, Copy)]
struct Arrow {
    letter: Option<Labels>,
    marks: (Marks, Marks),
    target: usize,
}

struct Product {
    arrows: Vec<Vec<Arrow>>,
    /// The sets that must be visited.
    wanted: (Marks, Marks),
}

impl Product {
    fn new((left, left_runs): (&Ldgba, Runs), (right, right_runs): (&Ldgba, Runs)) -> Result<Product, IntersectionError> {
        let effort = &mut Effort::default();
        let start = (left.initial(), right.initial());
        let mut numbers: HashMap<(StateId, StateId), usize> = HashMap::from([(start, 0)]);
        let mut pairs = vec![start];
        let mut arrows: Vec<Vec<Arrow>> = Vec::new();
        while let Some(&(p, q)) = pairs.get(arrows.len()) {
            let mut list = Vec::new();
            let mut add = |letter, marks, pair: (StateId, StateId)| {
                if left.is_sink(pair.0) || right.is_sink(pair.1) {
                    return;
                }
                let target = *numbers.entry(pair).or_insert_with(|| {
                    pairs.push(pair);
                    pairs.len() - 1
                });
                list.push(Arrow { letter, marks, target });
            };
            for (guard, one) in left.edges(p) {
                for (other, two) in right.edges(q) {
                    if let Some(letter) = guard.overlap(other, effort)? {
                        add(Some(letter), (one.marks, two.marks), (one.target, two.target));
                    }
                }
            }
            left.epsilon(p).iter().for_each(|target| add(None, (Marks::NONE, Marks::NONE), (*target, q)));
            right.epsilon(q).iter().for_each(|target| add(None, (Marks::NONE, Marks::NONE), (p, *target)));
            arrows.push(list);
            if pairs.len() > MAX_PAIRS {
                return Err(IntersectionError::TooLarge);
            }
        }
        if left.is_sink(start.0) || right.is_sink(start.1) {
            arrows.iter_mut().for_each(Vec::clear);
        }
        let wanted = |automaton: &Ldgba, runs| match runs {
            Runs::Accepting => automaton.all_sets(),
            Runs::Unfailing => Marks::NONE,
        };
        Ok(Product { arrows, wanted: (wanted(left, left_runs), wanted(right, right_runs)) })
    }

    /// The nodes of a component in which all wanted sets are visited.
    fn accepting_component(&self) -> Option<Vec<usize>> {
        let successors: Vec<Vec<usize>> =
            self.arrows.iter().map(|list| list.iter().map(|arrow| arrow.target).collect()).collect();
        let found = components(&successors);
        let mut visited: Vec<Option<(Marks, Marks)>> = vec![None; found.count];
        for (v, list) in self.arrows.iter().enumerate() {
            for arrow in list.iter().filter(|arrow| found.of[arrow.target] == found.of[v]) {
                let sets = visited[found.of[v]].get_or_insert((Marks::NONE, Marks::NONE));
                *sets = (sets.0.union(arrow.marks.0), sets.1.union(arrow.marks.1));
            }
        }
        // Jumps lead out of their component, so a component with an edge has one with a letter.
        let component = visited.iter().position(|sets| self.enough(*sets))?;
        Some((0..found.of.len()).filter(|v| found.of[*v] == component).collect())
    }

    fn enough(&self, sets: Option<(Marks, Marks)>) -> bool {
        sets.is_some_and(|sets| sets.0.union(self.wanted.0) == sets.0 && sets.1.union(self.wanted.1) == sets.1)
    }

    /// A word along the component: a way to it, and a cycle in it that visits all wanted sets.
    fn word(&self, nodes: &[usize]) -> Lasso {
        let inside: Vec<bool> = (0..self.arrows.len()).map(|v| nodes.binary_search(&v).is_ok()).collect();
        let everywhere = vec![true; self.arrows.len()];
        let (prefix, anchor) = self.way(0, &everywhere, |_, arrow| inside[arrow.target], Some(&|v| inside[v]));
        let (mut cycle, mut at) = (Vec::new(), anchor);
        let mut missing = self.wanted;
        loop {
            let useful = |arrow: &Arrow| arrow.marks.0.0 & missing.0.0 != 0 || arrow.marks.1.0 & missing.1.0 != 0;
            let done = missing == (Marks::NONE, Marks::NONE);
            if done && at == anchor && !cycle.is_empty() {
                break;
            }
            let goal =
                |_: usize, arrow: &Arrow| inside[arrow.target] && if done { arrow.target == anchor } else { useful(arrow) };
            let (arrows, target) = self.way(at, &inside, goal, None);
            for arrow in &arrows {
                missing = (Marks(missing.0.0 & !arrow.marks.0.0), Marks(missing.1.0 & !arrow.marks.1.0));
            }
            cycle.extend(arrows);
            at = target;
        }
        let letters = |arrows: &[Arrow]| arrows.iter().filter_map(|arrow| arrow.letter).collect();
        Lasso { prefix: letters(&prefix), cycle: letters(&cycle) }
    }

    /// A shortest way from `start` through nodes that are `allowed`, whose last arrow is a `goal`; empty if `start` is good already.
    fn way(
        &self,
        start: usize,
        allowed: &[bool],
        goal: impl Fn(usize, &Arrow) -> bool,
        already: Option<&dyn Fn(usize) -> bool>,
    ) -> (Vec<Arrow>, usize) {
        if already.is_some_and(|good| good(start)) {
            return (Vec::new(), start);
        }
        let mut from: HashMap<usize, (usize, Arrow)> = HashMap::new();
        let mut open = VecDeque::from([start]);
        while let Some(v) = open.pop_front() {
            for arrow in &self.arrows[v] {
                if goal(v, arrow) {
                    let mut way = vec![*arrow];
                    let mut at = v;
                    while at != start {
                        let (before, arrow) = from[&at];
                        way.push(arrow);
                        at = before;
                    }
                    way.reverse();
                    return (way, arrow.target);
                }
                if allowed[arrow.target] && arrow.target != start && !from.contains_key(&arrow.target) {
                    from.insert(arrow.target, (v, *arrow));
                    open.push_back(arrow.target);
                }
            }
        }
        unreachable!("the nodes of a reachable component reach one another")
    }
}
