//! Random formulas and words for property tests.

use ltl_rover::labels::{Labels, Propositions};
use ltl_rover::ltl::{BinaryOperator, Formula, Lasso, UnaryOperator};
use proptest::prelude::*;

/// The alphabet of the random formulas: three plain names and one that needs quotes.
pub const NAMES: [&str; 4] = ["a", "b", "p1", "two words"];

pub fn propositions() -> Propositions {
    Propositions::new(NAMES).unwrap()
}

/// A formula with at most `depth` levels and about `size` nodes.
pub fn formulas(depth: u32, size: u32) -> impl Strategy<Value = Formula> {
    let leaf = prop_oneof![
        1 => Just(Formula::True),
        1 => Just(Formula::False),
        8 => prop::sample::select(&NAMES[..]).prop_map(Formula::proposition),
    ];
    leaf.prop_recursive(depth, size, 2, |inner| {
        use BinaryOperator::{And, Iff, Implies, Or, Release, StrongRelease, Until, WeakUntil, Xor};
        use UnaryOperator::{Finally, Globally, Next, Not};
        prop_oneof![
            (prop::sample::select(vec![Not, Next, Finally, Globally]), inner.clone())
                .prop_map(|(operator, operand)| Formula::unary(operator, operand)),
            (
                prop::sample::select(vec![And, Or, Xor, Implies, Iff, Until, Release, WeakUntil, StrongRelease]),
                inner.clone(),
                inner
            )
                .prop_map(|(operator, left, right)| Formula::binary(operator, left, right)),
        ]
    })
}

/// A word over the four propositions with |u| ≤ 4 and 1 ≤ |v| ≤ 4.
pub fn lassos() -> impl Strategy<Value = Lasso> {
    let letter = || (0..16u64).prop_map(Labels);
    (prop::collection::vec(letter(), 0..=4), prop::collection::vec(letter(), 1..=4))
        .prop_map(|(prefix, cycle)| Lasso { prefix, cycle })
}
