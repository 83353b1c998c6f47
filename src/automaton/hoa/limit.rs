//! Which part of a non-deterministic automaton is deterministic in the limit, and whether that part has all accepting runs.

use super::super::guard::{Effort, Guard, TooComplex};
use super::super::ldgba::Marks;
use super::super::scc::{can_reach, components};
use super::check::Notes;
use super::classes::{Class, classes, merged};
use super::error::{Fault, HoaErrorKind};
use super::label::{Labeller, too_complex};
use super::nba::{Nba, NbaState};
use super::property::claims;
use super::syntax::Document;
use crate::labels::{Labels, Propositions};

/// A non-deterministic automaton whose letters are cut into classes and whose useless choices are gone.
pub(super) struct Partition {
    /// Per state: its classes of letters.
    pub classes: Vec<Vec<Class>>,
    /// Per state: its targets by letters, each once, with the letters that lead there.
    pub reach: Vec<Vec<(Guard, usize)>>,
    /// Per state: whether every word is accepted from it, as can be seen at once: all letters stay with states of the kind, by edges of all sets.
    pub universal: Vec<bool>,
    /// Per state: targets of ε-jumps from which something is accepted.
    pub epsilon: Vec<Vec<usize>>,
    /// Per state: whether something is accepted from it.
    pub live: Vec<bool>,
    /// Per state: whether it belongs to Q_D: whatever follows is deterministic.
    pub deterministic: Vec<bool>,
}

/// Cuts letters into classes, drops choices of which nothing comes, and computes Q_D as large as can be.
///
/// # Errors
/// Claims about determinism and completeness that are false; an accepting run that may meet a choice infinitely often.
pub(super) fn partition(nba: &Nba, document: &Document, labeller: &mut Labeller, notes: &mut Notes) -> Result<Partition, Fault> {
    let mut all = Vec::with_capacity(nba.states.len());
    for state in &nba.states {
        all.push(classes(&state.edges, nba.propositions.len(), &mut labeller.effort).map_err(too_complex(state.span))?);
    }
    check_claims(nba, document, &all, labeller)?;

    let epsilon: Vec<Vec<usize>> = nba.states.iter().map(|state| state.epsilon.clone()).collect();
    let accepting = accepting(nba, &all, &successors(&all, &epsilon));
    let live = can_reach(&successors(&all, &epsilon), &accepting);
    let universal = universal(nba, &all, &mut labeller.effort).map_err(too_complex(document.span))?;
    let reach = nba.states.iter().map(reach).collect();
    let mut part = Partition { classes: all, reach, universal, epsilon, live, deterministic: Vec::new() };
    part.prune();

    let after = successors(&part.classes, &part.epsilon);
    let choice: Vec<bool> = (0..nba.states.len()).map(|q| part.choice(q).is_some()).collect();
    part.deterministic = can_reach(&after, &choice).into_iter().map(|reaches| !reaches).collect();
    if let Some(q) = (0..accepting.len()).find(|q| accepting[*q] && !part.deterministic[*q]) {
        return Err(refusal(nba, &part, q, &after));
    }
    if nba.starts.is_empty() {
        notes.push((document.span, "there is no `Start:`, so nothing is accepted".into()));
    } else if !nba.starts.iter().any(|start| part.live[*start]) {
        notes.push((document.span, "nothing is accepted: no accepting cycle can be reached".into()));
    }
    Ok(part)
}

impl Partition {
    /// Where there is a choice, keeps the states from which something is accepted; if there is none, the first.
    fn prune(&mut self) {
        let live = &self.live;
        for class in self.classes.iter_mut().flatten().filter(|class| class.targets.len() > 1) {
            let first = class.targets[0];
            class.targets.retain(|(target, _)| live[*target]);
            if class.targets.is_empty() {
                class.targets.push(first);
            }
        }
        for targets in &mut self.epsilon {
            targets.retain(|target| live[*target]);
        }
    }

    /// What makes `q` non-deterministic: a letter and two targets of it, or an ε-jump (no letter).
    fn choice(&self, q: usize) -> Option<(Option<Labels>, usize, usize)> {
        let by_letter = self.classes[q].iter().find(|class| class.targets.len() > 1);
        let found = by_letter.map(|class| (class.guard.witness(), class.targets[0].0, class.targets[1].0));
        found.or_else(|| self.epsilon[q].first().map(|target| (None, q, *target)))
    }
}

/// The targets of a state, each once, with the letters that lead there.
fn reach(state: &NbaState) -> Vec<(Guard, usize)> {
    let mut targets: Vec<(Guard, usize)> = Vec::new();
    for (guard, (target, _)) in merged(&state.edges) {
        match targets.iter_mut().find(|(_, known)| *known == target) {
            Some((letters, _)) => letters.0.extend(guard.0),
            None => targets.push((guard, target)),
        }
    }
    targets
}

/// Per state, whether all letters lead, by edges of all sets, to such states.
fn universal(nba: &Nba, classes: &[Vec<Class>], effort: &mut Effort) -> Result<Vec<bool>, TooComplex> {
    let mut universal = Vec::with_capacity(classes.len());
    for list in classes {
        let all = list.iter().all(|class| class.targets.len() == 1 && class.targets[0].1 == nba.all_sets());
        let letters = || Guard(list.iter().flat_map(|class| class.guard.0.iter().copied()).collect());
        universal.push(all && letters().missing(effort)?.is_none());
    }
    loop {
        let stays = |q: usize| classes[q].iter().all(|class| universal[class.targets[0].0]);
        let Some(leaves) = (0..classes.len()).find(|q| universal[*q] && !stays(*q)) else { return Ok(universal) };
        universal[leaves] = false;
    }
}

