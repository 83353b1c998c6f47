//! The house rules that a compiler does not check: imports point down only, every file says what it is, none grows too long.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The floors, from the ground up. A module imports only from floors below its own; inside a module, siblings are free.
const FLOORS: &[&[&str]] = &[
    &["labels", "rng", "bib", "bdd"],
    &["ltl", "env", "nn"],
    &["automaton"],
    &["product", "finite"],
    &["agent"],
    &["eval"],
    &["train"],
    &["task"],
    &["session"],
    &["cli", "wasm"],
    &["main", "lib"],
];

/// Files of more than [`LONG`] lines, each with its reason.
const LONG_FOR_A_REASON: &[(&str, &str)] = &[];
const LONG: usize = 400;

/// Words that name no concept and so may name no file.
const REFUSED_NAMES: &[&str] = &["util", "utils", "common", "helper", "helpers", "misc"];

/// What only the shells on the top floors may touch: clocks, files, the process's environment, threads.
const SHELL_ONLY: &[&str] = &["std::time", "std::fs", "std::env", "std::thread", "std::net", "Instant::now", "SystemTime"];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(rust_files(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// Every source file: its path below `src`, its top-level module, its text without comments.
fn sources() -> Vec<(String, String, String)> {
    let src = root().join("src");
    let read = |path: PathBuf| {
        let name = path.strip_prefix(&src).unwrap().to_str().unwrap().replace('\\', "/");
        let module = name.split('/').next().unwrap().trim_end_matches(".rs").to_owned();
        let text = fs::read_to_string(&path).unwrap();
        let code: String = text.lines().map(|l| l.split("//").next().unwrap().to_owned() + "\n").collect();
        (name, module, code)
    };
    rust_files(&src).into_iter().map(read).collect()
}

/// The top-level modules of this crate that `code` names in paths, `use crate::{a, b::c}` included.
fn imports(code: &str) -> Vec<String> {
    let mut found = Vec::new();
    let word = |s: &str| s.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    for prefix in ["crate::", "ltl_rover::"] {
        for (at, _) in code.match_indices(prefix) {
            if code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_') {
                continue;
            }
            let rest = &code[at + prefix.len()..];
            let Some(group) = rest.strip_prefix('{') else {
                found.push(word(rest));
                continue;
            };
            let mut depth = 0;
            let mut start = true;
            for (i, c) in group.char_indices() {
                match c {
                    '{' => depth += 1,
                    '}' if depth == 0 => break,
                    '}' => depth -= 1,
                    ',' if depth == 0 => start = true,
                    c if c.is_whitespace() => {}
                    _ if start && depth == 0 => {
                        found.push(word(&group[i..]));
                        start = false;
                    }
                    _ => {}
                }
            }
        }
    }
    found
}

#[test]
fn imports_point_down_only() {
    let floor: BTreeMap<&str, usize> =
        FLOORS.iter().enumerate().flat_map(|(i, modules)| modules.iter().map(move |m| (*m, i))).collect();
    let mut faults = Vec::new();
    for (name, module, code) in sources() {
        let Some(&own) = floor.get(module.as_str()) else {
            faults.push(format!("src/{name}: the module `{module}` stands on no floor of the table"));
            continue;
        };
        for target in imports(&code) {
            if target != module && floor.get(target.as_str()).is_some_and(|&other| other >= own) {
                faults.push(format!("src/{name} (floor {own}) imports `{target}` (floor {})", floor[target.as_str()]));
            }
        }
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn files_import_siblings_not_their_own_mod_rs() {
    let mut faults = Vec::new();
    for (name, module, code) in sources() {
        let inside = name.contains('/') && !name.ends_with("mod.rs");
        if inside && code.contains(&format!("use crate::{module}::{{")) {
            faults.push(format!("src/{name} imports through its own mod.rs; name the sibling file"));
        }
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn every_file_says_what_it_is_and_stays_short() {
    let mut faults = Vec::new();
    for folder in ["src", "tests", "benches"] {
        if !root().join(folder).is_dir() {
            continue;
        }
        for path in rust_files(&root().join(folder)) {
            let text = fs::read_to_string(&path).unwrap();
            let name = path.strip_prefix(root()).unwrap().to_str().unwrap().replace('\\', "/");
            if !text.starts_with("//! ") {
                faults.push(format!("{name}: the first line is no `//!` sentence"));
            }
            let lines = text.lines().count();
            let excused = LONG_FOR_A_REASON.iter().any(|(file, _)| *file == name);
            if lines > LONG && !excused {
                faults.push(format!("{name}: {lines} lines, more than {LONG}"));
            }
            if lines <= LONG && excused {
                faults.push(format!("{name}: {lines} lines, no longer needs its excuse"));
            }
            if path.iter().any(|part| REFUSED_NAMES.contains(&part.to_str().unwrap().trim_end_matches(".rs"))) {
                faults.push(format!("{name}: the name says nothing"));
            }
        }
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn the_core_reads_no_clock_and_no_file() {
    let mut faults = Vec::new();
    for (name, module, code) in sources() {
        if ["cli", "wasm", "main"].contains(&module.as_str()) {
            continue;
        }
        let code = code.split("#[cfg(test)]").next().unwrap();
        for word in SHELL_ONLY {
            if code.contains(word) {
                faults.push(format!("src/{name}: `{word}` belongs into a shell"));
            }
        }
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn the_scanner_sees_grouped_and_plain_paths() {
    let code = "use crate::{automaton::{Edge, Ldgba}, env::X, rng::Rng};\nfn f() { crate::task::g(); my_crate::no(); }";
    let mut seen = imports(code);
    seen.sort();
    assert_eq!(seen, ["automaton", "env", "rng", "task"]);
}
