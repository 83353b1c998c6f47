//! `bench translate`: how small the automata of whole collections of formulas are, and how long it takes to make them.

mod contender;
mod measured;
mod report;

use super::super::failure::Failure;
use super::super::translate::{formulas_of, read_formula};
use crate::cli::output::{out, outln};
use crate::ltl::families;
use clap::Args;
use contender::{Native, Translates, WebAssembly};
use measured::{Goals, Measured, Set, reasons_of};
use report::Report;
use std::path::PathBuf;
use std::process::ExitCode;

/// Arguments of `bench translate`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  ltl-rover bench translate
  ltl-rover bench translate --set patterns.txt --negations --json
  ltl-rover bench translate --set dac.txt --goals sizes.tsv --wasm target/wasm32-unknown-unknown/release/examples/translate_wasm.wasm

Without --set, the formulas are families that the program makes: patterns in scopes, fairness, chains, counters.
A state is counted if something is accepted from it; one of an automaton that accepts nothing. Times are the best of the rounds.")]
pub struct Translate {
    /// A file with one formula a line; lines that start with # are skipped. May be given several times.
    #[arg(long, value_name = "FILE")]
    set: Vec<PathBuf>,
    /// A table of sizes to hold them against, with tabs: set, number in the set from 1, formula, then other tools' numbers of states in columns
    /// whose names begin with `owl`.
    #[arg(long, value_name = "FILE")]
    goals: Option<PathBuf>,
    /// Reasons for automata that are larger than allowed, with tabs: set, number, reason.
    #[arg(long, value_name = "FILE", requires = "goals")]
    reasons: Option<PathBuf>,
    /// The negation of every formula as well, as sets of their own.
    #[arg(long)]
    negations: bool,
    /// How often each formula is translated.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=1000))]
    rounds: u32,
    /// The translator's WebAssembly build, to be run by Node.
    #[arg(long, value_name = "FILE")]
    wasm: Option<PathBuf>,
    /// Exit with code 1 if a goal is missed.
    #[arg(long)]
    check: bool,
    /// One JSON object.
    #[arg(long)]
    json: bool,
}

impl Translate {
    /// Translates everything and prints the table.
    ///
    /// # Errors
    /// Files that cannot be read, formulas that are none, a WebAssembly module that cannot be run.
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let read = |path: &PathBuf| std::fs::read_to_string(path).map_err(|error| Failure::file(path, error));
        let goals =
            self.goals.as_ref().map(read).transpose()?.map(|text| Goals::parse(&text)).transpose().map_err(Failure::input)?;
        let reasons = reasons_of(&self.reasons.as_ref().map(read).transpose()?.unwrap_or_default());
        let mut contenders: Vec<Box<dyn Translates>> = vec![Box::new(Native)];
        if let Some(module) = &self.wasm {
            contenders.push(Box::new(WebAssembly::start(module).map_err(Failure::input)?));
        }
        let mut report = Report { sets: vec![], wasm: self.wasm.is_some(), reasons };
        for set in self.sets()? {
            eprint!("\r{:60}\r{}", "", set.name);
            report.sets.push(self.measure(set, goals.as_ref(), &mut contenders).map_err(Failure::running)?);
        }
        eprint!("\r{:60}\r", "");
        if self.json {
            outln!("{}", report.json());
        } else {
            out!("{report}");
        }
        Ok(ExitCode::from(u8::from(self.check && !report.reached())))
    }

    fn sets(&self) -> Result<Vec<Set>, Failure> {
        let mut sets = vec![];
        if self.set.is_empty() {
            for family in families::all() {
                sets.push(Set { name: family.name.to_owned(), formulas: family.formulas });
            }
        }
        for path in &self.set {
            let texts = formulas_of(path)?;
            let formulas = texts.iter().map(|(place, text)| read_formula(place, text).map(|(formula, _)| formula));
            let name = path.file_stem().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
            sets.push(Set { name, formulas: formulas.collect::<Result<_, _>>()? });
        }
        if self.negations {
            let negated = |set: &Set| Set {
                name: format!("not {}", set.name),
                formulas: set.formulas.iter().map(|formula| formula.negated()).collect(),
            };
            sets.extend(sets.iter().map(negated).collect::<Vec<_>>());
        }
        Ok(sets)
    }

    fn measure(
        &self,
        set: Set,
        goals: Option<&Goals>,
        contenders: &mut [Box<dyn Translates>],
    ) -> Result<(Set, Vec<Measured>), String> {
        let mut rows = vec![];
        for (i, formula) in set.formulas.iter().enumerate() {
            let mut row = Measured::new(i + 1, formula, goals.and_then(|goals| goals.of(&set.name, i + 1)));
            for contender in contenders.iter_mut() {
                row.add(contender.name(), contender.best(formula, self.rounds)?)?;
            }
            rows.push(row);
        }
        Ok((set, rows))
    }
}
