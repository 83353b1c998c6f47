//! One automaton's text as a tree: everything that is written, where it is written, nothing checked beyond the grammar.

use crate::ltl::Span;

/// A value and its place in the text.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct At<T> {
    pub value: T,
    pub span: Span,
}

/// A Boolean formula over propositions and aliases, as written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Label {
    Constant(bool),
    Proposition(u32),
    Alias(String),
    Not(Box<At<Label>>),
    And(Vec<At<Label>>),
    Or(Vec<At<Label>>),
}

/// An acceptance condition, as written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Condition {
    Constant(bool),
    /// `Inf(set)` or `Fin(set)`, perhaps of the complement of the set.
    Atom {
        infinitely: bool,
        complement: bool,
        set: u32,
    },
    And(Vec<At<Condition>>),
    Or(Vec<At<Condition>>),
}

/// An edge: `[label] target {sets}`; several targets are a conjunction.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct EdgeItem {
    pub span: Span,
    pub label: Option<At<Label>>,
    pub targets: Vec<At<u32>>,
    pub sets: Vec<At<u32>>,
}

/// A state: `State: [label] number "name" {sets}` and its edges.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct StateItem {
    pub number: At<u32>,
    pub label: Option<At<Label>>,
    pub name: Option<String>,
    pub sets: Vec<At<u32>>,
    pub edges: Vec<EdgeItem>,
}

/// `properties: name`, or, in version 1.1, `!name`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Property {
    pub name: String,
    pub negated: bool,
}

/// One automaton.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Document {
    /// From `HOA:` to `--END--`.
    pub span: Span,
    /// The version, if it is neither 1 nor 1.1.
    pub version: Option<At<String>>,
    pub states: Option<At<u32>>,
    pub starts: Vec<At<Vec<At<u32>>>>,
    pub propositions: Option<At<Vec<At<String>>>>,
    pub aliases: Vec<(At<String>, At<Label>)>,
    pub acceptance: Option<(At<u32>, At<Condition>)>,
    pub acceptance_name: Option<At<String>>,
    pub tool: Option<(String, Option<String>)>,
    pub name: Option<String>,
    pub properties: Vec<At<Property>>,
    /// Header items with a capital that the format does not define.
    pub unknown: Vec<At<String>>,
    pub body: Vec<StateItem>,
}
