//! The limit-deterministic automaton of a whole formula: an initial component that tracks the formula, and jumps out of it.
//!
//! The initial component is the deterministic automaton of `af`, but for [what no letter changes](super::invariant). A jump leaves it from a
//! state B that can recur, with a guess about the fixpoints that B still has ([`symmetric`](super::symmetric), [`split`](super::split),
//! [`asymmetric`](super::asymmetric)). Two shortcuts avoid jumps: a safety state is tracked in the accepting part at once, and a state whose
//! language is contained in that of one of its targets *is* that target, so that nothing is guessed at all.
//!
//! Good for MDPs: the initial component loses nothing that was read, every jump can be put off for as long as its guess may still come
//! true, and behind it everything is deterministic; [Sickert et al.](crate::bib::Sickert2016), section 5, and
//! [Hahn et al.](crate::bib::Hahn2020).

use super::asymmetric::{self, Layout};
use super::breakpoint::{Pair, Renewal, successors};
use super::graph::{Arrow, Graph, MarkSet, Numbering, State, all_sets, merge_edges};
use super::guess::Guesses;
use super::options::Construction;
use super::target::{Besides, Target, Together};
use super::unfold::Unfolding;
use super::work::Stop;
use super::{invariant, split, symmetric};
use crate::automaton::scc::components;
use crate::bdd::Bdd;
use std::collections::HashMap;

/// Which guesses are made, and how the deterministic part is laid out.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Guess {
    Symmetric,
    Split,
    Asymmetric(Layout, Renewal),
}

impl Guess {
    /// Whether this is a way that `construction` allows.
    pub fn is_of(self, construction: Construction) -> bool {
        match self {
            Guess::Symmetric => matches!(construction, Construction::All | Construction::Symmetric),
            Guess::Split => matches!(construction, Construction::All | Construction::Split),
            Guess::Asymmetric(..) => matches!(construction, Construction::All | Construction::Asymmetric),
        }
    }
}

/// A state of the automaton.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
enum Place {
    /// In the initial component.
    Track(Bdd),
    /// Behind a jump: what is tracked, the number of the automaton beside it, and its state.
    Inside { main: Pair, renewal: Option<Renewal>, beside: usize, at: usize },
}

/// The automaton for the formula with the raw diagram `raw`, and whether several recurrences that need memory stand beside one another in it.
pub(super) fn limit_deterministic(
    u: &mut Unfolding<'_>,
    raw: Bdd,
    guess: Guess,
    together: Together,
) -> Result<(Graph, bool), Stop> {
    let mut builder = Builder {
        guess,
        together,
        guesses: Guesses::default(),
        besides: Besides::default(),
        numbering: Numbering::new(),
        targets: HashMap::new(),
        graph: Graph::default(),
        marks: Vec::new(),
        sets: 1,
    };
    let initial = invariant::tracked(u, raw)?;
    let place = builder.place(u, initial)?;
    builder.numbering.number(place, &mut u.work)?;
    builder.expand(u)?;
    builder.add_jumps(u)?;
    builder.expand(u)?;
    let memory = builder.besides.has_memory(u);
    Ok((builder.finish(), memory))
}

struct Builder {
    guess: Guess,
    together: Together,
    guesses: Guesses,
    besides: Besides,
    numbering: Numbering<Place>,
    /// The targets of the states of the initial component.
    targets: HashMap<Bdd, Vec<Target>>,
    graph: Graph,
    /// Per state, how many sets its edges' marks speak of.
    marks: Vec<usize>,
    /// The largest of them.
    sets: usize,
}

impl Builder {
    /// Where the formula with the unfolding `b` is tracked.
    fn place(&mut self, u: &mut Unfolding<'_>, b: Bdd) -> Result<Place, Stop> {
        let atoms = u.atoms(b);
        if atoms.iter().all(|id| u.store.traits(*id).is_safety()) {
            return Ok(Place::Inside { main: Pair { all: b, rej: Bdd::TRUE }, renewal: None, beside: self.nothing(u)?, at: 0 });
        }
        if atoms.iter().all(|id| u.store.traits(*id).is_co_safety()) {
            return Ok(Place::Track(b));
        }
        if !self.targets.contains_key(&b) {
            let targets = match self.guess {
                Guess::Symmetric => {
                    let b = invariant::recalled(u, b)?;
                    symmetric::targets(u, &mut self.guesses, b)?
                }
                Guess::Split => split::targets(u, &mut self.guesses, b)?,
                Guess::Asymmetric(layout, renewal) => asymmetric::targets(u, &mut self.guesses, b, layout, renewal)?,
            };
            self.targets.insert(b, targets);
        }
        let targets = self.targets[&b].clone();
        let mut atoms: Vec<_> = targets.iter().flat_map(|target| u.atoms(target.language)).collect();
        atoms.sort_unstable();
        atoms.dedup();
        let assumed = u.with_implications(b, &atoms)?;
        for target in targets {
            if u.bdd.implies(assumed, target.language)? {
                return self.inside(u, &target);
            }
        }
        Ok(Place::Track(b))
    }

