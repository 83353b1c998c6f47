//! Round trips of the printer, and the semantics against laws and against a second, naive definition.

use super::random::{NAMES, formulas, lassos, propositions};
use ltl_rover::labels::Labels;
use ltl_rover::ltl::implication::Implications;
use ltl_rover::ltl::simplify::Simplifier;
use ltl_rover::ltl::{BinaryOperator as B, Formula, Lasso, Parentheses, Store, Style, UnaryOperator as U, satisfies};
use proptest::prelude::*;

fn holds(formula: &Formula, word: &Lasso) -> bool {
    satisfies(formula, &propositions(), word).unwrap()
}

/// The letter at position `i` of the infinite word.
fn letter(word: &Lasso, i: usize) -> Labels {
    match word.prefix.get(i) {
        Some(sigma) => *sigma,
        None => word.cycle[(i - word.prefix.len()) % word.cycle.len()],
    }
}

/// The textbook definition, read literally, at position `i`. Positions i and i + |v| behind the prefix carry the same suffix, so an
/// existential quantifier over j ≥ i need not look further than one full turn of the cycle behind max(i, |u|).
fn naive(formula: &Formula, word: &Lasso, i: usize) -> bool {
    let end = i.max(word.prefix.len()) + word.cycle.len();
    match formula {
        Formula::True => true,
        Formula::False => false,
        Formula::Proposition(name) => letter(word, i).holds(propositions().index(name).unwrap()),
        Formula::Unary(operator, a) => match operator {
            U::Not => !naive(a, word, i),
            U::Next => naive(a, word, i + 1),
            U::Finally => (i..end).any(|j| naive(a, word, j)),
            U::Globally => (i..end).all(|j| naive(a, word, j)),
        },
        Formula::Binary(operator, a, b) => {
            let until = |a: &Formula, b: &Formula| (i..end).any(|j| naive(b, word, j) && (i..j).all(|k| naive(a, word, k)));
            match operator {
                B::And => naive(a, word, i) && naive(b, word, i),
                B::Or => naive(a, word, i) || naive(b, word, i),
                B::Xor => naive(a, word, i) != naive(b, word, i),
                B::Implies => !naive(a, word, i) || naive(b, word, i),
                B::Iff => naive(a, word, i) == naive(b, word, i),
                B::Until => until(a, b),
                B::WeakUntil => until(a, b) || (i..end).all(|j| naive(a, word, j)),
                B::Release => (i..end).all(|j| naive(b, word, j) || (i..j).any(|k| naive(a, word, k))),
                B::StrongRelease => (i..end).any(|j| naive(a, word, j) && (i..=j).all(|k| naive(b, word, k))),
            }
        }
    }
}

/// Reads `law` and puts formulas in the places of its propositions x, y, z.
fn instance(law: &str, parts: &[Formula; 3]) -> Formula {
    fn put(formula: &Formula, parts: &[Formula; 3]) -> Formula {
        match formula {
            Formula::True | Formula::False => formula.clone(),
            Formula::Proposition(name) => parts[["x", "y", "z"].iter().position(|n| n == name).unwrap()].clone(),
            Formula::Unary(operator, a) => Formula::unary(*operator, put(a, parts)),
            Formula::Binary(operator, a, b) => Formula::binary(*operator, put(a, parts), put(b, parts)),
        }
    }
    put(&Formula::parse(law).unwrap(), parts)
}

fn only_propositions_are_negated(formula: &Formula) -> bool {
    match formula {
        Formula::True | Formula::False | Formula::Proposition(_) => true,
        Formula::Unary(U::Not, a) => matches!(**a, Formula::Proposition(_)),
        Formula::Unary(_, a) => only_propositions_are_negated(a),
        Formula::Binary(B::Xor | B::Implies | B::Iff, ..) => false,
        Formula::Binary(_, a, b) => only_propositions_are_negated(a) && only_propositions_are_negated(b),
    }
}

