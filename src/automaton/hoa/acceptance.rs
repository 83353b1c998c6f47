//! Acceptance conditions: which are generalised Büchi, and what the others are called.

use super::super::construct::MAX_SETS;
use super::error::{Fault, HoaErrorKind};
use super::syntax::{At, Condition, Document};
use crate::ltl::Span;

/// One accepting set F_j of the automaton: a set of the file, or its complement.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct UsedSet {
    pub set: u32,
    pub complement: bool,
}

/// The sets that must be visited infinitely often, in the order of the condition; none = every infinite run is accepting.
pub(super) fn generalised_buchi(document: &Document) -> Result<Vec<UsedSet>, Fault> {
    let (count, condition) = document.acceptance.as_ref().expect("the header is refused without `Acceptance:`");
    check_range(condition, *count)?;
    let mut used = Vec::new();
    let collected = collect(condition, &mut used);
    collected.map_err(|(span, what)| {
        let called = match &document.acceptance_name {
            Some(name) if !is_buchi(&name.value) => format!(" (acc-name: {})", name.value),
            _ => String::new(),
        };
        let message = format!("the acceptance condition is not generalised Büchi{called}: {what}");
        let hint = "allowed are `Inf(0)`, conjunctions such as `Inf(0) & Inf(1)`, and `t`; \
                    `autfilt --gba` or `ltl2tgba -G -D` may convert it";
        Fault::new(HoaErrorKind::Acceptance, span, message).hint(hint)
    })?;
    if used.len() > MAX_SETS {
        let message = format!("the acceptance condition uses {} sets; at most {MAX_SETS} are allowed", used.len());
        return Err(Fault::new(HoaErrorKind::Limit, condition.span, message));
    }
    Ok(used)
}

/// A remark if `acc-name:` promises another condition than `Acceptance:` states; the latter counts.
pub(super) fn mismatch(document: &Document, used: &[UsedSet]) -> Option<(Span, String)> {
    let name = document.acceptance_name.as_ref()?;
    let plain = used.iter().all(|u| !u.complement);
    let fits = match name.value.split(' ').collect::<Vec<_>>()[..] {
        ["Buchi"] => plain && used.len() == 1,
        ["generalized-Buchi", number] => plain && number.parse() == Ok(used.len()),
        ["all"] | ["Streett", "0"] => used.is_empty(),
        // Further names degenerate to these conditions for small parameters (`parity min even 1`); the condition itself decides.
        ["co-Buchi" | "generalized-co-Buchi" | "Rabin" | "generalized-Rabin" | "none", ..] => false,
        _ => true,
    };
    (!fits).then(|| {
        let actual = match used.len() {
            0 => "all".into(),
            1 => "Buchi".into(),
            n => format!("generalized-Buchi {n}"),
        };
        (name.span, format!("`acc-name: {}` does not fit `Acceptance:`, which is {actual} and counts", name.value))
    })
}

fn is_buchi(name: &str) -> bool {
    name == "Buchi" || name.starts_with("generalized-Buchi") || name == "all"
}

fn check_range(condition: &At<Condition>, count: At<u32>) -> Result<(), Fault> {
    match &condition.value {
        Condition::Constant(_) => Ok(()),
        Condition::Atom { set, .. } if *set >= count.value => {
            let message = format!("accepting set {set} is used, but `Acceptance:` announces {}", count.value);
            Err(Fault::new(HoaErrorKind::OutOfRange, condition.span, message))
        }
        Condition::Atom { .. } => Ok(()),
        Condition::And(parts) | Condition::Or(parts) => parts.iter().try_for_each(|part| check_range(part, count)),
    }
}

/// Gathers the sets of a conjunction; otherwise tells which part is something else, and what.
fn collect(condition: &At<Condition>, used: &mut Vec<UsedSet>) -> Result<(), (Span, &'static str)> {
    match &condition.value {
        Condition::Constant(true) => Ok(()),
        Condition::Constant(false) => Err((condition.span, "`f` accepts nothing")),
        Condition::Atom { infinitely: true, complement, set } => {
            let item = UsedSet { set: *set, complement: *complement };
            if !used.contains(&item) {
                used.push(item);
            }
            Ok(())
        }
        Condition::Atom { infinitely: false, .. } => Err((condition.span, "`Fin` asks for a set to be visited finitely often")),
        Condition::And(parts) => parts.iter().try_for_each(|part| collect(part, used)),
        Condition::Or(_) => Err((condition.span, "`|` leaves a choice between conditions")),
    }
}
