//! Classes of properties, words in common, and formulas in English.

use ltl_rover::automaton::translate::{Preference, TranslateOptions, translate};
use ltl_rover::automaton::{Class, classify, common_word};
use ltl_rover::ltl::{BinaryOperator as B, Evaluator, Formula, UnaryOperator as U};
use proptest::prelude::*;

/// Formulas with the smallest class they are in, from Manna & Pnueli's examples and from the tasks.
const CLASSES: &[(&str, Class)] = &[
    ("G a", Class::Safety),
    ("a W b", Class::Safety),
    ("G (a -> X b)", Class::Safety),
    ("a & X X b", Class::Safety),
    ("G (a -> (b U c) | G b)", Class::Safety),
    // Not syntactically safe.
    ("(a U b) | G a", Class::Safety),
    ("F a", Class::Guarantee),
    ("a U b", Class::Guarantee),
    ("F (a & F b)", Class::Guarantee),
    ("F (a & X G true)", Class::Guarantee),
    ("F a & G !b", Class::Obligation),
    ("G a | F b", Class::Obligation),
    ("F a -> F (a & F b)", Class::Obligation),
    ("F (a & F (b & F c)) & G !u", Class::Obligation),
    ("G F a", Class::Recurrence),
    ("G (a -> F b)", Class::Recurrence),
    ("G F a & G F b & G !u", Class::Recurrence),
    ("G F a | G b", Class::Recurrence),
    ("F G a", Class::Persistence),
    ("F G a | F b", Class::Persistence),
    ("F (a & G b)", Class::Persistence),
    ("G F a -> G F b", Class::Reactivity),
    ("F G a & G F b", Class::Reactivity),
];

fn class(text: &str) -> ltl_rover::automaton::Classification {
    classify(&Formula::parse(text).unwrap(), &TranslateOptions::default(), &|| false).unwrap()
}

#[test]
fn known_formulas_are_in_their_classes() {
    for (text, expected) in CLASSES {
        let found = class(text);
        assert_eq!(found.class, *expected, "{text}");
        assert_eq!(found.exact, *expected != Class::Reactivity, "{text}");
        assert!(found.satisfiable && !found.valid, "{text}");
    }
}

#[test]
fn unsatisfiable_and_valid_formulas_are_recognised() {
    for (text, satisfiable) in [("G a & F !a", false), ("X a & X !a", false), ("F a | G !a", true), ("(a U b) -> F b", true)] {
        let found = class(text);
        assert_eq!((found.satisfiable, found.valid), (satisfiable, satisfiable), "{text}");
        assert!(found.classes.contains(&Class::Safety) && found.classes.contains(&Class::Guarantee), "{text}");
    }
}

fn formulas() -> impl Strategy<Value = Formula> {
    let leaf = prop::sample::select(&["a", "b"][..]).prop_map(Formula::proposition);
    leaf.prop_recursive(4, 10, 2, |inner| {
        prop_oneof![
            (prop::sample::select(vec![U::Not, U::Next, U::Finally, U::Globally]), inner.clone())
                .prop_map(|(o, x)| Formula::unary(o, x)),
            (prop::sample::select(vec![B::And, B::Or, B::Until, B::Release, B::WeakUntil]), inner.clone(), inner)
                .prop_map(|(o, x, y)| Formula::binary(o, x, y)),
        ]
    })
}

fn options(prefer: Preference) -> TranslateOptions {
    TranslateOptions { propositions: vec!["a".into(), "b".into()], prefer, ..TranslateOptions::default() }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn a_formula_and_its_negation_have_no_word_in_common(formula in formulas()) {
        for prefer in [Preference::Smallest, Preference::Deterministic] {
            let positive = translate(&formula, &options(prefer)).unwrap();
            let negative = translate(&formula.negated(), &options(prefer)).unwrap();
            prop_assert_eq!(common_word(&positive, &negative).unwrap(), None, "{}", formula);
        }
    }

    #[test]
    fn a_common_word_satisfies_both(left in formulas(), right in formulas()) {
        let (a, b) = (translate(&left, &options(Preference::Smallest)).unwrap(), translate(&right, &options(Preference::Smallest)).unwrap());
        let both = Formula::binary(B::And, left.clone(), right.clone());
        let empty = translate(&both, &options(Preference::Smallest)).unwrap();
        match common_word(&a, &b).unwrap() {
            Some(word) => {
                prop_assert!(Evaluator::new(&both, a.propositions()).unwrap().satisfied_by(&word), "{} and {}: {:?}", left, right, word);
                prop_assert!(a.accepts(&word) && b.accepts(&word));
            }
            None => prop_assert!(empty.is_sink(empty.initial()), "{} and {} can both hold", left, right),
        }
    }

    #[test]
    fn classes_are_closed_under_negation_and_inclusion(formula in formulas()) {
        let found = classify(&formula, &options(Preference::Smallest), &|| false).unwrap();
        let negated = classify(&formula.negated(), &options(Preference::Smallest), &|| false).unwrap();
        let dual = |class: Class| match class {
            Class::Safety => Class::Guarantee,
            Class::Guarantee => Class::Safety,
            Class::Recurrence => Class::Persistence,
            Class::Persistence => Class::Recurrence,
            other => other,
        };
        for &class in &found.classes {
            prop_assert!(negated.classes.contains(&dual(class)), "{}: {:?} against {:?}", formula, found, negated);
        }
        prop_assert_eq!(found.satisfiable, !negated.valid);
    }
}

#[test]
fn formulas_are_told_in_english() {
    for (text, expected) in [
        ("G F green & G F yellow & G !unsafe", "again and again green, and again and again yellow, and never unsafe"),
        (
            "F (t1 & F (t2 & F t3)) & G !u",
            "at some time t1, and from then on at some time t2, and from then on at some time t3; and never u",
        ),
        ("a & X (F G a | F G b)", "a; and in the next step (either from some time on always a, or from some time on always b)"),
        ("G (p -> X X X q)", "whenever p, then in 3 steps q"),
        ("G F a -> G F b", "if again and again a, then again and again b"),
        ("G !(a & b)", "never (a and b)"),
        ("a W b", "a until b, or for ever"),
        ("a R b", "b up to and including the first time of a, or for ever"),
        ("(a | b) U !c", "a or b until not c, which comes"),
    ] {
        assert_eq!(Formula::parse(text).unwrap().paraphrase(), expected, "{text}");
    }
}
