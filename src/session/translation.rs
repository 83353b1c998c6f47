//! Translating while the user types: the automaton of a formula, what kind of property it is, and what is doubtful about it in an environment.

use super::builtin;
use super::check::{Remark, formula_refusal, occurrence};
use super::open::{read_hoa, task_refusal, written};
use super::own_map;
use super::refusal::{Place, Refusal, Subject};
use crate::automaton::translate::{Acceptance, Budget, Preference, TranslateOptions, translate};
use crate::automaton::{Class, Graph, Ldgba, Statistics, WordBudget, classify, matches_where};
use crate::env::{EnvSpec, Environment, Rover};
use crate::labels::Labels;
use crate::ltl::{Formula, Parentheses, Style};
use crate::product::{LetterMap, Renaming};
use crate::rng::{Purpose, Rng};
use crate::task::{self, Task};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// How an automaton is wanted.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TranslationOptions {
    /// Acceptance on states, as tasks have it; otherwise on edges, which gives fewer states.
    pub state_based: bool,
    /// Without ε-jumps where that is found, even if it takes more states.
    pub deterministic: bool,
    /// Tell the class of the property as well, which takes three times as long.
    pub classify: bool,
}

impl Default for TranslationOptions {
    fn default() -> TranslationOptions {
        TranslationOptions { state_based: true, deterministic: false, classify: true }
    }
}

/// What a warning is about.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Doubt {
    /// Something that is read otherwise elsewhere.
    Notation,
    /// No word satisfies the formula.
    Unsatisfiable,
    /// Every word satisfies it.
    Valid,
    /// The environment has no such proposition.
    UnknownProposition,
    /// The environment has the proposition, but it holds in no state: no region, no cell has that label.
    NeverHolds,
    /// Some word satisfies the formula, but no path of this environment can: its letters do not suffice.
    ImpossibleHere,
    /// The very first letter violates it, wherever an episode starts.
    LostAtStart,
    /// An automaton with choices may lose probability, unless it was made for Markov decision processes.
    GoodForMdps,
    /// The automaton is not that of the formula.
    Mismatch,
    /// How a file was read.
    Reading,
}

/// A remark on something that can be used, but perhaps is not meant.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Warning {
    /// What it is about.
    pub kind: Doubt,
    /// A sentence, and the place in the formula (in UTF-16 code units; all of it, if there is no narrower one).
    #[serde(flatten)]
    pub remark: Remark,
}

/// The class of a property.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
pub struct ClassFacts {
    /// The smallest class it was found to be in.
    pub name: Class,
    /// What that means, in a sentence.
    pub meaning: &'static str,
    /// Whether it is certain that no smaller class has it.
    pub exact: bool,
}

/// An automaton and what is said about it.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct TranslationFacts {
    /// The formula as it was written; empty if there is none.
    pub formula: String,
    /// With all parentheses, in mathematical signs.
    pub parenthesised: String,
    /// In English.
    pub paraphrase: String,
    /// Its class, if it was asked for and found within the budget.
    pub class: Option<ClassFacts>,
    /// The size of the automaton.
    pub size: Statistics,
    /// The automaton, to be drawn.
    pub graph: Graph,
    /// The automaton in the HOA format, to be opened, saved or copied.
    pub hoa: String,
    /// The propositions that the environment has; empty without one.
    pub offered: Vec<String>,
    /// The groups of propositions that the environment keeps apart, of which use was made.
    pub exclusive: Vec<Vec<String>>,
    /// What is doubtful.
    pub warnings: Vec<Warning>,
}

/// How much work a translation while typing may cost: about 75 ms in a browser.
const BUDGET: Budget = Budget { states: 2_000, nodes: 60_000, steps: 200_000, guesses: 8 };
/// The same for each of the two translations by which a formula is classified.
const CLASS_BUDGET: Budget = Budget { states: 1_000, nodes: 40_000, steps: 80_000, guesses: 7 };
/// Larger automata are not classified: comparing them takes time that grows with the square.
const MOST_EDGES: usize = 5_000;
/// Words on which a pasted automaton is held against the formula.
const WORDS: WordBudget = WordBudget { exhaustive: 500, random: 200, seed: 0 };
/// How many starts are tried.
const STARTS: usize = 64;

/// Translates for one environment, of which it knows the labels.
pub struct Translator {
    environment: Option<Known>,
}

/// What matters of an environment.
struct Known {
    spec: EnvSpec,
    renaming: Renaming,
    /// The letters of some starts, each once.
    starts: Vec<Labels>,
}

impl Translator {
    /// Without an environment: all propositions are welcome.
    pub fn free() -> Translator {
        Translator { environment: None }
    }

