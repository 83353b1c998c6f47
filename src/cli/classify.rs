//! `classify`: what kind of property a formula is, whether it can be satisfied, and what it says in English.

use super::failure::Failure;
use super::output::outln;
use super::translate::{formulas_of, read_formula};
use crate::automaton::translate::TranslateOptions;
use crate::automaton::{Classification, classify};
use crate::ltl::{Formula, Note, Parentheses, Style};
use clap::Args;
use serde_json::json;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

/// Tell the class of a formula in the hierarchy of safety and progress, whether it can be satisfied or violated, and what it says.
///
/// Exit code 0: the formula can be satisfied and violated. 1: it cannot be satisfied, or it is always true, or the budget was used up.
/// 2: it is no formula; the place is shown.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  ltl-rover classify 'G F r1 & G F r2 & G !unsafe'
  ltl-rover classify 'F (a & X G !a)' --json
  ltl-rover classify --file formulas.txt --json > classes.jsonl")]
pub struct Classify {
    /// The formula.
    #[arg(required_unless_present = "file", value_name = "LTL")]
    pub formula: Option<String>,
    /// A file with one formula a line; empty lines and lines that start with # are skipped.
    #[arg(long, value_name = "FILE", conflicts_with = "formula")]
    pub file: Option<PathBuf>,
    /// One JSON object per formula.
    #[arg(long)]
    pub json: bool,
    /// Give up after this many seconds per formula.
    #[arg(long, default_value_t = 60.0, value_name = "SECONDS")]
    pub timeout: f64,
}

impl Classify {
    /// Runs the command.
    ///
    /// # Errors
    /// A formula or a file that cannot be used; a formula whose automata exceed the budget.
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let texts = match (&self.formula, &self.file) {
            (Some(text), _) => vec![("formula".into(), text.clone())],
            (None, Some(path)) => formulas_of(path)?,
            (None, None) => return Err(Failure::input("there is no formula")),
        };
        let mut code = 0;
        for (place, text) in texts {
            let (formula, notes) = read_formula(&place, &text)?;
            let start = Instant::now();
            let found = classify(&formula, &TranslateOptions::default(), &|| start.elapsed().as_secs_f64() > self.timeout)
                .map_err(|error| Failure::running(format!("{place}: {error}")))?;
            if !found.satisfiable || found.valid {
                code = 1;
            }
            if self.json { print_json(&formula, &notes, &found) } else { print_text(&formula, &notes, &found) }
        }
        Ok(ExitCode::from(code))
    }
}

fn print_json(formula: &Formula, notes: &[Note], found: &Classification) {
    let notes: Vec<_> = notes
        .iter()
        .map(|note| json!({"kind": note.kind.code(), "span": [note.span.start, note.span.end], "message": note.message}))
        .collect();
    outln!(
        "{}",
        json!({
            "formula": formula.to_string(), "paraphrase": formula.paraphrase(), "class": found.class, "exact": found.exact,
            "classes": found.classes, "satisfiable": found.satisfiable, "valid": found.valid, "notes": notes,
        })
    );
}

fn print_text(formula: &Formula, notes: &[Note], found: &Classification) {
    outln!("{formula}");
    outln!("  fully parenthesised: {}", formula.printed(Style::Ascii, Parentheses::Everywhere));
    for note in notes {
        outln!("  note: {}", note.message);
    }
    outln!("  in English: {}", formula.paraphrase());
    if !found.satisfiable {
        outln!("  no word satisfies it");
    } else if found.valid {
        outln!("  every word satisfies it");
    } else {
        let certain = if found.exact { "" } else { ", or a smaller class that was not recognised" };
        outln!("  class: {} ({}){certain}", found.class.name(), found.class.meaning());
    }
}
