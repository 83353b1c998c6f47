//! Label maps: the shipped ones, map files and pictures with their errors, and the rover on them.

use ltl_rover::env::map::{LabelGrid, MapError, Picture, RoverMap};
use ltl_rover::env::{Environment, Rover, Shape};
use ltl_rover::labels::Labels;
use ltl_rover::rng::{Purpose, Rng};
use proptest::prelude::*;
use std::sync::Arc;

fn shipped(name: &str) -> RoverMap {
    RoverMap::from_json(RoverMap::shipped(name).unwrap(), None).unwrap()
}

/// A map file with one disc and one triangle, and one change to it.
fn with(from: &str, to: &str) -> String {
    let text = r#"{"name": "m", "unit": "m", "width": 100, "height": 60, "reach": 1.5,
 "labels": [{"name": "goal", "meaning": "at the flag"}, {"name": "unsafe"}],
 "regions": [{"label": "goal", "disc": [80, 30, 6]},
  {"label": "unsafe", "name": "rock", "polygon": [[20, 10], [40, 12], [30, 40]]}]}"#;
    assert!(text.contains(from), "{from}");
    text.replace(from, to)
}

fn area(shape: &Shape) -> f32 {
    match shape {
        Shape::Disc { radius, .. } => std::f32::consts::PI * radius * radius,
        Shape::Polygon { points } => {
            let twice = |(i, a): (usize, &[f32; 2])| {
                let b = points[(i + 1) % points.len()];
                a[0] * b[1] - b[0] * a[1]
            };
            (points.iter().enumerate().map(twice).sum::<f32>() / 2.0).abs()
        }
        _ => panic!("no other shape stands in a shipped map"),
    }
}

#[test]
fn the_shipped_maps_have_the_size_and_labels_of_the_paper() {
    let melas = shipped("melas");
    assert_eq!((melas.size, melas.reach, melas.unit.as_str()), ([456.0, 330.6], 2.0, "km"));
    assert_eq!(melas.propositions.iter().collect::<Vec<_>>(), ["m1", "m2", "unsafe"]);
    let victoria = shipped("victoria");
    assert_eq!((victoria.size, victoria.reach), ([746.0, 530.0], 10.0));
    let names: Vec<String> = (1..=12).map(|i| format!("v{i}")).chain(["unsafe".to_owned()]).collect();
    assert_eq!(victoria.propositions.iter().collect::<Vec<_>>(), names);
    assert_eq!(RoverMap::shipped("mars"), None);
    assert_eq!(RoverMap::shipped_names().collect::<Vec<_>>(), ["melas", "victoria"]);
}

#[test]
fn the_grids_of_the_shipped_maps_have_the_areas_of_their_shapes() {
    for map in [shipped("melas"), shipped("victoria")] {
        let cell = map.grid.cell();
        let hazard = map.hazard.unwrap();
        let painted = |label: usize| map.grid.area(label) as f32 * cell[0] * cell[1];
        let exact = |label: usize| -> f32 { map.regions.iter().filter(|r| r.proposition == label).map(|r| area(&r.shape)).sum() };
        assert!((painted(hazard) / exact(hazard) - 1.0).abs() < 0.002, "{}: {} {}", map.name, painted(hazard), exact(hazard));
        for label in (0..map.propositions.len()).filter(|&label| label != hazard) {
            // Discs may overlap one another, unsafe ground and the edge of the map.
            let share = painted(label) / exact(label);
            assert!((0.7..1.02).contains(&share), "{}: {} has {share} of its area", map.name, map.propositions.name(label));
        }
        // Nothing but safe ground between any two free places: hardly a free cell is cut off.
        let free = map.grid.size()[0] * map.grid.size()[1] - (0..map.propositions.len()).map(|l| map.grid.area(l)).sum::<usize>();
        assert!(free - map.grid.start_cells() < 10, "{}: {} of {free}", map.name, map.grid.start_cells());
    }
}

#[test]
fn known_places_have_their_labels() {
    let at = |map: &RoverMap, x, y| {
        let letter = map.grid.labels(x, y);
        map.propositions
            .iter()
            .enumerate()
            .filter(|(i, _)| letter.holds(*i))
            .map(|(_, n)| n.to_owned())
            .collect::<Vec<_>>()
            .join(" ")
    };
    let melas = shipped("melas");
    assert_eq!(at(&melas, 338.3, 47.9), "m1");
    assert_eq!(at(&melas, 386.6, 229.7), "m1");
    assert_eq!(at(&melas, 29.0, 125.3), "m2");
    assert_eq!(at(&melas, 229.1, 137.9), "", "the start of the layout the map was measured from");
    // Corners and borders of the unsafe areas are unsafe up to the edge of the map.
    for (x, y) in [(0.0, 330.6), (456.0, 330.6), (456.0, 300.0), (456.0, 0.0), (0.0, 200.0), (456.0, 60.0)] {
        assert_eq!(at(&melas, x, y), "unsafe", "({x}, {y})");
    }
    let victoria = shipped("victoria");
    assert_eq!(at(&victoria, 373.0, 265.0), "unsafe");
    assert_eq!(at(&victoria, 119.7, 201.8), "v1");
    assert_eq!(at(&victoria, 407.2, 22.4), "v12");
    assert_eq!(at(&victoria, 700.0, 500.0), "");
    for i in 0..12 {
        assert!(victoria.meanings[i].contains(&victoria.regions[i].name));
    }
}

