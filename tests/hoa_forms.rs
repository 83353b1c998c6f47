//! Random limit-deterministic automata: every form in which they are written reads back to the same language, as do trimming and
//! state-based acceptance.

use ltl_rover::automaton::hoa::{self, AcceptanceForm, EpsilonForm, WriteOptions};
use ltl_rover::automaton::{Cube, Edge, Gaps, Guard, Ldgba, LdgbaParts, Letters, Marks};
use ltl_rover::labels::{Labels, Propositions};
use ltl_rover::ltl::Lasso;
use proptest::prelude::*;

const PROPOSITIONS: usize = 2;
const LETTERS: u64 = 1 << PROPOSITIONS;

/// Per state and letter, a target (none: missing) and marks.
type Table = Vec<Vec<(Option<u16>, u32)>>;

/// An automaton with states 0 … n−1 in Q_N (edges to all, no marks), and d states of Q_D behind them (edges among these).
fn parts(nondeterministic: usize, sets: usize, table: Table, jumps: Vec<Vec<u16>>) -> LdgbaParts {
    let count = table.len();
    let inside = |q: usize, target: u16| {
        if q < nondeterministic {
            target % count as u16
        } else {
            (nondeterministic + usize::from(target) % (count - nondeterministic)) as u16
        }
    };
    let edges = table
        .iter()
        .enumerate()
        .map(|(q, row)| {
            let edge = |(sigma, (target, marks)): (usize, &(Option<u16>, u32))| {
                let target = inside(q, (*target)?);
                let marks = if usize::from(target) < nondeterministic { Marks(0) } else { Marks(marks & ((1 << sets) - 1)) };
                Some((Guard(vec![Cube::letter(Labels(sigma as u64), PROPOSITIONS)]), Edge { target, marks }))
            };
            row.iter().enumerate().filter_map(edge).collect()
        })
        .collect();
    let epsilon = (0..nondeterministic)
        .map(|q| jumps[q].iter().map(|d| (nondeterministic + usize::from(*d) % (count - nondeterministic)) as u16).collect())
        .collect();
    let names = (0..count).map(|q| format!("state \"{q}\" \\")).collect();
    let propositions = Propositions::new(["a", "b"]).unwrap();
    LdgbaParts { propositions, initial: 0, sets, edges, epsilon, names }
}

fn automata() -> impl Strategy<Value = Ldgba> {
    (0usize..3, 1usize..4, 1usize..3)
        .prop_flat_map(|(n, d, sets)| {
            let letter = (proptest::option::weighted(0.85, 0u16..8), 0u32..4);
            let row = proptest::collection::vec(letter, LETTERS as usize);
            let table = proptest::collection::vec(row, n + d);
            let jumps = proptest::collection::vec(proptest::collection::vec(0u16..8, 0..3), n);
            (Just(n), Just(sets), table, jumps)
        })
        .prop_map(|(n, sets, table, jumps)| Ldgba::new(parts(n, sets, table, jumps), Gaps::Sink).unwrap())
}

fn lassos(letters: u64) -> impl Strategy<Value = Vec<Lasso>> {
    let word = |least| proptest::collection::vec((0..letters).prop_map(Labels), least..5);
    proptest::collection::vec((word(0), word(1)).prop_map(|(prefix, cycle)| Lasso { prefix, cycle }), 40)
}

fn same_on(words: &[Lasso], left: &Ldgba, right: &Ldgba, what: &str) -> Result<(), TestCaseError> {
    for word in words {
        prop_assert_eq!(left.accepts(word), right.accepts(word), "{}: {:?}\n{}\n{}", what, word, left.dot(), right.dot());
    }
    Ok(())
}

