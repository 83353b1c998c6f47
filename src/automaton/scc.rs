//! Strongly connected components of a directed graph, by Tarjan's algorithm without recursion.

/// The strongly connected components of a graph with nodes 0 … n−1.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Components {
    /// Per node, the number of its component. Components are numbered in reverse topological order: an edge never leads to a
    /// component with a larger number.
    pub of: Vec<usize>,
    /// How many components there are.
    pub count: usize,
}

/// Finds the components of the graph in which `successors[v]` lists where the edges of node `v` lead.
///
/// # Panics
/// If a successor is not a node.
pub fn components(successors: &[Vec<usize>]) -> Components {
    const UNSEEN: usize = usize::MAX;
    let nodes = successors.len();
    let (mut order, mut low) = (vec![UNSEEN; nodes], vec![UNSEEN; nodes]);
    let (mut of, mut count, mut clock) = (vec![UNSEEN; nodes], 0, 0);
    let mut open: Vec<usize> = Vec::new();
    let mut calls: Vec<(usize, usize)> = Vec::new();
    for root in 0..nodes {
        if order[root] != UNSEEN {
            continue;
        }
        calls.push((root, 0));
        while let Some((v, next)) = calls.pop() {
            if next == 0 {
                (order[v], low[v]) = (clock, clock);
                clock += 1;
                open.push(v);
            } else {
                low[v] = low[v].min(low[successors[v][next - 1]]);
            }
            let mut i = next;
            while i < successors[v].len() && order[successors[v][i]] != UNSEEN {
                let w = successors[v][i];
                if of[w] == UNSEEN {
                    low[v] = low[v].min(order[w]);
                }
                i += 1;
            }
            if i < successors[v].len() {
                calls.push((v, i + 1));
                calls.push((successors[v][i], 0));
            } else if low[v] == order[v] {
                while let Some(w) = open.pop() {
                    of[w] = count;
                    low[w] = UNSEEN;
                    if w == v {
                        break;
                    }
                }
                count += 1;
            }
        }
    }
    Components { of, count }
}

/// The nodes from which a node of `goal` can be reached; `goal[v]` tells whether node `v` is one.
pub fn can_reach(successors: &[Vec<usize>], goal: &[bool]) -> Vec<bool> {
    let mut predecessors = vec![Vec::new(); successors.len()];
    for (v, nexts) in successors.iter().enumerate() {
        for &w in nexts {
            predecessors[w].push(v);
        }
    }
    let mut reaches = goal.to_vec();
    let mut open: Vec<usize> = (0..goal.len()).filter(|v| goal[*v]).collect();
    while let Some(w) = open.pop() {
        for &v in &predecessors[w] {
            if !std::mem::replace(&mut reaches[v], true) {
                open.push(v);
            }
        }
    }
    reaches
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn two_nodes_share_a_component_when_each_reaches_the_other(
            graph in (1usize..9).prop_flat_map(|n| proptest::collection::vec(proptest::collection::vec(0..n, 0..4), n)),
        ) {
            let n = graph.len();
            let reaches: Vec<Vec<bool>> =
                (0..n).map(|v| can_reach(&graph, &(0..n).map(|w| w == v).collect::<Vec<_>>())).collect();
            let found = components(&graph);
            for v in 0..n {
                prop_assert!(found.of[v] < found.count);
                for (w, back) in reaches.iter().enumerate() {
                    prop_assert_eq!(found.of[v] == found.of[w], reaches[v][w] && back[v]);
                    prop_assert!(!graph[v].contains(&w) || found.of[w] <= found.of[v]);
                }
            }
        }
    }
}
