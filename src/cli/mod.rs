//! The command line: one file per command, each a `struct` of arguments with a `run`. Files, clock, threads and terminal live here.
//!
//! Exit codes: 0 done, 1 the answer is no or something failed while running, 2 the input is not what it must be.
//! Results go to standard output (`--json`: one JSON object per line), progress and errors to standard error.

pub mod bench;
mod card;
mod check;
mod classify;
mod command;
mod curves;
mod eval;
mod failure;
mod files;
mod logs;
mod output;
mod plot;
mod progress;
mod replay;
mod reproduce;
mod run;
pub mod schema;
mod train;
mod trajectory;
mod translate;

pub use command::{Cli, main};
pub use failure::Failure;