/// Acceptance by following all runs: subsets of states cannot decide it, so a deterministic walk per choice of the jump does.
fn accepts_by_hand(automaton: &Ldgba, word: &Lasso) -> bool {
    let letter = |i: usize| {
        if i < word.prefix.len() { word.prefix[i] } else { word.cycle[(i - word.prefix.len()) % word.cycle.len()] }
    };
    // After this many steps every deterministic run has closed its loop; one more round collects its marks.
    let horizon = word.prefix.len() + word.cycle.len() * (automaton.len() + 1);
    let run = |mut q: u16, start: usize| {
        let mut marks = 0;
        for i in start..start + 2 * horizon {
            let edge = automaton.edge(q, letter(i));
            if i >= start + horizon {
                marks |= edge.marks.0;
            }
            q = edge.target;
        }
        marks == automaton.all_sets().0
    };
    let mut q = automaton.initial();
    let mut found = run(q, 0);
    for i in 0..horizon {
        found |= automaton.epsilon(q).iter().any(|d| run(*d, i));
        q = automaton.edge(q, letter(i)).target;
    }
    found
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(80))]

    #[test]
    fn acceptance_is_that_of_some_run(automaton in automata(), words in lassos(LETTERS)) {
        for word in &words {
            prop_assert_eq!(automaton.accepts(word), accepts_by_hand(&automaton, word), "{:?}\n{}", word, automaton.dot());
        }
    }

    #[test]
    fn what_is_written_reads_back(automaton in automata(), words in lassos(LETTERS)) {
        for acceptance in [AcceptanceForm::Transitions, AcceptanceForm::States(Letters::All)] {
            for epsilon in [EpsilonForm::Unlabelled, EpsilonForm::Resolved] {
                let options = WriteOptions { acceptance, epsilon, name: "a \"name\" \\".into() };
                let text = hoa::write(&automaton, &options).unwrap();
                let reading = hoa::read(&text);
                prop_assert!(reading.is_ok(), "{}\n{}", reading.unwrap_err(), text);
                let reading = reading.unwrap();
                prop_assert_eq!(reading.name.as_deref(), Some("a \"name\" \\"));
                same_on(&words, &automaton, &reading.automaton, &text)?;
                if acceptance == AcceptanceForm::Transitions && automaton.statistics().deterministic {
                    prop_assert_eq!(reading.automaton.graph(), automaton.graph());
                }
                // A second round changes nothing any more.
                let again = hoa::read(&hoa::write(&reading.automaton, &WriteOptions::default()).unwrap()).unwrap().automaton;
                same_on(&words, &automaton, &again, &text)?;
            }
        }
    }

    #[test]
    fn unlabelled_jumps_keep_states_and_names(automaton in automata()) {
        let automaton = automaton.trimmed();
        let text = hoa::write(&automaton, &WriteOptions::default()).unwrap();
        let again = hoa::read(&text).unwrap().automaton.trimmed();
        // Jumps into sinks and states that only they reach may go; nothing else.
        prop_assert!(again.len() <= automaton.len());
        prop_assert!(again.states().all(|q| automaton.states().any(|p| automaton.name(p) == again.name(q))));
    }

    #[test]
    fn other_forms_keep_the_language(automaton in automata(), words in lassos(LETTERS), regions in lassos(3)) {
        let trimmed = automaton.trimmed();
        prop_assert!(trimmed.len() <= automaton.len() && trimmed.reachable().iter().all(|r| *r));
        prop_assert!(trimmed.states().filter(|q| trimmed.is_sink(*q)).count() <= 1);
        same_on(&words, &automaton, &trimmed, "trimmed")?;
        let states = automaton.state_based(Letters::All).unwrap();
        prop_assert!(states.is_state_based());
        same_on(&words, &automaton, &states, "state-based")?;
        let exclusive = automaton.state_based(Letters::Exclusive).unwrap();
        prop_assert!(exclusive.is_state_based() && exclusive.len() <= states.len());
        // Letters 0, 1, 2: at most one proposition holds.
        same_on(&regions, &automaton, &exclusive, "state-based, exclusive")?;
    }

    #[test]
    fn sinks_accept_nothing(automaton in automata(), words in lassos(LETTERS)) {
        if automaton.is_sink(automaton.initial()) {
            prop_assert!(words.iter().all(|word| !automaton.accepts(word)));
        }
        for q in automaton.states().filter(|q| automaton.is_sink(*q)) {
            prop_assert!(automaton.edges(q).iter().all(|(_, edge)| automaton.is_sink(edge.target)));
        }
    }
}
