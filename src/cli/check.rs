//! `check`: can this automaton be used, is this a formula, do the two match? Also shows the automaton in other forms.

use super::failure::Failure;
use super::output::{out, outln};
use super::translate::names;
use crate::automaton::hoa::{self, AcceptanceForm, EpsilonForm, HoaError, Reading, StreamItem, WriteOptions};
use crate::automaton::{Letters, Matched, Mismatch, Statistics, WordBudget, matches_where};
use crate::ltl::{Formula, Parentheses, Style};
use clap::{Args, ValueEnum};
use serde_json::json;
use std::io::Read as _;
use std::path::Path;
use std::process::ExitCode;

/// Check automata in the HOA format, a formula, or both against one another.
///
/// Exit code 0: everything can be used, and matches if both are given. 1: automaton and formula differ; a word shows it.
/// 2: an automaton or the formula cannot be used; the place is shown.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  ltl-rover check specs/ball_pass_b1.hoa
  ltl-rover check specs/ball_pass_b1.hoa --formula 'G F r1 & G F r2'
  ltl-rover check 'G F r1 & G F r2' specs/ball_pass_b1.hoa --json
  ltl-rover check specs/ball_pass_b1.hoa --to dot | dot -Tsvg -o b1.svg
  ltl2tgba -G -D 'GFa & GFb' | ltl-rover check - --to hoa-exclusive")]
pub struct Check {
    /// Files in the HOA format (`-`: standard input), each with one automaton or several; and at most one formula.
    #[arg(required = true, value_name = "FILE.hoa | LTL")]
    pub inputs: Vec<String>,
    /// The formula that every automaton must match.
    #[arg(long, value_name = "LTL")]
    pub formula: Option<String>,
    /// One JSON object per automaton.
    #[arg(long)]
    pub json: bool,
    /// Write the automaton to standard output in this form; the summary goes to standard error.
    #[arg(long, value_enum, value_name = "FORM", conflicts_with = "json")]
    pub to: Option<Form>,
    /// How `--to hoa…` writes ε-jumps.
    #[arg(long, value_enum, default_value_t = Epsilon::Unlabelled)]
    pub epsilon: Epsilon,
    /// How many random words are tried against a formula, beside all short ones.
    #[arg(long, default_value_t = WordBudget::default().random, value_name = "N")]
    pub words: usize,
    /// Against a formula, try only words in which at most one of these propositions holds at a time, such as regions that do not overlap. May
    /// be given several times.
    #[arg(long, value_name = "A,B,…")]
    pub exclusive: Vec<String>,
    /// The seed of the random words.
    #[arg(long, default_value_t = 0)]
    pub seed: u64,
}

/// The forms in which an automaton can be written.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub enum Form {
    /// HOA with accepting sets on edges.
    Hoa,
    /// HOA with accepting sets on states.
    HoaStates,
    /// HOA with accepting sets on states, if at most one proposition holds at a time.
    HoaExclusive,
    /// A drawing for Graphviz.
    Dot,
    /// States and edges as JSON.
    Graph,
}

/// How ε-jumps are written.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub enum Epsilon {
    /// As edges without a label.
    Unlabelled,
    /// Resolved into ordinary edges.
    Resolved,
}