    fn nothing(&mut self, u: &mut Unfolding<'_>) -> Result<usize, Stop> {
        self.besides.number(u, &[], self.together, Renewal::Raw)
    }

    /// The state in which a target starts.
    fn inside(&mut self, u: &mut Unfolding<'_>, target: &Target) -> Result<Place, Stop> {
        let beside = self.besides.number(u, &target.beside, self.together, target.renewal.unwrap_or(Renewal::Raw))?;
        let at = self.besides.graph(beside).initial;
        Ok(Place::Inside { main: target.main, renewal: target.renewal, beside, at })
    }

    /// Gives edges to all states that have none yet.
    fn expand(&mut self, u: &mut Unfolding<'_>) -> Result<(), Stop> {
        while let Some(&place) = self.numbering.get(self.graph.states.len()) {
            let (edges, sets, left) = match place {
                Place::Track(b) => (self.track(u, b)?, 0, vec![b]),
                Place::Inside { main, renewal, beside, at } => {
                    let (edges, sets) = self.inside_edges(u, main, renewal, (beside, at))?;
                    (edges, sets, [&[main.all], &self.besides.graph(beside).states[at].left[..]].concat())
                }
            };
            let edges = merge_edges(&mut u.bdd, edges)?;
            self.graph.states.push(State { edges, left, ..State::default() });
            self.marks.push(sets);
            self.sets = self.sets.max(sets);
        }
        Ok(())
    }

    fn track(&mut self, u: &mut Unfolding<'_>, b: Bdd) -> Result<Vec<Arrow>, Stop> {
        let mut edges = Vec::new();
        for &(guard, raw) in u.steps(b)?.iter() {
            let next = invariant::tracked(u, raw)?;
            if next != Bdd::FALSE {
                let place = self.place(u, next)?;
                edges.push(Arrow { guard, target: self.numbering.number(place, &mut u.work)?, marks: 0 });
            }
        }
        Ok(edges)
    }

    fn inside_edges(
        &mut self,
        u: &mut Unfolding<'_>,
        main: Pair,
        renewal: Option<Renewal>,
        (beside, at): (usize, usize),
    ) -> Result<(Vec<Arrow>, usize), Stop> {
        let graph = self.besides.graph(beside);
        let mut edges = Vec::new();
        for (guard, next, met) in successors(u, main, renewal.unwrap_or(Renewal::Raw))? {
            for edge in &graph.states[at].edges {
                let guard = u.bdd.and(guard, edge.guard)?;
                if guard != Bdd::FALSE {
                    let main = if renewal.is_none() { Pair { rej: Bdd::TRUE, ..next } } else { next };
                    let place = Place::Inside { main, renewal, beside, at: edge.target };
                    let marks = u64::from(met) | edge.marks << 1;
                    edges.push(Arrow { guard, target: self.numbering.number(place, &mut u.work)?, marks });
                }
            }
        }
        Ok((edges, 1 + graph.sets))
    }

    /// Adds the jumps of the states of the initial component that can recur.
    fn add_jumps(&mut self, u: &mut Unfolding<'_>) -> Result<(), Stop> {
        let successors: Vec<Vec<usize>> =
            self.graph.states.iter().map(|state| state.edges.iter().map(|edge| edge.target).collect()).collect();
        let found = components(&successors);
        let mut sizes = vec![0; found.count];
        found.of.iter().for_each(|component| sizes[*component] += 1);
        for q in 0..successors.len() {
            let Some(&Place::Track(b)) = self.numbering.get(q) else { continue };
            let recurs = sizes[found.of[q]] > 1 || successors[q].contains(&q);
            if !recurs {
                continue;
            }
            for target in self.targets.get(&b).cloned().unwrap_or_default() {
                let place = self.inside(u, &target)?;
                let number = self.numbering.number(place, &mut u.work)?;
                self.graph.states[q].jumps.push(number);
            }
        }
        Ok(())
    }

    /// A set that the automaton of a state does not speak of is visited by all its edges.
    fn finish(mut self) -> Graph {
        self.graph.sets = self.sets;
        for (q, state) in self.graph.states.iter_mut().enumerate() {
            if let Some(Place::Inside { .. }) = self.numbering.get(q) {
                let spare: MarkSet = all_sets(self.sets) & !all_sets(self.marks[q]);
                state.edges.iter_mut().for_each(|edge| edge.marks |= spare);
            }
        }
        debug_assert_eq!(self.graph.states.len(), self.numbering.len());
        self.graph
    }
}
