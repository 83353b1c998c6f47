//! The tables of `bench translate`, as Markdown and as JSON.

use super::measured::{Measured, Set};
use serde_json::json;
use std::collections::BTreeMap;
use std::fmt;

/// The slowest formulas that are shown.
const SLOWEST: usize = 10;
/// The longest formula that is shown whole, in characters.
const LONGEST: usize = 90;
/// A contender, the greatest time for one formula in seconds, and the greatest median.
const GOALS: [(&str, f64, f64); 2] = [("native", 0.050, 0.001), ("wasm", 0.150, f64::INFINITY)];

/// Everything measured.
pub struct Report {
    pub sets: Vec<(Set, Vec<Measured>)>,
    pub wasm: bool,
    /// Reasons for automata that are larger than allowed.
    pub reasons: BTreeMap<(String, usize), String>,
}

/// Sums over a set.
struct Sums {
    states: usize,
    goal: Option<usize>,
    failed: usize,
    nodes: usize,
}

fn sums(rows: &[Measured]) -> Sums {
    let goals: Vec<usize> = rows.iter().filter_map(|row| row.goal).collect();
    Sums {
        states: rows.iter().filter_map(Measured::states).sum(),
        goal: (goals.len() == rows.len()).then(|| goals.iter().sum()),
        failed: rows.iter().filter(|row| row.size.is_err()).count(),
        nodes: rows.iter().filter_map(|row| row.size.as_ref().ok()).map(|size| size.spent.nodes).max().unwrap_or(0),
    }
}

/// The times of a contender in order, in seconds.
fn times(rows: &[Measured], contender: &str) -> Vec<f64> {
    let mut times: Vec<f64> = rows.iter().filter_map(|row| row.seconds.get(contender).copied()).collect();
    times.sort_by(f64::total_cmp);
    times
}

impl Report {
    fn contenders(&self) -> Vec<&'static str> {
        if self.wasm { vec!["native", "wasm"] } else { vec!["native"] }
    }

    fn rows(&self) -> impl Iterator<Item = (&Set, &Measured)> {
        self.sets.iter().flat_map(|(set, rows)| rows.iter().map(move |row| (set, row)))
    }

    /// Automata that are larger than allowed, each with the reason that was given.
    fn deviations(&self) -> Vec<(&Set, &Measured, Option<&String>)> {
        let with_reason = |(set, row): (&'_ Set, &'_ Measured)| self.reasons.get(&(set.name.clone(), row.index));
        self.rows().filter(|(_, row)| row.deviates()).map(|(set, row)| (set, row, with_reason((set, row)))).collect()
    }

    /// Whether every formula is translated in time, and is as small as it should be or has a reason.
    pub fn reached(&self) -> bool {
        let in_time = GOALS.iter().all(|(contender, longest, median)| {
            let rows: Vec<f64> = self.sets.iter().flat_map(|(_, rows)| times(rows, contender)).collect();
            let mut sorted = rows.clone();
            sorted.sort_by(f64::total_cmp);
            sorted.is_empty() || sorted[sorted.len() - 1] <= *longest && sorted[sorted.len() / 2] <= *median
        });
        in_time && self.rows().all(|(_, row)| row.size.is_ok()) && self.deviations().iter().all(|(_, _, reason)| reason.is_some())
    }

    /// Everything as one JSON object.
    pub fn json(&self) -> String {
        let row = |row: &Measured| {
            let milliseconds: BTreeMap<_, _> = row.seconds.iter().map(|(name, s)| (name, 1e3 * s)).collect();
            let mut object =
                json!({ "index": row.index, "formula": row.formula, "goal": row.goal, "milliseconds": milliseconds });
            match &row.size {
                Ok(size) => {
                    let list = json!({ "states": size.states, "sets": size.sets, "jumps": size.jumps, "spent": size.spent });
                    object["automaton"] = list;
                }
                Err(error) => object["error"] = json!(error),
            }
            object
        };
        let set = |(set, rows): &(Set, Vec<Measured>)| {
            let sums = sums(rows);
            json!({ "set": set.name, "states": sums.states, "goal": sums.goal, "formulas": rows.iter().map(row).collect::<Vec<_>>() })
        };
        json!({ "sets": self.sets.iter().map(set).collect::<Vec<_>>(), "reached": self.reached() }).to_string()
    }
}

