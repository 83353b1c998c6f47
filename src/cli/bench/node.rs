//! A WebAssembly build under Node: a process that times what it is asked on its standard input, one line in, one line out.

use super::measure::{Contender, Measure};
use serde_json::Value;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// What loads the module, before the script of each benchmark.
const LOAD: &str = include_str!("../../../benches/wasm/load.mjs");
/// The script that holds Node's clock while the kernel works.
const KERNELS: &str = include_str!("../../../benches/wasm/kernels.mjs");

/// A Node process with a module loaded.
pub struct Node {
    child: Child,
    questions: ChildStdin,
    answers: BufReader<ChildStdout>,
}

impl Node {
    /// Starts Node with `module` and `script`, which answers each line of JSON with a line.
    ///
    /// # Errors
    /// If the file is not there or Node does not start.
    pub fn start(module: &Path, script: &str) -> Result<Node, String> {
        if !module.is_file() {
            return Err(format!("there is no file {}", module.display()));
        }
        let mut child = Command::new("node")
            .args(["--input-type=module", "--eval", &format!("{LOAD}\n{script}"), "--"])
            .arg(module)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| format!("node did not start: {error}"))?;
        let questions = child.stdin.take().expect("it is piped");
        let answers = BufReader::new(child.stdout.take().expect("it is piped"));
        Ok(Node { child, questions, answers })
    }

    /// The line with which the script answers `question`.
    ///
    /// # Errors
    /// If the process has ended.
    pub fn ask(&mut self, question: &Value) -> Result<String, String> {
        let gone = |error: std::io::Error| format!("node went away: {error}");
        writeln!(self.questions, "{question}").map_err(gone)?;
        let mut answer = String::new();
        self.answers.read_line(&mut answer).map_err(gone)?;
        Ok(answer)
    }
}

impl Drop for Node {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The kernel's build, `benches/wasm/kernels.rs`, as a contender.
pub struct Kernels(Node);

impl Kernels {
    /// Starts Node with `module`.
    ///
    /// # Errors
    /// If the file is not there or Node does not start.
    pub fn start(module: &Path) -> Result<Kernels, String> {
        Node::start(module, KERNELS).map(Kernels)
    }
}

impl Contender for Kernels {
    fn name(&self) -> &str {
        "fast kernel, wasm simd128, Node"
    }

    fn time(&mut self, measure: Measure, count: usize) -> Result<Option<f64>, String> {
        let mut question = serde_json::to_value(measure).expect("plain data has a form in JSON");
        question["count"] = count.into();
        let answer = self.0.ask(&question)?;
        let seconds: f64 = answer.trim().parse().map_err(|_| format!("node answered {:?}", answer.trim()))?;
        Ok(Some(seconds))
    }
}
