//! An infinite word read by hand: is the formula true on it, does the automaton accept it, and what does each letter do.

use super::edges::EdgeIndex;
use super::frame::{FrameWriter, Layout, Place, Source};
use super::refusal::{Refusal, Subject};
use crate::automaton::{EmbeddedState, Marks, StateId};
use crate::env::Outcome;
use crate::labels::{Labels, Propositions};
use crate::ltl::{Formula, Lasso, satisfies};
use crate::product::{EpMdp, ProductStep, Renaming, Reward, Rounds};
use crate::train::End;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// The most letters of a word that is read.
const MAX_LETTERS: usize = 64;
/// The most times that a cycle is read before the run must repeat; embedded states are few in what a person can follow.
const MAX_TURNS: usize = 256;

/// An infinite word u·v^ω as a shell gives it.
#[derive(Clone, PartialEq, Eq, Default, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Word {
    /// u and v, letter by letter: the names of the propositions that hold.
    pub letters: Vec<Vec<String>>,
    /// The position of v's first letter, to which the word goes back after its last.
    pub back: usize,
    /// ε-jumps: before which letter (counted on through the turns of v), and to which state.
    #[serde(default)]
    pub jumps: Vec<(usize, StateId)>,
}

/// What was read.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct WordReading {
    /// Whether the word satisfies the formula, by the semantics of the logic, without an automaton.
    pub satisfied: bool,
    /// Whether the automaton accepts the word, with the best choice of ε-jumps.
    pub accepted: bool,
    /// Whether the run with the jumps of the word is accepting.
    pub run_accepting: bool,
    /// How many frames there are: before the first letter, then one per letter and per jump, until the run repeats itself.
    pub rows: usize,
    /// The row that the run comes back to after its last.
    pub back: usize,
    /// Per row the position of the letter that was read last; −1 before the first.
    pub positions: Vec<i32>,
    /// The frames, end to end; the environment's state in them is zero.
    #[serde(skip)]
    pub data: Vec<f32>,
}

fn refuse(message: impl Into<String>) -> Refusal {
    Refusal::new(Subject::Session, message)
}

impl Word {
    fn check(&self) -> Result<(), Refusal> {
        match self.letters.len() {
            0 => Err(refuse("a word has at least one letter")),
            n if n > MAX_LETTERS => Err(refuse(format!("a word has at most {MAX_LETTERS} letters here, not {n}"))),
            n if self.back >= n => {
                Err(refuse(format!("the word goes back to letter {}, and has letters 0 to {}", self.back, n - 1)))
            }
            _ => Ok(()),
        }
    }

    /// The word over `alphabet`, whose names stand for the word's names by `renaming`.
    fn lasso(&self, alphabet: &Propositions, renaming: &Renaming) -> Lasso {
        let letter = |names: &Vec<String>| {
            (0..alphabet.len()).fold(Labels(0), |letter, k| {
                let name = alphabet.name(k);
                let source = renaming.get(name).map_or(name, String::as_str);
                letter.with(k, names.iter().any(|n| n == source))
            })
        };
        let mut prefix: Vec<Labels> = self.letters.iter().map(letter).collect();
        let cycle = prefix.split_off(self.back);
        Lasso { prefix, cycle }
    }
}

/// Whether `word` satisfies `formula`. Propositions that no letter names are false.
///
/// # Errors
/// A formula that cannot be read, or a word that is none.
pub fn judge_word(formula: &str, word: &Word) -> Result<bool, Refusal> {
    word.check()?;
    let read = Formula::parse(formula).map_err(|e| super::check::formula_refusal(formula, &e))?;
    truth(&read, word, &Renaming::new())
}

fn truth(formula: &Formula, word: &Word, renaming: &Renaming) -> Result<bool, Refusal> {
    let alphabet = Propositions::new(formula.propositions()).map_err(|e| refuse(e.to_string()))?;
    satisfies(formula, &alphabet, &word.lasso(&alphabet, renaming)).map_err(|e| refuse(e.to_string()))
}

