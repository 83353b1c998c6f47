//! Making an automaton smaller without changing what an MDP can achieve with it: dead states, idle marks, redundant sets, bisimulation.
//!
//! Only reductions that keep every choice: no simulation relations (a simulating state may have lost the right to put off its jump).

use super::graph::{Arrow, Graph, MarkSet, State, merge_edges};
use super::pieces::before_a_jump;
use super::unfold::Unfolding;
use super::work::Stop;
use crate::automaton::scc::{can_reach, components};
use crate::bdd::Bdd;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Applies all reductions until nothing changes.
pub(super) fn reduced(u: &mut Unfolding<'_>, mut graph: Graph) -> Result<Graph, Stop> {
    loop {
        let before = (graph.states.len(), graph.edges(), graph.jumps(), graph.sets);
        settle_marks(&mut graph);
        graph = without_dead_states(graph);
        drop_redundant_sets(&mut graph);
        let moved = make_jumps_later(u, &mut graph)?;
        for state in &mut graph.states {
            state.edges = merge_edges(&mut u.bdd, std::mem::take(&mut state.edges))?;
        }
        graph = bisimulation_quotient(u, graph, |_| 0)?;
        if !moved && before == (graph.states.len(), graph.edges(), graph.jumps(), graph.sets) {
            return Ok(graph);
        }
    }
}

fn successors(graph: &Graph) -> Vec<Vec<usize>> {
    graph.states.iter().map(|state| state.edges.iter().map(|edge| edge.target).collect()).collect()
}

/// The strongly connected components of the edges in which an accepting run may stay, per state.
fn accepting(graph: &Graph) -> (Vec<usize>, Vec<bool>) {
    let found = components(&successors(graph));
    let waits = before_a_jump(graph);
    let mut marks: Vec<Option<MarkSet>> = vec![None; found.count];
    for (q, state) in graph.states.iter().enumerate() {
        for edge in &state.edges {
            if found.of[edge.target] == found.of[q] && !waits[q] {
                *marks[found.of[q]].get_or_insert(0) |= edge.marks;
            }
        }
    }
    let all = graph.all_sets();
    (found.of, marks.into_iter().map(|marks| marks.is_some_and(|marks| marks & all == all)).collect())
}

/// Clears the marks of edges on which no accepting run stays. In a component whose every cycle is accepting, marks all edges instead.
fn settle_marks(graph: &mut Graph) {
    let (of, accepting) = accepting(graph);
    let all = graph.all_sets();
    let always = components_without_gaps(graph, &of);
    for q in 0..graph.states.len() {
        for edge in &mut graph.states[q].edges {
            if of[edge.target] != of[q] || !accepting[of[q]] {
                edge.marks = 0;
            } else if always[of[q]] {
                edge.marks = all;
            }
        }
    }
}

/// Per component, whether every cycle in it visits all sets: for no set is there a cycle without it.
fn components_without_gaps(graph: &Graph, of: &[usize]) -> Vec<bool> {
    let mut always = vec![true; of.iter().max().map_or(0, |most| most + 1)];
    for set in 0..graph.sets {
        let avoiding: Vec<Vec<usize>> = graph
            .states
            .iter()
            .enumerate()
            .map(|(q, state)| {
                let misses = |edge: &&Arrow| edge.marks >> set & 1 == 0 && of[edge.target] == of[q];
                state.edges.iter().filter(misses).map(|edge| edge.target).collect()
            })
            .collect();
        let found = components(&avoiding);
        let mut sizes = vec![0; found.count];
        found.of.iter().for_each(|component| sizes[*component] += 1);
        for (q, nexts) in avoiding.iter().enumerate() {
            if sizes[found.of[q]] > 1 || nexts.contains(&q) {
                always[of[q]] = false;
            }
        }
    }
    always
}

