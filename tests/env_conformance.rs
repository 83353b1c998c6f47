//! One suite that every environment passes: ranges, determinism, clamping, copies, and labels that agree with the drawn scene.

use ltl_rover::env::map::{Picture, RoverMap};
use ltl_rover::env::{
    BallPass, Body, CartPole, Current, EnvSpec, Environment, Islands, Outcome, Rover, Scene, Shape, trace_hash,
};
use ltl_rover::labels::Labels;
use ltl_rover::rng::{Purpose, Rng};
use std::sync::{Arc, LazyLock};

/// Every environment there is; a new one is added here and nowhere else.
fn all() -> Vec<Box<dyn Environment>> {
    static MAPS: LazyLock<Vec<Arc<RoverMap>>> = LazyLock::new(|| {
        let shipped = RoverMap::shipped_names().map(|name| RoverMap::from_json(RoverMap::shipped(name).unwrap(), None).unwrap());
        shipped.chain([painted()]).map(Arc::new).collect()
    });
    let mut all: Vec<Box<dyn Environment>> = vec![Box::new(BallPass::new()), Box::new(CartPole::new())];
    all.extend(
        [Current::None, Current::AtA, Current::AtB].map(|current| Box::new(Islands::new(current)) as Box<dyn Environment>),
    );
    all.extend(MAPS.iter().map(|map| Box::new(Rover::new(map.clone())) as Box<dyn Environment>));
    all
}

/// A map whose labels are the colours of a picture: a green square and a red bar with blue under its end.
fn painted() -> RoverMap {
    let colour = |i: usize| match (i % 300, i / 300) {
        (40..90, 40..90) => [0, 255, 0, 255],
        (150..170, 0..140) => [255, 0, 0, 255],
        (150..170, 140..200) => [0, 0, 255, 255],
        _ => [255, 255, 255, 255],
    };
    let picture = Picture { width: 300, height: 200, pixels: (0..300 * 200).map(colour).collect() };
    RoverMap::from_picture("painted", &picture).unwrap()
}

fn observe(environment: &dyn Environment) -> Vec<f32> {
    let mut observation = vec![f32::NAN; environment.spec().observation];
    environment.observe(&mut observation);
    observation
}

fn random_action(spec: &EnvSpec, rng: &mut Rng) -> Vec<f32> {
    spec.action.iter().map(|_| rng.uniform_in(-1.0, 1.0)).collect()
}

/// A state drawn uniformly from the ranges of the channels, reachable or not.
fn any_state(spec: &EnvSpec, rng: &mut Rng) -> Vec<f32> {
    spec.state.iter().map(|c| rng.uniform_in(c.low, c.high)).collect()
}

fn assert_in_range(environment: &dyn Environment) {
    let spec = environment.spec();
    assert_eq!(environment.state().len(), spec.state.len());
    for (channel, &value) in spec.state.iter().zip(environment.state()) {
        assert!(channel.low <= value && value <= channel.high, "{}: {} = {value} {}", spec.name, channel.name, channel.unit);
    }
    assert!(environment.labels().0 >> spec.propositions.len() == 0, "{}: a label without a proposition", spec.name);
    let letter = environment.labels();
    assert!(spec.letters.contains(&letter), "{} says that the letter {letter:?} never occurs", spec.name);
}

/// Walks with random actions (sometimes held, so as to get far) and calls `check` in every state; starts over at the end.
fn walk(environment: &mut dyn Environment, steps: usize, seed: u64, mut check: impl FnMut(&dyn Environment)) {
    let mut rng = Rng::new(seed, Purpose::Tool);
    environment.reset(&mut rng);
    check(environment);
    let mut action = random_action(environment.spec(), &mut rng);
    for _ in 0..steps {
        if rng.chance(0.2) {
            action = random_action(environment.spec(), &mut rng);
        }
        let outcome = environment.step(&action, &mut rng);
        check(environment);
        if outcome == Outcome::Terminated || rng.chance(0.01) {
            if rng.chance(0.5) {
                environment.reset(&mut rng)
            } else {
                environment.reset_anywhere(&mut rng)
            }
            check(environment);
        }
    }
}