    /// For the environment of a task: the name of a built-in one, or the text of a task file (told apart by a line end); with `map`, the text
    /// of a map file, for the rover on that map.
    ///
    /// # Errors
    /// A task or a map that cannot be used.
    pub fn of_task(task: &str, map: Option<&str>) -> Result<Translator, Refusal> {
        let (toml, name, shipped) = if task.contains('\n') {
            (task, "task", None)
        } else {
            let found = builtin::find(task)?;
            (found.toml, found.name, builtin::map_of(found.name))
        };
        let task = Task::parse(toml, name).map_err(task_refusal)?;
        let environment: Box<dyn Environment> = match map.or(shipped) {
            None => task.environment().map_err(task_refusal)?,
            Some(text) => Box::new(Rover::new(Arc::new(own_map::read(text, None)?))),
        };
        Ok(Translator::of_environment(&*environment, &task.file().specification.labels))
    }

    /// For `environment`, whose labels are called as `renaming` says.
    pub fn of_environment(environment: &dyn Environment, renaming: &Renaming) -> Translator {
        let mut walker = environment.boxed_clone();
        let mut starts = vec![];
        for index in 0..STARTS {
            let mut rng = Rng::new(index as u64, Purpose::Tool);
            if index % 2 == 0 {
                walker.reset(&mut rng)
            } else {
                walker.reset_anywhere(&mut rng)
            }
            if !starts.contains(&walker.labels()) {
                starts.push(walker.labels());
            }
        }
        let environment = Some(Known { spec: environment.spec().clone(), renaming: renaming.clone(), starts });
        Translator { environment }
    }

    /// Translates `text`, and tells what there is to tell.
    ///
    /// # Errors
    /// A text that is no formula, at its place; a formula that is too hard for a translation while typing.
    pub fn translate(&self, text: &str, wanted: &TranslationOptions) -> Result<TranslationFacts, Refusal> {
        let reading = Formula::read(text).map_err(|error| formula_refusal(text, &error))?;
        let formula = &reading.formula;
        let exclusive = self.exclusive(&formula.propositions());
        let options = TranslateOptions {
            acceptance: if wanted.state_based { Acceptance::State } else { Acceptance::Transition },
            prefer: if wanted.deterministic { Preference::Deterministic } else { Preference::Smallest },
            budget: BUDGET,
            exclusive: exclusive.clone(),
            ..TranslateOptions::default()
        };
        let automaton = translate(formula, &options).map_err(|error| {
            let all = Place::of(text, 0..text.len());
            let hint = "a simpler formula, or `ltl-rover translate`, which takes its time; its automaton can be opened beside the formula";
            Refusal::new(Subject::Formula, error.to_string()).with_hint(Some(hint)).at(all)
        })?;
        let mut warnings = Warnings::new(text);
        for note in &reading.notes {
            warnings.at(Doubt::Notation, note.span.in_utf16(text), note.message.clone());
        }
        let classify_it = wanted.classify && automaton.statistics().edges <= MOST_EDGES;
        let plain = TranslateOptions { budget: CLASS_BUDGET, ..TranslateOptions::default() };
        let found = if classify_it { classify(formula, &plain, &|| false).ok() } else { None };
        let empty = automaton.is_sink(automaton.initial());
        if found.as_ref().map_or(empty && exclusive.is_empty(), |found| !found.satisfiable) {
            warnings.add(Doubt::Unsatisfiable, "nothing can satisfy this formula: it contradicts itself".into());
        } else {
            if found.as_ref().is_some_and(|found| found.valid) {
                warnings.add(Doubt::Valid, "everything satisfies this formula: there is nothing to be learnt".into());
            }
            self.doubts(&automaton, &mut warnings);
        }
        let class = found.map(|found| ClassFacts { name: found.class, meaning: found.class.meaning(), exact: found.exact });
        Ok(self.facts(Some(formula), automaton, None, class, exclusive, warnings))
    }

    /// Reads the automaton in `hoa`, and holds it against the formula `text`, if that is not empty.
    ///
    /// # Errors
    /// A text that is no automaton or no formula, at its place.
    pub fn read(&self, hoa: &str, text: &str) -> Result<TranslationFacts, Refusal> {
        let reading = read_hoa(hoa)?;
        let automaton = reading.automaton;
        let formula = if text.trim().is_empty() { None } else { Some(text) };
        let formula = formula.map(|text| Formula::parse(text).map_err(|error| formula_refusal(text, &error))).transpose()?;
        let mut warnings = Warnings::new(text);
        let mut names: Vec<String> = automaton.propositions().iter().map(str::to_owned).collect();
        names.extend(formula.iter().flat_map(Formula::propositions));
        let exclusive = self.exclusive(&names);
        for note in reading.notes {
            warnings.add(Doubt::Reading, format!("line {}: {}", note.place.line, note.message));
        }
        if !automaton.statistics().deterministic {
            let message = "this automaton has choices: unless it was made for Markov decision processes, as translations of formulas here \
                           are, the best policy on it may be worse than the best policy";
            warnings.add(Doubt::GoodForMdps, message.into());
        }
        if let Some(Err(error)) = formula.as_ref().map(|formula| matches_where(&automaton, formula, WORDS, &exclusive)) {
            warnings.add(Doubt::Mismatch, format!("this is not the automaton of the formula: {error}"));
        }
        if automaton.is_sink(automaton.initial()) {
            warnings.add(Doubt::Unsatisfiable, "this automaton accepts nothing".into());
        } else {
            self.doubts(&automaton, &mut warnings);
        }
        Ok(self.facts(formula.as_ref(), automaton, Some(hoa), None, exclusive, warnings))
    }

