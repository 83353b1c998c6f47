//! From the tree to an automaton: counts, ranges, definitions, labels, marks. Everything the grammar cannot tell.

use super::super::construct::MAX_STATES;
use super::super::guard::Guard;
use super::super::ldgba::Marks;
use super::acceptance::{UsedSet, generalised_buchi, mismatch};
use super::error::{Fault, HoaErrorKind};
use super::label::{Labeller, guard_of_letters};
use super::nba::{Nba, NbaEdge, NbaState};
use super::property::check_properties;
use super::syntax::{At, Document, EdgeItem, StateItem};
use crate::labels::{MAX_PROPOSITIONS, Propositions};
use crate::ltl::Span;
use std::collections::HashMap;

/// A remark and its place.
pub(super) type Notes = Vec<(Span, String)>;

/// Checks `document` and builds the automaton it describes.
pub(super) fn check(document: &Document, notes: &mut Notes) -> Result<(Nba, Labeller), Fault> {
    if let Some(version) = &document.version {
        notes.push((version.span, format!("version `{}` is read like version 1", version.value)));
    }
    for header in &document.unknown {
        notes.push((header.span, format!("`{}:` is not known and passed over; it may change the meaning", header.value)));
    }
    let propositions = propositions(document)?;
    let mut labeller = Labeller::new(propositions.len());
    for (name, label) in &document.aliases {
        labeller.define(name, label)?;
    }
    let count = state_count(document)?;
    let order = definitions(document, count)?;
    let starts = starts(document, count)?;
    let declared = document.acceptance.as_ref().expect("the header is refused without `Acceptance:`").0.value;
    for state in &document.body {
        check_state(state, count, declared)?;
    }
    check_properties(document)?;
    let used = generalised_buchi(document)?;
    notes.extend(mismatch(document, &used));

    let marks = MarkRule::new(document, count, used);
    let mut states = Vec::with_capacity(count);
    for item in order {
        let (edges, epsilon) = edges(item, &mut labeller, &marks, notes)?;
        states.push(NbaState { name: item.name.clone().unwrap_or_default(), span: item.number.span, edges, epsilon });
    }
    let nba = Nba { propositions, sets: marks.used.len().max(1), states, starts };
    Ok((nba, labeller))
}

fn propositions(document: &Document) -> Result<Propositions, Fault> {
    let Some(names) = &document.propositions else { return Ok(Propositions::default()) };
    if names.value.len() > MAX_PROPOSITIONS {
        let message = format!("{} atomic propositions; at most {MAX_PROPOSITIONS} are allowed", names.value.len());
        return Err(Fault::new(HoaErrorKind::Limit, names.span, message));
    }
    for (i, name) in names.value.iter().enumerate() {
        let fault = |message| Fault::new(HoaErrorKind::PropositionName, name.span, message);
        if name.value.is_empty() {
            return Err(fault("the name of a proposition is empty".into()));
        }
        if names.value[..i].iter().any(|earlier| earlier.value == name.value) {
            return Err(fault(format!("the proposition `{}` is listed twice", name.value)));
        }
    }
    let names = names.value.iter().map(|name| name.value.as_str());
    Ok(Propositions::new(names).expect("the names were checked one by one"))
}

/// The number of states: as announced, or one more than the largest number anywhere.
fn state_count(document: &Document) -> Result<usize, Fault> {
    let fault = |span, count: usize| {
        let message = format!("{count} states; at most {} are allowed", MAX_STATES - 1);
        Err(Fault::new(HoaErrorKind::Limit, span, message))
    };
    if let Some(count) = document.states {
        return if count.value as usize >= MAX_STATES {
            fault(count.span, count.value as usize)
        } else {
            Ok(count.value as usize)
        };
    }
    let starts = document.starts.iter().flat_map(|start| &start.value);
    let numbers = document.body.iter().map(|state| &state.number);
    let targets = document.body.iter().flat_map(|state| &state.edges).flat_map(|edge| &edge.targets);
    match starts.chain(numbers).chain(targets).max_by_key(|number| number.value) {
        Some(number) if number.value as usize >= MAX_STATES - 1 => fault(number.span, number.value as usize + 1),
        number => Ok(number.map_or(0, |number| number.value as usize + 1)),
    }
}