#[test]
fn the_spec_describes_every_number() {
    for environment in all() {
        let spec = environment.spec();
        let mut names: Vec<&str> = spec.state.iter().chain(&spec.action).map(|c| c.name.as_ref()).collect();
        for channel in spec.state.iter().chain(&spec.action) {
            assert!(channel.low < channel.high && channel.low.is_finite() && channel.high.is_finite(), "{channel:?}");
            assert!(!channel.name.is_empty());
        }
        names.sort_unstable();
        assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "{}: a channel's name occurs twice", spec.name);
        assert!(!spec.state.is_empty() && !spec.action.is_empty() && spec.observation > 0);
        assert!(spec.state.iter().any(|c| !c.unit.is_empty()), "{}: states have units", spec.name);
        assert_eq!(spec.meanings.len(), spec.propositions.len());
        assert!(spec.meanings.iter().all(|m| !m.is_empty()));
        assert!(spec.dt >= 0.0 && spec.dt.is_finite());
    }
}

#[test]
fn states_stay_in_range_and_observations_are_of_order_1() {
    for mut environment in all() {
        let mut largest = 0.0_f32;
        walk(environment.as_mut(), 20_000, 1, |e| {
            assert_in_range(e);
            for o in observe(e) {
                assert!(o.is_finite());
                largest = largest.max(o.abs());
            }
        });
        assert!(0.5 < largest && largest < 5.0, "{}: the largest observation is {largest}", environment.spec().name);
    }
}

#[test]
fn the_same_seed_gives_the_same_path_and_another_seed_another() {
    for mut environment in all() {
        let mut twin = environment.boxed_clone();
        let first = trace_hash(environment.as_mut(), 3, 2_000);
        // The first walk must leave nothing behind that the second could notice.
        assert_eq!(first, trace_hash(environment.as_mut(), 3, 2_000));
        assert_eq!(first, trace_hash(twin.as_mut(), 3, 2_000));
        assert_ne!(first, trace_hash(twin.as_mut(), 4, 2_000));
    }
}

#[test]
fn a_state_that_was_given_can_be_set_and_goes_on_the_same_way() {
    for mut environment in all() {
        let mut other = environment.boxed_clone();
        let mut rng = Rng::new(5, Purpose::Tool);
        walk(environment.as_mut(), 500, 2, |e| {
            other.set_state(e.state());
            assert_eq!(e.state(), other.state());
            assert_eq!(e.labels(), other.labels());
            assert_eq!(observe(e), observe(other.as_ref()));
            let mut on = e.boxed_clone();
            let action = random_action(e.spec(), &mut rng);
            let (mut one, mut two) = (rng.clone(), rng.clone());
            assert_eq!(on.step(&action, &mut one), other.step(&action, &mut two));
            assert_eq!(on.state(), other.state());
        });
    }
}

#[test]
fn states_from_outside_are_clamped() {
    for mut environment in all() {
        let (low, high): (Vec<f32>, Vec<f32>) = environment.spec().state.iter().map(|c| (c.low, c.high)).unzip();
        let n = low.len();
        environment.set_state(&vec![f32::NEG_INFINITY; n]);
        assert_eq!(environment.state(), low);
        environment.set_state(&vec![f32::MAX; n]);
        assert_eq!(environment.state(), high);
        environment.set_state(&vec![f32::NAN; n]);
        assert_in_range(environment.as_ref());
        assert!(environment.state().iter().all(|v| v.is_finite()));
        let mut rng = Rng::new(6, Purpose::Tool);
        for _ in 0..500 {
            // Whatever is in range may be set and left again, reachable or not.
            let state = any_state(environment.spec(), &mut rng);
            environment.set_state(&state);
            assert_eq!(environment.state(), state);
            for _ in 0..5 {
                environment.step(&random_action(environment.spec(), &mut rng), &mut rng);
                assert_in_range(environment.as_ref());
                assert!(observe(environment.as_ref()).iter().all(|o| o.is_finite()));
            }
        }
    }
}

