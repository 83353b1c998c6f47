//! From the labels of an environment to the letters of an automaton: propositions are matched by name.

use crate::env::EnvSpec;
use crate::labels::{Labels, Propositions};
use std::collections::BTreeMap;

/// New names for labels, from a task file: automaton proposition → environment proposition. Propositions that are not named here
/// stand for the label of their own name.
pub type Renaming = BTreeMap<String, String>;

/// For each proposition of an automaton, the label of an environment that it stands for.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct LetterMap {
    /// Indices into the environment's propositions, by automaton proposition.
    sources: Vec<usize>,
    /// Where both alphabets agree, letters pass with this mask.
    identity: Option<u64>,
}

/// Why an automaton cannot read the labels of an environment.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LetterMapError {
    /// A proposition stands for a label that the environment does not have.
    #[error(
        "the proposition `{proposition}` stands for the label `{label}`, which the environment `{environment}` does not have; \
         its labels are {available}{suggestion}"
    )]
    UnknownLabel {
        /// The automaton's proposition.
        proposition: String,
        /// The label it stands for; the same name unless renamed.
        label: String,
        /// The environment's name.
        environment: String,
        /// The labels there are.
        available: String,
        /// A near name, as a question; empty if there is none.
        suggestion: String,
    },
    /// A renaming for a proposition that the automaton does not read.
    #[error("`{proposition}` is renamed, but the automaton has no such proposition; it reads {available}{suggestion}")]
    UnknownProposition {
        /// The name that was to be renamed.
        proposition: String,
        /// The propositions there are.
        available: String,
        /// A near name, as a question; empty if there is none.
        suggestion: String,
    },
}

impl LetterMap {
    /// Matches the propositions of an automaton to the labels of an environment.
    ///
    /// # Errors
    /// Names the proposition or renaming that fits nothing, and lists what exists.
    pub fn new(automaton: &Propositions, environment: &EnvSpec, renaming: &Renaming) -> Result<LetterMap, LetterMapError> {
        for proposition in renaming.keys() {
            if automaton.index(proposition).is_none() {
                return Err(LetterMapError::UnknownProposition {
                    proposition: proposition.clone(),
                    available: list(automaton),
                    suggestion: suggestion(proposition, automaton),
                });
            }
        }
        let mut sources = vec![];
        for proposition in automaton.iter() {
            let label = renaming.get(proposition).map_or(proposition, String::as_str);
            let Some(source) = environment.propositions.index(label) else {
                return Err(LetterMapError::UnknownLabel {
                    proposition: proposition.to_owned(),
                    label: label.to_owned(),
                    environment: environment.name.to_owned(),
                    available: list(&environment.propositions),
                    suggestion: suggestion(label, &environment.propositions),
                });
            };
            sources.push(source);
        }
        let in_place = sources.iter().enumerate().all(|(i, &source)| i == source);
        let identity = in_place.then(|| u64::MAX.checked_shr(64 - sources.len() as u32).unwrap_or(0));
        Ok(LetterMap { sources, identity })
    }

    /// The letter that the automaton reads where the environment shows `labels`.
    pub fn letter(&self, labels: Labels) -> Labels {
        if let Some(mask) = self.identity {
            return Labels(labels.0 & mask);
        }
        let bits = self.sources.iter().enumerate();
        Labels(bits.fold(0, |letter, (i, &source)| letter | (labels.0 >> source & 1) << i))
    }
}

fn list(names: &Propositions) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    if quoted.is_empty() { "none".to_owned() } else { quoted.join(", ") }
}

fn suggestion(name: &str, names: &Propositions) -> String {
    let near = names.iter().map(|other| (strsim::damerau_levenshtein(name, other), other)).min();
    match near {
        Some((distance, other)) if distance <= 1 + name.chars().count() / 4 => format!(" (did you mean `{other}`?)"),
        _ => String::new(),
    }
}
