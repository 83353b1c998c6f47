//! A run of the product as rows: for people, as JSON lines, and as CSV.

use crate::automaton::{EmbeddedState, Ldgba, Marks};
use crate::env::EnvSpec;
use crate::labels::Labels;
use crate::product::ProductStep;
use serde_json::{Map, Value, json};

/// What rows need to know to name things.
pub struct Names<'a> {
    /// The automaton.
    pub automaton: &'a Ldgba,
    /// The environment.
    pub spec: &'a EnvSpec,
}

/// One product state of a run.
pub struct Row<'a> {
    /// Its index in the run.
    pub index: usize,
    /// The environment's state, in physical units.
    pub state: &'a [f32],
    /// The letter that was read on entering it.
    pub labels: Labels,
    /// (q, T, T_Φ).
    pub at: EmbeddedState,
    /// The step that led to it; none for the first.
    pub step: Option<&'a ProductStep>,
    /// Rounds completed so far.
    pub rounds: u32,
}

impl Names<'_> {
    fn state(&self, q: u16) -> String {
        if self.automaton.name(q).is_empty() { q.to_string() } else { format!("{q} {}", self.automaton.name(q)) }
    }

    fn letter(&self, labels: Labels) -> Vec<&str> {
        let propositions = self.automaton.propositions();
        (0..propositions.len()).filter(|&i| labels.holds(i)).map(|i| propositions.name(i)).collect()
    }

    /// The titles of the columns of [`Names::line`].
    pub fn head(&self) -> String {
        let channels: String = self.spec.state.iter().map(|c| format!("{:>11}", shortened(&c.name))).collect();
        format!("{:>5} {:>6} {:<18} {:<8} {:<14} {}", "step", "rounds", "state of automaton", "T", "letter", channels)
    }

    /// A row for people; `*` marks a visit to an accepting set in T.
    pub fn line(&self, row: &Row<'_>) -> String {
        let fresh = if row.step.is_some_and(|s| s.fresh.0 != 0) { "*" } else { " " };
        let (q, sets) = (self.state(row.at.q), sets(row.at.frontier).iter().map(|j| j.to_string()).collect::<Vec<_>>().join(","));
        let numbers: String = row.state.iter().map(|x| format!("{x:>11.4}")).collect();
        let letter = self.letter(row.labels).join(",");
        format!("{:>5} {:>5}{fresh} {:<18} {:<8} {:<14} {numbers}", row.index, row.rounds, q, format!("{{{sets}}}"), letter)
    }

    /// A row as an object.
    pub fn object(&self, row: &Row<'_>) -> Value {
        let state: Map<String, Value> =
            self.spec.state.iter().zip(row.state).map(|(c, x)| (c.name.to_string(), json!(x))).collect();
        let moved = row.step.map(|s| json!({ "kind": s.kind, "fresh": sets(s.fresh), "sink": s.sink, "ended": s.ends() }));
        json!({
            "index": row.index,
            "state": state,
            "letter": self.letter(row.labels),
            "q": row.at.q,
            "frontier": sets(row.at.frontier),
            "rounds": row.rounds,
            "step": moved,
        })
    }

    /// The names of the columns of [`Names::record`].
    pub fn columns(&self) -> Vec<String> {
        let fixed = ["index", "q", "frontier", "letter", "rounds"].map(str::to_owned);
        fixed.into_iter().chain(self.spec.state.iter().map(|c| c.name.replace(' ', "_"))).collect()
    }

    /// A row as cells; sets are written with spaces in between.
    pub fn record(&self, row: &Row<'_>) -> Vec<String> {
        let sets: Vec<String> = sets(row.at.frontier).iter().map(|j| j.to_string()).collect();
        let fixed = [
            row.index.to_string(),
            row.at.q.to_string(),
            sets.join(" "),
            self.letter(row.labels).join(" "),
            row.rounds.to_string(),
        ];
        fixed.into_iter().chain(row.state.iter().map(|x| x.to_string())).collect()
    }
}

fn sets(marks: Marks) -> Vec<usize> {
    marks.iter().collect()
}

fn shortened(name: &str) -> String {
    name.chars().take(10).collect()
}
