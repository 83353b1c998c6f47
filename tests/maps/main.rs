//! Label maps: the shipped ones and the rover on them; map files and pictures with their errors.

mod files;
mod pictures;
mod survival;

use ltl_rover::env::map::RoverMap;
use ltl_rover::env::{Environment, Rover, Shape};
use ltl_rover::labels::Labels;
use ltl_rover::rng::{Purpose, Rng};
use std::sync::{Arc, LazyLock};

/// A shipped map, read once.
fn shipped(name: &str) -> Arc<RoverMap> {
    static MAPS: LazyLock<[Arc<RoverMap>; 2]> = LazyLock::new(|| {
        ["melas", "victoria"].map(|name| Arc::new(RoverMap::from_json(RoverMap::shipped(name).unwrap(), None).unwrap()))
    });
    MAPS[usize::from(name == "victoria")].clone()
}

fn rover(name: &str) -> Rover {
    Rover::new(shipped(name))
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
    assert!(Rover::shipped("mars").is_none());
    assert_eq!(RoverMap::shipped_names().collect::<Vec<_>>(), ["melas", "victoria", "three_targets"]);
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
    let mut rover = rover("melas");
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
    let mut rover = rover("victoria");
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
    let map = shipped("melas");
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
