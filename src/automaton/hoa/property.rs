//! `properties:` must not contradict what is written: a file that does is not what its author thinks it is.

use super::error::{Fault, HoaErrorKind};
use super::syntax::{At, Document, Property, StateItem};

/// Refuses properties whose contrary can be seen in the text. Determinism and completeness are checked once the letters are known
/// ([`claims`]); properties about languages and unknown ones are passed over.
pub(super) fn check_properties(document: &Document) -> Result<(), Fault> {
    for property in &document.properties {
        let Property { name, negated } = &property.value;
        if let Some(contrary) = document.properties.iter().find(|p| p.value.name == *name && p.value.negated != *negated) {
            let message = format!("`{name}` and `!{name}` contradict each other");
            return Err(Fault::new(HoaErrorKind::Property, property.span.max(contrary.span), message));
        }
        let any_state = |test: fn(&StateItem) -> bool| document.body.iter().any(test);
        let implicit = |s: &StateItem| s.label.is_none() && !s.edges.is_empty() && s.edges.iter().all(|e| e.label.is_none());
        let contradicted = !*negated
            && match name.as_str() {
                "state-labels" => any_state(|s| s.edges.iter().any(|e| e.label.is_some())) || any_state(implicit),
                "trans-labels" => any_state(|s| s.label.is_some()),
                "implicit-labels" => any_state(|s| s.label.is_some() || s.edges.iter().any(|e| e.label.is_some())),
                "explicit-labels" => any_state(implicit),
                "state-acc" => any_state(|s| s.edges.iter().any(|e| !e.sets.is_empty())),
                "trans-acc" => any_state(|s| !s.sets.is_empty()),
                "colored" => any_state(|s| s.edges.iter().any(|e| e.sets.len() + s.sets.len() != 1)),
                _ => false,
            };
        if contradicted {
            let message = format!("`properties: {name}` contradicts the body");
            return Err(
                Fault::new(HoaErrorKind::Property, property.span, message).hint("properties must be true, or be left out")
            );
        }
    }
    Ok(())
}

/// The place where the property `name` is claimed, or, if `negated`, its contrary.
pub(super) fn claims<'a>(document: &'a Document, name: &str, negated: bool) -> Option<&'a At<Property>> {
    document.properties.iter().find(|p| p.value.name == name && p.value.negated == negated)
}