/// Keeps the states that can be reached and from which something is accepted; the initial state in any case.
fn without_dead_states(graph: Graph) -> Graph {
    let (of, accepting) = accepting(&graph);
    let goal: Vec<bool> = of.iter().map(|component| accepting[*component]).collect();
    let both: Vec<Vec<usize>> = graph
        .states
        .iter()
        .map(|state| state.edges.iter().map(|edge| edge.target).chain(state.jumps.iter().copied()).collect())
        .collect();
    let alive = can_reach(&both, &goal);
    let mut numbers: HashMap<usize, usize> = HashMap::new();
    let mut order = vec![graph.initial];
    numbers.insert(graph.initial, 0);
    let mut at = 0;
    while let Some(&q) = order.get(at) {
        at += 1;
        for &next in &both[q] {
            if alive[next] && !numbers.contains_key(&next) {
                numbers.insert(next, order.len());
                order.push(next);
            }
        }
    }
    let mut old: Vec<Option<State>> = graph.states.into_iter().map(Some).collect();
    let states = order
        .iter()
        .map(|q| {
            let state = old[*q].take().expect("each state is taken once");
            let edges = state
                .edges
                .into_iter()
                .filter(|edge| alive[edge.target])
                .map(|edge| Arrow { target: numbers[&edge.target], ..edge })
                .collect();
            let jumps: BTreeSet<usize> = state.jumps.iter().filter(|q| alive[**q]).map(|q| numbers[q]).collect();
            State { edges, jumps: jumps.into_iter().collect(), left: state.left }
        })
        .collect();
    Graph { states, initial: 0, sets: graph.sets }
}

/// Drops, in each accepting component, the sets that are visited whenever another one is; numbers the others from 0.
fn drop_redundant_sets(graph: &mut Graph) {
    let (of, accepting) = accepting(graph);
    let mut inner: BTreeMap<usize, BTreeSet<MarkSet>> = BTreeMap::new();
    for (q, state) in graph.states.iter().enumerate() {
        for edge in &state.edges {
            if of[edge.target] == of[q] && accepting[of[q]] {
                inner.entry(of[q]).or_default().insert(edge.marks);
            }
        }
    }
    let mut kept: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (component, marks) in &inner {
        let implied = |i: usize, j: usize| marks.iter().all(|m| m >> j & 1 == 0 || m >> i & 1 == 1);
        let mut list: Vec<usize> = (0..graph.sets).collect();
        for i in 0..graph.sets {
            if list.iter().any(|&j| j != i && implied(i, j)) {
                list.retain(|j| *j != i);
            }
        }
        // The last set goes too if nothing but it is left and every edge has it; one is kept so that acceptance stays visible.
        kept.insert(*component, list);
    }
    let sets = kept.values().map(Vec::len).max().unwrap_or(graph.sets.min(1));
    let all = super::graph::all_sets(sets);
    for q in 0..graph.states.len() {
        for edge in &mut graph.states[q].edges {
            let stays = of[edge.target] == of[q];
            edge.marks = match kept.get(&of[q]) {
                Some(list) if stays => {
                    let renumbered = list.iter().enumerate().fold(0, |m, (new, old)| m | (edge.marks >> old & 1) << new);
                    renumbered | all & !super::graph::all_sets(list.len())
                }
                _ => 0,
            };
        }
    }
    graph.sets = sets;
}

