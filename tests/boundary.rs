//! The browser boundary under Node, and a short training that must come out twice on every target: that part runs natively too.

use ltl_rover::session::{OpenRequest, Session};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test;

#[cfg_attr(target_arch = "wasm32", wasm_bindgen_test)]
#[cfg_attr(not(target_arch = "wasm32"), test)]
fn training_gives_finite_numbers_and_comes_out_twice() {
    let run = || {
        let request = OpenRequest { task: "ball_pass_b1".into(), seed: 3, ..OpenRequest::default() };
        let mut session = Session::open(&request).expect("a built-in task opens");
        session.advance(1_040);
        session.frame()
    };
    let frame = run();
    assert!(frame.iter().all(|x| x.is_finite()));
    assert_eq!(frame, run());
}

#[cfg(target_arch = "wasm32")]
mod boundary {
    use js_sys::{Array, Float32Array, JSON, Object, Reflect};
    use ltl_rover::wasm::{Session, Translator, builtin_tasks, check_formula, check_hoa, translate_formula};
    use wasm_bindgen::{JsCast, JsValue};
    use wasm_bindgen_test::wasm_bindgen_test;

    fn parse(text: &str) -> JsValue {
        JSON::parse(text).expect("the test's own JSON")
    }

    fn get(object: &JsValue, path: &str) -> JsValue {
        path.split('.').fold(object.clone(), |value, key| {
            Reflect::get(&value, &key.into())
                .unwrap_or_else(|_| panic!("no `{key}` of `{path}` in {:?}", JSON::stringify(object)))
        })
    }

    fn open(text: &str) -> Result<Session, JsValue> {
        let request = parse(text);
        // JSON has no 64-bit integers: the page passes the seed as one.
        Reflect::set(&request, &"seed".into(), &js_sys::BigInt::from(7u64).into()).expect("a plain object");
        Session::open(request.unchecked_into())
    }

