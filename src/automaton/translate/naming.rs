//! What states and subformulas are called in automata and messages.

use super::unfold::Unfolding;
use crate::bdd::{Bdd, Variable};

impl Unfolding<'_> {
    /// The subformula in focus as text, shortened if it is long.
    pub fn focused(&self) -> Option<String> {
        let text = self.store.formula(self.focus, 10 * LONGEST_NAME)?.to_string();
        let short: String = text.chars().take(2 * LONGEST_NAME).collect();
        Some(if short.len() < text.len() { format!("{short} …") } else { short })
    }

    /// Splits a monotone diagram over nx(·) into its minimal sets of atoms that suffice. `None` if there are more than `limit`.
    fn minimal_clauses(&mut self, f: Bdd, limit: usize) -> Option<Vec<Vec<Variable>>> {
        if f.is_constant() {
            return Some(if f == Bdd::TRUE { vec![Vec::new()] } else { Vec::new() });
        }
        let variable = self.bdd.top(f).expect("not constant");
        let (low, high) = self.bdd.branches(f);
        let mut clauses = self.minimal_clauses(low, limit)?;
        for clause in self.minimal_clauses(high, limit)? {
            if !clauses.iter().any(|smaller| smaller.iter().all(|v| clause.contains(v))) {
                let mut clause = clause;
                clause.insert(0, variable);
                clauses.push(clause);
            }
        }
        (clauses.len() <= limit).then_some(clauses)
    }

    /// The conjunction of states as text; empty if none of them is known as a formula.
    pub fn name(&mut self, states: &[Bdd]) -> String {
        let mut parts = Vec::new();
        for state in states {
            let Some(origin) = self.origin(*state) else { return String::new() };
            let Some(clauses) = self.minimal_clauses(origin, MOST_CLAUSES) else { return String::new() };
            let mut disjuncts = Vec::new();
            for clause in clauses {
                let atoms: Vec<_> = clause.iter().map(|v| self.atom(*v)).collect();
                disjuncts.push(self.store.and(atoms));
            }
            parts.push(self.store.or(disjuncts));
        }
        let all = self.store.and(parts);
        let all = self.simplifier.simplify(&mut self.store, all);
        self.store.formula(all, LONGEST_NAME).map_or_else(String::new, |formula| formula.to_string())
    }
}

/// States that are a disjunction of more clauses, or formulas with more nodes, get no name.
const MOST_CLAUSES: usize = 12;
const LONGEST_NAME: usize = 40;