/// Makes jumps whose target cannot recur one letter later: the jump from q to t is replaced, for every letter, by one from where the letter leads
/// from q to where it leads from t.
///
/// What t accepts, q accepts; so what is left of it after a letter is accepted from where the letter leads from q, and the new jumps are right
/// however their source is reached. A policy that jumped early jumps later and is then in the same state. As targets that cannot recur are left
/// after finitely many letters, no jump is put off for ever. Tells whether there were such jumps.
fn make_jumps_later(u: &mut Unfolding<'_>, graph: &mut Graph) -> Result<bool, Stop> {
    let successors = successors(graph);
    let found = components(&successors);
    let mut sizes = vec![0; found.count];
    found.of.iter().for_each(|component| sizes[*component] += 1);
    let recurs = |q: usize| sizes[found.of[q]] > 1 || successors[q].contains(&q);
    let waits = before_a_jump(graph);
    let mut jumps: Vec<BTreeSet<usize>> = graph.states.iter().map(|state| state.jumps.iter().copied().collect()).collect();
    let mut open: Vec<(usize, usize)> = jumps
        .iter()
        .enumerate()
        .flat_map(|(q, targets)| targets.iter().map(move |t| (q, *t)))
        .filter(|(_, t)| !recurs(*t))
        .collect();
    let moved = !open.is_empty();
    while let Some((q, target)) = open.pop() {
        jumps[q].remove(&target);
        for inside in &graph.states[target].edges {
            for outside in &graph.states[q].edges {
                u.work.tick(1)?;
                // A state before no jump accepts what it should without one.
                if !waits[outside.target] || jumps[outside.target].contains(&inside.target) {
                    continue;
                }
                if u.bdd.and(outside.guard, inside.guard)? != Bdd::FALSE {
                    jumps[outside.target].insert(inside.target);
                    if !recurs(inside.target) {
                        open.push((outside.target, inside.target));
                    }
                }
            }
        }
    }
    for (state, jumps) in graph.states.iter_mut().zip(jumps) {
        state.jumps = jumps.into_iter().collect();
    }
    Ok(moved)
}

/// Merges states of the same `kind` with the same edges and jumps, up to merging.
pub(super) fn bisimulation_quotient(u: &mut Unfolding<'_>, graph: Graph, kind: impl Fn(usize) -> u64) -> Result<Graph, Stop> {
    type Signature = (Vec<(usize, MarkSet, Bdd)>, BTreeSet<usize>);
    let count = graph.states.len();
    let waits = before_a_jump(&graph);
    let mut kinds = HashMap::new();
    let mut block: Vec<usize> = (0..count)
        .map(|q| {
            let fresh = kinds.len();
            *kinds.entry((waits[q], kind(q))).or_insert(fresh)
        })
        .collect();
    let mut blocks = kinds.len();
    loop {
        u.work.tick(count)?;
        let mut numbers: HashMap<(usize, Signature), usize> = HashMap::new();
        let mut next = Vec::with_capacity(count);
        for (q, state) in graph.states.iter().enumerate() {
            let mut guards: BTreeMap<(usize, MarkSet), Bdd> = BTreeMap::new();
            for edge in &state.edges {
                let guard = guards.entry((block[edge.target], edge.marks)).or_insert(Bdd::FALSE);
                *guard = u.bdd.or(*guard, edge.guard)?;
            }
            let edges = guards.into_iter().map(|((target, marks), guard)| (target, marks, guard)).collect();
            let jumps = state.jumps.iter().map(|target| block[*target]).collect();
            let fresh = numbers.len();
            next.push(*numbers.entry((block[q], (edges, jumps))).or_insert(fresh));
        }
        let found = numbers.len();
        block = next;
        if found == blocks {
            break;
        }
        blocks = found;
    }
    if blocks == count {
        return Ok(graph);
    }
    let mut states: Vec<Option<State>> = vec![None; blocks];
    for (q, state) in graph.states.into_iter().enumerate() {
        if states[block[q]].is_none() {
            let edges = state.edges.iter().map(|edge| Arrow { target: block[edge.target], ..*edge }).collect();
            let edges = merge_edges(&mut u.bdd, edges)?;
            let jumps: BTreeSet<usize> = state.jumps.iter().map(|target| block[*target]).collect();
            states[block[q]] = Some(State { edges, jumps: jumps.into_iter().collect(), left: state.left });
        }
    }
    let states = states.into_iter().map(|state| state.expect("every block has a state")).collect();
    Ok(Graph { states, initial: block[graph.initial], sets: graph.sets })
}