/// Reads `word` with the product's automaton and frontier, paid by `reward`.
pub(super) fn read(
    product: &EpMdp,
    reward: &dyn Reward,
    (layout, edges): (&Layout, &EdgeIndex),
    (formula, renaming): (&Formula, &Renaming),
    word: &Word,
) -> Result<WordReading, Refusal> {
    word.check()?;
    let environment = &product.environment().spec().propositions;
    if let Some(name) = word.letters.iter().flatten().find(|name| environment.index(name).is_none()) {
        let known: Vec<&str> = environment.iter().collect();
        return Err(refuse(format!("the environment has no proposition `{name}`; it has {}", known.join(", "))));
    }
    let satisfied = truth(formula, word, renaming)?;
    let automaton = product.embedding().automaton();
    let shown = word.lasso(environment, &Renaming::new());
    let letters: Vec<Labels> = shown.prefix.iter().chain(&shown.cycle).copied().collect();
    let heard: Vec<Labels> = letters.iter().map(|&l| product.letters().letter(l)).collect();
    let (prefix, cycle) = heard.split_at(word.back);
    let accepted = automaton.accepts(&Lasso { prefix: prefix.to_vec(), cycle: cycle.to_vec() });

    let mut reader = Reader {
        product,
        reward,
        edges,
        writer: FrameWriter::new(layout.clone(), Source::Word),
        at: product.embedding().start(),
        rounds: Rounds::new(automaton.all_sets()),
        total: 0.0,
        read: 0,
        data: vec![],
        positions: vec![],
    };
    reader.writer.unread(automaton.initial());
    reader.put(Labels(0), None);
    // Where the run stood before each turn of the cycle: the row, and the marks seen before it.
    let mut turns: HashMap<EmbeddedState, usize> = HashMap::new();
    let mut marks: Vec<Marks> = vec![Marks::NONE];
    let mut position: usize = 0;
    let last_jump = word.jumps.iter().map(|j| j.0).max().unwrap_or(0);
    let start = loop {
        let mut here = word.jumps.iter().filter(|j| j.0 == reader.read).map(|j| j.1).collect::<Vec<_>>();
        here.truncate(automaton.len());
        for target in here {
            reader.jump(target, position.checked_sub(1).map_or(Labels(0), |p| letters[p]), position)?;
            marks.push(Marks::NONE);
        }
        if position == word.back && reader.read >= last_jump {
            if let Some(row) = turns.insert(reader.at, reader.positions.len() - 1) {
                break row;
            }
            if turns.len() > MAX_TURNS {
                return Err(refuse("the run over this word does not repeat itself soon enough to be shown"));
            }
        }
        marks.push(reader.letter(heard[position], letters[position], position));
        position = if position + 1 == letters.len() { word.back } else { position + 1 };
    };
    let repeated = marks[start + 1..].iter().fold(Marks::NONE, |sum, m| sum.union(*m));
    Ok(WordReading {
        satisfied,
        accepted,
        run_accepting: repeated == automaton.all_sets(),
        rows: reader.positions.len(),
        back: start + 1,
        positions: reader.positions,
        data: reader.data,
    })
}

/// The run of one word, frame by frame.
struct Reader<'a> {
    product: &'a EpMdp,
    reward: &'a dyn Reward,
    edges: &'a EdgeIndex,
    writer: FrameWriter,
    at: EmbeddedState,
    rounds: Rounds,
    total: f64,
    read: usize,
    data: Vec<f32>,
    positions: Vec<i32>,
}

impl Reader<'_> {
    /// Reads a letter; the sets that it visits.
    fn letter(&mut self, heard: Labels, shown: Labels, position: usize) -> Marks {
        let mut step = ProductStep::read(self.product.embedding(), self.at, heard, Outcome::Running);
        step.closes_round = self.rounds.visit(step.visited);
        self.read += 1;
        self.take(&step, shown, position as i32);
        step.visited
    }

    fn jump(&mut self, target: StateId, shown: Labels, position: usize) -> Result<(), Refusal> {
        if !self.product.embedding().automaton().epsilon(self.at.q).contains(&target) {
            return Err(refuse(format!("there is no ε-jump to q{target} from q{}", self.at.q)));
        }
        let step = ProductStep::jump(self.product.embedding(), self.at, target, Labels(0));
        self.take(&step, shown, position as i32 - 1);
        Ok(())
    }

    fn take(&mut self, step: &ProductStep, shown: Labels, position: i32) {
        let parts = self.reward.parts(step);
        self.total += f64::from(parts.base);
        self.writer.step(step, &parts, step.sink.then_some(End::Terminated), self.edges);
        self.writer.total(self.total);
        self.at = step.to;
        self.put(shown, Some(position));
    }

    fn put(&mut self, shown: Labels, position: Option<i32>) {
        self.writer.place(&Place {
            at: self.at,
            jumps: self.product.embedding().automaton().epsilon(self.at.q),
            rounds: self.rounds.completed(),
            labels: shown,
            module: None,
            episode_step: self.read as u32,
        });
        self.data.extend_from_slice(self.writer.frame());
        self.positions.push(position.unwrap_or(-1));
    }
}