#[test]
fn actions_are_clamped_and_nan_is_no_action() {
    for mut environment in all() {
        let n = environment.spec().action.len();
        let mut rng = Rng::new(7, Purpose::Tool);
        environment.reset_anywhere(&mut rng);
        let after = |action: f32| {
            let mut copy = environment.boxed_clone();
            copy.step(&vec![action; n], &mut rng.clone());
            copy.state().to_vec()
        };
        assert_eq!(after(1.0), after(1.5));
        assert_eq!(after(1.0), after(f32::INFINITY));
        assert_eq!(after(-1.0), after(-1e30));
        assert_eq!(after(0.0), after(f32::NAN));
        assert_ne!(after(1.0), after(-1.0), "{}: the action does something", environment.spec().name);
    }
}

#[test]
fn a_scaled_disturbance_is_of_another_size_or_there_is_none() {
    for mut environment in all() {
        let own = trace_hash(environment.as_mut(), 3, 500);
        let mut scaled = environment.boxed_clone();
        let there_is_one = scaled.scale_disturbance(1.5);
        let mut copy = scaled.boxed_clone();
        assert_eq!(trace_hash(copy.as_mut(), 3, 500) != own, there_is_one, "{}: copies keep the scale", environment.spec().name);
        walk(scaled.as_mut(), 2_000, 4, |e| assert_in_range(e));
        scaled.scale_disturbance(1.0);
        assert_eq!(trace_hash(scaled.as_mut(), 3, 500), own);
    }
}

#[test]
fn a_copy_goes_its_own_way() {
    for mut environment in all() {
        let mut rng = Rng::new(8, Purpose::Tool);
        environment.reset(&mut rng);
        let before = environment.state().to_vec();
        let mut copy = environment.boxed_clone();
        for _ in 0..10 {
            copy.step(&random_action(environment.spec(), &mut rng), &mut rng);
        }
        assert_eq!(environment.state(), before);
        assert_ne!(copy.state(), before);
    }
}

#[test]
fn starts_are_safe_and_uniform_starts_are_spread() {
    for mut environment in all() {
        let mut rng = Rng::new(9, Purpose::Tool);
        let hazard = environment.spec().propositions.index("unsafe");
        let x = environment.spec().state[0].clone();
        let mut seen = vec![];
        for _ in 0..1_000 {
            environment.reset(&mut rng);
            assert!(!hazard.is_some_and(|i| environment.labels().holds(i)));
            environment.reset_anywhere(&mut rng);
            assert_in_range(environment.as_ref());
            assert!(!hazard.is_some_and(|i| environment.labels().holds(i)));
            seen.push(environment.state()[0]);
            // A start must leave the learner a chance: doing nothing does not end the episode at once.
            let mut copy = environment.boxed_clone();
            let idle = vec![0.0; environment.spec().action.len()];
            assert_eq!(copy.step(&idle, &mut rng), Outcome::Running, "{}: {:?}", environment.spec().name, environment.state());
        }
        seen.sort_unstable_by(f32::total_cmp);
        let span = seen[seen.len() - 1] - seen[0];
        assert!(
            span > 0.4 * (x.high - x.low),
            "{}: starts lie in {}..{}",
            environment.spec().name,
            seen[0],
            seen[seen.len() - 1]
        );
        let half = (seen[seen.len() * 3 / 4] - seen[seen.len() / 4]) / span;
        assert!((0.35..0.85).contains(&half), "{}: the middle half of the starts spans {half}", environment.spec().name);
    }
}