fn shortened(formula: &str) -> String {
    let text: String = formula.chars().take(LONGEST).collect();
    let text = if text.len() < formula.len() { format!("{text} …") } else { text };
    format!("`{}`", text.replace('|', "\\|"))
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let contenders = self.contenders();
        write!(f, "| set | formulas | states | others' fewest | most nodes |")?;
        contenders.iter().try_for_each(|name| write!(f, " {name}: median, longest, ms |"))?;
        write!(f, "\n|---|---|---|---|---|")?;
        contenders.iter().try_for_each(|_| write!(f, "---|"))?;
        writeln!(f)?;
        let mut every: Vec<&Measured> = vec![];
        for (set, rows) in &self.sets {
            let Sums { states, goal, failed, nodes } = sums(rows);
            let goal = goal.map_or("–".into(), |goal| goal.to_string());
            let states = if failed == 0 { states.to_string() } else { format!("{states}, {failed} beyond the budget") };
            write!(f, "| {} | {} | {states} | {goal} | {nodes} |", set.name, rows.len())?;
            for name in &contenders {
                let times = times(rows, name);
                write!(f, " {:.2}, {:.1} |", 1e3 * times[times.len() / 2], 1e3 * times[times.len() - 1])?;
            }
            writeln!(f)?;
            every.extend(rows);
        }
        for name in &contenders {
            let mut times: Vec<f64> = every.iter().filter_map(|row| row.seconds.get(name).copied()).collect();
            times.sort_by(f64::total_cmp);
            let (median, longest) = (1e3 * times[times.len() / 2], 1e3 * times[times.len() - 1]);
            writeln!(f, "\nAll {} formulas, {name}: median {median:.2} ms, longest {longest:.1} ms.", times.len())?;
        }
        let mut slowest: Vec<(&Set, &Measured)> = self.rows().collect();
        slowest.sort_by(|(_, a), (_, b)| b.seconds["native"].total_cmp(&a.seconds["native"]));
        writeln!(f, "\nThe slowest:\n\n| set | formula | states | ms |\n|---|---|---|---|")?;
        for (set, row) in slowest.into_iter().take(SLOWEST) {
            let states = row.states().map_or("–".into(), |states| states.to_string());
            let times: Vec<String> = contenders.iter().map(|name| format!("{:.1} {name}", 1e3 * row.seconds[name])).collect();
            writeln!(f, "| {} {} | {} | {states} | {} |", set.name, row.index, shortened(&row.formula), times.join(", "))?;
        }
        for (set, row) in self.rows() {
            if let Err(error) = &row.size {
                writeln!(f, "\n{} {}, {}: {error}.", set.name, row.index, shortened(&row.formula))?;
            }
        }
        if self.rows().any(|(_, row)| row.goal.is_some()) {
            let deviations = self.deviations();
            writeln!(f, "\nAutomata with more states than the smallest of the others' and one: {}.", deviations.len())?;
            if !deviations.is_empty() {
                writeln!(f, "\n| set | formula | states | others' fewest | reason |\n|---|---|---|---|---|")?;
            }
            for (set, row, reason) in deviations {
                let (states, goal) = (row.states().unwrap_or(0), row.goal.unwrap_or(0));
                let reason = reason.map_or("none is known", String::as_str);
                writeln!(f, "| {} {} | {} | {states} | {goal} | {reason} |", set.name, row.index, shortened(&row.formula))?;
            }
        }
        Ok(())
    }
}
