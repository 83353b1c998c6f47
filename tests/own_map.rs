//! Maps of one's own: made of files and pictures, opened as tasks, kept in checkpoints, refused at their place.

use ltl_rover::agent::Replays;
use ltl_rover::env::map::MAX_TEXT;
use ltl_rover::session::{MapFacts, OpenRequest, Refusal, Session, Subject, check_map, map_of_picture, picture};
use proptest::prelude::*;

/// A map of 20 × 10 cells: `left` on its left edge, `right` on its right, `unsafe` in a corner.
fn painted(left: &str, right: &str) -> String {
    let row = |k: usize| if k < 2 { "[1,2],[0,16],[3,2]" } else { "[1,2],[0,16],[2,2]" };
    let runs: Vec<&str> = (0..10).map(row).collect();
    format!(
        r#"{{"name":"painted","unit":"m","width":40,"height":20,"reach":1,
            "labels":[{{"name":"{left}"}},{{"name":"{right}"}},{{"name":"unsafe"}}],
            "grid":{{"columns":20,"rows":10,"letters":[[],["{left}"],["{right}"],["unsafe"]],"runs":[{}]}}}}"#,
        runs.join(",")
    )
}

fn request(map: &str) -> OpenRequest {
    let small = [("learner.hidden", "[8, 8]"), ("learner.exploration.warm_up", "50"), ("training.evaluate_every", "0")];
    let overrides = small.map(|(key, value)| (key.to_owned(), value.to_owned())).into();
    OpenRequest { task: "own_map".into(), map: Some(map.into()), seed: 4, overrides, ..OpenRequest::default() }
}

fn of_picture(width: usize, height: usize, pixels: &[u8]) -> Result<MapFacts, Refusal> {
    map_of_picture("field", &picture(width, height, pixels)?)
}

fn refused(request: &OpenRequest) -> Refusal {
    Session::open(request).err().expect("this is refused")
}

#[test]
fn a_painter_learns_everything_of_a_map_and_its_file_reads_back() {
    let facts = check_map(&painted("left", "right"), None).unwrap();
    assert_eq!((facts.cells, facts.size, facts.hazard), ([20, 10], [40.0, 20.0], Some(2)));
    let areas: Vec<_> = facts.labels.iter().map(|l| (l.name.as_str(), l.area)).collect();
    assert_eq!(areas, [("left", 20), ("right", 16), ("unsafe", 4)]);
    assert_eq!(facts.suggested, "G F left & G F right & G !unsafe");
    let cell = |column: usize, row: usize| facts.letters[usize::from(facts.indices[row * 20 + column])].clone();
    assert_eq!([cell(0, 0), cell(5, 5), cell(19, 0), cell(19, 9)], [vec![0], vec![], vec![2], vec![1]]);
    assert_eq!(check_map(&facts.json, None).unwrap(), facts);
}

#[test]
fn a_flat_picture_becomes_labels_and_any_other_is_refused() {
    let pixel = |i: usize| match i % 8 {
        0 => [0, 255, 0, 255],
        7 => [255, 0, 0, 255],
        _ => [255; 4],
    };
    let pixels: Vec<u8> = (0..32).flat_map(pixel).collect();
    let facts = of_picture(8, 4, &pixels).unwrap();
    assert_eq!((facts.cells, facts.suggested.as_str()), ([8, 4], "G F green & G !unsafe"));
    assert!(Session::open(&request(&facts.json)).is_ok());
    let refusal = |width, height, pixels: &[u8]| of_picture(width, height, pixels).unwrap_err();
    assert!(refusal(8, 5, &pixels).message.contains("pixels"), "fewer pixels than its size says");
    assert!(refusal(1 << 20, 1, &pixels).message.contains("4096"));
    assert_eq!(refusal(0, 0, &[]).subject, Subject::Map);
    assert!(refusal(2, 1, &[255, 0, 0, 255, 0, 255, 0, 255]).message.contains("nowhere to start"));
    let shades: Vec<u8> = (0..100u8).flat_map(|k| [k, 2 * k, 255 - k, 255]).collect();
    assert!(refusal(10, 10, &shades).message.contains("not flat"));
}

#[test]
fn a_session_opens_on_the_map_with_its_propositions() {
    let session = Session::open(&request(&painted("left", "right"))).unwrap_or_else(|e| panic!("{e}"));
    let description = session.describe();
    let names: Vec<_> = description.environment.propositions.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["left", "right", "unsafe"]);
    assert_eq!(
        description.formula.text, "G F left & G F right & G !unsafe",
        "the task's own formula speaks of other propositions"
    );
    let kept = Session::open(&request(&painted("spring", "camp"))).unwrap().describe();
    assert_eq!(kept.formula.text, "G F camp & G F spring & G !unsafe", "the map has the propositions of the task's own formula");
    assert!(kept.hoa.contains("elsewhere"), "so its own automaton stays");
    let own = OpenRequest { formula: Some("F (left & X F right)".into()), ..request(&painted("left", "right")) };
    assert_eq!(Session::open(&own).unwrap().describe().formula.text, "F (left & X F right)");
}

