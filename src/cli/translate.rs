//! `translate`: from a formula to a small limit-deterministic automaton, as HOA, DOT or JSON.

use super::failure::Failure;
use super::output::out;
use crate::automaton::hoa::{self, AcceptanceForm, EpsilonForm, WriteOptions};
use crate::automaton::translate::{Acceptance, Budget, Preference, Spent, TranslateOptions, translate_counting};
use crate::automaton::{Ldgba, Letters};
use crate::ltl::{Formula, Note};
use clap::{Args, ValueEnum};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// Translate formulas to limit-deterministic Büchi automata that are good for MDPs.
///
/// Exit code 0: done. 1: a translation needs more than its budget. 2: a formula or an option is wrong; the place is shown.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  ltl-rover translate 'G F r1 & G F r2'
  ltl-rover translate 'G F r1 & G F r2 & G !unsafe' --state-based --exclusive r1,r2 --stats
  ltl-rover translate 'F G a | F G b' --epsilon jumps --format dot | dot -Tsvg -o fg.svg
  ltl-rover translate --file formulas.txt --format json > automata.jsonl")]
pub struct Translate {
    /// The formula.
    #[arg(required_unless_present = "file", value_name = "LTL")]
    pub formula: Option<String>,
    /// A file with one formula a line; empty lines and lines that start with # are skipped.
    #[arg(long, value_name = "FILE", conflicts_with = "formula")]
    pub file: Option<PathBuf>,
    /// Put acceptance on states instead of edges.
    #[arg(long)]
    pub state_based: bool,
    /// Prefer an automaton without ε-jumps, even if it has more states.
    #[arg(long)]
    pub deterministic: bool,
    /// Propositions of which at most one holds at a time, such as regions that do not overlap. May be given several times.
    #[arg(long, value_name = "A,B,…")]
    pub exclusive: Vec<String>,
    /// How ε-jumps are written.
    #[arg(long, value_enum, default_value_t = Epsilon::Compiled)]
    pub epsilon: Epsilon,
    /// What is written.
    #[arg(long, value_enum, default_value_t = Format::Hoa)]
    pub format: Format,
    /// Tell the automaton's size and the time taken, on standard error.
    #[arg(long)]
    pub stats: bool,
    /// How many states may be made, discarded attempts included.
    #[arg(long, default_value_t = Budget::default().states, value_name = "N")]
    pub max_states: usize,
    /// Give up after this many seconds.
    #[arg(long, default_value_t = 60.0, value_name = "SECONDS")]
    pub timeout: f64,
}

/// How ε-jumps are written.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub enum Epsilon {
    /// As edges without a label.
    Jumps,
    /// Compiled away: a state with a jump gets the edges of the jump's target.
    Compiled,
}

/// What is written.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub enum Format {
    /// The Hanoi Omega-Automata format.
    Hoa,
    /// A drawing for Graphviz.
    Dot,
    /// One JSON object per formula: the formula, statistics, states and edges.
    Json,
}

impl Translate {
    /// Runs the command.
    ///
    /// # Errors
    /// A formula, an option or a file that cannot be used; a translation that exceeds its budget.
    pub fn run(&self) -> Result<ExitCode, Failure> {
        if !(self.timeout > 0.0 && self.timeout.is_finite()) {
            return Err(Failure::input("--timeout must be a positive number of seconds"));
        }
        for (place, text) in self.texts()? {
            self.one(&place, &text)?;
        }
        Ok(ExitCode::SUCCESS)
    }

    /// The formulas, each with the name of its place for errors.
    fn texts(&self) -> Result<Vec<(String, String)>, Failure> {
        match (&self.formula, &self.file) {
            (Some(text), _) => Ok(vec![("formula".into(), text.clone())]),
            (None, Some(path)) => formulas_of(path),
            (None, None) => Err(Failure::input("there is no formula")),
        }
    }

    fn one(&self, place: &str, text: &str) -> Result<(), Failure> {
        let (formula, notes) = read_formula(place, text)?;
        for note in notes {
            eprintln!("{place}: note: {}", note.message);
        }
        let options = TranslateOptions {
            acceptance: if self.state_based { Acceptance::State } else { Acceptance::Transition },
            exclusive: self.exclusive.iter().map(|group| names(group)).collect(),
            prefer: if self.deterministic { Preference::Deterministic } else { Preference::Smallest },
            budget: Budget { states: self.max_states, ..Budget::default() },
            ..TranslateOptions::default()
        };
        for name in options.exclusive.iter().flatten() {
            if !formula.propositions().contains(name) {
                eprintln!("{place}: note: --exclusive names `{name}`, which the formula does not have");
            }
        }
        let (automaton, spent, taken) =
            timed(&formula, &options, self.timeout).map_err(|error| Failure::running(format!("{place}: {error}")))?;
        if self.stats {
            let summary = super::check::summary(&automaton.statistics());
            eprintln!("{place}: {formula}: {summary}, {} nodes of diagrams, {:.1} ms", spent.nodes, taken.as_secs_f64() * 1e3);
        }
        out!("{}", self.written(&formula, &automaton, taken)?);
        Ok(())
    }

    fn written(&self, formula: &Formula, automaton: &Ldgba, taken: Duration) -> Result<String, Failure> {
        let acceptance = if self.state_based { AcceptanceForm::States(Letters::All) } else { AcceptanceForm::Transitions };
        let epsilon = match self.epsilon {
            Epsilon::Jumps => EpsilonForm::Unlabelled,
            Epsilon::Compiled => EpsilonForm::Resolved,
        };
        match self.format {
            Format::Hoa => {
                hoa::write(automaton, &WriteOptions { acceptance, epsilon, name: formula.to_string() }).map_err(Failure::running)
            }
            Format::Dot => Ok(automaton.dot()),
            Format::Json => {
                let object = json!({
                    "formula": formula.to_string(), "statistics": automaton.statistics(),
                    "milliseconds": taken.as_secs_f64() * 1e3, "automaton": automaton.graph(),
                });
                Ok(format!("{object}\n"))
            }
        }
    }
}

/// Translates within `seconds`; the automaton, what was spent of the budget, and the time taken.
fn timed(
    formula: &Formula,
    options: &TranslateOptions,
    seconds: f64,
) -> Result<(Ldgba, Spent, Duration), crate::automaton::translate::TranslateError> {
    let start = Instant::now();
    let (automaton, spent) = translate_counting(formula, options, &|| start.elapsed().as_secs_f64() > seconds)?;
    Ok((automaton, spent, start.elapsed()))
}

/// The formula in `text`, with the remarks on it.
pub(super) fn read_formula(place: &str, text: &str) -> Result<(Formula, Vec<Note>), Failure> {
    let reading = Formula::read(text).map_err(|error| {
        let span = error.span().start..error.span().end;
        Failure::located(place, text, span, error.message(), error.suggestion().map(str::to_owned))
    })?;
    Ok((reading.formula, reading.notes))
}

/// The formulas of a file, one a line, each with its place.
pub(super) fn formulas_of(path: &Path) -> Result<Vec<(String, String)>, Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| Failure::file(path, error))?;
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty() && !line.trim_start().starts_with('#'));
    let formulas: Vec<_> = lines.map(|(i, line)| (format!("{}:{}", path.display(), i + 1), line.to_owned())).collect();
    if formulas.is_empty() {
        return Err(Failure::input(format!("{}: there is no formula", path.display())));
    }
    Ok(formulas)
}

/// The names of a list separated by commas.
pub(super) fn names(list: &str) -> Vec<String> {
    list.split(',').map(str::trim).filter(|name| !name.is_empty()).map(str::to_owned).collect()
}
