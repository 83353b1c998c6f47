//! Pictures as maps: colours, legends, refusals, and maps written as one file.

use crate::files::with;
use crate::shipped;
use ltl_rover::env::Shape;
use ltl_rover::env::map::{Picture, RoverMap};
use ltl_rover::labels::Labels;
use std::sync::Arc;

/// Encodes pixels as an RGBA PNG.
pub fn png(width: u32, height: u32, pixels: &[[u8; 4]]) -> Vec<u8> {
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

pub const WHITE: [u8; 4] = [255; 4];
pub const RED: [u8; 4] = [255, 0, 0, 255];
pub const GREEN: [u8; 4] = [0, 255, 0, 255];

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
fn a_map_written_as_one_file_is_the_same_map() {
    for map in [shipped("melas"), Arc::new(RoverMap::from_json(&with("m", "m"), None).unwrap())] {
        assert!(RoverMap::from_json(&map.to_json(), None).unwrap() == *map, "{}", map.name);
    }
    let text = r##"{"name": "m", "unit": "m", "width": 8, "height": 2, "reach": 1, "labels": [{"name": "goal"}, {"name": "unsafe"}],
        "regions": [{"label": "goal", "disc": [1, 1, 1.9]}], "picture": "view.png",
        "image": {"file": "labels.png", "colours": {"#ff0000": "unsafe", "#ffffff": null, "#00ff00": "goal"}}}"##;
    assert_eq!(RoverMap::image_file(text).unwrap().as_deref(), Some("labels.png"));
    let pixels = [WHITE, WHITE, RED, GREEN, WHITE, RED, RED, WHITE];
    let map = RoverMap::from_json(text, Some(&png(4, 2, &pixels))).unwrap();
    let again = RoverMap::from_json(&map.to_json(), None).unwrap();
    assert!(again.grid == map.grid && again.regions == map.regions && again.meanings == map.meanings);
    assert_eq!(again.picture.as_deref(), Some("view.png"));
    assert_eq!(RoverMap::image_file(&map.to_json()).unwrap(), None);
    let painted = RoverMap::from_png("p", &png(4, 2, &pixels)).unwrap();
    let again = RoverMap::from_json(&painted.to_json(), None).unwrap();
    assert!(again.grid == painted.grid && again.propositions == painted.propositions && again.reach == painted.reach);
    // What is written out is checked like everything else.
    for (from, to, message) in [
        ("[0,2]", "[9,2]", "grid.runs[0]: there is no such letter"),
        ("[0,2]", "[0,1]", "grid.runs: the runs have fewer cells"),
        ("[0,2]", "[0,4000000000]", "grid.runs[0]"),
        ("\"columns\":4", "\"columns\":0", "grid.columns"),
        ("\"rows\":2", "\"rows\":4000000000", "at most 16777216"),
        ("[\"green\"]", "[\"gren\"]", "did you mean `green`?"),
    ] {
        let text = painted.to_json();
        assert!(text.contains(from), "{text}");
        let error = RoverMap::from_json(&text.replacen(from, to, 1), None).unwrap_err().to_string();
        assert!(error.contains(message), "{from} → {to}: {error}");
    }
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