/// The items of the body by the numbers of their states.
fn definitions(document: &Document, count: usize) -> Result<Vec<&StateItem>, Fault> {
    let mut order: Vec<Option<&StateItem>> = vec![None; count];
    for item in &document.body {
        in_range(&item.number, count)?;
        if order[item.number.value as usize].replace(item).is_some() {
            let message = format!("state {} is defined a second time", item.number.value);
            return Err(Fault::new(HoaErrorKind::DuplicateState, item.number.span, message));
        }
    }
    if let Some(missing) = order.iter().position(Option::is_none) {
        let starts = document.starts.iter().flat_map(|start| &start.value);
        let targets = document.body.iter().flat_map(|state| &state.edges).flat_map(|edge| &edge.targets);
        let place = starts.chain(targets).find(|number| number.value as usize == missing).map(|number| number.span);
        let span = place.or(document.states.map(|states| states.span)).unwrap_or(document.span);
        let fault = Fault::new(HoaErrorKind::UndefinedState, span, format!("state {missing} has no `State:` in the body"));
        return Err(fault.hint(format!("all states from 0 to {} must be listed", count - 1)));
    }
    Ok(order.into_iter().flatten().collect())
}

fn in_range(number: &At<u32>, count: usize) -> Result<(), Fault> {
    if (number.value as usize) < count {
        return Ok(());
    }
    let message = format!("state {} does not exist: there are {count} states, numbered from 0", number.value);
    Err(Fault::new(HoaErrorKind::OutOfRange, number.span, message))
}

/// The one state of a conjunction.
fn single(states: &[At<u32>], span: Span) -> Result<usize, Fault> {
    if states.iter().any(|state| state.value != states[0].value) {
        let message = "a conjunction of states makes the automaton alternating, which is not supported";
        let fault = Fault::new(HoaErrorKind::UniversalBranching, span, message);
        return Err(fault.hint("`autfilt --remove-alternation` may convert it"));
    }
    Ok(states[0].value as usize)
}

fn starts(document: &Document, count: usize) -> Result<Vec<usize>, Fault> {
    let mut starts = Vec::new();
    for start in &document.starts {
        start.value.iter().try_for_each(|state| in_range(state, count))?;
        let state = single(&start.value, start.span)?;
        if !starts.contains(&state) {
            starts.push(state);
        }
    }
    Ok(starts)
}

fn check_state(state: &StateItem, count: usize, declared: u32) -> Result<(), Fault> {
    for set in state.sets.iter().chain(state.edges.iter().flat_map(|edge| &edge.sets)) {
        if set.value >= declared {
            let message = format!("accepting set {} does not exist: `Acceptance:` announces {declared}", set.value);
            return Err(Fault::new(HoaErrorKind::OutOfRange, set.span, message));
        }
    }
    for edge in &state.edges {
        edge.targets.iter().try_for_each(|target| in_range(target, count))?;
        single(&edge.targets, edge.span)?;
        if let (Some(_), Some(label)) = (&state.label, &edge.label) {
            let message = format!("state {} has a label, so its edges must have none", state.number.value);
            return Err(Fault::new(HoaErrorKind::Labels, label.span, message));
        }
    }
    Ok(())
}

/// Which accepting sets F_j an edge belongs to.
///
/// A state's marks mean all edges that leave it; a run visits them infinitely often just when it visits the edges that enter the
/// state infinitely often, so they are put there: the visit then counts when the state is reached \[D1\]. (The visit of an
/// initial state before the first letter is one visit less; infinitely many remain.) Only the complement of a set that has both
/// states and edges stays on leaving edges, where it is defined.
struct MarkRule {
    used: Vec<UsedSet>,
    /// Per set of the file, the bits of the F_j it stands for.
    bits: HashMap<u32, u32>,
    /// The F_j that are complements.
    complement: u32,
    /// The F_j whose set is given by states alone.
    by_states: u32,
    /// Per state, the bits of the sets it is in.
    states: Vec<u32>,
}

