//! The program as a user meets it: examples in every help text, exit codes, a reader that leaves early.
#![cfg(feature = "cli")]

use std::process::{Command, Output, Stdio};

const COMMANDS: &[&str] =
    &["check", "classify", "translate", "train", "eval", "run", "replay", "plot", "reproduce", "bench", "schema"];

fn ltl_rover(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ltl-rover"));
    command.current_dir(env!("CARGO_MANIFEST_DIR")).args(arguments).output().unwrap()
}

#[test]
fn every_command_explains_itself_with_an_example() {
    for command in COMMANDS {
        let help = String::from_utf8(ltl_rover(&[command, "--help"]).stdout).unwrap();
        assert!(help.contains(&format!("ltl-rover {command}")), "{command}: no example in its help");
    }
}

#[test]
fn wrong_input_ends_with_2_and_names_its_place() {
    let cases: &[(&[&str], &[&str])] = &[
        (&["translate", "G F (a"], &["never closed", "formula:1:5"]),
        (&["check", "G U a"], &["formula:1:"]),
        (&["train", "specs/none.toml"], &["specs/none.toml"]),
        (&["train", "specs/ball_pass_b1.toml", "--set", "learner.batchh=3"], &["learner.batchh", "did you mean `batch`"]),
        (&["train", "specs/ball_pass_b1.toml", "--set", "learner.batch=-3"], &["learner.batch", "a whole number"]),
        (&["train", "specs/ball_pass_b1.toml", "--preset", "quick"], &["quick", "fast"]),
        (&["eval", "no/such/run"], &["no/such/run"]),
    ];
    for (arguments, words) in cases {
        let done = ltl_rover(arguments);
        // Long lines are broken where the terminal ends.
        let said = String::from_utf8(done.stderr).unwrap().replace('│', " ").split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(done.status.code(), Some(2), "{arguments:?}: {said}");
        for word in *words {
            assert!(said.contains(word), "{arguments:?}: no `{word}` in {said}");
        }
    }
}

#[test]
fn a_reader_that_leaves_early_ends_the_program_without_a_word() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_ltl-rover"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["schema"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let done = child.wait_with_output().unwrap();
    assert_eq!(String::from_utf8(done.stderr).unwrap(), "");
    assert!(done.status.success());
}

#[test]
fn eval_writes_a_row_for_every_episode() {
    let file = std::env::temp_dir().join(format!("ltl-rover-episodes-{}.csv", std::process::id()));
    let policy = "assets/policies/ball_pass_b1.safetensors";
    let done = ltl_rover(&["eval", policy, "--runs", "3", "--max-steps", "20", "--json", "--episodes", file.to_str().unwrap()]);
    let table = std::fs::read_to_string(&file).unwrap();
    std::fs::remove_file(&file).unwrap();
    let summed: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    let mut lines = table.lines();
    assert_eq!(
        lines.next().unwrap(),
        "episode,start x,start y,start velocity x,start velocity y,success,rounds,first_round_steps,steps,sink,total_reward"
    );
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 3);
    let successes = rows.iter().filter(|row| row[5] == "true").count();
    assert_eq!(summed["successes"], successes);
    assert!(rows.iter().enumerate().all(|(k, row)| row[0] == k.to_string() && row[1].parse::<f32>().unwrap() >= 0.0));
}
