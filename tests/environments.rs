//! What each environment is by definition: its dynamics, labels and borders, against numbers from elsewhere.

use ltl_rover::env::{BallPass, CartPole, Current, Environment, Islands, Outcome, Rover};
use ltl_rover::labels::Labels;
use ltl_rover::rng::{Purpose, Rng};

fn rng() -> Rng {
    Rng::new(1, Purpose::Tool)
}

#[test]
fn ball_pass_falls_as_galilei_says() {
    let mut ball = BallPass::new();
    ball.reset(&mut rng());
    assert_eq!(ball.state(), [300.0, 600.0, 0.0, 0.0]);
    // Free fall from rest: y = 600 − 300 t²/2; after 38 steps t = 1.9 s.
    for k in 1..=38 {
        assert_eq!(ball.step(&[0.0, 0.0], &mut rng()), Outcome::Running);
        let t = f64::from(k) * 0.05;
        assert!((f64::from(ball.state()[1]) - (600.0 - 150.0 * t * t)).abs() < 0.01);
        assert!((f64::from(ball.state()[3]) + 300.0 * t).abs() < 0.01);
    }
    // At 2 s it is at 0 m, give or take rounding; at 2.05 s it has left the arena.
    let ends: Vec<Outcome> = (39..=41).map(|_| ball.step(&[0.0, 0.0], &mut rng())).collect();
    assert_eq!((ends[0], ends[2]), (Outcome::Running, Outcome::Terminated));
    assert_eq!(ball.state()[1], 0.0);
}

#[test]
fn ball_pass_hovers_at_half_thrust_and_is_pushed_sideways() {
    let mut ball = BallPass::new();
    ball.set_state(&[100.0, 100.0, 0.0, 0.0]);
    for _ in 0..20 {
        assert_eq!(ball.step(&[0.25, 0.5], &mut rng()), Outcome::Running);
    }
    // One second at 150 m/s²: 75 m and 150 m/s.
    let expected = [175.0, 100.0, 150.0, 0.0];
    assert!(ball.state().iter().zip(expected).all(|(a, b): (&f32, f32)| (a - b).abs() < 0.01), "{:?}", ball.state());
}

#[test]
fn ball_pass_labels_hold_where_the_ball_touches() {
    let mut ball = BallPass::new();
    let mut labels = |x: f32, y: f32| {
        ball.set_state(&[x, y, 0.0, 0.0]);
        ball.labels()
    };
    assert_eq!(labels(180.0, 180.0), Labels::only(0));
    assert_eq!(labels(220.0, 180.0), Labels::only(0), "touching from outside: 30 m + 10 m");
    assert_eq!(labels(180.0, 140.0), Labels::only(0));
    assert_eq!(labels(220.01, 180.0), Labels::EMPTY);
    assert_eq!(labels(480.0 + 24.0, 360.0 + 32.0), Labels::only(1), "a 24-32-40 triangle");
    assert_eq!(labels(480.0 + 24.0, 360.0 + 32.02), Labels::EMPTY);
    assert_eq!(labels(300.0, 600.0), Labels::EMPTY);
}

#[test]
fn ball_pass_ends_outside_the_arena_and_not_on_its_border() {
    let mut ball = BallPass::new();
    for (state, action, outcome) in [
        // On the wall at rest, thrust along it: still in the arena.
        ([600.0, 300.0, 0.0, 0.0], [0.0, 0.5], Outcome::Running),
        ([600.0, 300.0, 0.0, 0.0], [0.1, 0.5], Outcome::Terminated),
        ([0.0, 300.0, 0.0, 0.0], [-0.1, 0.5], Outcome::Terminated),
        ([300.0, 600.0, 0.0, 0.0], [0.0, 0.4], Outcome::Running),
        ([300.0, 600.0, 0.0, 0.0], [0.0, 0.6], Outcome::Terminated),
        ([300.0, 0.0, 0.0, 0.0], [0.0, 0.4], Outcome::Terminated),
    ] {
        ball.set_state(&state);
        assert_eq!(ball.step(&action, &mut rng()), outcome, "{state:?} {action:?}");
        assert!((0.0..=600.0).contains(&ball.state()[0]) && (0.0..=600.0).contains(&ball.state()[1]));
    }
}

#[test]
fn cart_pole_moves_as_gymnasium_recorded() {
    let mut cart = CartPole::new();
    for (state, action, next, terminated) in GYMNASIUM {
        cart.set_state(&state);
        let outcome = cart.step(&[action], &mut rng());
        for (ours, theirs) in cart.state().iter().zip(next) {
            assert!((ours - theirs).abs() < 3e-6 * (1.0 + theirs.abs()), "{state:?} {action}: {:?}", cart.state());
        }
        assert_eq!(outcome == Outcome::Terminated, terminated);
    }
}

