//! The WebAssembly build of the kernel under Node, as a contender: a process that times what it is asked on its standard input.

use super::measure::{Contender, Measure};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// The script that holds Node's clock.
const SCRIPT: &str = include_str!("../../../benches/wasm/kernels.mjs");

/// A Node process with the module loaded.
pub struct Node {
    child: Child,
    questions: ChildStdin,
    answers: BufReader<ChildStdout>,
}

impl Node {
    /// Starts Node with `module`, a build of `benches/wasm/kernels.rs`.
    ///
    /// # Errors
    /// If the file is not there or Node does not start.
    pub fn start(module: &Path) -> Result<Node, String> {
        if !module.is_file() {
            return Err(format!("there is no file {}", module.display()));
        }
        let mut child = Command::new("node")
            .args(["--input-type=module", "--eval", SCRIPT, "--"])
            .arg(module)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| format!("node did not start: {error}"))?;
        let questions = child.stdin.take().expect("it is piped");
        let answers = BufReader::new(child.stdout.take().expect("it is piped"));
        Ok(Node { child, questions, answers })
    }
}

impl Contender for Node {
    fn name(&self) -> &str {
        "fast kernel, wasm simd128, Node"
    }

    fn time(&mut self, measure: Measure, count: usize) -> Result<Option<f64>, String> {
        let mut question = serde_json::to_value(measure).expect("plain data has a form in JSON");
        question["count"] = count.into();
        let gone = |error: std::io::Error| format!("node went away: {error}");
        writeln!(self.questions, "{question}").map_err(gone)?;
        let mut answer = String::new();
        self.answers.read_line(&mut answer).map_err(gone)?;
        let seconds: f64 = answer.trim().parse().map_err(|_| format!("node answered {:?}", answer.trim()))?;
        Ok(Some(seconds))
    }
}

impl Drop for Node {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
