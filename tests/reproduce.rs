//! `reproduce` on a tiny budget: cells are kept and not repeated, reports have intervals and say what is missing.
#![cfg(feature = "cli")]

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::SystemTime;

/// A learner that costs nothing, and few short evaluations.
const TINY: &str = "--budget 260 --runs 4 --seeds 2 --first-seed 5 --set learner.hidden=[4] --set learner.batch=4 \
                    --set learner.exploration.warm_up=50 --set training.evaluate_every=130 --set training.evaluation_runs=2";

fn reproduce(out: &Path, arguments: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ltl-rover"));
    command.current_dir(env!("CARGO_MANIFEST_DIR")).arg("reproduce").args(arguments.split_whitespace());
    command.arg("--out").arg(out).output().unwrap()
}

fn done(out: &Path, arguments: &str) -> String {
    let output = reproduce(out, arguments);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{arguments}: {said}");
    said
}

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("ltl-rover-reproduce-{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    folder
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Files of `folder/cells` with the times at which they were written.
fn cells(folder: &Path) -> Vec<(PathBuf, SystemTime)> {
    let entries = fs::read_dir(folder.join("cells")).unwrap().map(|e| e.unwrap());
    let mut found: Vec<_> = entries.map(|e| (e.path(), e.metadata().unwrap().modified().unwrap())).collect();
    found.sort();
    found
}

#[test]
fn finished_cells_are_kept_and_reports_have_intervals() {
    let out = folder("tables");
    let said = done(&out, &format!("table1 --task ball_pass_b1 --method modular,standard-ddpg {TINY}"));
    assert!(said.contains("4 cells to run, 0 kept"), "{said}");
    let first = cells(&out);
    assert_eq!(first.len(), 4);
    let cell: Value = serde_json::from_str(&text(&first[0].0)).unwrap();
    assert_eq!((&cell["task"], &cell["steps"], &cell["config"]["max_steps"]), (&"ball_pass_b1".into(), &260.into(), &200.into()));
    assert!(cell["training"]["wall"].as_f64().unwrap() > 0.0 && !cell["machine"].as_str().unwrap().is_empty());

    // One cell is lost, one contender comes in addition: two seeds of the one and one of the other are run.
    fs::remove_file(&first[3].0).unwrap();
    let said = done(&out, &format!("table1 --task ball_pass_b1 {TINY} --jobs 1"));
    assert!(said.contains("3 cells to run, 3 kept"), "{said}");
    let second = cells(&out);
    assert_eq!(second.len(), 6);
    assert!(first[..3].iter().all(|kept| second.contains(kept)), "finished cells are not written again");
    assert!(done(&out, &format!("table2 --task ball_pass_b1 {TINY}")).is_empty(), "both tables are made of the same cells");
    assert_eq!(cells(&out), second);

    let markdown = text(&out.join("table1.md"));
    let row = markdown.lines().find(|l| l.starts_with("| B1 | 200 | standard product |")).unwrap();
    assert!(row.contains('%') && row.contains('[') && row.contains("/2"), "{row}");
    assert!(markdown.contains("| C2 | 500 | standard DDPG | 61 % | not yet run |"), "{markdown}");
    // 0 of 4: Clopper and Pearson's upper end is 1 − 0.025^(1/4) = 60.2 %.
    assert!(markdown.contains("| 0/4 | [0, 60.2] |"), "{markdown}");
    assert!(!markdown.contains("| C2 | 500 | standard product"), "with one accepting set both products are the same");
    let table = text(&out.join("table1.csv"));
    assert_eq!(table.lines().count(), 1 + 6);
    let json: Value = serde_json::from_str(&text(&out.join("table1.json"))).unwrap();
    assert_eq!(json["rows"][0]["seeds"][1]["seed"], 6);
    assert_eq!(json["rows"][0]["ci95_bootstrap"]["high"], json["rows"][0]["ci95_bootstrap"]["low"], "both seeds are alike");
    assert!(text(&out.join("table1.svg")).starts_with("<svg"));
    let two = text(&out.join("table2.md"));
    assert!(two.contains("| B1 | modular DDPG | 12.1 min | 0/2 | never |"), "{two}");

    // A changed recipe is another cell.
    let changed = format!("table1 --task ball_pass_b1 --method modular {TINY} --set learner.n_step=2");
    assert!(done(&out, &format!("{changed} --report-only")).is_empty());
    assert!(text(&out.join("table1.md")).contains("| B1 | 200 | modular DDPG | 100 % | not yet run |"));
    assert_eq!(cells(&out), second);
    fs::remove_dir_all(out).unwrap();
}

#[test]
fn curves_ablation_and_trajectories_write_their_pictures() {
    let out = folder("pictures");
    done(&out, &format!("curves --task ball_pass_b2 {TINY}"));
    for file in ["ball_pass_b2-average-reward.svg", "ball_pass_b2-total-reward.svg"] {
        assert!(text(&out.join("curves").join(file)).contains("modular DDPG, 2 seeds"), "{file}");
    }
    assert!(text(&out.join("curves/README.md")).contains("![total-reward](ball_pass_b2-total-reward.svg)"));
    assert!(text(&out.join("curves/ball_pass_b2.csv")).lines().count() > 4);

    done(&out, &format!("ablation --task ball_pass_b1 --option n_step,counterfactual {TINY}"));
    let markdown = text(&out.join("ablation.md"));
    assert!(markdown.contains("| n_step | n_step = 10 | 1 | 0/2 | never |"), "{markdown}");

    fs::remove_dir_all(out).unwrap();
}

#[test]
fn what_cannot_be_is_refused_in_words() {
    let out = folder("refused");
    for (arguments, words) in [
        ("table1 --task ball_pass_b9", "there is no shipped task `ball_pass_b9`"),
        ("table1 --task ball_pass_b1 --preset quick", "there is no preset `quick`"),
        ("ablation --task ball_pass_b1 --option magic", "no option `magic`"),
        ("trajectories --task ball_pass_b1", "no map to draw on"),
        ("trajectories --task victoria --policies no/such/folder", "there is no policy of `victoria`"),
    ] {
        let output = reproduce(&out, arguments);
        let said = String::from_utf8_lossy(&output.stderr).replace('│', " ");
        let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(output.status.code(), Some(2), "{arguments}: {said}");
        assert!(said.contains(words), "{arguments}: {said}");
    }
    assert!(!out.exists(), "nothing is written");
}
