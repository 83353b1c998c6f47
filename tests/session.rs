//! The session as a shell uses it: opened, described, advanced, read, rolled out, evaluated, driven, saved and restored.

use ltl_rover::agent::Replays;
use ltl_rover::session::{Layout, OpenRequest, Session, Subject, ValueMapRequest, builtin_tasks, check_formula, check_hoa};

fn request(task: &str) -> OpenRequest {
    OpenRequest { task: task.into(), seed: 7, ..OpenRequest::default() }
}

fn open(task: &str) -> Session {
    Session::open(&request(task)).unwrap_or_else(|e| panic!("{task}: {e}"))
}

/// A session with small networks that learn early: what is tested here does not depend on how well they learn.
fn small(request: OpenRequest, overrides: &[(&str, &str)]) -> Session {
    let small = [("learner.hidden", "[8, 8]"), ("learner.exploration.warm_up", "100")];
    let overrides = small.iter().chain(overrides).map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    let task = request.task.clone();
    Session::open(&OpenRequest { overrides, ..request }).unwrap_or_else(|e| panic!("{task}: {e}"))
}

fn light(task: &str) -> Session {
    small(request(task), &[("training.evaluate_every", "150")])
}

/// The numbers of field `name` in a frame.
fn field<'a>(layout: &Layout, frame: &'a [f32], name: &str) -> &'a [f32] {
    let field = layout.fields.iter().find(|f| f.name == name).unwrap_or_else(|| panic!("no field {name}"));
    &frame[field.offset..field.offset + field.length]
}

#[test]
fn every_built_in_task_opens_is_described_and_moves() {
    for entry in builtin_tasks() {
        for preset in &entry.presets {
            let mut session = Session::open(&OpenRequest { preset: Some(preset.clone()), ..request(&entry.name) })
                .unwrap_or_else(|e| panic!("{} {preset}: {e}", entry.name));
            let description = session.describe();
            assert_eq!((description.task.name.as_str(), &description.task.preset), (entry.name.as_str(), preset));
            assert_eq!(description.environment.name, entry.environment);
            assert!(!description.hoa.is_empty() && !description.settings.is_empty());
            let layout = description.layout;
            let mut next = 0;
            for f in &layout.fields {
                assert_eq!(f.offset, next, "{}: fields follow each other without gaps", f.name);
                next += f.length;
            }
            assert_eq!(session.frame().len(), layout.length);
            assert_eq!(session.advance(30), 30);
            let frame = session.frame();
            // Of 30 moves, ε-moves are no steps of the environment.
            let step = field(&layout, &frame, "step")[0];
            assert!(step == 30.0 || entry.name == "islands" && (1.0..30.0).contains(&step), "{}: {step}", entry.name);
            assert!(frame.iter().all(|x| x.is_finite()), "{}: every number of a frame is finite", entry.name);
            let edge = &description.automaton.edges[field(&layout, &frame, "edge")[0] as usize];
            assert_eq!(
                [f32::from(edge.from), f32::from(edge.to)],
                [field(&layout, &frame, "q_before")[0], field(&layout, &frame, "q")[0]]
            );
            assert!(serde_json::to_value(session.describe()).is_ok());
        }
    }
}

#[test]
fn reward_parts_add_up_and_a_round_is_seen_once() {
    let mut session = light("ball_pass_b1");
    let layout = session.describe().layout;
    let one = |frame: &[f32], name: &str| field(&layout, frame, name)[0];
    let (mut total, mut rounds) = (0.0, 0.0);
    for _ in 0..600 {
        session.advance(1);
        let frame = session.frame();
        let parts = ["accepting_reward", "sink_reward", "shaping_reached", "shaping_left"].map(|name| one(&frame, name));
        assert!((parts.iter().sum::<f32>() - one(&frame, "reward")).abs() < 1e-6);
        if one(&frame, "episode_step") == 1.0 {
            (total, rounds) = (0.0, 0.0);
        }
        total += one(&frame, "accepting_reward");
        rounds += one(&frame, "closes_round");
        assert!((total - one(&frame, "return")).abs() < 1e-5);
        assert!(rounds <= one(&frame, "rounds"));
        assert_eq!(one(&frame, "end") > 0.0, one(&frame, "end") == 2.0 || one(&frame, "discount") == 0.0);
    }
}

