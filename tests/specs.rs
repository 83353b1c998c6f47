//! Every task in `specs/` opens and ticks, in each of its presets; what is wrong with a task is said at its place.

use ltl_rover::automaton::translate::translate;
use ltl_rover::automaton::{Ldgba, hoa};
use ltl_rover::env::map::RoverMap;
use ltl_rover::labels::Labels;
use ltl_rover::product::LetterMap;
use ltl_rover::task::{Override, Setup, Task, TaskError};
use std::fs;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("specs")
}

fn tasks() -> Vec<(String, String)> {
    let entries = fs::read_dir(folder()).unwrap().map(|e| e.unwrap().path());
    let mut found: Vec<(String, String)> = entries
        .filter(|p| p.extension().is_some_and(|e| e == "toml"))
        .map(|p| (p.file_name().unwrap().to_str().unwrap().to_owned(), fs::read_to_string(&p).unwrap()))
        .collect();
    found.sort();
    found
}

/// The task, on the map that it names.
fn with_its_map(name: &str, text: &str) -> Result<Task, TaskError> {
    let task = Task::parse(text, name)?;
    Ok(match task.map_file().and_then(|file| fs::read_to_string(folder().join(file)).ok()) {
        Some(map) => task.with_map(RoverMap::from_json(&map, None).unwrap()),
        None => task,
    })
}

fn open(name: &str, text: &str, preset: &str, overrides: &[Override]) -> Result<Setup, TaskError> {
    let task = with_its_map(name, text)?;
    let hoa = task.file().specification.hoa.as_ref().map(|file| fs::read_to_string(folder().join(file)).unwrap());
    Setup::open(task, preset, overrides, hoa.as_deref())
}

fn b1() -> String {
    fs::read_to_string(folder().join("ball_pass_b1.toml")).unwrap()
}

fn refusal(text: &str) -> TaskError {
    match open("task.toml", text, "fast", &[]) {
        Ok(_) => panic!("this should be refused:\n{text}"),
        Err(error) => error,
    }
}

#[test]
fn every_task_opens_and_ticks_in_every_preset() {
    let tasks = tasks();
    for wanted in ["ball_pass_b1.toml", "ball_pass_b2.toml", "cart_pole_c1.toml", "cart_pole_c2.toml"] {
        assert!(tasks.iter().any(|(name, _)| name == wanted), "{wanted} is missing");
    }
    for (name, text) in &tasks {
        let presets: Vec<String> = Task::parse(text, name).unwrap().presets().map(str::to_owned).collect();
        for wanted in ["paper", "fast"] {
            assert!(presets.iter().any(|p| p == wanted), "{name} has no preset `{wanted}`");
        }
        for preset in &presets {
            // Learning sooner than the recipe, so that its updates are seen as well.
            let small = ["learner.exploration.warm_up=20", "learner.batch=8", "learner.hidden=[8]"];
            let overrides = small.map(|o| o.parse().unwrap());
            let setup = open(name, text, preset, &overrides).unwrap_or_else(|e| panic!("{e}"));
            let mut trainer = setup.trainer(1);
            let ticks: Vec<_> = trainer.ticks().take(100).collect();
            assert!(ticks.iter().any(|t| t.update.is_some()), "{name} {preset} never learns");
            for pair in ticks.windows(2) {
                let ended = pair[0].end.is_some();
                assert_eq!(ended, pair[1].start.is_some(), "{name}: an episode starts where one has ended");
                assert!(ended || pair[0].product.to == pair[1].product.from, "{name}: embedded states are connected");
            }
        }
    }
}

#[test]
fn the_paper_presets_are_algorithm_2() {
    for (name, text) in tasks() {
        let setup = open(&name, &text, "paper", &[]).unwrap();
        let (p, l) = (&setup.preset().product, &setup.preset().learner);
        assert_eq!((p.accepting_discount, p.discount), (0.99, 0.9999), "{name}");
        assert_eq!((l.n_step, l.updates_per_step, l.counterfactual.samples), (1, 1, 0), "{name}");
        assert_eq!(l.exploration.hold_probability.range(), (0.0, 0.0), "{name}");
    }
}

