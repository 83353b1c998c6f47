//! The command `check` as a user meets it: exit codes, summaries, places of errors, JSON.
#![cfg(feature = "cli")]

use serde_json::Value;
use std::io::Write as _;
use std::process::{Command, Output, Stdio};

fn check(arguments: &[&str], input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_ltl-rover"))
        .arg("check")
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A command that never reads its input may have closed it already.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

fn code(output: &Output) -> i32 {
    output.status.code().unwrap()
}

fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

const UNTIL: &str = "specs/corpus/hoa/ok/until.hoa";
const RABIN: &str = "specs/corpus/hoa/err/rabin.hoa";

#[test]
fn a_usable_automaton_is_summed_up() {
    let done = check(&[UNTIL], "");
    assert_eq!(code(&done), 0);
    let text = out(&done);
    assert!(text.contains("3 states (1 sink), 1 accepting set on edges, deterministic, 5 edges"), "{text}");
    assert!(text.contains("name: a U b") && text.contains("propositions: a, b"), "{text}");
}

#[test]
fn an_unusable_one_is_refused_at_its_place() {
    let done = check(&[RABIN], "");
    assert_eq!(code(&done), 2);
    let text = err(&done);
    assert!(text.contains("not generalised") && text.contains("rabin.hoa:5:15"), "{text}");

    let done = check(&[RABIN, "--json"], "");
    let object: Value = serde_json::from_str(&out(&done)).unwrap();
    assert_eq!((code(&done), &object["ok"], &object["kind"]), (2, &Value::Bool(false), &"acceptance".into()));
    assert_eq!((&object["line"], &object["column"]), (&5.into(), &15.into()));
}

#[test]
fn a_formula_is_held_against_the_automaton_in_either_order() {
    for arguments in [&["a U b", UNTIL][..], &[UNTIL, "--formula", "a U b"], &[UNTIL, "a U b"]] {
        let done = check(arguments, "");
        assert_eq!(code(&done), 0, "{}", err(&done));
        assert!(out(&done).contains("matches the formula"), "{}", out(&done));
    }
    let done = check(&["a W b", UNTIL, "--json"], "");
    let object: Value = serde_json::from_str(&out(&done)).unwrap();
    assert_eq!((code(&done), &object["counter_example"]["text"]), (1, &"cycle{{a}}".into()));
    let done = check(&["a U (b", UNTIL], "");
    assert!(code(&done) == 2 && err(&done).contains("never closed"), "{}", err(&done));
}

#[test]
fn streams_are_read_to_their_end() {
    let good = std::fs::read_to_string(format!("{}/{UNTIL}", env!("CARGO_MANIFEST_DIR"))).unwrap();
    let done = check(&["-"], &format!("{good}HOA: v1 --ABORT--\n{good}"));
    assert_eq!((code(&done), out(&done).matches("3 states").count()), (0, 2));
    let done = check(&["-"], &format!("{good}HOA: v1 Start: x --END--\n{good}"));
    assert_eq!((code(&done), out(&done).matches("3 states").count()), (2, 2));
    assert_eq!(code(&check(&["-"], "HOA: v1 --ABORT--")), 2);
    assert_eq!(code(&check(&["-"], "")), 2);
    assert_eq!(code(&check(&["no-such-file.hoa"], "")), 2);
}

#[test]
fn other_forms_are_written() {
    let done = check(&[UNTIL, "--to", "hoa-states"], "");
    let text = out(&done);
    assert!(text.starts_with("HOA: v1\nname: \"a U b\"\n") && text.contains("state-acc"), "{text}");
    assert_eq!(code(&check(&["-", "a U b"], &text)), 0);
    assert!(out(&check(&[UNTIL, "--to", "dot"], "")).starts_with("digraph {"));
    let graph: Value = serde_json::from_str(&out(&check(&[UNTIL, "--to", "graph"], ""))).unwrap();
    assert_eq!(graph["states"].as_array().unwrap().len(), 3);
}