#[test]
fn a_rollout_does_not_disturb_training() {
    let (mut watched, mut alone) = (light("ball_pass_b1"), light("ball_pass_b1"));
    for k in 0..6 {
        watched.rollout(k);
        watched.begin_drive(k);
        watched.begin_evaluation(2).unwrap();
        while watched.advance_evaluation(50) {}
        watched.advance(100);
        alone.advance(100);
    }
    assert_eq!(watched.frame(), alone.frame());
}

#[test]
fn a_trace_is_an_episode_from_start_to_end() {
    let mut session = open("cart_pole_c1");
    let layout = session.describe().layout;
    let trace = session.rollout(3);
    assert_eq!(trace.data.len(), trace.rows * layout.length);
    assert_eq!(session.rollout(3), trace, "the same index gives the same episode");
    assert_ne!(session.rollout(4).data, trace.data);
    for (row, frame) in trace.data.chunks(layout.length).enumerate() {
        assert_eq!(field(&layout, frame, "source"), [1.0]);
        assert_eq!(field(&layout, frame, "episode_step"), [row as f32]);
        assert_eq!(field(&layout, frame, "end")[0] > 0.0, row + 1 == trace.rows);
    }
    let last = &trace.data[(trace.rows - 1) * layout.length..];
    assert_eq!(field(&layout, last, "rounds"), [trace.rounds as f32]);
}

#[test]
fn a_checkpoint_goes_on_bit_by_bit_with_its_curves() {
    let mut session = light("ball_pass_b1");
    session.advance(320);
    let bytes = session.save(Replays::Keep);
    let mut again = Session::restore(&bytes).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(again.curves(), session.curves());
    assert_eq!(again.describe().seed, 7);
    session.advance(200);
    again.advance(200);
    assert_eq!(again.frame(), session.frame());
    assert_eq!(again.rollout(0), session.rollout(0));
    let small = session.save(Replays::Leave);
    assert!(small.len() < bytes.len());
    assert_eq!(Session::restore(&small).unwrap().steps(), session.steps());
    let policy = session.save_policy();
    assert!(policy.len() < small.len());
    assert_eq!(Session::restore(&policy).unwrap().steps(), 0);
}

#[test]
fn bytes_that_are_no_checkpoint_are_refused() {
    let bytes = open("ball_pass_b1").save(Replays::Leave);
    for wrong in [&b""[..], b"not a checkpoint at all", &bytes[..bytes.len() / 2], &bytes[..8]] {
        assert_eq!(Session::restore(wrong).err().expect("this is no checkpoint").subject, Subject::Checkpoint);
    }
}

#[test]
fn an_evaluation_in_slices_counts_every_run_once() {
    let mut session = open("ball_pass_b1");
    assert!(session.begin_evaluation(0).is_err() && session.begin_evaluation(u32::MAX).is_err());
    assert!(session.evaluation().is_none());
    session.begin_evaluation(12).unwrap();
    let mut last = 0;
    while session.advance_evaluation(7) {
        let now = session.evaluation().unwrap();
        assert!(now.runs >= last && now.low <= now.high);
        last = now.runs;
    }
    let done = session.evaluation().unwrap();
    assert_eq!((done.wanted, done.runs, done.seed), (12, 12, 7));
}

#[test]
fn a_driven_episode_obeys_the_controls_and_ends() {
    let mut session = open("ball_pass_b1");
    let layout = session.describe().layout;
    assert!(session.drive(&[0.0, 0.0], None).is_err(), "no episode was begun");
    let start = session.begin_drive(1);
    assert_eq!(field(&layout, &start, "source"), [2.0]);
    assert!(session.drive(&[0.0], None).is_err());
    assert!(session.drive(&[0.0, 0.0], Some(1)).is_err(), "there are no ε-jumps here");
    let mut frame = start;
    for _ in 0..300 {
        frame = session.drive(&[1.0, 1.0], None).unwrap();
    }
    assert_eq!(field(&layout, &frame, "action"), [1.0, 1.0]);
    assert_eq!(field(&layout, &frame, "end"), [1.0], "the ball has left the arena");
    assert_eq!(session.drive(&[0.0, 0.0], None).unwrap(), frame, "what is over stays as it is");
}

