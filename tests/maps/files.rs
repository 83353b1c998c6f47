//! Map files: what they say, what is wrong with them and where, and that nothing breaks the reader.

use crate::pictures::{GREEN, RED, WHITE, png};
use ltl_rover::env::map::{LabelGrid, MapError, RoverMap};
use ltl_rover::labels::Labels;
use proptest::prelude::*;

/// A map file with one disc and one triangle, and one change to it.
pub fn with(from: &str, to: &str) -> String {
    let text = r#"{"name": "m", "unit": "m", "width": 100, "height": 60, "reach": 1.5,
 "labels": [{"name": "goal", "meaning": "at the flag"}, {"name": "unsafe"}],
 "regions": [{"label": "goal", "disc": [80, 30, 6]},
  {"label": "unsafe", "name": "rock", "polygon": [[20, 10], [40, 12], [30, 40]]}]}"#;
    assert!(text.contains(from), "{from}");
    text.replace(from, to)
}

#[test]
fn a_map_file_says_where_it_is_wrong() {
    assert!(RoverMap::from_json(&with("m", "m"), None).is_ok());
    let free = r##""image": {"colours": {"#ffffff": null}}, "labels""##;
    for (from, to, place, message) in [
        ("\"unit\": \"m\",", "\"unit\": \"m\"", "line 1, column", "expected `,` or `}`"),
        ("\"reach\"", "\"Reach\"", "line 1, column", "unknown field `Reach`"),
        ("\"reach\": 1.5,", "", "line 4, column", "missing field `reach`"),
        ("\"width\": 100", "\"width\": \"wide\"", "line 1, column", "invalid type: string \"wide\""),
        ("\"width\": 100", "\"width\": -3", "width", "-3 is not allowed; it must be greater than 0"),
        ("\"width\": 100", "\"width\": 1e30", "width", "at most 10⁹"),
        ("\"reach\": 1.5", "\"reach\": 0", "reach", "greater than 0"),
        ("{\"name\": \"unsafe\"}", "{\"name\": \"goal\"}", "labels", "`goal` is listed twice"),
        ("\"label\": \"goal\"", "\"label\": \"gaol\"", "regions[0].label", "did you mean `goal`?"),
        ("\"label\": \"unsafe\"", "\"label\": \"water\"", "regions[1].label", "the labels are `goal`, `unsafe`"),
        ("[80, 30, 6]", "[80, 30, -6]", "regions[0].disc[2]", "-6 is not allowed"),
        ("[80, 30, 6]", "[80, 30]", "line 3, column", "invalid length 2"),
        ("[80, 30, 6]", "[80, 1e12, 6]", "regions[0].disc", "between −10⁹ and 10⁹"),
        ("[40, 12], [30, 40]", "[40, 12]", "regions[1].polygon", "at least 3 corners, this one has 2"),
        ("\"disc\": [80, 30, 6]", "\"name\": \"x\"", "regions[0]", "either a `disc` or a `polygon`"),
        ("\"labels\"", "\"hazard\": \"wall\", \"labels\"", "hazard", "there is no label `wall`"),
        ("\"labels\"", "\"cell\": 0.0001, \"labels\"", "cell", "grid cells; at most 16777216"),
        ("\"labels\"", free, "image", "there is none"),
        ("[80, 30, 6]", "[50, 30, 900]", "map", "nowhere to start"),
    ] {
        let error = RoverMap::from_json(&with(from, to), None).unwrap_err();
        assert!(error.place.starts_with(place), "{from} → {to}: {error}");
        assert!(error.to_string().contains(message), "{from} → {to}: {error}");
    }
    let error = RoverMap::from_json(&with("m", "m"), Some(&png(1, 1, &[[0; 4]]))).unwrap_err();
    assert!(error.to_string().contains("does not say what its colours mean"), "{error}");
    let long = " ".repeat(5 << 20);
    assert!(RoverMap::from_json(&long, None).unwrap_err().to_string().contains("bytes; at most 4194304"));
}