#[test]
fn a_step_goes_in_the_direction_by_a_uniform_distance() {
    let mut rover = Rover::shipped("melas").unwrap();
    let mut rng = Rng::new(1, Purpose::Tool);
    let (mut distances, n) = (vec![], 20_000);
    for k in 0..n {
        let angle = k as f32 * 0.37;
        rover.set_state(&[228.0, 165.0]);
        // The length of the action does not matter.
        let length = 0.1 + 0.9 * rng.uniform();
        rover.step(&[length * angle.cos(), length * angle.sin()], &mut rng);
        let (dx, dy) = (rover.state()[0] - 228.0, rover.state()[1] - 165.0);
        let distance = dx.hypot(dy);
        assert!(distance <= 2.0 + 1e-4);
        let along = dx * angle.cos() + dy * angle.sin();
        assert!((along - distance).abs() < 1e-3, "the rover went off course");
        distances.push(f64::from(distance) / 2.0);
    }
    // Kolmogorov-Smirnov distance to the uniform distribution: 1.95 / √n is exceeded once in a thousand.
    distances.sort_unstable_by(f64::total_cmp);
    let gap = distances.iter().enumerate().map(|(i, d)| (d - (i as f64 + 0.5) / n as f64).abs()).fold(0.0, f64::max);
    assert!(gap < 1.95 / f64::from(n).sqrt(), "{gap}");
}

#[test]
fn the_border_stops_the_rover_and_no_direction_is_east() {
    let mut rover = Rover::shipped("victoria").unwrap();
    let mut rng = Rng::new(2, Purpose::Tool);
    rover.set_state(&[745.9, 529.9]);
    for _ in 0..10 {
        rover.step(&[1.0, 1.0], &mut rng);
    }
    assert_eq!(rover.state(), [746.0, 530.0]);
    rover.set_state(&[100.0, 300.0]);
    rover.step(&[0.0, 0.0], &mut rng);
    assert!(rover.state()[0] > 100.0 && rover.state()[1] == 300.0);
}

#[test]
fn starts_are_uniform_over_the_free_ground() {
    let map = Arc::new(shipped("melas"));
    let mut rover = Rover::new(map.clone());
    let mut rng = Rng::new(3, Purpose::Tool);
    let n = 20_000;
    let mut counts = [[0_u32; 4]; 4];
    for _ in 0..n {
        rover.reset(&mut rng);
        assert_eq!(rover.labels(), Labels::EMPTY);
        let [x, y] = [rover.state()[0], rover.state()[1]];
        counts[(y / 330.6 * 4.0) as usize][(x / 456.0 * 4.0) as usize] += 1;
    }
    let [columns, rows] = map.grid.size();
    let mut free = [[0_u32; 4]; 4];
    for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        let (x, y) = ((column as f32 + 0.5) * map.grid.cell()[0], (row as f32 + 0.5) * map.grid.cell()[1]);
        free[row * 4 / rows][column * 4 / columns] += u32::from(map.grid.labels(x, y) == Labels::EMPTY);
    }
    // Cells of the 4 × 4 table may be split by its lines; a row of pixels is 0.6 % of a table row.
    let mut statistic = 0.0;
    for (count, free) in counts.as_flattened().iter().zip(free.as_flattened()) {
        let expected = f64::from(*free) / map.grid.start_cells() as f64 * f64::from(n);
        if expected > 5.0 {
            statistic += (f64::from(*count) - expected).powi(2) / expected;
        }
    }
    assert!(statistic < 45.0, "χ² with 15 degrees of freedom: {statistic}");
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

/// Encodes pixels as an RGBA PNG.
fn png(width: u32, height: u32, pixels: &[[u8; 4]]) -> Vec<u8> {
    encode(width, height, png::ColorType::Rgba, pixels.as_flattened())
}

fn encode(width: u32, height: u32, colour: png::ColorType, data: &[u8]) -> Vec<u8> {
    let mut bytes = vec![];
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(colour);
    encoder.set_depth(png::BitDepth::Eight);
    if colour == png::ColorType::Indexed {
        encoder.set_palette([255, 255, 255, 0, 255, 0, 255, 0, 0].as_slice());
    }
    encoder.write_header().unwrap().write_image_data(data).unwrap();
    bytes
}