#[test]
fn cart_pole_labels_are_closed_bands_and_open_limits() {
    let mut cart = CartPole::new();
    let mut labels = |x: f32, degrees: f32| {
        cart.set_state(&[x, 0.0, degrees.to_radians(), 0.0]);
        cart.labels()
    };
    let (green, yellow, hazard) = (Labels::only(0), Labels::only(1), Labels::only(2));
    assert_eq!(labels(-1.44, 0.0), green);
    assert_eq!(labels(-0.96, 0.0), green);
    assert_eq!(labels(-1.441, 0.0), Labels::EMPTY);
    assert_eq!(labels(-0.959, 0.0), Labels::EMPTY);
    assert_eq!(labels(0.96, 0.0), yellow);
    assert_eq!(labels(1.44, 0.0), yellow);
    assert_eq!(labels(1.441, 0.0), Labels::EMPTY);
    assert_eq!(labels(2.4, 0.0), Labels::EMPTY);
    assert_eq!(labels(2.4001, 0.0), hazard);
    assert_eq!(labels(-2.4001, 0.0), hazard);
    assert_eq!(labels(0.0, 12.0), Labels::EMPTY);
    assert_eq!(labels(0.0, 12.01), hazard);
    assert_eq!(labels(0.0, -12.01), hazard);
    assert_eq!(labels(1.2, 13.0), Labels(yellow.0 | hazard.0), "fallen inside a band: both hold");
}

#[test]
fn cart_pole_ends_exactly_when_it_is_unsafe() {
    let mut cart = CartPole::new();
    let mut draws = rng();
    let mut ends = 0;
    cart.reset(&mut draws);
    for _ in 0..5_000 {
        let outcome = cart.step(&[draws.uniform_in(-1.0, 1.0)], &mut rng());
        assert_eq!(outcome == Outcome::Terminated, cart.labels().holds(2));
        if outcome == Outcome::Terminated {
            ends += 1;
            cart.reset_anywhere(&mut draws);
        }
    }
    assert!(ends > 10);
}

#[test]
fn cart_pole_starts_within_gymnasiums_box() {
    let (mut cart, mut draws) = (CartPole::new(), rng());
    let mut widest = 0.0_f32;
    for _ in 0..500 {
        cart.reset(&mut draws);
        assert!(cart.state().iter().all(|v| v.abs() <= 0.05));
        widest = cart.state().iter().fold(widest, |w, v| w.max(v.abs()));
    }
    assert!(widest > 0.045);
}

#[test]
fn islands_can_be_held_exactly_where_there_is_no_current() {
    // The best one can do: steer back to the centre of the island with all force.
    let held = |current, goal: [f32; 2], label: usize| {
        let (mut boat, mut draws) = (Islands::new(current), rng());
        boat.set_state(&goal);
        let mut inside = 0;
        for _ in 0..1_000 {
            let back: Vec<f32> = boat.state().iter().zip(goal).map(|(s, g)| 5.0 * (g - s)).collect();
            boat.step(&back, &mut draws);
            inside += usize::from(boat.labels().holds(label));
        }
        inside
    };
    let (a, b) = ([2.5, 5.0], [7.5, 5.0]);
    assert_eq!((held(Current::None, a, 0), held(Current::None, b, 1)), (1_000, 1_000));
    assert_eq!((held(Current::AtB, a, 0), held(Current::AtA, b, 1)), (1_000, 1_000));
    let (swept_a, swept_b) = (held(Current::AtA, a, 0), held(Current::AtB, b, 1));
    assert!((100..900).contains(&swept_a) && (100..900).contains(&swept_b), "{swept_a} {swept_b}");
}

#[test]
fn islands_start_at_a() {
    let (mut boat, mut draws) = (Islands::new(Current::AtA), rng());
    for _ in 0..500 {
        boat.reset(&mut draws);
        assert_eq!(boat.labels(), Labels::only(0));
    }
    boat.set_state(&[4.0, 5.0]);
    assert_eq!(boat.labels(), Labels::only(0), "the shore belongs to the island");
    boat.set_state(&[4.001, 5.0]);
    assert_eq!(boat.labels(), Labels::EMPTY);
}