/// Valid formulas: dualities, expansion laws, definitions, distribution.
const LAWS: &[&str] = &[
    "!(x & y) <-> (!x | !y)",
    "!X x <-> X !x",
    "!F x <-> G !x",
    "!(x U y) <-> (!x R !y)",
    "!(x W y) <-> (!x M !y)",
    "(x U y) <-> (y | (x & X (x U y)))",
    "(x W y) <-> (y | (x & X (x W y)))",
    "(x R y) <-> (y & (x | X (x R y)))",
    "(x M y) <-> (y & (x | X (x M y)))",
    "F x <-> (x | X F x)",
    "G x <-> (x & X G x)",
    "F x <-> (true U x)",
    "G x <-> (false R x)",
    "(x W y) <-> ((x U y) | G x)",
    "(x M y) <-> ((x R y) & F x)",
    "(x R y) <-> (y W (x & y))",
    "(x M y) <-> (y U (x & y))",
    "(x ^ y) <-> !(x <-> y)",
    "X (x U y) <-> (X x U X y)",
    "F (x | y) <-> (F x | F y)",
    "G (x & y) <-> (G x & G y)",
    "G F (x U y) <-> G F y",
    "F G (x & y) <-> (F G x & F G y)",
    "((x | y) U z) <-> ((x | y) U z)",
    "(x U (y | z)) <-> ((x U y) | (x U z))",
    "((x & y) U z) <-> ((x U z) & (y U z))",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn what_is_printed_parses_back_to_the_same_tree(formula in formulas(8, 40)) {
        for style in [Style::Ascii, Style::Unicode] {
            for parentheses in [Parentheses::Needed, Parentheses::Everywhere] {
                let text = formula.printed(style, parentheses).to_string();
                let reading = Formula::read(&text).map_err(|error| TestCaseError::fail(format!("{text}: {error}")))?;
                prop_assert_eq!(&reading.formula, &formula, "{}", text);
                prop_assert!(reading.notes.is_empty(), "{} is disputed: {:?}", text, reading.notes);
            }
        }
    }

    #[test]
    fn the_semantics_is_the_textbook_definition(formula in formulas(4, 10), word in lassos()) {
        prop_assert_eq!(holds(&formula, &word), naive(&formula, &word, 0), "{}", formula);
    }

    #[test]
    fn laws_hold(x in formulas(3, 8), y in formulas(3, 8), z in formulas(3, 8), word in lassos()) {
        let parts = [x, y, z];
        for law in LAWS {
            prop_assert!(holds(&instance(law, &parts), &word), "{} with {:?}", law, parts);
        }
    }

    #[test]
    fn the_normal_form_is_equivalent(formula in formulas(6, 30), word in lassos()) {
        let mut store = Store::new(NAMES.map(str::to_owned).to_vec());
        let id = store.insert(&formula);
        let negation = store.not(id);
        let normal = store.formula(id, 100_000).unwrap();
        prop_assert_eq!(holds(&normal, &word), holds(&formula, &word), "{} became {}", formula, normal);
        let negated = store.formula(negation, 100_000).unwrap();
        prop_assert_eq!(holds(&negated, &word), !holds(&formula, &word), "!({}) became {}", formula, negated);
        for tree in [&normal, &negated] {
            prop_assert!(only_propositions_are_negated(tree), "{}", tree);
        }
    }

    #[test]
    fn simplification_is_sound(formula in formulas(5, 14), word in lassos()) {
        let mut store = Store::new(NAMES.map(str::to_owned).to_vec());
        let id = store.insert(&formula);
        let simple = Simplifier::default().simplify(&mut store, id);
        let tree = store.formula(simple, 100_000).unwrap();
        prop_assert_eq!(holds(&tree, &word), holds(&formula, &word), "{} became {}", formula, tree);
    }

    #[test]
    fn implication_is_sound(a in formulas(3, 6), b in formulas(3, 6), words in prop::collection::vec(lassos(), 8)) {
        let mut store = Store::new(NAMES.map(str::to_owned).to_vec());
        let (x, y) = (store.insert(&a), store.insert(&b));
        if Implications::default().shows(&store, x, y) {
            for word in words {
                prop_assert!(!holds(&a, &word) || holds(&b, &word), "{} does not imply {}", a, b);
            }
        }
    }

    #[test]
    fn traits_say_the_truth(formula in formulas(4, 12), word in lassos()) {
        let mut store = Store::new(NAMES.map(str::to_owned).to_vec());
        let id = store.insert(&formula);
        let traits = store.traits(id);
        let suffix = {
            let mut letters = word.prefix.clone();
            letters.extend(&word.cycle);
            Lasso { prefix: letters[1..].to_vec(), cycle: word.cycle.clone() }
        };
        let (here, later) = (holds(&formula, &word), holds(&formula, &suffix));
        prop_assert!(!traits.eventual || !later || here, "{} is not eventual", formula);
        prop_assert!(!traits.universal || !here || later, "{} is not universal", formula);
    }

    #[test]
    fn another_way_to_write_the_same_word_changes_nothing(formula in formulas(5, 20), word in lassos()) {
        let mut unrolled = word.clone();
        unrolled.prefix.push(word.cycle[0]);
        unrolled.cycle.rotate_left(1);
        let twice = Lasso { prefix: word.prefix.clone(), cycle: [&word.cycle[..], &word.cycle[..]].concat() };
        prop_assert_eq!(holds(&formula, &word), holds(&formula, &unrolled));
        prop_assert_eq!(holds(&formula, &word), holds(&formula, &twice));
    }
}

#[test]
fn a_proposition_the_alphabet_lacks_is_named() {
    let word = Lasso { prefix: vec![], cycle: vec![Labels::EMPTY] };
    let error = satisfies(&Formula::parse("a & nowhere").unwrap(), &propositions(), &word).unwrap_err();
    assert_eq!(error.name, "nowhere");
    assert_eq!(error.to_string(), "the formula's proposition `nowhere` is none of the alphabet's: a, b, p1, two words");
}
