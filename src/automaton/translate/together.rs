//! Deterministic automata beside one another: their product or, where it has too many edges, recurrences one after the other.

use super::graph::{Arrow, Graph, Numbering, State, merge_edges};
use super::pieces::product;
use super::unfold::Unfolding;
use super::work::Stop;

/// How many edges a product of deterministic pieces should have. An automaton for n recurrences with a set for each has one state, but 2ⁿ edges;
/// this is as many as for twelve.
pub(super) const MOST_EDGES: usize = 1 << 12;

/// One of several automata of which all have to accept.
pub(super) struct Piece {
    pub graph: Graph,
    /// Whether it is one of [`recurrence`](super::pieces::recurrence).
    pub recurs: bool,
}

/// The intersection of `start` and all pieces. The recurrences among them have a set each, or all together one if that gives more than
/// `most_edges`.
pub(super) fn beside_one_another(
    u: &mut Unfolding<'_>,
    start: Graph,
    pieces: &[Piece],
    most_edges: usize,
) -> Result<Graph, Stop> {
    let recurring = pieces.iter().filter(|piece| piece.recurs).count();
    let mut all = start.clone();
    let mut recurred = 0;
    for piece in pieces {
        all = product(u, &all, &piece.graph)?;
        recurred += usize::from(piece.recurs);
        if all.edges() > most_edges && recurring > 1 && recurred > 0 {
            return in_turn(u, start, pieces);
        }
    }
    Ok(all)
}

/// The intersection, with the recurrences one after the other.
fn in_turn(u: &mut Unfolding<'_>, start: Graph, pieces: &[Piece]) -> Result<Graph, Stop> {
    let (recurring, others): (Vec<&Piece>, Vec<&Piece>) = pieces.iter().partition(|piece| piece.recurs);
    let mut all = start;
    for piece in others {
        all = product(u, &all, &piece.graph)?;
    }
    let recurring: Vec<Graph> = recurring.into_iter().map(|piece| piece.graph.clone()).collect();
    let chain = round_robin(u, &recurring)?;
    product(u, &all, &chain)
}

/// Waits for a mark of the first automaton, then of the second, and so on; the last one's mark is the mark of all. Each starts afresh when its
/// turn comes, which is right for recurrences, as they forget every prefix.
pub(super) fn round_robin(u: &mut Unfolding<'_>, graphs: &[Graph]) -> Result<Graph, Stop> {
    let mut numbering = Numbering::new();
    numbering.number((0, graphs[0].initial), &mut u.work)?;
    let mut chain = Graph { states: Vec::new(), initial: 0, sets: 1 };
    while let Some(&(turn, q)) = numbering.get(chain.states.len()) {
        let mut edges = Vec::new();
        for edge in &graphs[turn].states[q].edges {
            let done = edge.marks != 0;
            let next = if done { (turn + 1) % graphs.len() } else { turn };
            let target = if done && graphs.len() > 1 { graphs[next].initial } else { edge.target };
            let marks = u64::from(done && next == 0);
            edges.push(Arrow { guard: edge.guard, target: numbering.number((next, target), &mut u.work)?, marks });
        }
        let edges = merge_edges(&mut u.bdd, edges)?;
        chain.states.push(State { edges, left: graphs[turn].states[q].left.clone(), ..State::default() });
    }
    Ok(chain)
}