#[test]
fn the_disturbance_scales_gusts_and_distances() {
    // Standard deviations of 4 000 displacements: gusts are 0.05 m per axis; distances uniform on (0, 10] have 10/√12.
    let deviation = |environment: &mut dyn Environment, from: [f32; 2], scale: f32| {
        assert!(environment.scale_disturbance(scale));
        let mut draws = rng();
        let moved: Vec<f64> = (0..4_000)
            .map(|_| {
                environment.set_state(&from);
                environment.step(&[0.0, 0.0], &mut draws);
                f64::from(environment.state()[0] - from[0])
            })
            .collect();
        let mean = moved.iter().sum::<f64>() / 4_000.0;
        (moved.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / 4_000.0).sqrt()
    };
    let mut rover = Rover::shipped("victoria").expect("a shipped map");
    assert_eq!(rover.map().reach, 10.0);
    for scale in [0.5, 1.0, 1.25, 3.0] {
        let gust = deviation(&mut Islands::new(Current::None), [5.0, 5.0], scale);
        assert!((gust / (0.05 * f64::from(scale)) - 1.0).abs() < 0.05, "{gust} m at {scale}");
        let distance = deviation(&mut rover, [300.0, 200.0], scale);
        assert!((distance * 12.0_f64.sqrt() / (10.0 * f64::from(scale)) - 1.0).abs() < 0.05, "{distance} at {scale}");
    }
}

type Recorded = ([f32; 4], f32, [f32; 4], bool);

/// Single steps of Gymnasium 1.4.0's `CartPoleEnv` (explicit Euler, computed in 64 bits) with `force_mag` set to 10·action N:
/// state, action, next state, terminated.
const GYMNASIUM: [Recorded; 24] = [
    ([1.342, 1.848, 0.006, -0.857], -0.892, [1.37896, 1.67387, -0.01114, -0.594046], false),
    ([-0.513, -0.549, -0.182, -1.805], 0.998, [-0.52398, -0.352761, -0.2181, -2.14771], true),
    ([0.67, -1.593, -0.026, 1.897], 0.795, [0.63814, -1.437604, 0.01194, 1.656342], false),
    ([1.515, -0.646, -0.003, 0.707], -0.878, [1.50208, -0.817275, 0.01114, 0.96303], false),
    ([0.245, -1.371, 0.152, -1.743], 0.358, [0.21758, -1.302958, 0.11714, -1.79937], false),
    ([1.628, -1.636, 0.158, 1.489], -0.963, [1.59528, -1.825447, 0.18778, 1.81589], false),
    ([0.913, -2.993, 0.001, -0.253], -0.593, [0.85314, -3.108722, -0.00406, -0.079124], false),
    ([-0.77, 1.837, -0.073, -1.404], 0.397, [-0.73326, 1.915336, -0.10108, -1.542634], false),
    ([-0.226, 1.794, -0.106, -0.721], 0.6, [-0.19012, 1.912431, -0.12042, -0.928756], false),
    ([0.031, 0.038, -0.106, -1.942], 0.866, [0.03176, 0.207956, -0.14484, -2.226609], false),
    ([-1.822, 2.07, -0.053, 1.804], -0.201, [-1.7806, 2.031379, -0.01692, 1.846276], false),
    ([1.92, 0.337, -0.104, 0.966], 0.349, [1.92674, 0.406429, -0.08468, 0.831898], false),
    ([0.811, -0.217, -0.111, 0.564], -0.786, [0.80666, -0.368685, -0.09972, 0.757561], false),
    ([0.846, 0.812, -0.049, 1.194], -0.612, [0.86224, 0.69324, -0.02512, 1.357526], false),
    ([-0.482, 1.788, -0.048, 0.853], 0.225, [-0.44624, 1.832548, -0.03094, 0.772148], false),
    ([1.94, 2.95, 0.089, 1.235], -0.694, [1.999, 2.813527, 0.1137, 1.465031], false),
    ([0.937, 2.086, -0.04, 0.213], -0.041, [0.97872, 2.078572, -0.03574, 0.212376], false),
    ([2.018, -1.096, -0.039, -1.996], -0.16, [1.99608, -1.126809, -0.07892, -1.961285], false),
    ([0.578, 2.61, 0.169, -0.691], 0.978, [0.6302, 2.79814, 0.15518, -0.91974], false),
    ([-1.374, 1.94, -0.137, -0.38], -0.853, [-1.3352, 1.775706, -0.1446, -0.176021], false),
    ([1.575, 1.973, -0.144, 0.108], -0.484, [1.61446, 1.880735, -0.14184, 0.202775], false),
    ([-0.036, 0.319, -0.157, 1.458], -0.443, [-0.02962, 0.234602, -0.12784, 1.537071], false),
    ([-0.233, -2.656, -0.199, -1.219], -0.317, [-0.28612, -2.715192, -0.22338, -1.190085], true),
    ([1.884, 2.338, -0.008, -0.181], 0.334, [1.93076, 2.403285, -0.01162, -0.281276], false),
];
