//! No text makes the parser panic, overflow the stack or point outside the text.

use ltl_rover::ltl::{Formula, ParseErrorKind};
use proptest::prelude::*;

const PIECES: &[&str] = &[
    "a", "b", "GFa", "aUb", "Ub", "X1", "true", "FALSE", "tt", "0", "1", "U", "R", "W", "M", "V", "X", "F", "G", "!", "~", "&",
    "&&", "|", "||", "^", "xor", "->", "=>", "<->", "<=>", "<>", "[]", "[", "<", "-", "(", ")", "((", "))", "\"", "\"q r\"",
    "\"\\\"\"", "\\", " ", "\t", "\n", "¬", "∧", "∨", "→", "↔", "⊕", "○", "◇", "□", "⊤", "⊥", "é", "😀", "=", ".", "_", "9",
];

/// Whatever comes out, it is consistent.
fn check(text: &str) {
    match Formula::read(text) {
        Ok(reading) => {
            let printed = reading.formula.to_string();
            assert_eq!(Formula::parse(&printed).as_ref(), Ok(&reading.formula), "{text:?} prints as {printed:?}");
            for note in reading.notes {
                assert!(text.get(note.span.start..note.span.end).is_some_and(|piece| !piece.is_empty()), "{text:?}: {note:?}");
            }
        }
        Err(error) => {
            let span = error.span();
            assert!(error.source_text().get(span.start..span.end).is_some(), "{text:?}: {error:?}");
            assert!(text.starts_with(error.source_text()));
            assert!(!error.to_string().is_empty() && error.caret().ends_with('^'), "{error:?}");
            let (start, end) = span.in_utf16(text);
            assert!(start <= end && end <= text.encode_utf16().count());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, ..ProptestConfig::default() })]

    #[test]
    fn any_text(text in any::<String>()) {
        check(&text);
    }

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..60)) {
        check(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn any_symbols(pieces in prop::collection::vec(prop::sample::select(PIECES), 0..25)) {
        check(&pieces.concat());
        check(&pieces.join(" "));
    }
}

/// On a stack of one megabyte, as wasm has it.
fn on_a_small_stack(work: impl FnOnce() + Send + 'static) {
    std::thread::Builder::new().stack_size(1 << 20).spawn(work).unwrap().join().unwrap();
}

#[test]
fn long_and_deep_texts_are_refused_or_read_but_never_overflow() {
    on_a_small_stack(|| {
        for (unit, end) in [
            ("(", "a"),
            ("!", "a"),
            ("G", "a"),
            ("a U ", "a"),
            ("a -> ", "a"),
            ("a & ", "a"),
            ("(a U ", "a"),
            ("\"", ""),
            ("[]<>", "p"),
            ("(!", "a"),
        ] {
            for count in [10, 255, 256, 257, 1000, 10_000, 70_000] {
                check(&format!("{}{end}", unit.repeat(count)));
            }
        }
    });
}

#[test]
fn the_highest_trees_are_handled_on_a_small_stack() {
    on_a_small_stack(|| {
        for text in [format!("{}a", "a U ".repeat(255)), format!("{}a", "!".repeat(255)), format!("a{}", " & a".repeat(255))] {
            let formula = Formula::parse(&text).unwrap();
            assert_eq!(formula.height(), 256);
            assert_eq!(formula.clone(), formula);
            assert_eq!(Formula::parse(&formula.to_string()), Ok(formula));
        }
        let error = Formula::parse(&format!("{}a", "a U ".repeat(256))).unwrap_err();
        assert_eq!(error.kind(), &ParseErrorKind::TooDeep);
        let error = Formula::parse(&" ".repeat(1 << 17)).unwrap_err();
        assert_eq!(error.kind(), &ParseErrorKind::TooLong);
    });
}