impl Check {
    /// Runs the command.
    ///
    /// # Errors
    /// A formula or a file that cannot be read.
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let (files, formulas): (Vec<&String>, Vec<&String>) = self.inputs.iter().partition(|input| is_file(input));
        let formula = match (&formulas[..], &self.formula) {
            ([], None) => None,
            ([text], None) => Some(parse(text)?),
            ([], Some(text)) => Some(parse(text)?),
            _ => {
                return Err(
                    Failure::input("more than one formula, or a file that does not exist").help("give one formula at most")
                );
            }
        };
        if files.is_empty()
            && let Some(formula) = &formula
        {
            self.report_formula(formula);
        }
        let mut code = 0;
        for file in files {
            code = code.max(self.check_file(file, formula.as_ref())?);
        }
        Ok(ExitCode::from(code))
    }

    fn report_formula(&self, formula: &Formula) {
        let (text, full) = (formula.to_string(), formula.printed(Style::Ascii, Parentheses::Everywhere).to_string());
        if self.json {
            outln!("{}", json!({"ok": true, "formula": text, "parenthesised": full, "propositions": formula.propositions()}));
        } else {
            outln!("{text}\n  fully parenthesised: {full}\n  propositions: {}", formula.propositions().join(", "));
        }
    }

    /// The exit code of one file.
    fn check_file(&self, file: &str, formula: Option<&Formula>) -> Result<u8, Failure> {
        let (name, text) = read_file(file)?;
        let items = hoa::read_stream(&text);
        let mut usable = 0;
        let mut code = 0;
        for item in &items {
            match item {
                StreamItem::Automaton(reading) => {
                    usable += 1;
                    code = code.max(self.report(&name, reading, formula)?);
                }
                StreamItem::Refused(error) => {
                    self.report_error(&name, &text, error);
                    code = 2;
                }
                StreamItem::Aborted(error) => {
                    // An aborted automaton counts for nothing; a file without any other is an error.
                    self.say(format_args!("{name}: note: {error}"));
                }
            }
        }
        if usable == 0 && code == 0 {
            // `hoa::read` knows how to say that there is nothing.
            let error = hoa::read(&text).expect_err("there is no automaton");
            self.report_error(&name, &text, &error);
            code = 2;
        }
        Ok(code)
    }

    /// Reports a usable automaton; gives its exit code.
    fn report(&self, name: &str, reading: &Reading, formula: Option<&Formula>) -> Result<u8, Failure> {
        let automaton = &reading.automaton;
        let statistics = automaton.statistics();
        let exclusive: Vec<Vec<String>> = self.exclusive.iter().map(|group| names(group)).collect();
        let mut seen = std::collections::HashSet::new();
        if let Some(twice) = exclusive.iter().flatten().find(|name| !seen.insert(*name)) {
            return Err(Failure::input(format!("--exclusive names `{twice}` twice; groups must not overlap")));
        }
        let budget = WordBudget { random: self.words, seed: self.seed, ..WordBudget::default() };
        let matched = formula.map(|formula| matches_where(automaton, formula, budget, &exclusive));
        let code = u8::from(matches!(matched, Some(Err(_))));
        if self.json {
            let notes: Vec<String> = reading.notes.iter().map(ToString::to_string).collect();
            let mut object = json!({
                "file": name, "ok": code == 0, "name": reading.name, "states_in_file": reading.states,
                "statistics": statistics, "propositions": automaton.propositions(), "notes": notes,
            });
            match &matched {
                Some(Ok(Matched { words, length })) => object["matches"] = json!({"words": words, "all_up_to": length}),
                Some(Err(Mismatch::Word(found))) => {
                    object["counter_example"] = json!({"text": found.text(), "accepted": found.accepted, "word": found.word});
                }
                Some(Err(error)) => object["error"] = json!(error.to_string()),
                None => {}
            }
            outln!("{object}");
            return Ok(code);
        }
        self.say(format_args!("{name}: {}", summary(&statistics)));
        if let Some(title) = &reading.name {
            self.say(format_args!("  name: {title}"));
        }
        let propositions: Vec<&str> = automaton.propositions().iter().collect();
        self.say(format_args!("  propositions: {}", propositions.join(", ")));
        for note in &reading.notes {
            self.say(format_args!("  note: {note}"));
        }
        match &matched {
            Some(Ok(Matched { words, length })) => {
                self.say(format_args!("  matches the formula on {words} words, all u·v^ω with |u| + |v| ≤ {length} among them"));
            }
            Some(Err(error)) => eprintln!("{name}: does not match the formula: {error}"),
            None => {}
        }
        if let Some(form) = self.to {
            out!("{}", self.written(form, reading)?);
        }
        Ok(code)
    }

    fn report_error(&self, name: &str, text: &str, error: &HoaError) {
        let place = error.place();
        if self.json {
            let span = [place.span.start, place.span.end];
            outln!(
                "{}",
                json!({
                    "file": name, "ok": false, "error": error.message(), "kind": error.kind().code(), "hint": error.suggestion(),
                    "line": place.line, "column": place.column, "span": span,
                })
            );
        }
        let hint = error.suggestion().map(str::to_owned);
        let message = format!("{name}: line {}, column {}: {}", place.line, place.column, error.message());
        let (excerpt, at) = place.excerpt();
        let long = excerpt.starts_with('…') || text.lines().nth(place.line - 1).is_some_and(|line| line.len() > 200);
        let failure = match long {
            // Of an automaton on one line only the part around the place is shown.
            true => Failure::located(name, excerpt, at, message, hint),
            false => Failure::located(name, text, place.span.start..place.span.end, message, hint),
        };
        let _ = failure.print();
    }

    fn written(&self, form: Form, reading: &Reading) -> Result<String, Failure> {
        let automaton = &reading.automaton;
        let acceptance = match form {
            Form::Dot => return Ok(automaton.dot()),
            Form::Graph => return Ok(format!("{}\n", json!(automaton.graph()))),
            Form::Hoa => AcceptanceForm::Transitions,
            Form::HoaStates => AcceptanceForm::States(Letters::All),
            Form::HoaExclusive => AcceptanceForm::States(Letters::Exclusive),
        };
        let epsilon = match self.epsilon {
            Epsilon::Unlabelled => EpsilonForm::Unlabelled,
            Epsilon::Resolved => EpsilonForm::Resolved,
        };
        let name = reading.name.clone().unwrap_or_default();
        hoa::write(automaton, &WriteOptions { acceptance, epsilon, name }).map_err(Failure::running)
    }

    /// A line of the summary: on standard output, unless that is taken.
    fn say(&self, line: std::fmt::Arguments<'_>) {
        if self.json || self.to.is_some() { eprintln!("{line}") } else { outln!("{line}") }
    }
}