#[test]
fn refusals_name_the_text_and_the_place() {
    let refused = |request: OpenRequest| Session::open(&request).err().expect("this is refused");
    let unknown = refused(request("ball_pass_b9"));
    assert!(unknown.subject == Subject::Task && unknown.message.contains("ball_pass_b1"));
    let formula = refused(OpenRequest { formula: Some("G F (r1 &".into()), ..request("ball_pass_b1") });
    assert_eq!((formula.subject, formula.place.start), (Subject::Formula, 9));
    let hoa = refused(OpenRequest { hoa: Some("HOA: v1\nStates: x".into()), ..request("ball_pass_b1") });
    assert_eq!((hoa.subject, hoa.place.line), (Subject::Hoa, 2));
    assert_eq!(refused(OpenRequest { preset: Some("fats".into()), ..request("ball_pass_b1") }).hint, "did you mean `fast`?");
    let wrong = OpenRequest { overrides: [("learner.n_stp".to_owned(), "3".to_owned())].into(), ..request("ball_pass_b1") };
    assert_eq!(refused(wrong).subject, Subject::Task);
    assert_eq!(check_hoa("HOA: v2").unwrap_err().subject, Subject::Hoa);
    assert!(check_formula("G F r1", &[]).is_ok());
}

#[test]
fn a_formula_of_ones_own_is_translated_and_an_automaton_is_held_against_it() {
    let own = OpenRequest { formula: Some("F (r2 & X F r1) & G !(r1 & r2)".into()), ..request("ball_pass_b1") };
    let mut session = Session::open(&own).unwrap_or_else(|e| panic!("{e}"));
    assert!(session.describe().hoa.starts_with("HOA: v1"));
    session.advance(20);
    let shipped = open("ball_pass_b1").describe().hoa;
    let same = OpenRequest { formula: Some("G F r2 & G F r1".into()), hoa: Some(shipped.clone()), ..request("ball_pass_b1") };
    assert!(Session::open(&same).is_ok());
    let other = OpenRequest { formula: Some("F G r1".into()), hoa: Some(shipped), ..request("ball_pass_b1") };
    let refusal = Session::open(&other).err().expect("they differ");
    assert!(refusal.subject == Subject::Hoa && refusal.message.contains("cycle{"), "{refusal}");
    let strange = OpenRequest { formula: Some("G F r9".into()), ..request("ball_pass_b1") };
    let refusal = Session::open(&strange).err().expect("there is no r9");
    assert!(refusal.subject == Subject::Formula && refusal.message.contains("r9"), "{refusal:?}");
}

#[test]
fn an_override_is_in_force() {
    let changed = OpenRequest { overrides: [("learner.n_step".to_owned(), "3".to_owned())].into(), ..request("ball_pass_b1") };
    let description = Session::open(&changed).unwrap().describe();
    let setting = description.settings.iter().find(|s| s.key == "learner.n_step").unwrap();
    assert_eq!(setting.value, "3");
    assert!(description.settings.iter().any(|s| s.key == "learner.tau" && s.value == "0.005"), "an f32 is shown as it was meant");
}

#[test]
fn a_value_map_is_the_critic_over_the_plane_of_the_body() {
    for (task, axes) in [("ball_pass_b1", [0, 1]), ("cart_pole_c1", [0, 2]), ("melas", [0, 1])] {
        let mut session = light(task);
        let request = ValueMapRequest { q: 0, frontier: 3, columns: 7, rows: 5 };
        let before = session.frame();
        let map = session.value_map(&request).unwrap_or_else(|e| panic!("{task}: {e}"));
        assert_eq!(map.axes.each_ref().map(|a| a.channel), axes, "{task}");
        assert!(map.axes.iter().all(|a| a.low < a.high));
        assert_eq!((map.values.len(), map.controls.len() % 35), (35, 0));
        assert!(map.values.iter().all(|v| v.is_finite()) && map.controls.iter().all(|u| (-1.0..=1.0).contains(u)));
        assert!(map.values.iter().any(|v| v != &map.values[0]), "{task}: the network sees where it is");
        assert_eq!(session.frame(), before, "looking changes nothing");
        assert_eq!(session.value_map(&request).unwrap(), map);
        let of =
            |session: &mut Session, frontier| session.value_map(&ValueMapRequest { frontier, ..request.clone() }).unwrap().values;
        assert_ne!(of(&mut session, 1), of(&mut session, 2), "{task}: it matters which set is still to be visited");
        for wrong in [
            ValueMapRequest { columns: 0, ..request.clone() },
            ValueMapRequest { rows: usize::MAX, ..request.clone() },
            ValueMapRequest { q: 999, ..request.clone() },
        ] {
            assert_eq!(session.value_map(&wrong).unwrap_err().subject, Subject::Session);
        }
    }
}