/// Per state, where edges and ε-jumps lead.
pub(super) fn successors(classes: &[Vec<Class>], epsilon: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let letters = |list: &[Class]| list.iter().flat_map(|class| &class.targets).map(|(target, _)| *target).collect::<Vec<_>>();
    classes.iter().zip(epsilon).map(|(list, jumps)| letters(list).into_iter().chain(jumps.iter().copied()).collect()).collect()
}

/// Per state, whether it lies in a component whose inner edges belong to all accepting sets.
fn accepting(nba: &Nba, classes: &[Vec<Class>], successors: &[Vec<usize>]) -> Vec<bool> {
    let found = components(successors);
    let mut marks = vec![Marks::NONE; found.count];
    for (q, list) in classes.iter().enumerate() {
        for (target, edge) in list.iter().flat_map(|class| &class.targets) {
            if found.of[*target] == found.of[q] {
                marks[found.of[q]] = marks[found.of[q]].union(*edge);
            }
        }
    }
    found.of.iter().map(|component| marks[*component] == nba.all_sets()).collect()
}

/// `deterministic`, `complete` and their negations in version 1.1, against what is written.
fn check_claims(nba: &Nba, document: &Document, all: &[Vec<Class>], labeller: &mut Labeller) -> Result<(), Fault> {
    let fault = |span, message: String| {
        Err(Fault::new(HoaErrorKind::Property, span, message).hint("properties must be true, or be left out"))
    };
    let choice = all.iter().position(|list| list.iter().any(|class| class.targets.len() > 1));
    if let Some(claim) = claims(document, "deterministic", false) {
        if nba.starts.len() > 1 {
            return fault(claim.span, "`properties: deterministic`, but there are several initial states".into());
        }
        if let Some(q) = choice {
            return fault(claim.span, format!("`properties: deterministic`, but state {q} has two edges for the same letter"));
        }
    }
    if let (Some(claim), None, true) = (claims(document, "deterministic", true), choice, nba.starts.len() <= 1)
        && nba.states.iter().all(|state| state.epsilon.is_empty())
    {
        return fault(claim.span, "`properties: !deterministic`, but the automaton is deterministic".into());
    }
    let (positive, negative) = (claims(document, "complete", false), claims(document, "complete", true));
    if positive.is_none() && negative.is_none() {
        return Ok(());
    }
    let mut incomplete = nba.states.is_empty().then(|| "there is no state".to_owned());
    for (q, list) in all.iter().enumerate() {
        let guard = Guard(list.iter().flat_map(|class| class.guard.0.iter().copied()).collect());
        if let Some(letter) = guard.missing(&mut labeller.effort).map_err(too_complex(nba.states[q].span))? {
            incomplete = Some(format!("state {q} has no edge for the letter {}", letter_text(letter, &nba.propositions)));
            break;
        }
    }
    match (positive, negative, incomplete) {
        (Some(claim), _, Some(why)) => fault(claim.span, format!("`properties: complete`, but {why}")),
        (_, Some(claim), None) => {
            fault(claim.span, "`properties: !complete`, but every state has an edge for every letter".into())
        }
        _ => Ok(()),
    }
}

/// `{a, b}`: the propositions that hold in a letter.
pub(super) fn letter_text(letter: Labels, propositions: &Propositions) -> String {
    let names: Vec<&str> = (0..propositions.len()).filter(|i| letter.holds(*i)).map(|i| propositions.name(i)).collect();
    format!("{{{}}}", names.join(", "))
}

/// Why an automaton with the accepting state `q` outside of Q_D is refused.
fn refusal(nba: &Nba, part: &Partition, q: usize, after: &[Vec<usize>]) -> Fault {
    // The nearest state with a choice.
    let mut seen = vec![false; after.len()];
    let mut queue = std::collections::VecDeque::from([q]);
    seen[q] = true;
    let at = loop {
        let state = queue.pop_front().expect("a state outside of Q_D reaches a choice");
        if part.choice(state).is_some() {
            break state;
        }
        for &next in &after[state] {
            if !std::mem::replace(&mut seen[next], true) {
                queue.push_back(next);
            }
        }
    };
    let (letter, first, second) = part.choice(at).expect("the loop stops at a choice");
    let choice = match letter {
        Some(letter) => {
            format!("state {at} leads for the letter {} to {first} and to {second}", letter_text(letter, &nba.propositions))
        }
        None => format!("state {at} has an ε-jump to {second}"),
    };
    let message = format!("not limit-deterministic: {choice}, and can be reached from state {q} on an accepting cycle");
    let span = part_span(nba, at, second);
    Fault::new(HoaErrorKind::NotLimitDeterministic, span, message)
        .hint("from the states of accepting cycles on, everything must be deterministic; `ltl2tgba -G -D` gives such automata")
}

/// The edge from `q` to `target`, or the state `q`.
fn part_span(nba: &Nba, q: usize, target: usize) -> crate::ltl::Span {
    nba.states[q].edges.iter().find(|edge| edge.target == target).map_or(nba.states[q].span, |edge| edge.span)
}
