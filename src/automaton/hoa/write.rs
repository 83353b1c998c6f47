//! From an automaton to text in the HOA format that the reader, and other tools, understand.

use super::super::guard::Guard;
use super::super::ldgba::{Ldgba, Marks, StateId};
use super::super::ldgba_error::LdgbaError;
use super::super::state_based::Letters;
use std::fmt::Write as _;

/// Where accepting sets are written.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub enum AcceptanceForm {
    /// On edges: the states are those of the automaton.
    #[default]
    Transitions,
    /// On states ([`Ldgba::state_based`]), for tools that know nothing else; there may be more of them.
    States(Letters),
}

/// How ε-jumps are written; the format has no form for them.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub enum EpsilonForm {
    /// As edges without a label beside edges with one: a widespread extension of the format, which Rabinizer 4 and CSRL use.
    #[default]
    Unlabelled,
    /// Resolved: for a jump from q to d, q gets the edges of d. A plain automaton of the format; reading it back recovers the jumps.
    Resolved,
}

/// How an automaton is written.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub struct WriteOptions {
    /// Where accepting sets are written.
    pub acceptance: AcceptanceForm,
    /// How ε-jumps are written.
    pub epsilon: EpsilonForm,
    /// `name:`, such as the formula; empty = none.
    pub name: String,
}

/// Writes `automaton` in version 1 of the format.
///
/// # Errors
/// When state-based acceptance takes too many states.
pub fn write(automaton: &Ldgba, options: &WriteOptions) -> Result<String, LdgbaError> {
    match options.acceptance {
        AcceptanceForm::Transitions => Ok(text(automaton, options, false)),
        AcceptanceForm::States(_) if automaton.is_state_based() => Ok(text(automaton, options, true)),
        AcceptanceForm::States(letters) => Ok(text(&automaton.state_based(letters)?, options, true)),
    }
}

fn text(automaton: &Ldgba, options: &WriteOptions, on_states: bool) -> String {
    let mut out = String::from("HOA: v1\n");
    if !options.name.is_empty() {
        let _ = writeln!(out, "name: {}", quoted(&options.name));
    }
    let _ = writeln!(out, "tool: \"ltl-rover\" \"{}\"", env!("CARGO_PKG_VERSION"));
    let _ = writeln!(out, "States: {}\nStart: {}", automaton.len(), automaton.initial());
    let names: String = automaton.propositions().iter().map(|name| format!(" {}", quoted(name))).collect();
    let _ = writeln!(out, "AP: {}{names}", automaton.propositions().len());
    let sets: Vec<String> = (0..automaton.sets()).map(|j| format!("Inf({j})")).collect();
    match sets.len() {
        1 => out += "acc-name: Buchi\n",
        n => out += &format!("acc-name: generalized-Buchi {n}\n"),
    }
    let _ = writeln!(out, "Acceptance: {} {}", sets.len(), sets.join("&"));
    out += "properties: no-univ-branch complete ";
    out += if on_states { "state-acc" } else { "trans-acc" };
    if automaton.states().all(|q| automaton.epsilon(q).is_empty()) {
        out += " trans-labels explicit-labels deterministic";
    }
    out += "\n--BODY--\n";
    let into = on_states.then(|| marks_of_states(automaton));
    for q in automaton.states() {
        let _ = write!(out, "State: {q}");
        if !automaton.name(q).is_empty() {
            let _ = write!(out, " {}", quoted(automaton.name(q)));
        }
        out += &into.as_ref().map_or(String::new(), |into| marks(into[usize::from(q)]));
        out.push('\n');
        edges(automaton, q, options.epsilon, on_states, &mut out);
    }
    out + "--END--\n"
}

fn edges(automaton: &Ldgba, q: StateId, form: EpsilonForm, on_states: bool, out: &mut String) {
    for (guard, edge) in automaton.edges(q) {
        let own = if on_states { String::new() } else { marks(edge.marks) };
        let _ = writeln!(out, "[{}] {}{own}", label(guard), edge.target);
    }
    for &d in automaton.epsilon(q) {
        match form {
            EpsilonForm::Unlabelled => {
                let _ = writeln!(out, "{d}");
            }
            EpsilonForm::Resolved => {
                for (guard, edge) in automaton.edges(d).iter().filter(|(_, edge)| !automaton.is_sink(edge.target)) {
                    let _ = writeln!(out, "[{}] {}", label(guard), edge.target);
                }
            }
        }
    }
}

/// Per state, the marks of the edges that enter it; they are the same for all.
fn marks_of_states(automaton: &Ldgba) -> Vec<Marks> {
    let mut into = vec![Marks::NONE; automaton.len()];
    for (_, edge) in automaton.states().flat_map(|q| automaton.edges(q)) {
        into[usize::from(edge.target)] = edge.marks;
    }
    into
}

/// ` {0 2}`, or nothing.
fn marks(marks: Marks) -> String {
    let numbers: Vec<String> = marks.iter().map(|j| j.to_string()).collect();
    if numbers.is_empty() { String::new() } else { format!(" {{{}}}", numbers.join(" ")) }
}

fn label(guard: &Guard) -> String {
    let cube = |positive: u64, negative: u64| {
        let literals: Vec<String> = (0..64)
            .filter(|i| (positive | negative) >> i & 1 == 1)
            .map(|i| format!("{}{i}", if negative >> i & 1 == 1 { "!" } else { "" }))
            .collect();
        if literals.is_empty() { "t".into() } else { literals.join("&") }
    };
    let cubes: Vec<String> = guard.minimised().0.iter().map(|c| cube(c.positive, c.negative)).collect();
    if cubes.is_empty() { "f".into() } else { cubes.join(" | ") }
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}
