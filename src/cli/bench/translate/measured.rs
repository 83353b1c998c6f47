//! What was measured of a formula, and what it is held against.

use super::contender::{Outcome, Size};
use crate::ltl::Formula;
use std::collections::BTreeMap;

/// Formulas under a name.
pub struct Set {
    pub name: String,
    pub formulas: Vec<Formula>,
}

/// One formula.
pub struct Measured {
    /// Its number in its set, from 1.
    pub index: usize,
    pub formula: String,
    /// The smallest number of states that another tool needs.
    pub goal: Option<usize>,
    pub size: Result<Size, String>,
    /// Seconds, by contender.
    pub seconds: BTreeMap<&'static str, f64>,
}

impl Measured {
    pub fn new(index: usize, formula: &Formula, goal: Option<usize>) -> Measured {
        Measured { index, formula: formula.to_string(), goal, size: Err("not translated".into()), seconds: BTreeMap::new() }
    }

    /// Takes what a contender found; all must find the same.
    pub fn add(&mut self, contender: &'static str, outcome: Outcome) -> Result<(), String> {
        match (self.seconds.is_empty(), &self.size, &outcome.result) {
            (true, _, _) => self.size = outcome.result,
            (false, Ok(a), Ok(b)) if (a.states, a.sets, a.jumps) != (b.states, b.sets, b.jumps) => {
                return Err(format!("{}: {contender} gives another automaton: {b:?}, not {a:?}", self.formula));
            }
            _ => {}
        }
        self.seconds.insert(contender, outcome.seconds);
        Ok(())
    }

    /// States, if there is an automaton.
    pub fn states(&self) -> Option<usize> {
        self.size.as_ref().ok().map(|size| size.states)
    }

    /// Whether it has more states than another tool needs, and one.
    pub fn deviates(&self) -> bool {
        self.states().zip(self.goal).is_some_and(|(states, goal)| states > goal + 1)
    }
}

/// Other tools' sizes: by set and number, the smallest of them.
pub struct Goals(BTreeMap<(String, usize), usize>);

impl Goals {
    /// Reads a table with tabs and a head line.
    ///
    /// # Errors
    /// A table without the columns that are needed.
    pub fn parse(text: &str) -> Result<Goals, String> {
        let mut lines = text.lines();
        let head: Vec<&str> = lines.next().unwrap_or_default().split('\t').collect();
        let column = |name: &str| head.iter().position(|h| *h == name).ok_or(format!("the goals have no column `{name}`"));
        let (set, index) = (column("set")?, column("index")?);
        let others: Vec<usize> = (0..head.len()).filter(|i| head[*i].starts_with("owl")).collect();
        if others.is_empty() {
            return Err("the goals have no column whose name begins with `owl`".into());
        }
        let mut goals = BTreeMap::new();
        for line in lines {
            let cells: Vec<&str> = line.split('\t').collect();
            let least = others.iter().filter_map(|i| cells.get(*i)?.parse::<usize>().ok()).min();
            let key = cells.get(index).and_then(|cell| cell.parse().ok()).zip(cells.get(set));
            if let (Some((index, set)), Some(least)) = (key, least) {
                goals.insert(((*set).to_owned(), index), least);
            }
        }
        Ok(Goals(goals))
    }

    /// The goal of formula `index` (from 1) of `set`.
    pub fn of(&self, set: &str, index: usize) -> Option<usize> {
        self.0.get(&(set.to_owned(), index)).copied()
    }
}

/// Reasons by set and number.
pub fn reasons_of(text: &str) -> BTreeMap<(String, usize), String> {
    let entry = |line: &str| {
        let mut cells = line.splitn(3, '\t');
        Some(((cells.next()?.to_owned(), cells.next()?.parse().ok()?), cells.next()?.to_owned()))
    };
    text.lines().filter_map(entry).collect()
}