/// Whether an input is meant as a file: it exists, or looks like the name of one.
fn is_file(input: &str) -> bool {
    input == "-" || input.ends_with(".hoa") || Path::new(input).is_file()
}

fn parse(text: &str) -> Result<Formula, Failure> {
    Formula::parse(text).map_err(|error| {
        let span = error.span().start..error.span().end;
        Failure::located("formula", text, span, error.message(), error.suggestion().map(str::to_owned))
    })
}

/// The name to show and the text. Bytes that are no UTF-8, such as names in another encoding, become U+FFFD.
fn read_file(file: &str) -> Result<(String, String), Failure> {
    let mut bytes = Vec::new();
    if file == "-" {
        std::io::stdin().read_to_end(&mut bytes).map_err(|error| Failure::input(format!("standard input: {error}")))?;
        return Ok(("standard input".into(), String::from_utf8_lossy(&bytes).into_owned()));
    }
    bytes = std::fs::read(file).map_err(|error| Failure::file(Path::new(file), error))?;
    Ok((file.into(), String::from_utf8_lossy(&bytes).into_owned()))
}

/// `4 states (1 sink), 2 accepting sets, deterministic, 9 edges`
pub(super) fn summary(s: &Statistics) -> String {
    let plural = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    let mut parts = vec![match (s.sinks, s.unreachable) {
        (0, 0) => plural(s.states, "state"),
        (sinks, 0) => format!("{} ({})", plural(s.states, "state"), plural(sinks, "sink")),
        (sinks, unreachable) => format!("{} ({}, {unreachable} unreachable)", plural(s.states, "state"), plural(sinks, "sink")),
    }];
    parts.push(format!("{} on {}", plural(s.sets, "accepting set"), if s.state_based { "states" } else { "edges" }));
    parts.push(match s.deterministic {
        true => "deterministic".into(),
        false => format!("{} from {}", plural(s.epsilon, "ε-jump"), plural(s.nondeterministic, "non-deterministic state")),
    });
    parts.push(plural(s.edges, "edge"));
    if s.empty_language {
        parts.push("accepts nothing".into());
    }
    parts.join(", ")
}