#[test]
fn unsafe_wins_over_every_label() {
    let map = RoverMap::from_json(&with("[80, 30, 6]", "[30, 20, 6]"), None).unwrap();
    assert_eq!(map.grid.labels(30.0, 20.0), Labels::only(1));
    assert_eq!(map.grid.labels(30.0, 15.0), Labels::only(1));
    // Another name for the hazard, and the same shapes the other way round.
    let other =
        with("[80, 30, 6]", "[30, 20, 6]").replace("unsafe", "lava").replace("\"labels\"", "\"hazard\": \"lava\", \"labels\"");
    let map = RoverMap::from_json(&other, None).unwrap();
    assert_eq!(map.grid.labels(30.0, 20.0), Labels::only(1));
    let plain = RoverMap::from_json(&other.replace("\"hazard\": \"lava\",", ""), None).unwrap();
    assert_eq!(plain.grid.labels(30.0, 20.0), Labels(0b11), "without a hazard labels overlap");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Whatever bytes come in, the answer is a map or an error.
    #[test]
    fn any_bytes_are_read_or_refused(mut bytes in prop::collection::vec(any::<u8>(), 0..300), as_png in any::<bool>()) {
        if as_png {
            bytes.splice(0..0, *b"\x89PNG\r\n\x1a\n");
        }
        let _: Result<RoverMap, MapError> = RoverMap::from_png("x", &bytes);
        let _ = RoverMap::from_json(&String::from_utf8_lossy(&bytes), None);
    }

    /// A good picture or map file with some bytes changed is read or refused.
    #[test]
    fn damaged_files_are_read_or_refused(changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4)) {
        let mut text = with("\"labels\"", "\"cell\": 2, \"labels\"").into_bytes();
        let mut picture = png(4, 2, &[WHITE, RED, GREEN, WHITE, WHITE, RED, RED, GREEN]);
        for (at, byte) in changes {
            let (i, j) = (at.index(text.len()), at.index(picture.len()));
            text[i] = byte;
            picture[j] = byte;
        }
        let _ = RoverMap::from_json(&String::from_utf8_lossy(&text), None);
        let _ = RoverMap::from_png("x", &picture);
    }

    /// The cells of discs and triangles are those whose centres lie inside, by a test with half-planes.
    #[test]
    fn grids_agree_with_geometry(
        disc in (0.0_f32..40.0, 0.0_f32..30.0, 1.0_f32..12.0),
        corners in prop::array::uniform3((-10.0_f32..50.0, -10.0_f32..40.0)),
    ) {
        let (x, y, r) = disc;
        let points: Vec<String> = corners.iter().map(|(x, y)| format!("[{x}, {y}]")).collect();
        let text = format!(
            r#"{{"name": "m", "unit": "m", "width": 40, "height": 30, "reach": 1, "cell": 1,
            "labels": [{{"name": "d"}}, {{"name": "t"}}],
            "regions": [{{"label": "d", "disc": [{x}, {y}, {r}]}}, {{"label": "t", "polygon": [{}]}}]}}"#,
            points.join(", ")
        );
        let Ok(map) = RoverMap::from_json(&text, None) else { return Ok(()) };
        let grid: &LabelGrid = &map.grid;
        let side = |a: (f32, f32), b: (f32, f32), x: f64, y: f64| {
            let (ax, ay, bx, by) = (f64::from(a.0), f64::from(a.1), f64::from(b.0), f64::from(b.1));
            (bx - ax) * (y - ay) - (by - ay) * (x - ax)
        };
        for (cx, cy) in (0..40).flat_map(|i| (0..30).map(move |j| (f64::from(i) + 0.5, f64::from(j) + 0.5))) {
            let letter = grid.labels(cx as f32, cy as f32);
            let distance = (cx - f64::from(x)).hypot(cy - f64::from(y)) - f64::from(r);
            if distance.abs() > 1e-4 {
                prop_assert_eq!(letter.holds(0), distance < 0.0);
            }
            let sides = [0, 1, 2].map(|i| side(corners[i], corners[(i + 1) % 3], cx, cy));
            if sides.iter().all(|s| s.abs() > 1e-3) {
                let inside = sides.iter().all(|s| *s > 0.0) || sides.iter().all(|s| *s < 0.0);
                prop_assert_eq!(letter.holds(1), inside);
            }
        }
    }
}
