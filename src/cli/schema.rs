//! `schema`: the JSON schema of task files, for editors and other tools.

use super::failure::Failure;
use super::output::out;
use crate::task::TaskFile;
use clap::Args;
use std::process::ExitCode;

/// Arguments of `schema`.
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  ltl-rover schema > specs/task.schema.json")]
pub struct Schema {}

/// The schema, as pretty JSON with a line end.
pub fn text() -> String {
    let schema = schemars::schema_for!(TaskFile);
    serde_json::to_string_pretty(&schema).expect("a schema has a form in JSON") + "\n"
}

impl Schema {
    /// Prints the schema.
    ///
    /// # Errors
    /// None.
    pub fn run(&self) -> Result<ExitCode, Failure> {
        out!("{}", text());
        Ok(ExitCode::SUCCESS)
    }
}