#[test]
fn a_policy_file_keeps_what_its_critics_think() {
    let mut session = light("ball_pass_b1");
    session.advance(140);
    let request = ValueMapRequest { q: 0, frontier: 3, columns: 4, rows: 4 };
    let map = session.value_map(&request).unwrap();
    let mut shown = Session::restore(&session.save_policy()).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(shown.value_map(&request).unwrap(), map);
    let shipped = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/policies/ball_pass_b1.safetensors")).unwrap();
    match Session::restore(&shipped).unwrap().value_map(&request) {
        Ok(map) => assert!(map.values.iter().any(|v| *v > 0.01), "a trained critic expects something"),
        Err(refusal) => assert!(refusal.message.contains("without its critics"), "{refusal}"),
    }
}

#[test]
fn an_episode_begins_where_it_is_told() {
    let mut session = light("ball_pass_b1");
    let layout = session.describe().layout;
    let trace = session.rollout_from(0, &[120.0, 480.0, 0.0, 0.0]).unwrap();
    assert_eq!(field(&layout, &trace.data[..layout.length], "state"), [120.0, 480.0, 0.0, 0.0]);
    let outside = session.rollout_from(0, &[1e9, f32::NAN, 0.0, 0.0]).unwrap();
    assert!(outside.data.iter().all(|x| x.is_finite()), "a state outside is brought inside");
    assert_eq!(session.rollout_from(0, &[1.0]).unwrap_err().subject, Subject::Session);
}

#[test]
fn losses_are_kept_by_module() {
    let mut session = light("ball_pass_b1");
    session.advance(1500);
    let curves = session.curves();
    assert_eq!(curves.modules.len(), session.describe().modules.len());
    assert!(curves.modules.iter().all(|m| m.len() == curves.episode.len()));
    assert!(curves.modules.iter().flatten().flatten().any(|loss| *loss > 0.0), "some module was updated");
}

#[test]
fn training_stands_still_where_its_recipe_ends() {
    // What always holds is satisfied by every policy, so the first evaluation finds no failure.
    let always = OpenRequest { formula: Some("G F (m1 | !m1)".to_owned()), ..request("melas") };
    let mut learned = small(always, &[("training.evaluate_every", "150"), ("training.evaluation_runs", "3")]);
    assert_eq!((learned.best(), learned.finished()), (None, false));
    let mut made = 0;
    while !learned.finished() {
        made += learned.advance(10_000);
    }
    assert_eq!((made, learned.steps(), learned.first_perfect_step()), (150, 150, Some(150)));
    let best = learned.best().expect("it was evaluated");
    assert_eq!((best.step, best.runs, best.successes), (150, 3, 3));
    let layout = learned.describe().layout;
    let states = |session: &mut Session| -> Vec<f32> {
        session.rollout(0).data.chunks(layout.length).flat_map(|frame| field(&layout, frame, "state").to_vec()).collect()
    };
    let mut kept = Session::restore(&learned.save_policy()).unwrap_or_else(|e| panic!("{e}"));
    assert!(states(&mut kept) == states(&mut learned), "the best policy is the present one");
    assert_eq!(learned.advance(40), 40, "whoever wants more gets it");
    let mut spent = small(request("ball_pass_b1"), &[("training.steps", "130"), ("training.evaluate_every", "0")]);
    assert_eq!((spent.advance(10_000), spent.finished()), (130, true));
    assert_eq!((spent.advance(20), spent.best()), (20, None));
}