#[test]
fn unknown_keys_are_refused_with_a_suggestion_and_their_line() {
    let error = refusal(&b1().replace("n_step = 10", "n_stp = 10"));
    assert_eq!(error.help(), Some("did you mean `n_step`?"));
    let line = 1 + b1().lines().position(|l| l == "n_step = 10").unwrap();
    assert_eq!(error.position().map(|p| p.0), Some(line), "{error}");
    let error = refusal(&b1().replace("frontier = \"refill\"", "frontier = \"refil\""));
    assert_eq!(error.help(), Some("did you mean `refill`?"));
    let error = refusal(&b1().replace("name = \"ball_pass\"", "name = \"ballpass\""));
    assert_eq!(error.help(), Some("did you mean `ball_pass`?"));
    assert_eq!(error.position().map(|p| p.0), Some(5), "{error}");
}

#[test]
fn values_outside_their_range_are_refused_at_their_line() {
    for (old, new) in [
        ("accepting_discount = 0.9\n", "accepting_discount = 1.0\n"),
        ("tau = 0.005", "tau = 0.0"),
        ("n_step = 10", "n_step = 0"),
        ("hidden = [64, 64]\nactor_rate = 1e-3", "hidden = []\nactor_rate = 1e-3"),
        ("batch = 64\nn_step = 10", "batch = 100000\nn_step = 10"),
    ] {
        assert!(b1().contains(old), "the test looks for {old}");
        let text = b1().replace(old, new);
        let error = refusal(&text);
        let key = new.lines().next().unwrap().split(' ').next().unwrap();
        assert!(error.message().contains(&format!("`{key}`")), "{error}");
        let (line, _) = error.position().unwrap();
        assert!(text.lines().nth(line - 1).unwrap().starts_with(key), "{error}");
    }
    assert!(refusal(&b1().replace("max_steps = 200", "max_steps = 0")).message().contains("max_steps"));
}

#[test]
fn a_disturbance_is_refused_where_there_is_none() {
    let error = refusal(&b1().replace("[presets.fast.training]", "[presets.fast.training]\ndisturbance = 1.5"));
    assert!(error.to_string().contains("nothing random disturbs a step of `ball_pass`"), "{error}");
    let (line, _) = error.position().unwrap();
    assert!(b1().lines().nth(line - 2).unwrap().starts_with("[presets.fast.training]"), "{error}");
    let error = refusal(&b1().replace("[presets.fast.training]", "[presets.fast.training]\ndisturbance = -1.0"));
    assert!(error.message().contains("`disturbance` is -1.0; allowed is 0 to 100"), "{error}");
}

#[test]
fn formulas_and_automata_are_refused_at_their_place() {
    let error = refusal(&b1().replace("G F r1 & G F r2", "G F r1 & G F (r2"));
    let (line, column) = error.position().unwrap();
    assert_eq!(line, 8, "{error}");
    assert!(column > "ltl = \"G F r1 ".len(), "{error}");
    let task = Task::parse(&b1(), "task.toml").unwrap();
    let Err(error) = Setup::open(task, "fast", &[], Some("HOA: v1\nStates: x\n--BODY--\n--END--\n")) else {
        panic!("no automaton")
    };
    assert_eq!((error.file(), error.position().map(|p| p.0)), ("ball_pass_b1.hoa", Some(2)), "{error}");
}

#[test]
fn overrides_change_what_they_name_and_nothing_else() {
    let parse = |o: &str| o.parse::<Override>().unwrap();
    let open = |o: &str| open("task.toml", &b1(), "fast", &[parse(o)]);
    let plain = open("learner.n_step=10").unwrap();
    let changed = open("learner.modules=one").unwrap();
    let mut expected = plain.preset().clone();
    expected.learner.modules = ltl_rover::agent::ModuleMap::One;
    assert_eq!(changed.preset(), &expected);
    let schedule = open("learner.actor_rate={ from = 1e-3, to = 1e-4, over = 100 }").unwrap();
    assert_eq!(schedule.preset().learner.actor_rate.at(100), 1e-4);
    for (wrong, said) in [
        ("learner.n_stp=3", "n_step"),
        ("learner.n_step=0", "n_step"),
        ("learner.n_step=three", "n_step"),
        ("learner.n_step.x=3", "no table"),
        ("lerner.n_step=3", "learner"),
    ] {
        let Err(error) = open(wrong) else { panic!("{wrong} should be refused") };
        assert!(error.to_string().contains(said), "{wrong}: {error}");
    }
    assert!("learner.n_step".parse::<Override>().is_err());
}

