//! What each environment is by definition: its dynamics, labels and borders, against numbers from elsewhere.

use ltl_rover::env::{BallPass, CartPole, Environment, Outcome};
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

type Recorded = ([f32; 4], f32, [f32; 4], bool);

/// Single steps of Gymnasium 1.4.0's `CartPoleEnv` (explicit Euler, computed in 64 bits) with `force_mag` set to 10·action N:
/// state, action, next state, terminated.
const GYMNASIUM: [Recorded; 24] = [
    ([1.342012882, 1.847644687, 0.006130225, -0.856794477], -0.8921386, [1.3789658, 1.6734858, -0.011005665, -0.59375881], false),
    (
        [-0.513176918, -0.549160779, -0.181889921, -1.804969192],
        0.99835223,
        [-0.52416013, -0.35285387, -0.21798931, -2.1477533],
        true,
    ),
    ([0.670424104, -1.592938781, -0.02602098, 1.896744728], 0.795355201, [0.63856533, -1.4374735, 0.011913915, 1.6559765], false),
    (
        [1.514616609, -0.645572007, -0.002790793, 0.706757426],
        -0.878394604,
        [1.5017052, -0.81692731, 0.011344356, 0.96296889],
        false,
    ),
    ([0.244622916, -1.371290326, 0.151860476, -1.743142247], 0.358363062, [0.21719711, -1.303176, 0.11699763, -1.7996623], false),
    ([1.628389359, -1.636088848, 0.158179298, 1.488781929], -0.962965548, [1.5956676, -1.8255309, 0.18795494, 1.8157084], false),
    (
        [0.912980497, -2.992801905, 0.001345586, -0.25333178],
        -0.593494356,
        [0.85312446, -3.1086249, -0.0037210493, -0.079201873],
        false,
    ),
    (
        [-0.770252347, 1.837291956, -0.073419169, -1.403845668],
        0.397023976,
        [-0.73350651, 1.9156373, -0.10149608, -1.542613],
        false,
    ),
    (
        [-0.226405963, 1.793636918, -0.105793417, -0.720861375],
        0.599759042,
        [-0.19053322, 1.9120189, -0.12021064, -0.92848682],
        false,
    ),
    (
        [0.031099811, 0.03831001, -0.105522349, -1.941854835],
        0.866447806,
        [0.031866011, 0.20834963, -0.14435945, -2.2264616],
        false,
    ),
    ([-1.822366476, 2.069560766, -0.052847706, 1.80409193], -0.201149479, [-1.7809753, 2.0309087, -0.016765867, 1.846459], false),
    ([1.920345068, 0.336958647, -0.103945866, 0.965686679], 0.34877944, [1.9270842, 0.40634413, -0.084632133, 0.83166513], false),
    (
        [0.810502946, -0.217053846, -0.111244574, 0.563760579],
        -0.785821021,
        [0.80616187, -0.36870017, -0.099969363, 0.75718552],
        false,
    ),
    (
        [0.845777988, 0.812320828, -0.049394991, 1.194093347],
        -0.611949027,
        [0.86202441, 0.69357588, -0.025513124, 1.3574773],
        false,
    ),
    (
        [-0.481980771, 1.787603259, -0.04780985, 0.853031456],
        0.225035608,
        [-0.44622871, 1.8321559, -0.030749221, 0.77222813],
        false,
    ),
    ([1.940404296, 2.950060368, 0.089470498, 1.235375285], -0.694269955, [1.9994055, 2.8135296, 0.114178, 1.4656216], false),
    (
        [0.936717153, 2.085746288, -0.039509702, 0.213000163],
        -0.0410244949,
        [0.97843208, 2.0783066, -0.035249699, 0.21253809],
        false,
    ),
    (
        [2.017501116, -1.096332908, -0.03916619, -1.996320844],
        -0.159630924,
        [1.9955745, -1.1270681, -0.079092607, -1.9617654],
        false,
    ),
    ([0.578318894, 2.609766483, 0.169470638, -0.690600753], 0.977722049, [0.63051422, 2.7978443, 0.15565862, -0.91908976], false),
    (
        [-1.374230266, 1.939512134, -0.137096211, -0.379605383],
        -0.853053391,
        [-1.33544, 1.7752096, -0.14468832, -0.17564426],
        false,
    ),
    ([1.575371265, 1.972788453, -0.144084275, 0.108425908], -0.483716995, [1.614827, 1.88058, -0.14191576, 0.203091], false),
    (
        [-0.036186919, 0.31923604, -0.157495186, 1.457502246],
        -0.442607373,
        [-0.029802198, 0.23492188, -0.12834514, 1.5362958],
        false,
    ),
    (
        [-0.232657388, -2.656448364, -0.198901922, -1.219361901],
        -0.316649646,
        [-0.28578636, -2.7155735, -0.22328916, -1.1905151],
        true,
    ),
    ([1.883699059, 2.338369846, -0.007799593, -0.18096073], 0.333986074, [1.9304665, 2.4036492, -0.011418808, -0.2811698], false),
];