const WHITE: [u8; 4] = [255; 4];
const RED: [u8; 4] = [255, 0, 0, 255];
const GREEN: [u8; 4] = [0, 255, 0, 255];

#[test]
fn a_flat_picture_is_a_map() {
    let navy = [0, 0, 130, 255];
    let blue = [30, 60, 255, 255];
    let map = RoverMap::from_png("tiny", &png(3, 2, &[WHITE, GREEN, RED, navy, blue, [9, 9, 9, 0]])).unwrap();
    assert_eq!(map.propositions.iter().collect::<Vec<_>>(), ["green", "unsafe", "blue", "blue2"]);
    assert_eq!((map.size, map.unit.as_str(), map.hazard), ([3.0, 2.0], "px", Some(1)));
    let letters = [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1)].map(|(x, y)| map.grid.labels(x as f32 + 0.5, y as f32 + 0.5));
    let only = Labels::only;
    assert_eq!(letters, [Labels::EMPTY, only(0), only(1), only(2), only(3), Labels::EMPTY]);
    let Shape::Cells { cell, runs } = &map.regions[0].shape else { panic!("labels from a picture are cells") };
    assert_eq!((cell, runs), (&[1.0, 1.0], &vec![[0, 1, 1]]));
    // The other colour types say the same.
    let index = encode(3, 1, png::ColorType::Indexed, &[0, 1, 2]);
    let rgb = encode(3, 1, png::ColorType::Rgb, &[255, 255, 255, 0, 255, 0, 255, 0, 0]);
    let rgba = png(3, 1, &[WHITE, GREEN, RED]);
    let maps = [index, rgb, rgba].map(|bytes| RoverMap::from_png("tiny", &bytes).unwrap());
    assert!(maps[0] == maps[1] && maps[1] == maps[2]);
    let grey = RoverMap::from_png("grey", &encode(2, 1, png::ColorType::Grayscale, &[0, 200])).unwrap();
    assert!(grey.propositions.is_empty());
}

#[test]
fn a_legend_gives_colours_their_labels() {
    let file = |image: &str| {
        format!(
            r##"{{"name": "m", "unit": "m", "width": 40, "height": 20, "reach": 1, "labels": [{{"name": "goal"}}, {{"name": "unsafe"}}],
            "regions": [{{"label": "goal", "disc": [35, 5, 2]}}], "image": {image}}}"##
        )
    };
    let pixels = png(2, 1, &[[250, 3, 1, 255], [254, 255, 255, 255]]);
    let read = |image: &str| RoverMap::from_json(&file(image), Some(&pixels));
    let map = read(r##"{"colours": {"#ff0000": "unsafe", "#ffffff": null}, "tolerance": 5}"##).unwrap();
    assert_eq!(map.grid.labels(10.0, 10.0), Labels::only(1));
    assert_eq!(map.grid.size(), [2, 1]);
    let error = |image: &str| read(image).unwrap_err().to_string();
    let message = error(r##"{"colours": {"#ff0000": "unsafe", "#ffffff": null}, "tolerance": 4}"##);
    assert!(message.contains("pixel (0, 0): the colour #fa0301") && message.contains("1 of 2 pixels"), "{message}");
    assert!(read(r##"{"colours": {"#ff0000": "unsafe"}, "tolerance": 5, "others": "free"}"##).is_ok());
    assert!(error(r##"{"colours": {"red": "unsafe"}}"##).contains("write it as #rrggbb"));
    assert!(error(r##"{"colours": {"#ff00é": "unsafe"}}"##).contains("write it as #rrggbb"));
    assert!(error(r##"{"colours": {"#ff0000": "usafe"}}"##).contains("image.colours.#ff0000: there is no label `usafe`"));
    assert!(error(r##"{"colours": {}, "others": "ignore"}"##).contains("unknown variant `ignore`"));
}

#[test]
fn pictures_that_cannot_be_maps_are_refused() {
    let error = |bytes: &[u8]| RoverMap::from_png("x", bytes).unwrap_err().to_string();
    assert!(error(b"GIF89a").contains("the picture cannot be read"));
    let good = png(2, 1, &[WHITE, RED]);
    assert!(error(&good[..good.len() - 20]).contains("cannot be read"));
    assert!(error(&[]).contains("cannot be read"));
    assert!(error(&encode(5_000, 1, png::ColorType::Grayscale, &[255; 5_000])).contains("5000 pixels on a side; at most 4096"));
    let shades: Vec<[u8; 4]> = (0..100).map(|i| [i, 255, 0, 255]).collect();
    assert!(error(&png(100, 1, &shades)).contains("not flat"));
    assert!(error(&png(2, 1, &[RED, GREEN])).contains("nowhere to start"));
    let wrong = Picture { width: 3, height: 1, pixels: vec![WHITE] };
    assert!(RoverMap::from_picture("x", &wrong).is_err());
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