#[test]
fn what_is_wrong_with_a_map_is_said_of_the_map() {
    for (map, said) in [
        ("", "line 1"),
        ("{\"name\": 3}", "invalid type"),
        (&painted("left", "left"), "listed twice"),
        (&painted("left", "right").replace("\"rows\":10", "\"rows\":11"), "fewer cells"),
        (&painted("left", "right").replace("[0,16]", "[9,16]"), "no such letter"),
        (&painted("left", "right").replace("\"width\":40", "\"width\":-1"), "greater than 0"),
        (&painted("left", "right").replace("\"columns\":20", "\"columns\":20000000000"), "at most"),
        (&"[".repeat(200_000), "line 1"),
        (&" ".repeat(MAX_TEXT + 1), "bytes"),
        (r#"{"name":"","unit":"","width":9,"height":9,"reach":1,"labels":[]}"#, "no label yet"),
    ] {
        let refusal = refused(&request(map));
        assert_eq!(refusal.subject, Subject::Map, "{refusal}");
        assert!(refusal.message.contains(said), "{refusal}");
    }
    let elsewhere = refused(&OpenRequest { task: "ball_pass_b1".into(), overrides: [].into(), ..request(&painted("a", "b")) });
    assert!(elsewhere.subject == Subject::Map && elsewhere.message.contains("rover"), "{elsewhere}");
    let strange = refused(&OpenRequest { formula: Some("G F nowhere".into()), ..request(&painted("a", "b")) });
    assert!(strange.subject == Subject::Formula && strange.message.contains("nowhere"), "{strange}");
}

#[test]
fn a_checkpoint_knows_its_map_its_counts_and_how_it_was_opened() {
    let own = OpenRequest { formula: Some("F left".into()), ..request(&painted("left", "right")) };
    let mut session = Session::open(&own).unwrap();
    session.advance(130);
    let bytes = session.save(Replays::Keep);
    let mut again = Session::restore(&bytes).unwrap_or_else(|e| panic!("{e}"));
    let reopened = again.describe().request;
    let facts = |map: &Option<String>| check_map(map.as_ref().unwrap(), None).unwrap();
    assert_eq!(facts(&reopened.map), facts(&own.map));
    assert_eq!(OpenRequest { map: own.map.clone(), ..reopened }, OpenRequest { preset: Some("fast".into()), ..own });
    for _ in 0..5 {
        session.advance(101);
        again.advance(101);
        assert_eq!(
            (again.frame(), again.curves(), again.statistics()),
            (session.frame(), session.curves(), session.statistics())
        );
    }
    let shipped = OpenRequest { task: "own_map".into(), seed: u64::MAX, ..OpenRequest::default() };
    let bytes = Session::open(&shipped).unwrap().save(Replays::Leave);
    let preset = Some("fast".to_owned());
    assert_eq!(Session::restore(&bytes).unwrap().describe().request, OpenRequest { preset, ..shipped });
    let again = Session::restore(&bytes).unwrap().save(Replays::Leave);
    assert!(again == bytes, "what was opened again is kept as the same bytes");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// Whatever is painted opens with the formula that is suggested for it, or is refused with a reason.
    #[test]
    fn whatever_is_painted_opens_or_is_refused(cells in prop::collection::vec(0..4usize, 24)) {
        let runs: Vec<String> = cells.iter().map(|c| format!("[{c},1]")).collect();
        let map = format!(
            r#"{{"name":"","unit":"m","width":6,"height":4,"reach":1,"labels":[{{"name":"a"}},{{"name":"G"}},{{"name":"unsafe"}}],
                "grid":{{"columns":6,"rows":4,"letters":[[],["a"],["G"],["a","G"]],"runs":[{}]}}}}"#,
            runs.join(",")
        );
        match check_map(&map, None) {
            Ok(facts) if facts.suggested.is_empty() => prop_assert!(cells.iter().all(|&c| c == 0)),
            Ok(facts) => prop_assert_eq!(Session::open(&request(&map)).unwrap().describe().formula.text, facts.suggested),
            Err(refusal) => prop_assert!(refusal.message.contains("nowhere to start") && !cells.contains(&0), "{}", refusal),
        }
    }

    #[test]
    fn no_bytes_panic(text in ".{0,200}", image in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = check_map(&text, None);
        let _ = check_map(&text, picture(image.len() / 4, 1, &image).ok().as_ref());
        let _ = of_picture(3, 5, text.as_bytes());
    }
}