    pub(super) fn exclusive(&self, names: &[String]) -> Vec<Vec<String>> {
        self.environment.as_ref().map_or(vec![], |known| task::exclusive(names, &known.spec, &known.renaming))
    }

    fn facts(
        &self,
        formula: Option<&Formula>,
        automaton: Ldgba,
        hoa: Option<&str>,
        class: Option<ClassFacts>,
        exclusive: Vec<Vec<String>>,
        warnings: Warnings<'_>,
    ) -> TranslationFacts {
        let offered = self.environment.iter().flat_map(|known| known.spec.propositions.iter().map(str::to_owned)).collect();
        TranslationFacts {
            formula: warnings.text.to_owned(),
            parenthesised: formula.map_or(String::new(), |f| f.printed(Style::Unicode, Parentheses::Everywhere).to_string()),
            paraphrase: formula.map_or(String::new(), Formula::paraphrase),
            class,
            size: automaton.statistics(),
            graph: automaton.graph(),
            hoa: hoa.map_or_else(|| written(&automaton), str::to_owned),
            offered,
            exclusive,
            warnings: warnings.list,
        }
    }

    /// What is doubtful about an automaton in the environment.
    fn doubts(&self, automaton: &Ldgba, warnings: &mut Warnings<'_>) {
        let Some(known) = &self.environment else { return };
        let labels = &known.spec.propositions;
        let label = |name: &str| labels.index(known.renaming.get(name).map_or(name, String::as_str));
        let offered = labels.iter().collect::<Vec<_>>().join(", ");
        let mut never = vec![];
        for name in automaton.propositions().iter() {
            match label(name) {
                None => {
                    let message = format!("the environment has no proposition `{name}`; it has {offered}");
                    warnings.about(Doubt::UnknownProposition, name, message);
                }
                Some(index) if !known.spec.can_hold(index) => {
                    let message = format!("`{name}` can never hold here: no place has this label");
                    warnings.about(Doubt::NeverHolds, name, message);
                    never.push(name);
                }
                Some(_) => {}
            }
        }
        // Propositions that a user renames but does not use do not matter here.
        let renaming = known.renaming.iter().filter(|(name, _)| automaton.propositions().index(name).is_some());
        let renaming: Renaming = renaming.map(|(name, label)| (name.clone(), label.clone())).collect();
        let Ok(map) = LetterMap::new(automaton.propositions(), &known.spec, &renaming) else { return };
        let mut letters: Vec<Labels> = known.spec.letters.iter().map(|letter| map.letter(*letter)).collect();
        letters.sort_unstable();
        letters.dedup();
        let hopeful = automaton.hopeful(&letters);
        if !hopeful[usize::from(automaton.initial())] {
            let why =
                if never.is_empty() { "what it asks for does not happen together" } else { "what it asks for does not exist" };
            warnings.add(Doubt::ImpossibleHere, format!("no path in this environment satisfies this formula: {why}"));
            return;
        }
        let mut starts = known.starts.iter().map(|letter| map.letter(*letter));
        if starts.all(|letter| !automaton.may_begin_with(letter, &hopeful)) {
            let message = "every episode violates this formula in its very first state".to_owned();
            warnings.add(Doubt::LostAtStart, message);
        }
    }
}

/// Translates `text` for the environment of a task (as [`Translator::of_task`]; none if `task` is empty).
///
/// # Errors
/// What [`Translator::of_task`] and [`Translator::translate`] refuse.
pub fn translate_formula(text: &str, task: &str, options: &TranslationOptions) -> Result<TranslationFacts, Refusal> {
    let translator = if task.is_empty() { Translator::free() } else { Translator::of_task(task, None)? };
    translator.translate(text, options)
}

/// Warnings about a text.
struct Warnings<'a> {
    text: &'a str,
    list: Vec<Warning>,
}

impl<'a> Warnings<'a> {
    fn new(text: &'a str) -> Warnings<'a> {
        Warnings { text, list: vec![] }
    }

    fn at(&mut self, kind: Doubt, (start, end): (usize, usize), message: String) {
        self.list.push(Warning { kind, remark: Remark { message, start, end } });
    }

    /// About the whole text.
    fn add(&mut self, kind: Doubt, message: String) {
        self.at(kind, (0, self.text.encode_utf16().count()), message);
    }

    /// About the first occurrence of a proposition.
    fn about(&mut self, kind: Doubt, name: &str, message: String) {
        match occurrence(self.text, name) {
            Some(span) => self.at(kind, span.in_utf16(self.text), message),
            None => self.add(kind, message),
        }
    }
}
