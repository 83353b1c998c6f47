//! Infinite words read by hand in a session: truth, acceptance, the run's frames, the frontier rules, ε-jumps, refusals.

use ltl_rover::session::{Layout, OpenRequest, Session, Subject, Word, WordReading, judge_word};

fn open(task: &str, formula: &str, hoa: Option<&str>, frontier: &str) -> Session {
    let overrides = [("product.frontier".to_owned(), format!("\"{frontier}\""))].into();
    let formula = (!formula.is_empty()).then(|| formula.to_owned());
    let request =
        OpenRequest { task: task.into(), formula, hoa: hoa.map(str::to_owned), seed: 1, overrides, ..OpenRequest::default() };
    Session::open(&request).unwrap_or_else(|e| panic!("{task}: {e}"))
}

/// `r1 r2; ; (r2)`: letters apart by `;`, the cycle from the parenthesis on.
fn word(text: &str) -> Word {
    let letters: Vec<&str> = text.split(';').collect();
    let back = letters.iter().position(|l| l.contains('(')).expect("a cycle");
    let names = |l: &&str| l.replace(['(', ')'], " ").split_whitespace().map(str::to_owned).collect();
    Word { letters: letters.iter().map(names).collect(), back, jumps: vec![] }
}

fn column(layout: &Layout, reading: &WordReading, name: &str) -> Vec<f32> {
    let field = layout.fields.iter().find(|f| f.name == name).expect("a field");
    (0..reading.rows).map(|row| reading.data[row * layout.length + field.offset]).collect()
}

#[test]
fn truth_and_acceptance_agree_and_the_run_comes_back() {
    let session = open("ball_pass_b1", "", None, "refill");
    let layout = session.describe().layout;
    let reading = session.read_word(&word("; (r1; ; r2; )")).unwrap();
    assert!(reading.satisfied && reading.accepted && reading.run_accepting);
    assert_eq!(reading.positions.len(), reading.rows);
    assert_eq!(reading.data.len(), reading.rows * layout.length);
    assert_eq!(&reading.positions[..6], [-1, 0, 1, 2, 3, 4]);
    assert_eq!(&column(&layout, &reading, "q")[..6], [0.0, 0.0, 1.0, 0.0, 2.0, 0.0]);
    assert!(column(&layout, &reading, "source").iter().all(|s| *s == 3.0));
    assert!(column(&layout, &reading, "rounds").last() >= Some(&1.0));
    assert!(reading.back > 0 && reading.back < reading.rows);
    let missing = session.read_word(&word("r2; (r1; )")).unwrap();
    assert!(!missing.satisfied && !missing.accepted && !missing.run_accepting);
}

#[test]
fn all_short_words_over_two_propositions_are_judged_alike_by_logic_and_automaton() {
    for (task, formula) in
        [("ball_pass_b1", ""), ("ball_pass_b2", ""), ("ball_pass_b1", "!r2 U r1"), ("ball_pass_b1", "!r2 W r1")]
    {
        let session = open(task, formula, None, "refill");
        let text = session.describe().formula.text;
        for code in 0..64usize {
            // Letters with both propositions are left out: the file of B1 has regions that are disjoint.
            let letter = |k: usize| match (code >> (2 * k)) & 3 {
                1 => vec!["r1".to_owned()],
                2 => vec!["r2".to_owned()],
                _ => vec![],
            };
            for back in 0..3 {
                let word = Word { letters: (0..3).map(letter).collect(), back, jumps: vec![] };
                let reading = session.read_word(&word).unwrap();
                assert_eq!(reading.satisfied, judge_word(&text, &word).unwrap());
                assert_eq!(reading.satisfied, reading.accepted, "{text} on {word:?}");
                assert_eq!(reading.accepted, reading.run_accepting, "{text} on {word:?}");
            }
        }
    }
}

#[test]
fn the_frontier_rules_pay_as_they_are_meant_to() {
    let paid = |rule: &str| {
        let session = open("ball_pass_b1", "", None, rule);
        let layout = session.describe().layout;
        let word = Word { letters: (0..8).map(|k| vec![["r1", "r2"][k % 2].to_owned()]).collect(), back: 6, jumps: vec![] };
        let reading = session.read_word(&word).unwrap();
        column(&layout, &reading, "accepting_reward")[1..9].iter().map(|r| u8::from(*r > 0.0)).collect::<Vec<_>>()
    };
    assert_eq!(paid("refill"), [1, 1, 1, 1, 1, 1, 1, 1]);
    // Equation 1 to the letter: after the first round F_1 never pays again.
    assert_eq!(paid("printed"), [1, 1, 0, 1, 0, 1, 0, 1]);
    assert_eq!(paid("standard"), [1, 1, 1, 1, 1, 1, 1, 1]);
}

#[test]
fn jumps_are_made_where_the_word_says() {
    let hoa = "HOA: v1 States: 3 Start: 0 AP: 2 \"r1\" \"r2\" Acceptance: 1 Inf(0) --BODY--
        State: 0 [t] 0 1 2 State: 1 {0} [0] 1 State: 2 {0} [1] 2 --END--";
    let session = open("ball_pass_b1", "F G r1 | F G r2", Some(hoa), "refill");
    let graph = session.describe().automaton;
    let target = |label: &str| graph.edges.iter().find(|e| e.from == e.to && e.label == label).expect("a loop").from;
    let base = word("r2; r1; (r1)");
    let stay = session.read_word(&base).unwrap();
    assert!(stay.satisfied && stay.accepted && !stay.run_accepting, "acceptance needs a jump");
    let right = session.read_word(&Word { jumps: vec![(1, target("r1"))], ..base.clone() }).unwrap();
    assert!(right.run_accepting);
    assert_eq!(&right.positions[..4], [-1, 0, 0, 1], "a jump reads no letter");
    let wrong = session.read_word(&Word { jumps: vec![(1, target("r2"))], ..base.clone() }).unwrap();
    assert!(wrong.accepted && !wrong.run_accepting);
    let refusal = session.read_word(&Word { jumps: vec![(0, 99)], ..base }).unwrap_err();
    assert!(refusal.message.contains("no ε-jump"), "{refusal}");
}

#[test]
fn words_that_are_none_are_refused() {
    let session = open("ball_pass_b1", "", None, "refill");
    let message = |word: Word| session.read_word(&word).unwrap_err().message;
    assert!(message(Word::default()).contains("at least one letter"));
    assert!(message(Word { letters: vec![vec![]], back: 1, jumps: vec![] }).contains("goes back"));
    assert!(message(Word { letters: vec![vec![]; 65], back: 0, jumps: vec![] }).contains("at most 64"));
    assert!(message(word("(sea)")).contains("no proposition `sea`"));
    let refusal = judge_word("G F", &word("(r1)")).unwrap_err();
    assert_eq!(refusal.subject, Subject::Formula);
    assert!(judge_word("G !sea", &word("(r1)")).unwrap(), "what no letter names is false");
}