impl MarkRule {
    fn new(document: &Document, count: usize, used: Vec<UsedSet>) -> MarkRule {
        let mut rule = MarkRule { used, bits: HashMap::new(), complement: 0, by_states: 0, states: vec![0; count] };
        for (j, used) in rule.used.iter().enumerate() {
            *rule.bits.entry(used.set).or_default() |= 1 << j;
            rule.complement |= u32::from(used.complement) << j;
        }
        let (mut on_states, mut on_edges) = (0, 0);
        for state in &document.body {
            let bits = rule.bits_of(&state.sets);
            rule.states[state.number.value as usize] = bits;
            on_states |= bits;
            on_edges |= state.edges.iter().fold(0, |all, edge| all | rule.bits_of(&edge.sets));
        }
        rule.by_states = on_states & !on_edges;
        rule
    }

    fn bits_of(&self, sets: &[At<u32>]) -> u32 {
        sets.iter().fold(0, |all, set| all | self.bits.get(&set.value).copied().unwrap_or(0))
    }

    fn marks(&self, source: usize, edge: &EdgeItem, target: usize) -> Marks {
        if self.used.is_empty() {
            return Marks(1);
        }
        let (on_edge, leaves, enters) = (self.bits_of(&edge.sets), self.states[source], self.states[target]);
        let all = u32::MAX >> (32 - self.used.len());
        let visited = (on_edge | enters) & !self.complement;
        let avoided = !enters & self.by_states | !(on_edge | leaves) & !self.by_states;
        Marks(visited | avoided & self.complement & all)
    }
}

/// The labelled edges of a state, and the targets of its ε-edges.
fn edges(
    state: &StateItem,
    labeller: &mut Labeller,
    rule: &MarkRule,
    notes: &mut Notes,
) -> Result<(Vec<NbaEdge>, Vec<usize>), Fault> {
    let source = state.number.value as usize;
    let finish = |edge: &EdgeItem, guard: Guard| {
        let target = edge.targets[0].value as usize;
        NbaEdge { guard, target, marks: rule.marks(source, edge, target), span: edge.span }
    };
    let labelled = state.edges.iter().filter(|edge| edge.label.is_some()).count();
    let mut edges = Vec::with_capacity(state.edges.len());
    let mut epsilon = Vec::new();
    if let Some(label) = &state.label {
        let guard = labeller.guard(label)?;
        edges.extend(state.edges.iter().map(|edge| finish(edge, guard.clone())));
    } else if labelled > 0 {
        for edge in &state.edges {
            match &edge.label {
                Some(label) => edges.push(finish(edge, labeller.guard(label)?)),
                None => {
                    let target = edge.targets[0].value as usize;
                    notes.push((
                        edge.span,
                        format!("the edge {source} → {target} without a label, beside edges with one, is read as an ε-jump"),
                    ));
                    epsilon.push(target);
                }
            }
        }
    } else if !state.edges.is_empty() {
        let count = labeller.propositions();
        if count >= 32 || state.edges.len() != 1 << count {
            let message = format!("state {source} has {} edges without a label", state.edges.len());
            let hint = format!("without labels there must be one edge for each of the 2^{count} letters");
            return Err(Fault::new(HoaErrorKind::Labels, state.number.span, message).hint(hint));
        }
        let mut groups: Vec<(&EdgeItem, Vec<u64>)> = Vec::new();
        let mut index = HashMap::new();
        for (letter, edge) in state.edges.iter().enumerate() {
            let target = edge.targets[0].value as usize;
            let key = (target, rule.marks(source, edge, target));
            let group = *index.entry(key).or_insert_with(|| {
                groups.push((edge, Vec::new()));
                groups.len() - 1
            });
            groups[group].1.push(letter as u64);
        }
        edges.extend(groups.into_iter().map(|(edge, letters)| finish(edge, guard_of_letters(&letters, count))));
    }
    edges.retain(|edge| !edge.guard.is_empty());
    Ok((edges, epsilon))
}