/// B1's recipe for another environment and formula.
fn elsewhere(environment: &str, ltl: &str) -> String {
    let b1 = b1();
    let hoa = b1.lines().find(|line| line.starts_with("hoa = ")).unwrap();
    b1.replace("name = \"ball_pass\"", environment).replace("G F r1 & G F r2", ltl).replace(hoa, "hoa = \"own.hoa\"")
}

const GF_GREEN: &str =
    "HOA: v1\nStates: 1\nStart: 0\nAP: 1 \"green\"\nAcceptance: 1 Inf(0)\n--BODY--\nState: 0\n[0] 0 {0}\n[!0] 0\n--END--\n";

fn green(environment: &str, prepare: impl FnOnce(Task) -> Task) -> Result<Setup, TaskError> {
    let task = prepare(Task::parse(&elsewhere(environment, "G F green"), "task.toml")?);
    Setup::open(
        task,
        "fast",
        &["learner.batch=8".parse().unwrap(), "learner.exploration.warm_up=20".parse().unwrap()],
        Some(GF_GREEN),
    )
}

#[test]
fn environments_take_only_their_own_options() {
    for (environment, line, said) in [
        ("name = \"rover\"", 5, "needs a map"),
        ("name = \"rover\"\nmap = \"mela\"", 6, "did you mean `melas`?"),
        ("name = \"cart_pole\"\nmap = \"melas\"", 6, "only `rover` has a map"),
        ("name = \"rover\"\nmap = \"melas\"\ncurrent = \"at_a\"", 7, "only `islands` has a current"),
        ("name = \"islands\"\ncurrent = \"at_c\"", 6, "unknown variant `at_c`"),
    ] {
        let Err(error) = green(environment, |task| task) else { panic!("{environment} should be refused") };
        assert!(error.to_string().contains(said), "{error}");
        assert_eq!(error.position().map(|p| p.0), Some(line), "{error}");
    }
    let environment = |section: &str| {
        let task = Task::parse(&elsewhere(section, "G F a"), "task.toml").unwrap();
        task.environment().unwrap().spec().propositions.iter().collect::<Vec<_>>().join(" ")
    };
    assert_eq!(environment("name = \"rover\"\nmap = \"melas\""), "m1 m2 unsafe");
    assert_eq!(environment("name = \"islands\"\ncurrent = \"at_b\""), "a b");
}

#[test]
fn a_map_of_ones_own_goes_with_the_checkpoint() {
    let pixel = |i: usize| if i % 20 < 3 { [0, 255, 0, 255] } else { [255; 4] };
    let picture = ltl_rover::env::map::Picture { width: 20, height: 10, pixels: (0..200).map(pixel).collect() };
    let map = ltl_rover::env::map::RoverMap::from_picture("own", &picture).unwrap();
    let section = "name = \"rover\"\nmap = \"own.png\"";
    let task = Task::parse(&elsewhere(section, "G F green"), "task.toml").unwrap();
    assert_eq!(task.map_file(), Some("own.png"));
    let setup = green(section, |task| task.with_map(map)).unwrap();
    let mut run = setup.run(3);
    for _ in 0..60 {
        run.advance();
    }
    let saved = run.save(&setup.origin(), ltl_rover::agent::Replays::Keep);
    let checkpoint = ltl_rover::train::Checkpoint::read(&saved).unwrap();
    let again = Setup::from_checkpoint(&checkpoint).unwrap();
    let mut resumed = again.resume(&checkpoint).unwrap();
    for _ in 0..60 {
        run.advance();
        resumed.advance();
    }
    assert!(
        resumed.save(&again.origin(), ltl_rover::agent::Replays::Keep)
            == run.save(&setup.origin(), ltl_rover::agent::Replays::Keep)
    );
}