#[test]
fn labels_agree_with_the_scene() {
    for mut environment in all() {
        let scene = environment.scene();
        let spec = environment.spec().clone();
        assert!(scene.regions.iter().all(|region| region.proposition < spec.propositions.len()));
        assert!(scene.ground.x[0] < scene.ground.x[1] && scene.ground.y[0] < scene.ground.y[1]);
        for p in 0..spec.propositions.len() {
            assert!(scene.regions.iter().any(|region| region.proposition == p), "{}: nothing shows proposition {p}", spec.name);
        }
        let mut rng = Rng::new(10, Purpose::Tool);
        let (mut compared, mut holding) = (0, Labels::EMPTY);
        for _ in 0..20_000 {
            environment.set_state(&any_state(&spec, &mut rng));
            let Some(drawn) = labels_of_scene(&scene, environment.state()) else { continue };
            compared += 1;
            holding = Labels(holding.0 | drawn.0);
            assert_eq!(environment.labels(), drawn, "{}: {:?}", spec.name, environment.state());
        }
        assert!(compared > 15_000, "{}: only {compared} states were clearly inside or outside", spec.name);
        assert_eq!(holding.0.count_ones() as usize, spec.propositions.len(), "{}: every proposition held somewhere", spec.name);
    }
}

/// L(s) by geometry in 64 bits; `None` too near to a border to tell.
fn labels_of_scene(scene: &Scene, state: &[f32]) -> Option<Labels> {
    let place = match scene.body {
        Body::Ball { position, .. } | Body::Rover { position, .. } => position.map(|i| f64::from(state[i])),
        Body::CartPole { position, .. } => [f64::from(state[position]), 0.0],
    };
    let tolerance = 1e-3 * f64::from(scene.ground.x[1] - scene.ground.x[0]);
    let mut labels = Labels::EMPTY;
    for region in &scene.regions {
        // Positive inside, negative outside, by the distance to the border.
        let (depth, tolerance) = match &region.shape {
            Shape::Disc { centre, radius } => {
                let (dx, dy) = (place[0] - f64::from(centre[0]), place[1] - f64::from(centre[1]));
                (f64::from(*radius) + f64::from(region.margin) - dx.hypot(dy), tolerance)
            }
            Shape::Band { channel, low, high } => {
                let value = f64::from(state[*channel]);
                ((value - f64::from(*low)).min(f64::from(*high) - value), 1e-6)
            }
            Shape::Polygon { points } => (polygon_depth(points, place), tolerance),
            Shape::Cells { cell, runs } => (cells_depth(runs, cell.map(f64::from), place), tolerance),
        };
        if depth.abs() < tolerance {
            return None;
        }
        if depth > 0.0 {
            labels = labels.with(region.proposition, true);
        }
    }
    let hidden = scene.hazard.filter(|&hazard| labels.holds(hazard));
    Some(hidden.map_or(labels, Labels::only))
}

/// Positive in one of the cells, negative outside, nearly 0 close to the edge of a run.
fn cells_depth(runs: &[[u32; 3]], [width, height]: [f64; 2], [x, y]: [f64; 2]) -> f64 {
    let depth = |&[row, column, length]: &[u32; 3]| {
        let (left, top) = (f64::from(column) * width, f64::from(row) * height);
        let right = left + f64::from(length) * width;
        let across = (x - left).min(right - x);
        // Rows touch one another, so only the sides of a run count as its border.
        if top <= y && y < top + height { across } else { f64::NEG_INFINITY }
    };
    runs.iter().map(depth).fold(f64::NEG_INFINITY, f64::max)
}

/// Distance to the border of a polygon, negative outside (winding by angles: another method than the library's).
fn polygon_depth(points: &[[f32; 2]], [x, y]: [f64; 2]) -> f64 {
    let (mut nearest, mut winding) = (f64::INFINITY, 0.0);
    for (i, &from) in points.iter().enumerate() {
        let to = points[(i + 1) % points.len()];
        let (ax, ay) = (f64::from(from[0]) - x, f64::from(from[1]) - y);
        let (bx, by) = (f64::from(to[0]) - x, f64::from(to[1]) - y);
        let (ex, ey) = (bx - ax, by - ay);
        let along = (-(ax * ex + ay * ey) / (ex * ex + ey * ey).max(1e-12)).clamp(0.0, 1.0);
        nearest = nearest.min((ax + along * ex).hypot(ay + along * ey));
        winding += (ax * by - ay * bx).atan2(ax * bx + ay * by);
    }
    if winding.abs() > 1.0 { nearest } else { -nearest }
}