    #[wasm_bindgen_test]
    fn a_session_crosses_in_plain_objects_and_typed_arrays() {
        let mut session =
            open(r#"{ "task": "ball_pass_b1", "formula": null, "overrides": { "learner.n_step": "3" } }"#).ok().unwrap();
        let description: JsValue = session.describe().into();
        assert_eq!(get(&description, "task.name"), "ball_pass_b1");
        assert_eq!(get(&description, "seed").as_f64(), Some(7.0), "a number, as JSON has it");
        assert!(get(&description, "environment.scene.picture").is_null());
        assert!(JSON::stringify(&description).is_ok());
        let length = get(&description, "layout.length").as_f64().unwrap() as u32;
        assert_eq!(session.advance(25), 25);
        assert_eq!(session.frame().length(), length);
        let trace: JsValue = session.rollout(2).into();
        let rows = get(&trace, "rows").as_f64().unwrap() as u32;
        assert_eq!(get(&trace, "data").unchecked_into::<Float32Array>().length(), rows * length);
        assert!(get(&session.curves().into(), "total").is_instance_of::<Float32Array>());
        assert_eq!(get(&session.statistics().into(), "0.capacity").as_f64().map(|c| c > 0.0), Some(true));
        assert!(JsValue::from(session.evaluation()).is_undefined());
    }

    #[wasm_bindgen_test]
    fn a_checkpoint_crosses_both_ways() {
        let mut session = open(r#"{ "task": "ball_pass_b2" }"#).ok().unwrap();
        session.advance(300);
        let bytes = session.save().to_vec();
        let mut again = Session::restore(&bytes).ok().unwrap();
        session.advance(100);
        again.advance(100);
        assert_eq!(again.frame().to_vec(), session.frame().to_vec());
    }

    #[wasm_bindgen_test]
    fn refusals_are_errors_with_a_place() {
        let error = open(r#"{ "task": "ball_pass_b1", "formula": "□ r1 & & r2" }"#).err().unwrap();
        assert!(error.is_instance_of::<js_sys::Error>());
        assert_eq!((get(&error, "field"), get(&error, "start").as_f64()), ("formula".into(), Some(7.0)));
        let malformed = open(r#"{ "task": 5 }"#).err().unwrap();
        assert!(get(&malformed, "message").as_string().unwrap().contains("malformed"));
        assert!(Session::restore(&[1, 2, 3]).is_err());
    }

    #[wasm_bindgen_test]
    fn verdicts_say_what_was_read_or_what_is_wrong() {
        let good: JsValue = check_formula("G F r1", vec!["r1".into()]).into();
        assert_eq!((get(&good, "ok"), get(&good, "facts.parenthesised")), (true.into(), "□(◇r1)".into()));
        let bad: JsValue = check_formula("G F", vec![]).into();
        assert_eq!((get(&bad, "ok"), get(&bad, "error.start").as_f64()), (false.into(), Some(3.0)));
        assert_eq!(get(&check_hoa("HOA: v1").into(), "ok"), false);
        assert!(Array::from(&builtin_tasks().into()).length() >= 4);
        assert!(get(&Object::new().into(), "nothing").is_undefined());
    }

    #[wasm_bindgen_test]
    fn formulas_are_translated_while_they_are_typed() {
        let good: JsValue = translate_formula("G F r1 & G F r2", "ball_pass_b1", JsValue::UNDEFINED.unchecked_into()).into();
        assert_eq!((get(&good, "ok"), get(&good, "facts.class.name")), (true.into(), "recurrence".into()));
        assert_eq!((get(&good, "facts.size.states"), get(&good, "facts.size.sets")), (3.into(), 2.into()));
        assert_eq!(get(&good, "facts.graph.initial"), 0);
        assert!(get(&good, "facts.hoa").as_string().unwrap().starts_with("HOA: v1"));
        let options = parse(r#"{ "state_based": false, "classify": false }"#);
        let small: JsValue = translate_formula("G F r1 & G F r2", "ball_pass_b1", options.unchecked_into()).into();
        assert_eq!((get(&small, "facts.size.states"), get(&small, "facts.class")), (1.into(), JsValue::NULL));
        let strange = parse(r#"{ "state_based": "no" }"#);
        let refused: JsValue = translate_formula("a", "", strange.unchecked_into()).into();
        assert!(get(&refused, "error.message").as_string().unwrap().contains("malformed"));

        let translator = open(r#"{ "task": "cart_pole_c1" }"#).ok().unwrap().translator();
        let verdict = |text: &str| JsValue::from(translator.translate(text, JsValue::NULL.unchecked_into()));
        let unknown = verdict("□ F gren");
        assert_eq!(
            (get(&unknown, "facts.warnings.0.kind"), get(&unknown, "facts.warnings.0.start")),
            ("unknown_proposition".into(), 4.into())
        );
        assert_eq!(get(&unknown, "facts.offered.1"), "yellow");
        let broken = verdict("□ F");
        assert_eq!((get(&broken, "ok"), get(&broken, "error.start")), (false.into(), 3.into()));
        let pasted: JsValue = translator.read("HOA: v1", "").into();
        assert_eq!(get(&pasted, "error.field"), "hoa");
        assert!(Translator::of_task("nothing", None).is_err());
    }

    /// The longest that a page may wait between a key and the automaton, in a browser: 150 ms; here with room for a busy machine.
    #[wasm_bindgen_test]
    fn hard_formulas_are_given_up_in_time() {
        let translator = Translator::of_task("", None).ok().unwrap();
        let clauses = |n: u32| (0..n).map(|i| format!("(G F a{i} | F G b{i})")).collect::<Vec<_>>().join(" & ");
        let nested =
            "((((a U b) U (c U d)) U ((e U f) U (g U h))) R (((b U a) U (d U c)) U ((f U e) U (h U g)))) U G (a U X X (b R c))";
        for text in [clauses(5), clauses(12), format!("!({})", clauses(6)), nested.into(), format!("!({nested})")] {
            let start = js_sys::Date::now();
            let verdict: JsValue = translator.translate(&text, JsValue::UNDEFINED.unchecked_into()).into();
            let taken = js_sys::Date::now() - start;
            assert!(taken < 1000.0, "{text}: {taken} ms");
            assert!(get(&verdict, "ok").is_truthy() || get(&verdict, "error.message").as_string().unwrap().contains("allowed"));
        }
    }
}
