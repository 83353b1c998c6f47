//! What is said about formulas and automata while they are typed: sizes, classes, warnings, refusals.

use ltl_rover::session::{Doubt, TranslationFacts, TranslationOptions, Translator, translate_formula};

fn of(task: &str, text: &str) -> TranslationFacts {
    translate_formula(text, task, &TranslationOptions::default()).unwrap_or_else(|refusal| panic!("{text}: {refusal}"))
}

fn kinds(facts: &TranslationFacts) -> Vec<Doubt> {
    facts.warnings.iter().map(|warning| warning.kind).collect()
}

#[test]
fn a_sound_formula_has_an_automaton_a_class_and_no_warning() {
    let facts = of("ball_pass_b1", "G F r1 & G F r2");
    assert_eq!((facts.size.states, facts.size.sets, facts.size.epsilon), (3, 2, 0));
    assert_eq!(facts.class.map(|class| (class.name.name(), class.exact)), Some(("recurrence", true)));
    assert_eq!(
        (facts.warnings.len(), facts.offered.len(), facts.exclusive),
        (0, 2, vec![vec!["r1".to_owned(), "r2".to_owned()]])
    );
    assert_eq!(facts.graph.states.len(), 3);
    assert!(facts.hoa.starts_with("HOA: v1") && !facts.paraphrase.is_empty());
    let edges = TranslationOptions { state_based: false, ..TranslationOptions::default() };
    assert_eq!(translate_formula("G F r1 & G F r2", "ball_pass_b1", &edges).unwrap().size.states, 1);
    // Without an environment nothing is known to be apart.
    assert_eq!(of("", "G F r1 & G F r2").size.states, 4);
}

#[test]
fn what_cannot_be_or_cannot_fail_is_said() {
    assert_eq!(kinds(&of("ball_pass_b1", "F r1 & G !r1")), [Doubt::Unsatisfiable]);
    assert_eq!(kinds(&of("ball_pass_b1", "F r1 | G !r1")), [Doubt::Valid]);
    assert_eq!(kinds(&of("ball_pass_b1", "F (r1 & r2)")), [Doubt::ImpossibleHere]);
    assert_eq!(kinds(&of("", "F (r1 & r2)")), []);
    // The cart starts between the bands in half of the starts tried, and anywhere in the others.
    assert_eq!(kinds(&of("cart_pole_c1", "unsafe & G F green")), [Doubt::LostAtStart]);
    assert_eq!(kinds(&of("cart_pole_c1", "F (green & unsafe)")), []);
    assert_eq!(kinds(&of("cart_pole_c1", "F (green & yellow)")), [Doubt::ImpossibleHere]);
}

#[test]
fn strange_propositions_are_named_with_their_place() {
    let facts = of("ball_pass_b1", "□◇ r1 ∧ ◇ r3");
    assert_eq!(kinds(&facts), [Doubt::UnknownProposition]);
    let warning = &facts.warnings[0].remark;
    assert_eq!((warning.start, warning.end), (10, 12));
    assert_eq!(warning.message, "the environment has no proposition `r3`; it has r1, r2");

    let map = r#"{ "name": "flat", "unit": "m", "width": 40, "height": 30, "reach": 1, "labels": [{"name": "goal"}, {"name": "base"}],
        "regions": [{"label": "goal", "disc": [30, 15, 4]}] }"#;
    let translator = Translator::of_task("ball_pass_b1", Some(map)).unwrap();
    let translate = |text: &str| translator.translate(text, &TranslationOptions::default()).unwrap();
    let facts = translate("F goal & F base");
    assert_eq!(kinds(&facts), [Doubt::NeverHolds, Doubt::ImpossibleHere]);
    assert_eq!((facts.warnings[0].remark.start, facts.offered.join(" ")), (11, "goal base".into()));
    assert_eq!(kinds(&translate("F goal & G !base")), [Doubt::NeverHolds]);
    assert_eq!(kinds(&translate("goal")), [Doubt::LostAtStart]);
}

#[test]
fn a_pasted_automaton_is_doubted_when_it_has_choices_or_means_something_else() {
    let translator = Translator::of_task("ball_pass_b1", None).unwrap();
    let file =
        |body: &str| format!("HOA: v1 States: 2 Start: 0 AP: 2 \"r1\" \"r2\" Acceptance: 1 Inf(0) --BODY-- {body} --END--");
    let guessing = file("State: 0 [t] 0 [0] 1 State: 1 [0] 1 {0}");
    let facts = translator.read(&guessing, "F G r1").unwrap();
    assert!(kinds(&facts).contains(&Doubt::GoodForMdps) && !kinds(&facts).contains(&Doubt::Mismatch), "{:?}", facts.warnings);
    assert_eq!((facts.size.epsilon, facts.parenthesised.as_str()), (1, "◇(□r1)"));
    let certain = file("State: 0 [!0] 0 [0] 1 State: 1 [!0] 0 [0] 1 {0}");
    assert_eq!(kinds(&translator.read(&certain, "").unwrap()), []);
    let facts = translator.read(&certain, "F G r1").unwrap();
    assert_eq!(kinds(&facts), [Doubt::Mismatch]);
    assert!(facts.warnings[0].remark.message.contains("cycle{"), "{}", facts.warnings[0].remark.message);
    let empty = file("State: 0 [t] 0 State: 1 [t] 1 {0}");
    assert!(kinds(&translator.read(&empty, "").unwrap()).contains(&Doubt::Unsatisfiable));
    let refusal = translator.read("HOA: v1\nStates: x", "").unwrap_err();
    assert_eq!((refusal.place.line, refusal.place.column), (2, 9));
}

#[test]
fn refusals_say_where_and_what_is_allowed() {
    let translator = Translator::free();
    let refuse = |text: &str| translator.translate(text, &TranslationOptions::default()).unwrap_err();
    let refusal = refuse("G (a & ");
    assert_eq!(refusal.place.start, 6);
    let clauses: Vec<String> = (0..12).map(|i| format!("(G F a{i} | F G b{i})")).collect();
    let text = clauses.join(" & ");
    let refusal = refuse(&text);
    assert!(refusal.message.contains("allowed") && refusal.hint.contains("ltl-rover translate"), "{refusal}");
    assert_eq!((refusal.place.start, refusal.place.end), (0, text.len()));
    assert!(translate_formula("a", "no_task", &TranslationOptions::default()).is_err());
}
