//! Drawings for Graphviz: accepting sets by number and colour, sinks grey and square, ε-jumps dashed.

use super::graph::{GraphEdge, GraphEdgeKind, GraphState};
use super::ldgba::Ldgba;
use std::fmt::Write as _;

impl Ldgba {
    /// The automaton in the DOT language. An accepting set j is written as ⓙ on its edges, and drawn in the colour j modulo 8 of
    /// Graphviz's scheme `dark28`; an edge of several sets has parallel lines in their colours.
    pub fn dot(&self) -> String {
        let graph = self.graph();
        let mut dot = String::from(
            "digraph {\n  rankdir=LR\n  node [shape=ellipse]\n  edge [colorscheme=dark28]\n  start [shape=none, label=\"\", width=0]\n",
        );
        for state in &graph.states {
            let _ = writeln!(dot, "  {} [{}]", state.id, node(state));
        }
        let _ = writeln!(dot, "  start -> {}", graph.initial);
        for edge in &graph.edges {
            let _ = writeln!(dot, "  {} -> {} [{}]", edge.from, edge.to, line(edge));
        }
        dot + "}\n"
    }
}

fn node(state: &GraphState) -> String {
    let label = if state.name.is_empty() { state.id.to_string() } else { format!("{}\\n{}", state.id, quoted(&state.name)) };
    let look = match (state.sink, state.deterministic) {
        (true, _) => ", shape=box, style=\"filled,dashed\", fillcolor=gray85",
        (false, true) => "",
        (false, false) => ", style=rounded, shape=box",
    };
    format!("label=\"{label}\"{look}")
}

fn line(edge: &GraphEdge) -> String {
    let label = quoted(&edge.label);
    match (edge.kind, edge.marks.is_empty()) {
        (GraphEdgeKind::Epsilon, _) => format!("label=\"{label}\", style=dashed"),
        (GraphEdgeKind::Letter, true) => format!("label=\"{label}\""),
        (GraphEdgeKind::Letter, false) => {
            let numbers: Vec<String> = edge.marks.iter().map(|j| circled(*j)).collect();
            let colours: Vec<String> = edge.marks.iter().map(|j| (j % 8 + 1).to_string()).collect();
            format!("label=\"{label}\\n{}\", color=\"{}\", penwidth=2", numbers.join(" "), colours.join(":"))
        }
    }
}

/// ⓪ ① … ⑳ ㉑ … ㉛
fn circled(number: usize) -> String {
    let character = match number {
        0 => Some('⓪'),
        1..=20 => char::from_u32(0x2460 + number as u32 - 1),
        21..=35 => char::from_u32(0x3251 + number as u32 - 21),
        _ => None,
    };
    character.map_or_else(|| format!("({number})"), String::from)
}

fn quoted(text: &str) -> String {
    text.replace('\\', "\\\\").replace('"', "\\\"").replace(['\n', '\r'], " ")
}

#[cfg(test)]
mod tests {
    use super::super::hoa;

    #[test]
    fn sets_sinks_and_jumps_are_drawn() {
        let source = "HOA: v1 States: 2 Start: 0 AP: 1 \"a\" Acceptance: 1 Inf(0)
            --BODY-- State: 0 \"FG \\\"a\\\"\" [t] 0 1 State: 1 [0] 1 {0} --END--";
        let dot = hoa::read(source).unwrap().automaton.dot();
        assert!(dot.contains("  0 [label=\"0\\nFG \\\"a\\\"\", style=rounded, shape=box]\n"), "{dot}");
        assert!(dot.contains("  2 [label=\"2\\nsink\", shape=box, style=\"filled,dashed\", fillcolor=gray85]\n"), "{dot}");
        assert!(dot.contains("  0 -> 1 [label=\"ε\", style=dashed]\n"), "{dot}");
        assert!(dot.contains("  1 -> 1 [label=\"a\\n⓪\", color=\"1\", penwidth=2]\n"), "{dot}");
        assert!(dot.contains("  1 -> 2 [label=\"!a\"]\n"), "{dot}");
    }
}