#[test]
fn an_automaton_of_another_formula_is_refused_with_a_word() {
    let b1 = fs::read_to_string(folder().join("ball_pass_b1.hoa")).unwrap();
    let text = fs::read_to_string(folder().join("ball_pass_b2.toml")).unwrap();
    let Err(error) = Setup::open(Task::parse(&text, "task.toml").unwrap(), "fast", &[], Some(&b1)) else { panic!("they differ") };
    assert!(error.message().contains("cycle{"), "{error}");
    let line = 1 + text.lines().position(|l| l.starts_with("hoa")).unwrap();
    assert_eq!(error.position().map(|p| p.0), Some(line), "{error}");
}

#[test]
fn without_a_file_the_formula_is_translated() {
    for (name, text) in tasks() {
        let text: String = text.lines().filter(|l| !l.starts_with("hoa = ")).map(|l| format!("{l}\n")).collect();
        let setup = open(&name, &text, "fast", &[]).unwrap_or_else(|e| panic!("{e}"));
        assert!(setup.automaton().len() > 1, "{name}");
    }
}

/// 200 runs say something only where they differ.
#[test]
fn evaluations_start_in_places_of_their_own() {
    use ltl_rover::eval::RolloutSettings;
    use ltl_rover::product::Start;
    for (name, text) in tasks() {
        let setup = open(&name, &text, "fast", &[]).unwrap();
        let starts = |settings: RolloutSettings| {
            let places: Vec<Vec<u32>> = (0..20)
                .map(|seed| {
                    setup.rollout_under(settings, seed).product().environment().state().iter().map(|x| x.to_bits()).collect()
                })
                .collect();
            let different = places.iter().enumerate().filter(|(i, place)| !places[..*i].contains(place)).count();
            (different, places)
        };
        let task = setup.rollout_settings();
        assert_eq!(starts(task).0, 20, "{name}");
        let initial = RolloutSettings { start: Start::Initial, ..task };
        assert_eq!(starts(initial).0, if name.starts_with("ball_pass") { 1 } else { 20 }, "{name}");
        assert_eq!(starts(initial).1, starts(initial).1, "{name}: the same seed gives the same start");
    }
}

/// Both automata are the same but for the numbers and names of their states, as far as `letters` can tell.
fn same_but_for_numbers(one: &Ldgba, other: &Ldgba, letters: &[Labels]) -> bool {
    let mut partner = std::collections::HashMap::from([(one.initial(), other.initial())]);
    let mut open = vec![one.initial()];
    while let Some(q) = open.pop() {
        let p = partner[&q];
        // ε-jumps correspond in their order.
        let jumps = one.epsilon(q).iter().copied().zip(other.epsilon(p).iter().copied());
        let mut pairs: Vec<_> = jumps.collect();
        let mut same = one.epsilon(q).len() == other.epsilon(p).len();
        for sigma in letters {
            let (left, right) = (one.edge(q, *sigma), other.edge(p, *sigma));
            same &= left.marks == right.marks;
            pairs.push((left.target, right.target));
        }
        for (left, right) in pairs {
            let known = partner.get(&left).copied();
            same &= known.is_none_or(|known| known == right);
            if known.is_none() {
                partner.insert(left, right);
                open.push(left);
            }
        }
        if !same {
            return false;
        }
    }
    let images: std::collections::HashSet<_> = partner.values().collect();
    one.sets() == other.sets() && images.len() == partner.len() && (partner.len(), partner.len()) == (one.len(), other.len())
}

#[test]
fn the_shipped_automata_are_the_translations() {
    for (name, text) in tasks() {
        let task = with_its_map(&name, &text).unwrap();
        let Some(hoa_name) = task.file().specification.hoa.clone() else { continue };
        let shipped = hoa::read(&fs::read_to_string(folder().join(hoa_name)).unwrap()).unwrap().automaton;
        let environment = task.environment().unwrap();
        let spec = environment.spec();
        let names = task.formula().propositions();
        let exclusive = ltl_rover::task::exclusive(&names, spec, &task.file().specification.labels);
        let translated = translate(task.formula(), &ltl_rover::task::options(exclusive)).unwrap();
        assert_eq!(translated.propositions(), shipped.propositions(), "{name}");
        let map = LetterMap::new(shipped.propositions(), spec, &task.file().specification.labels).unwrap();
        let letters: Vec<Labels> = spec.letters.iter().map(|letter| map.letter(*letter)).collect();
        assert!(same_but_for_numbers(&translated, &shipped, &letters), "{name}\n{}\n{}", translated.dot(), shipped.dot());
    }
}
